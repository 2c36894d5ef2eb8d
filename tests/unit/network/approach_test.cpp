#include "network/approach.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "num/trig.h"
#include "support/wire_nets.h"

using namespace wireskin;
using namespace wireskin::network;
using namespace unit;

static std::vector<Approach> approaches_of(WireNet& net, double reach) {
  Array<uint32_t> curve(net.heap.context);
  Array<Approach> found(net.heap.context);
  must(curve_of_samples(net.wires, &curve));
  must(find_approaches(net.wires, curve.span(), reach, &found));
  return to_vector(found);
}

TEST_CASE("two lines that pass each other: one place each, their distance") {
  WireNet net;
  net.add(line({-1, 0, 0}, {1, 0, 0}, 7));
  net.add(line({0.1, -1, 0.05}, {0.1, 1, 0.05}, 9));
  CHECK(approaches_of(net, 0.04).empty());
  const std::vector<Approach> found = approaches_of(net, 0.06);
  REQUIRE(found.size() == 1);
  CHECK(found[0].distance == doctest::Approx(0.05));
  CHECK(length(found[0].at_a - Vec3{0.1, 0, 0}) < 1e-12);
  CHECK(length(found[0].at_b - Vec3{0.1, 0, 0.05}) < 1e-12);
}

TEST_CASE("crossings at samples are found once") {
  WireNet net;
  net.add(line({-1, 0, 0}, {1, 0, 0}, 8));
  net.add(line({0, -1, 0}, {0, 1, 0}, 8));
  const std::vector<Approach> found = approaches_of(net, 0.3);
  REQUIRE(found.size() == 1);
  CHECK(found[0].distance == 0.0);
  CHECK(found[0].a.edge == 4);
  CHECK(found[0].a.part == 0.0);
  CHECK(found[0].b.edge == 9 + 4);
}

TEST_CASE("a sample that lies on the other line is found whatever its last bits are") {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> even(-1.0, 1.0);
  for (int round = 0; round < 5000; ++round) {
    CAPTURE(round);
    const auto any = [&] { return Vec3{even(random), even(random), even(random)}; };
    const Vec3 d = wireskin::unit(any()), e = wireskin::unit(any()), crossing = 0.3 * any();
    if (length(cross(d, e)) < 0.3) continue;
    WireNet net;
    const double first = 0.5 + 0.05 * even(random);
    net.add(line(crossing - first * d, crossing + (1.0 - first) * d, 7));
    std::vector<Vec3> other;
    for (int k = -3; k <= 3; ++k) other.push_back(crossing + (k / 6.0) * e);
    net.add(other);
    const std::vector<Approach> found = approaches_of(net, 0.02);
    REQUIRE(!found.empty());
    CHECK(found[0].distance < 1e-12);
  }
}

TEST_CASE("coarse circles that cross between samples meet on their arcs, not their chords") {
  double before = 1.0;
  for (const uint32_t n : {12u, 24u, 48u}) {
    WireNet net;
    std::vector<Vec3> a, b;
    for (uint32_t i = 0; i < n; ++i) {
      const double s = 2 * k_pi * (i + 0.3) / n, t = 2 * k_pi * (i + 0.6) / n;
      a.push_back({std::cos(s), std::sin(s), 0});
      b.push_back({std::cos(t), 0, std::sin(t)});
    }
    net.add(a, true);
    net.add(b, true);
    const std::vector<Approach> found = approaches_of(net, 0.02);
    REQUIRE(found.size() == 2);
    const double error =
        std::max(length(found[0].at_a - Vec3{std::copysign(1.0, found[0].at_a.x), 0, 0}),
                 length(found[1].at_b - Vec3{std::copysign(1.0, found[1].at_b.x), 0, 0}));
    CHECK(error < 0.2 * before);  // of third order and better
    before = error;
  }
  CHECK(before < 2e-5);
}

TEST_CASE("random segments against brute force") {
  Random random(11);
  for (int round = 0; round < 30; ++round) {
    WireNet net;
    const uint32_t n = 40;
    for (uint32_t i = 0; i < n; ++i) {
      const Vec3 p = {random(), random(), random()};
      net.add({p, p + 0.4 * Vec3{random(), random(), random()}});
    }
    const double reach = 0.05;
    uint32_t expected = 0;
    for (uint32_t i = 0; i < n; ++i) {
      for (uint32_t k = i + 1; k < n; ++k) {
        const Vec3 p = net.wires.position[2 * i], d = net.wires.position[2 * i + 1] - p;
        const Vec3 q = net.wires.position[2 * k], e = net.wires.position[2 * k + 1] - q;
        double least = 1e9;  // convex in both parameters: alternate
        double s = 0.5, t = 0.5;
        double before = -1.0;
        for (int step = 0; step < 2000 && s != before; ++step) {
          before = s;
          t = std::clamp(dot(p + s * d - q, e) / dot(e, e), 0.0, 1.0);
          s = std::clamp(dot(q + t * e - p, d) / dot(d, d), 0.0, 1.0);
        }
        least = length(p + s * d - q - t * e);
        expected += least <= reach;
      }
    }
    CHECK(approaches_of(net, reach).size() == expected);
  }
}

TEST_CASE("curves that are all alone leave the caller no longer without a question") {
  WireNet net;
  constexpr uint32_t k_curves = 20000;
  for (uint32_t c = 0; c < k_curves; ++c) net.add(line({2.0 * c, 0, 0}, {2.0 * c + 1.0, 0, 0}, 1));
  net.heap.checkpoints = 0;
  CHECK(approaches_of(net, 0.01).empty());
  // One for 4096 samples of each pass over them, one for 512 edges that are compared with others.
  CHECK(net.heap.checkpoints >= 2 * k_curves / 4096 + k_curves / 512);
}
