#include "flow/flat_cells.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "flow/unseen_more.h"
#include "unit/flow/prisms.h"

using namespace unit;
using flow_tests::Net;
using wireskin::flow::Need;
using wireskin::flow::Pass;

namespace {

struct Cells : FlowOf {
  explicit Cells(const Net& net) : FlowOf(net) {}

  size_t held() const {
    size_t count = 0;
    for (const auto& v : flow.persistence.voids) count += v.held;
    return count;
  }
  double length_of(Need need) const {
    double sum = 0.0;
    for (uint32_t e = 0; e < flow.complex.edge_count(); ++e) {
      if (!flow.curves.on_curve(e) || flow.cells.need[e] != need) continue;
      sum += length(flow.complex.point[flow.complex.edge[2 * e]] -
                    flow.complex.point[flow.complex.edge[2 * e + 1]]);
    }
    return 4.0 * sum;  // in the units of the net
  }
  size_t triangles(Pass turn) const {
    return size_t(std::count(flow.cells.turn.begin(), flow.cells.turn.end(), turn));
  }
};

Net without(Net net, size_t curve) {
  net.curve.erase(net.curve.begin() + std::ptrdiff_t(curve));
  return net;
}

}  // namespace

TEST_CASE("a cube is one cell, and all its edges are settled") {
  const Cells cube(flow_tests::lattice(1, 1, 1));
  CHECK(cube.held() == 1);
  CHECK(cube.length_of(Need::settled) == doctest::Approx(12.0).epsilon(1e-4));
  CHECK(cube.triangles(Pass::first) == 0);
}

TEST_CASE("a cross section whose rim is creases without it goes") {
  const Cells house(flow_tests::spire(1.0, 0.8));
  CHECK(house.held() == 1);
  CHECK(house.triangles(Pass::first) > 0);  // the floor of the attic
  CHECK(Cells(flow_tests::bipyramid(3, 1.5, 1.5)).held() == 1);
}

TEST_CASE("a wall whose rim would lie in flat faces without it stays") {
  CHECK(Cells(flow_tests::lattice(2, 1, 1)).held() == 2);
  CHECK(Cells(flow_tests::lattice(2, 2, 2)).held() == 8);
  CHECK(Cells(flow_tests::cubes_at({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}})).held() == 3);
}

TEST_CASE("a hole is outside, a boss is not") {
  CHECK(Cells(flow_tests::box_with_hole(1.0)).held() == 1);
  CHECK(Cells(flow_tests::box_with_hole(0.5)).held() == 1);
  CHECK(Cells(flow_tests::box_on_a_box()).held() == 1);
}

TEST_CASE("where an edge is missing no cell is closed, and the curves round it wait for a face") {
  const Cells open(without(flow_tests::lattice(1, 1, 1), 0));
  CHECK(open.held() == 0);
  CHECK(open.triangles(Pass::last) == 0);
  CHECK(open.triangles(Pass::late) > 0);
  CHECK(open.length_of(Need::waiting) == doctest::Approx(6.0).epsilon(1e-4));
  CHECK(open.length_of(Need::settled) == doctest::Approx(5.0).epsilon(1e-4));
}

TEST_CASE("curves that are not straight have no flat cells") {
  const Cells torus(flow_tests::torus_net(6, 4, 0.4, 12));
  CHECK(torus.triangles(Pass::last) + torus.triangles(Pass::late) == 0);
  CHECK(torus.held() == 0);
}
