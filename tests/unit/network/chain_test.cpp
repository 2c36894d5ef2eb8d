#include "network/chain.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "num/trig.h"
#include "support/wire_nets.h"

using namespace wireskin;
using namespace wireskin::network;
using namespace unit;

static std::vector<Vec3> circle(uint32_t n) {
  std::vector<Vec3> points;
  for (uint32_t i = 0; i < n; ++i) {
    points.push_back({std::cos(2 * k_pi * i / n), std::sin(2 * k_pi * i / n), 0});
  }
  return points;
}

// Two-point segments in any order and direction.
static void add_segments(WireNet& net, const std::vector<Vec3>& points, bool closed,
                         uint32_t seed) {
  std::vector<std::vector<Vec3>> segments;
  Random random(seed);
  for (size_t i = 0; i + (closed ? 0 : 1) < points.size(); ++i) {
    segments.push_back({points[i], points[(i + 1) % points.size()]});
    if (random() < 0.0) std::reverse(segments.back().begin(), segments.back().end());
  }
  std::shuffle(segments.begin(), segments.end(), random.engine);
  for (const auto& segment : segments) net.add(segment);
}

TEST_CASE("segments of circles, however coarse, become closed curves") {
  for (const uint32_t n : {7u, 8u, 12u, 100u}) {
    for (uint32_t seed = 1; seed <= 5; ++seed) {
      WireNet net;
      add_segments(net, circle(n), true, seed);
      net.weld();
      must(chain_wires(Chaining::automatic, 0.0, &net.wires));
      REQUIRE(net.wires.curves() == 1);
      CHECK(net.wires.closed[0] == 1);
      CHECK(net.wires.samples() == n);
      const std::vector<Vec3> points = net.points_of(0);
      for (uint32_t i = 0; i < n; ++i) {  // neighbours stay neighbours
        CHECK(length(points[(i + 1) % n] - points[i]) == doctest::Approx(2 * std::sin(k_pi / n)));
      }
    }
  }
}

TEST_CASE("a square stays four sides, a bend of 40 degrees in smooth curves two") {
  WireNet square;
  add_segments(square, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, true, 1);
  square.weld();
  must(chain_wires(Chaining::automatic, 0.0, &square.wires));
  CHECK(square.wires.curves() == 4);

  std::vector<Vec3> bent = line({0, 0, 0}, {1, 0, 0}, 5);
  const double angle = 40.0 * k_pi / 180.0;
  for (int i = 1; i <= 5; ++i) {
    bent.push_back({1 + 0.2 * i * std::cos(angle), 0.2 * i * std::sin(angle), 0});
  }
  for (const double corner : {0.0, 0.9}) {
    WireNet net;
    add_segments(net, bent, false, 2);
    net.weld();
    must(chain_wires(Chaining::automatic, corner, &net.wires));
    CHECK(net.wires.curves() == (corner == 0.0 ? 2 : 1));
  }
}

TEST_CASE("joints by number between long curves are the caller's") {
  for (const Chaining chaining : {Chaining::automatic, Chaining::all, Chaining::none}) {
    WireNet net;
    net.add(line({0, 0, 0}, {1, 0, 0}, 3), false, {}, {0, 1, 2, 3});
    net.add(line({1, 0, 0}, {2, 0, 0}, 3), false, {}, {3, 4, 5, 6});
    net.weld();
    must(chain_wires(chaining, 0.0, &net.wires));
    CHECK(net.wires.curves() == (chaining == Chaining::all ? 1 : 2));
  }
}

TEST_CASE("pieces keep their normals and origins when they are turned round") {
  WireNet net;
  const std::vector<Vec3> up(3, Vec3{0, 0, 1}), down(3, Vec3{0, 0, -1});
  net.add(line({0, 0, 0}, {1, 0, 0}, 2), false, up);
  net.add(line({2, 0, 0}, {1, 0, 0}, 2), false, down);
  net.weld();
  must(chain_wires(Chaining::automatic, 0.0, &net.wires));
  REQUIRE(net.wires.curves() == 1);
  REQUIRE(net.wires.samples() == 5);
  CHECK(net.wires.position[4] == Vec3{2, 0, 0});
  CHECK(net.wires.normal[4] == Vec3{0, 0, -1});
  CHECK(net.wires.origin[4].curve == 1);
  CHECK(net.wires.origin[4].sample == 0);
  CHECK(net.wires.along[3].curve == 1);
  CHECK(net.wires.along[3].sample == 0);
  CHECK(net.wires.along[3].backwards == 1);
  CHECK(net.wires.along[1].backwards == 0);
}

TEST_CASE("three ends at a point, or boundary beside inside, do not join") {
  WireNet net;
  net.add(line({0, 0, 0}, {1, 0, 0}, 3));
  net.add(line({0, 0, 0}, {-1, 0, 0}, 3));
  net.add(line({0, 0, 0}, {0, 1, 0}, 3));
  net.weld();
  must(chain_wires(Chaining::all, 0.0, &net.wires));
  CHECK(net.wires.curves() == 3);
  WireNet mixed;
  mixed.add(line({0, 0, 0}, {1, 0, 0}, 3));
  mixed.add(line({0, 0, 0}, {-1, 0, 0}, 3));
  mixed.wires.boundary[1] = 1;
  mixed.weld();
  must(chain_wires(Chaining::all, 0.0, &mixed.wires));
  CHECK(mixed.wires.curves() == 2);
}
