#include "flow/flat_lids.h"

#include <doctest/doctest.h>

#include "flow/round.h"
#include "unit/flow/faces.h"

using namespace unit;
using flow_tests::Net;
using namespace wireskin::flow;

namespace {

struct LidsOf : CellsOf {
  wireskin::Array<uint32_t> lids{heap.context};

  LidsOf(const Net& net, Lids which) : CellsOf(net) {
    merge();
    must(find_lids(heap.context, drawing, faces, which, &rims, &lids));
  }
};

}  // namespace

TEST_CASE("a can has two lids, of which none is the only one") {
  const Net can = flow_tests::stack({{1, 0}, {1, 2}}, 4);
  const LidsOf all(can, Lids::all);
  CHECK(all.count(FaceState::dangling) == 2);
  CHECK(all.lids.size() == 2);
  const LidsOf single(can, Lids::single);
  CHECK(single.count(FaceState::dangling) == 0);
  CHECK(single.lids.size() == 2);
}

TEST_CASE("a cone has one lid") {
  const Net cone = flow_tests::pointed({{1, 0}}, 4, 2.0);
  CHECK(LidsOf(cone, Lids::single).count(FaceState::dangling) == 1);
  const LidsOf none(cone, Lids::none);
  CHECK(none.count(FaceState::dangling) == 0);
  CHECK(none.lids.size() == 1);
}

TEST_CASE("what walls leave to both sides is a section, open where there are lids") {
  const LidsOf three(flow_tests::stack({{1, 0}, {0.7, 1}, {0.5, 2}}, 4), Lids::all);
  CHECK(three.count(FaceState::dangling) == 2);
  CHECK(three.count(FaceState::hole) == 1);
  const LidsOf sphere(flow_tests::great_circles(), Lids::all);
  CHECK(sphere.count(FaceState::dangling) + sphere.count(FaceState::hole) == 0);
  CHECK(sphere.lids.empty());
}

TEST_CASE("circles that a torus lies flat on are no lids") {
  const LidsOf torus(flow_tests::torus_net(12, 8, 0.6, 6), Lids::all);
  CHECK(torus.count(FaceState::dangling) == 0);
}

TEST_CASE("a circle alone is no lid, two in a row neither") {
  CHECK(LidsOf(flow_tests::stack({{1, 0}, {1, 1}}, 0), Lids::all).lids.empty());
  CHECK(LidsOf(flow_tests::stack({{1, 0}, {1, 1}}, 0), Lids::all).count(FaceState::dangling) == 0);
}

TEST_CASE("where a knob stands on a box there is a hole, and a lid at its end") {
  const LidsOf knob(flow_tests::box_with_knob(4), Lids::single);
  CHECK(knob.count(FaceState::hole) == 1);
  CHECK(knob.count(FaceState::dangling) == 7);  // with the sides of the box
}

TEST_CASE("a curve that ends in mid-air shows no wall") {
  Net can = flow_tests::stack({{1, 0}, {1, 2}}, 4);
  for (uint32_t k = 0; k < 4; ++k) {
    const uint32_t v = flow_tests::k_round + k * flow_tests::k_round / 4;
    can.edge(v, can.add(1.3 * can.vertex[v]));
  }
  CHECK(LidsOf(can, Lids::all).count(FaceState::dangling) == 2);
}

TEST_CASE("each network has its own lids") {
  Net two = flow_tests::pointed({{1, 0}}, 4, 2.0);
  const Net other = flow_tests::pointed({{1, 0}}, 6, 2.0);
  const uint32_t first = uint32_t(two.vertex.size());
  for (const Vec3& p : other.vertex) two.add(p + Vec3{5, 0, 0});
  for (std::vector<uint32_t> curve : other.curve) {
    for (uint32_t& v : curve) v += first;
    two.curve.push_back(curve);
  }
  CHECK(LidsOf(two, Lids::single).count(FaceState::dangling) == 2);
}
