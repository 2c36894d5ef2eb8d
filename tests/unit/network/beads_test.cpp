#include "network/beads.h"

#include <doctest/doctest.h>

#include "support/wire_nets.h"

using namespace wireskin;
using namespace wireskin::network;
using namespace unit;

struct Strung : WireNet {
  Beads beads{wires};

  void string(size_t joints) {
    weld();
    must(curve_of_samples(wires, &beads.curve));
    must(beads.string_samples(joints));
  }
};

TEST_CASE(
    "beads made between samples stand in the order of the curve, whatever order they came in") {
  Strung net;
  net.add(line({0, 0, 0}, {3, 0, 0}, 3));
  net.string(2);
  const uint32_t late = net.beads.make_bead({1, 0.75}), early = net.beads.make_bead({1, 0.25});
  CHECK(net.beads.bead[1].next == early);
  CHECK(net.beads.bead[early].next == late);
  CHECK(net.beads.bead[late].next == 2);
  CHECK(net.beads.bead[2].previous == late);
  CHECK(net.beads.bead[early].to_next == doctest::Approx(0.5));
  CHECK(net.beads.make_bead({1, 0.25}) == early);  // there is one already
  CHECK(net.beads.make_bead({1, 0.0}) == 1);       // a sample serves
  const BeadPlace place = net.beads.locate({1, 0.5});
  CHECK(place.bead == early);
  CHECK(place.behind == doctest::Approx(0.25));
}

TEST_CASE("the nearest special bead: an end within reach, else none") {
  Strung net;
  net.add(line({0, 0, 0}, {10, 0, 0}, 10));
  net.string(1);
  CHECK(net.beads.special_near({2, 0.0}, 2.5) == 0);
  CHECK(net.beads.special_near({9, 0.0}, 2.5) == 10);
  CHECK(net.beads.special_near({5, 0.0}, 2.5) == k_none);
  const WirePlace place = net.beads.nearest_place({4, 0.0}, {5.5, 1, 0}, 3.0);
  CHECK(place.edge == 5);
  CHECK(place.part == doctest::Approx(0.5));
}

TEST_CASE("beads that were united are written as one point, the rest as it was") {
  Strung net;
  net.add(line({0, 0, 0}, {4, 0, 0}, 4));
  net.add(line({0, 1, 0}, {4, 1, 0}, 4));
  net.string(1);
  net.beads.unite(net.beads.make_bead({1, 0.5}), net.beads.make_bead({6, 0.5}));
  Wires out(net.heap.context);
  must(write_beads(&net.beads, &out));
  REQUIRE(out.samples() == 12);
  CHECK(out.size(0) == 6);
  CHECK(out.point[2] == out.point[8]);
  CHECK(length(out.position[2] - Vec3{1.5, 0.5, 0}) < 1e-12);  // two insides meet in the middle
  CHECK(out.position[8] == out.position[2]);
  CHECK(out.origin[2].sample == 1);
  CHECK(out.origin[2].part == 0.5);
  CHECK(out.points == 11);
}
