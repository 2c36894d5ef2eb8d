#include "network/linking.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>

#include "support/meshes.h"

using namespace unit;
using namespace wireskin::network;

namespace {

struct Ribbon {
  Heap heap;
  Border border{heap.context};

  Ribbon() { must(border.start.push(0)); }
  // f(t) -> {position, normal} for t in [0, 1).
  template <typename F>
  void add(uint32_t n, const F& f) {
    for (uint32_t i = 0; i < n; ++i) {
      const std::pair<Vec3, Vec3> sample = f(2 * k_pi * i / n);
      must(border.vertex.push(border.size()));
      must(border.position.push(sample.first));
      must(border.normal.push(wireskin::unit(sample.second)));
    }
    must(border.start.push(border.size()));
  }
  int number() {
    int32_t found = 99;
    must(linking_number(border, &found));
    return found;
  }
};

// A circle whose normals turn `turns` times about it.
int twisted_circle(int turns, uint32_t n) {
  Ribbon r;
  r.add(n, [=](double t) {
    const Vec3 out = {std::cos(t), std::sin(t), 0};
    return std::make_pair(out,
                          std::cos(turns * t) * out + std::sin(turns * t) * Vec3{0.0, 0.0, 1.0});
  });
  return r.number();
}

}  // namespace

TEST_CASE("circles whose normals turn about them link their copy as often") {
  for (int turns : {-3, -1, 0, 1, 2}) {
    CAPTURE(turns);
    for (uint32_t n : {24u, 61u, 400u})
      CHECK(std::abs(twisted_circle(turns, n)) == std::abs(turns));
  }
  CHECK(twisted_circle(1, 50) == -twisted_circle(-1, 50));
}

TEST_CASE("the border of a Moebius band and knots are refused, bands and discs are not") {
  Ribbon moebius;
  moebius.add(200, [](double t) {
    const double a = 2 * t, w = 0.4, c = std::cos(t), s = std::sin(t);
    const Vec3 out = {std::cos(a), std::sin(a), 0}, up = {0, 0, 1};
    const Vec3 across = c * out + s * up;
    return std::make_pair(out + w * across, s * out - c * up);
  });
  CHECK(std::abs(moebius.number()) == 2);

  Ribbon trefoil;
  trefoil.add(160, [](double t) {
    return std::make_pair(Vec3{std::sin(t) + 2 * std::sin(2 * t), std::cos(t) - 2 * std::cos(2 * t),
                               -std::sin(3 * t)},
                          Vec3{0, 0, 1});
  });
  CHECK(std::abs(trefoil.number()) == 3);

  for (double twist : {0.0, 0.5, 2.0}) {  // a tube whose ends have other starts
    Ribbon tube;
    for (int end : {1, -1}) {
      tube.add(60, [=](double t) {
        const double a = end * t + end * twist;
        const Vec3 out = {std::cos(a), std::sin(a), 0};
        return std::make_pair(out + Vec3{0, 0, 1.0 * end}, out);
      });
    }
    CHECK(tube.number() == 0);
  }

  Ribbon sphere;  // no mirror takes this curve to itself
  sphere.add(150, [](double t) {
    const double up = 0.6 * std::sin(2 * t) + 0.4 * std::sin(3 * t + 0.5);
    const double round = t + 0.5 * std::sin(2 * t + 1);
    const Vec3 p = {std::cos(up) * std::cos(round), std::cos(up) * std::sin(round), std::sin(up)};
    return std::make_pair(p, p);
  });
  CHECK(sphere.number() == 0);

  Ribbon saddle;  // normals of z = x^2 - y^2
  saddle.add(90, [](double t) {
    const double x = std::cos(t), y = std::sin(t);
    return std::make_pair(Vec3{x, y, x * x - y * y}, Vec3{-2 * x, 2 * y, 1});
  });
  CHECK(saddle.number() == 0);
}

TEST_CASE("where normals are not known the number is not defined") {
  Ribbon r;
  r.add(40, [](double t) {
    const Vec3 out = {std::cos(t), std::sin(t), 0};
    return std::make_pair(
        out, t > 3.0 && t < 3.3 ? Vec3{} : std::cos(t) * out + Vec3{0, 0, std::sin(t)});
  });
  CHECK(r.number() == 0);
}
