#include "network/snap.h"

#include <doctest/doctest.h>

#include "support/wire_nets.h"

using namespace wireskin;
using namespace wireskin::network;
using namespace unit;

struct Snapped : WireNet {
  SnapResult result{heap.context};
  WireCounts counts;

  void snap(double tolerance) {
    weld();
    must(snap_wires(tolerance, &wires, &result));
    Array<uint32_t> component(heap.context);
    must(count_wires(wires, &component, &counts));
  }
};

TEST_CASE("end to end: both meet in the middle") {
  Snapped net;
  net.add(line({-1, 0, 0}, {-0.01, 0, 0}, 20));
  net.add(line({0.01, 0.01, 0}, {1, 0, 0}, 20));
  net.snap(0.05);
  REQUIRE(net.result.snaps.size() == 1);
  CHECK(net.result.snaps[0].kind == SnapKind::end_end);
  CHECK(net.wires.position[20] == net.wires.position[21]);
  CHECK(length(net.wires.position[20] - Vec3{0, 0.005, 0}) < 1e-15);
  CHECK(net.counts.dangling == 2);
  CHECK(net.result.open_before == 1);
  CHECK(net.result.open_after == 0);
}

TEST_CASE("end to inside: the end comes, a sample is made, the other curve keeps its bits") {
  Snapped net;
  const std::vector<Vec3> other = line({-1, 0, 0}, {1, 0, 0}, 11);
  net.add(other);
  net.add(line({0.03, 0.02, 0}, {0.03, 1, 0}, 20));
  net.snap(0.05);
  REQUIRE(net.result.snaps.size() == 1);
  CHECK(net.result.snaps[0].kind == SnapKind::end_inside);
  REQUIRE(net.wires.size(0) == 13);
  CHECK(length(net.wires.position[6] - Vec3{0.03, 0, 0}) < 1e-12);
  CHECK(net.wires.position[13] == net.wires.position[6]);
  CHECK(net.wires.origin[6].curve == 0);
  CHECK(net.wires.origin[6].sample == 5);
  CHECK(net.wires.origin[6].part > 0.0);
  for (uint32_t i = 0; i < 12; ++i) CHECK(net.wires.position[i < 6 ? i : i + 1] == other[i]);
}

TEST_CASE("an end near a node goes to the node, which stays") {
  Snapped net;
  net.add(line({0, 0, 0}, {1, 0, 0}, 20), false, {}, {});
  net.add(line({0, 0, 0}, {0, 1, 0}, 20));
  net.add(line({0, 0, 0}, {0, 0, 1}, 20));
  net.add(line({-0.02, -0.01, 0}, {-1, -1, 0}, 20));
  net.snap(0.05);
  REQUIRE(net.result.snaps.size() == 1);
  CHECK(net.wires.position[net.wires.start[3]] == Vec3{0, 0, 0});
  CHECK(net.counts.nodes == 1);
}

TEST_CASE("a curve that overshoots another has its tip brought back") {
  Snapped net;
  net.add(line({-1, 0, 0}, {1, 0, 0}, 21));
  net.add(line({0, -0.03, 0.001}, {0, 1, 0.001}, 20));
  net.snap(0.05);
  REQUIRE(net.result.snaps.size() == 1);
  CHECK(net.result.snaps[0].kind == SnapKind::end_inside);
  CHECK(net.counts.dangling == 3);
  CHECK(std::fabs(net.wires.position[net.wires.start[1]].y) < 1e-12);
}

TEST_CASE("the tip of a curve that is connected just before stays") {
  Snapped net;
  net.add(line({-1, 0, 0}, {1, 0, 0}, 20));
  // Joined at the origin, where it goes on for a little.
  net.add({{0, -0.04, 0}, {0, 0, 0}, {0, 0.5, 0}, {0, 1, 0}});
  net.snap(0.05);
  CHECK(net.result.snaps.size() == 0);
}

TEST_CASE("a complete network is left alone even where its curves pass each other") {
  Snapped net;
  std::vector<Vec3> flat = line({0, 0, 0}, {1, 0, 0}, 10), arch = flat;
  for (size_t i = 1; i < 10; ++i) arch[i].z = 0.01;
  net.add(flat);
  net.add(arch);
  net.add({{0, 0, 0}, {0.5, 1, 0}, {1, 0, 0}});
  const std::vector<Vec3> before = to_vector(net.wires.position);
  net.snap(0.05);
  CHECK(net.result.snaps.size() == 0);
  CHECK(net.wires.samples() == before.size());
  for (uint32_t i = 0; i < before.size(); ++i) CHECK(net.wires.position[i] == before[i]);
}

TEST_CASE("one curve's ends close it") {
  Snapped net;
  net.add({{0, 0.01, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, -0.01, 0}});
  net.snap(0.05);
  REQUIRE(net.result.snaps.size() == 1);
  CHECK(net.counts.dangling == 0);
  CHECK(net.wires.position[0] == net.wires.position[4]);
}

TEST_CASE("random grids of lines with gaps at every crossing are joined") {
  for (uint32_t seed = 1; seed <= 20; ++seed) {
    Random random(seed);
    Snapped net;
    const uint32_t n = 5;
    for (uint32_t i = 0; i < n; ++i) {
      const double at = 0.25 * i;
      const auto off = [&] { return 0.004 * random(); };
      net.add(line({at + off(), 0, off()}, {at + off(), 1, off()}, 23));
      net.add(line({0, at + off(), off()}, {1, at + off(), off()}, 29));
    }
    net.snap(0.02);
    CHECK(net.counts.nodes == n * n);
    CHECK(net.counts.dangling == 0);
    CHECK(net.counts.components == 1);
  }
}

TEST_CASE("curves drawn on a surface: crossings stay where they are, however near they are") {
  // A fan of lines through three points within the tolerance of each other, no three at one point.
  Snapped net;
  net.add(line({-1, 0, 0}, {1, 0, 0}, 40));
  net.add(line({-1, -1.01, 1e-5}, {1, 0.99, 1e-5}, 41));
  net.add(line({-1, 1.02, -1e-5}, {1, -0.98, -1e-5}, 42));
  net.snap(0.05);
  CHECK(net.result.snaps.size() == 3);
  CHECK(net.counts.nodes == 3);
  for (const Snap& snap : net.result.snaps) CHECK(snap.distance < 3e-5);
}

TEST_CASE("curves drawn on a surface: those side by side stay apart where others join them") {
  Snapped net;
  for (const double x : {-0.5, 0.5}) net.add(line({x, -1, 0}, {x, 1, 0}, 40));
  // Nearest to each other between the two, half the tolerance.
  net.add(
      {{-1, 0.1, 1e-6}, {-0.4, 0.04, 1e-6}, {0, 0.0125, 1e-6}, {0.4, 0.04, 1e-6}, {1, 0.1, 1e-6}});
  net.add({{-1, -0.1, 0}, {-0.4, -0.04, 0}, {0, -0.0125, 0}, {0.4, -0.04, 0}, {1, -0.1, 0}});
  net.snap(0.05);
  CHECK(net.counts.nodes == 4);
  CHECK(net.counts.components == 1);
}

TEST_CASE("curves drawn on a surface: an end on a border is not taken away by a crossing near it") {
  Snapped net;
  net.add(line({-1, 0, 0}, {1, 0, 0}, 40));          // the border
  net.add(line({0.01, 0, 1e-6}, {0.01, 1, 0}, 40));  // ends on it
  net.add(line({-1, 0.02, 0}, {1, 0.04, 0}, 40));    // crosses that just before
  net.add(line({-0.51, -1, 0}, {-0.52, 1, 0}, 40));
  net.snap(0.05);
  CHECK(net.counts.nodes == 5);  // one where the third begins beside the border
  CHECK(net.wires.position[net.wires.start[1]].y == doctest::Approx(0.0));
  CHECK(net.result.snaps.size() == 5);
}

TEST_CASE("curves drawn on a surface: a point at a node keeps no curve from it") {
  for (const bool point : {false, true}) {
    CAPTURE(point);
    Snapped net;
    net.add(line({-1, 0, 0}, {1, 0, 0}, 40));
    net.add(line({0, -1, 0}, {0, 1, 0}, 40));
    net.add(line({-1, -1 + 0.004, 0.0018}, {1, 1 + 0.004, 0.0018}, 41));  // past the node
    if (point) net.add({{0, 0, 0}});
    net.snap(0.05);
    CHECK(net.counts.nodes == 1);
    CHECK(net.counts.components == 1);
  }
}
