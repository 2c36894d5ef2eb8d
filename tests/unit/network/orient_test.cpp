#include "network/orient.h"

#include <doctest/doctest.h>

#include <cmath>

#include "num/trig.h"
#include "support/wire_nets.h"

using namespace wireskin;
using namespace wireskin::network;
using namespace unit;

static std::vector<Contradiction> orient(WireNet& net) {
  Array<uint8_t> turned(net.heap.context);
  Array<Contradiction> contradictions(net.heap.context);
  net.weld();
  must(orient_along(&net.wires, &turned, &contradictions));
  must(orient_across(&net.wires, turned.span(), &contradictions));
  return to_vector(contradictions);
}

// Octagons: normals turn by 45 degrees from one sample to the next.
static std::vector<Vec3> ring(int axis, uint32_t n) {
  std::vector<Vec3> points;
  for (uint32_t i = 0; i < n; ++i) {
    const double a = 2 * k_pi * i / n, c = std::cos(a), s = std::sin(a);
    const double snap = 1e-9;
    const auto r = [&](double x) {
      return std::fabs(x) < snap                  ? 0.0
             : std::fabs(std::fabs(x) - 1) < snap ? std::copysign(1.0, x)
                                                  : x;
    };
    points.push_back(axis == 0   ? Vec3{0, r(c), r(s)}
                     : axis == 1 ? Vec3{r(s), 0, r(c)}
                                 : Vec3{r(c), r(s), 0});
  }
  return points;
}

TEST_CASE("any signs on three rings of the sphere come out outward") {
  for (const uint32_t n : {4u, 8u, 40u}) {
    for (uint32_t seed = 1; seed <= 10; ++seed) {
      Random random(seed);
      WireNet net;
      for (int axis = 0; axis < 3; ++axis) {
        std::vector<Vec3> normals = ring(axis, n);
        for (Vec3& m : normals) m = random() < 0.0 ? -m : m;
        net.add(ring(axis, n), true, normals);
      }
      CHECK(orient(net).empty());
      // All alike; outward unless two thirds of the given ones said otherwise.
      const double sign = dot(net.wires.normal[0], net.wires.position[0]);
      for (uint32_t i = 0; i < net.wires.samples(); ++i) {
        CHECK(dot(net.wires.normal[i], net.wires.position[i]) == doctest::Approx(sign));
      }
      if (n == 40) CHECK(sign > 0.0);
    }
  }
}

TEST_CASE("a Moebius band contradicts itself, at a named place") {
  WireNet net;
  std::vector<Vec3> points, normals;
  for (int i = 0; i < 60; ++i) {
    const double a = 2 * k_pi * i / 60;
    const Vec3 out = {std::cos(a), std::sin(a), 0};
    points.push_back(out);
    normals.push_back(std::cos(0.5 * a) * out + Vec3{0, 0, std::sin(0.5 * a)});
  }
  net.add(points, true, normals);
  const std::vector<Contradiction> found = orient(net);
  REQUIRE(found.size() == 1);
  CHECK(found[0].a.sample == 59);
  CHECK(found[0].b.sample == 0);
}

TEST_CASE("signs that agree already stay, inward ones too") {
  WireNet net;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<Vec3> normals = ring(axis, 16);
    for (Vec3& m : normals) m = -m;
    net.add(ring(axis, 16), true, normals);
  }
  const std::vector<Vec3> before = to_vector(net.wires.normal);
  CHECK(orient(net).empty());
  for (uint32_t i = 0; i < before.size(); ++i) CHECK(net.wires.normal[i] == before[i]);
}
