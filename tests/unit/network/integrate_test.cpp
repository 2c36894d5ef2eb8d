#include "network/integrate.h"

#include <doctest/doctest.h>

#include <cmath>

#include "num/trig.h"
#include "support/context.h"

using namespace wireskin;
using namespace wireskin::network;
using namespace unit;

struct Sensor {
  Heap heap;
  std::vector<uint32_t> start = {0}, point;
  uint32_t points = 0;
  std::vector<double> arc;
  std::vector<Vec3> tangent, position;
  std::vector<uint8_t> to_next;
  double residual = -1.0;

  void add(const std::vector<uint32_t>& own, const std::vector<double>& s,
           const std::vector<Vec3>& t, bool next) {
    for (uint32_t p : own) points = p + 1 > points ? p + 1 : points;
    point.insert(point.end(), own.begin(), own.end());
    arc.insert(arc.end(), s.begin(), s.end());
    tangent.insert(tangent.end(), t.begin(), t.end());
    to_next.push_back(next);
    start.push_back(static_cast<uint32_t>(arc.size()));
  }
  Status run() {
    position.assign(arc.size(), Vec3{9, 9, 9});
    return integrate_tangents(
        heap.context, {view(start), view(point), points, view(arc), view(tangent), view(to_next)},
        unit::span(position), &residual);
  }
};

TEST_CASE("straight steps, two components, each from its own origin") {
  Sensor sensor;
  const Vec3 x = {1, 0, 0}, y = {0, 1, 0}, z = {0, 0, 1};
  sensor.add({0, 1, 2}, {0, 1, 3}, {x, y, z}, true);
  sensor.add({3, 4}, {5, 7}, {z, z}, true);
  must(sensor.run());
  CHECK(length(sensor.position[2] - Vec3{1, 2, 0}) < 1e-15);
  CHECK(sensor.position[3] == Vec3{});
  CHECK(length(sensor.position[4] - Vec3{0, 0, 2}) < 1e-15);
  CHECK(sensor.residual < 1e-15);
}

TEST_CASE("circular arcs are exact however coarse, up to half turns") {
  for (const int n : {3, 5, 50}) {
    Sensor sensor;
    std::vector<uint32_t> own;
    std::vector<double> s;
    std::vector<Vec3> t;
    for (int i = 0; i <= n; ++i) {
      const double a = 1.5 * k_pi * i / n;
      own.push_back(static_cast<uint32_t>(i));
      s.push_back(2 * a);
      t.push_back({-std::sin(a), std::cos(a), 0});
    }
    sensor.add(own, s, t, false);
    must(sensor.run());
    for (int i = 0; i <= n; ++i) {
      const double a = 1.5 * k_pi * i / n;
      const Vec3 truth = {2 * std::cos(a) - 2, 2 * std::sin(a), 0};
      CHECK(length(sensor.position[static_cast<size_t>(i)] - truth) < 1e-11);  // rounding adds up
    }
  }
}

TEST_CASE("a loop that does not close spreads its gap by arc length") {
  // A square whose last side was measured too long: each side gives way in proportion.
  Sensor sensor;
  const Vec3 x = {1, 0, 0}, y = {0, 1, 0};
  sensor.add({0, 1, 2, 3, 0}, {0, 1, 2, 3, 4.4}, {x, y, -x, -y, x}, true);
  must(sensor.run());
  const double share = 0.4 / 4.4;  // of the gap, per unit of arc
  CHECK(length(sensor.position[1] - Vec3{1, share, 0}) < 1e-14);
  CHECK(length(sensor.position[2] - Vec3{1, 1 + 2 * share, 0}) < 1e-14);
  CHECK(sensor.position[4] == sensor.position[0]);
  CHECK(sensor.residual == doctest::Approx(std::sqrt((3 + 1.4 * 1.4) / 4) * share));
}

TEST_CASE("no allocation may fail unnoticed") {
  for (size_t i = 0;; ++i) {
    Sensor sensor;
    const Vec3 x = {1, 0, 0}, y = {0, 1, 0};
    sensor.add({0, 1, 2, 0}, {0, 1, 2, 3}, {x, y, x, x}, false);
    sensor.heap.allocator.fail_at = i;
    const Status status = sensor.run();
    CHECK(sensor.heap.allocator.clean());
    if (status.ok()) {
      CHECK(i > 10);
      break;
    }
    CHECK(status.code == Code::out_of_memory);
  }
}
