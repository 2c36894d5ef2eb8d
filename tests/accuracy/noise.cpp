#include "accuracy/noise.h"

#include <algorithm>

namespace accuracy {

using namespace networks;  // its operators on points are not found otherwise

namespace {

class Gaussian {
 public:
  explicit Gaussian(uint64_t seed) : state_(seed) {}

  double next() {
    const double radius = std::sqrt(-2.0 * std::log(uniform()));
    return radius * std::cos(2.0 * 3.14159265358979323846 * uniform());
  }

 private:
  // In (0, 1].
  double uniform() {
    state_ += 0x9e3779b97f4a7c15u;
    uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return (static_cast<double>((z ^ (z >> 31)) >> 11) + 1.0) * 0x1p-53;
  }

  uint64_t state_;
};

}  // namespace

Network with_noise(Network network, double position, double degrees, uint64_t seed) {
  Gaussian gaussian(seed);
  const double angle = degrees * 3.14159265358979323846 / 180.0;
  for (size_t i = 0; i < network.positions.size(); ++i) {
    for (double& x : network.positions[i]) x += position * gaussian.next();
    const Point n = unit(network.normals[i]);
    const auto [e, f] = tangent_frame(n);
    const double a = angle * gaussian.next();
    const double b = angle * gaussian.next();
    network.normals[i] = unit(n + a * e + b * f);
  }
  return network;
}

double diagonal(const Network& network) {
  Point low = network.positions[0], high = low;
  for (const Point& p : network.positions) {
    for (size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], p[k]);
      high[k] = std::max(high[k], p[k]);
    }
  }
  return distance(low, high);
}

}  // namespace accuracy
