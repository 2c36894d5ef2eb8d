#include "network/grouping.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "support/curve_nets.h"

using namespace unit;
using namespace wireskin::network;

namespace {

struct Groups {
  Stages stages;
  Grouping grouping;

  explicit Groups(const CurveNet& net)
      : stages(net), grouping(stages.heap.context, stages.vertices, &stages.network) {
    REQUIRE(stages.resample(0.5));
    must(take_components(&grouping));
  }
  std::vector<uint32_t> members(uint32_t p) {
    std::vector<uint32_t> all;
    uint32_t q = p;
    do {
      all.push_back(q);
      q = grouping.next[q];
    } while (q != p);
    std::sort(all.begin(), all.end());
    return all;
  }
};

}  // namespace

TEST_CASE("grouping: groups are walked all the way round") {
  Groups g(torus_net(6, 6));
  const uint32_t n = g.stages.network.patches();
  REQUIRE(n == 36);
  std::vector<uint32_t> label(n);
  for (uint32_t p = 0; p < n; ++p) label[p] = p;
  std::mt19937 random(3);
  for (int k = 0; k < 60; ++k) {
    const uint32_t a = random() % n, b = random() % n;
    g.grouping.join(a, b);
    const uint32_t from = label[b], to = label[a];
    for (uint32_t& l : label) l = l == from ? to : l;
    for (uint32_t p = 0; p < n; ++p) {
      std::vector<uint32_t> expected;
      for (uint32_t q = 0; q < n; ++q) {
        if (label[q] == label[p]) expected.push_back(q);
      }
      CHECK(g.members(p) == expected);
      CHECK(g.grouping.root(p) == expected[0]);
      CHECK(g.grouping.is_alone(p) == (expected.size() == 1));
    }
  }
}

TEST_CASE("grouping: groups share a vertex where cycles of theirs do") {
  CurveNet net = octant_net();
  net.add_circle({9, 0, 0}, 1, true);
  Groups g(net);
  REQUIRE(g.stages.network.patches() == 9);
  uint32_t ring = 0;
  while (!g.stages.network.ring[ring]) ++ring;
  int meet = 0;
  for (uint32_t a = 0; a < 9; ++a) {
    for (uint32_t b = 0; b < 9; ++b) meet += share_vertex(&g.grouping, a, b);
    CHECK(share_vertex(&g.grouping, a, ring) == (a == ring));
  }
  // Each octant meets all but the opposite one, and itself.
  CHECK(meet == 8 * 7 + 1);
  g.grouping.join(ring, ring == 0 ? 1 : 0);
  meet = 0;
  for (uint32_t a = 0; a < 9; ++a) meet += share_vertex(&g.grouping, ring, a);
  CHECK(meet == 8);
  for (uint8_t passed : g.grouping.passed) CHECK(passed == 0);
}

TEST_CASE("grouping: corners and the patches at them") {
  Groups g(octant_net());
  for (uint32_t p = 0; p < 8; ++p) {
    REQUIRE(g.grouping.corner[p].size() == 3);
    for (uint32_t v : g.grouping.corner[p]) {
      CHECK(g.grouping.at_corner[v].size() == 4);
      bool found = false;
      for (uint32_t q : g.grouping.at_corner[v]) found = found || q == p;
      CHECK(found);
    }
  }
}
