#include "network/write_beads.h"

#include <doctest/doctest.h>

#include "support/strung_beads.h"

using namespace wireskin;
using namespace wireskin::network;
using namespace unit;

namespace {

struct Written : StrungBeads {
  Wires out{heap.context};

  void write(double detour) { must(write_beads(detour, &beads, &out)); }
};

}  // namespace

TEST_CASE("beads that were united are written as one point, the rest as it was") {
  Written net;
  net.add(line({0, 0, 0}, {4, 0, 0}, 4));
  net.add(line({0, 1, 0}, {4, 1, 0}, 4));
  net.add(line({0, 9, 0}, {4, 9, 0}, 4));
  net.string(1);
  net.beads.unite(net.beads.make_bead({1, 0.5}), net.beads.make_bead({6, 0.5}));
  net.write(0.0);
  REQUIRE(net.out.samples() == 17);
  CHECK(net.out.size(0) == 6);
  CHECK(net.out.point[2] == net.out.point[8]);
  // Two insides meet in the middle.
  CHECK(length(net.out.position[2] - Vec3{1.5, 0.5, 0}) < 1e-12);
  CHECK(net.out.position[8] == net.out.position[2]);
  CHECK(net.out.origin[2].sample == 1);
  CHECK(net.out.origin[2].part == 0.5);
  CHECK(net.out.points == 16);
  for (uint32_t i = 0; i < 5; ++i) CHECK(net.out.position[12 + i] == net.wires.position[10 + i]);
}

TEST_CASE("nodes stay, insides come to nodes and ends to insides") {
  Written net;
  net.add(line({0, 0, 0}, {4, 0, 0}, 4));
  net.add(line({2, 0, 0}, {2, 3, 0}, 3));
  net.add(line({2, -3, 0}, {2, -0.25, 0}, 3));
  net.add(line({3.5, 0.25, 0}, {3.5, 3, 0}, 3));
  net.string(2);
  net.beads.unite(2, 12);
  net.beads.unite(net.beads.make_bead({3, 0.5}), 13);
  net.write(0.0);
  CHECK(net.out.position[2] == Vec3{2, 0, 0});
  CHECK(net.out.position[net.out.start[3] - 1] == Vec3{2, 0, 0});
  CHECK(net.out.position[net.out.start[3]] == Vec3{3.5, 0, 0});
}

TEST_CASE("a short way from a new node back to itself is left out, unless no curve would remain") {
  for (const double detour : {0.5, 2.0}) {
    Written net;
    net.add({{0, 0, 0}, {1, 0, 0}, {1.2, 0.2, 0}, {1, 0.1, 0}, {1, 2, 0}});
    net.add({{5, 0, 0}, {5.1, 0.1, 0}, {5, 0.1, 0}});
    net.string(2);
    net.beads.unite(1, 3);
    net.beads.unite(5, 7);
    net.write(detour);
    CHECK(net.out.size(0) == (detour < 1.0 ? 5 : 3));
    CHECK(net.out.size(1) == 3);
  }
}
