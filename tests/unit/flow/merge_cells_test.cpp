#include "flow/merge_cells.h"

#include <doctest/doctest.h>

#include <set>

#include "flow/unseen_more.h"
#include "unit/flow/faces.h"

using namespace unit;
using flow_tests::Net;
using namespace wireskin::flow;

namespace {

struct MergedOf : CellsOf {
  using CellsOf::CellsOf;
  size_t cell_count() {
    std::set<uint32_t> roots;
    for (uint32_t i = 0; i < cells.forest.parent.size(); ++i) roots.insert(cells.forest.root_of(i));
    return roots.size();
  }
};

// A plate with n square holes in a row, or rows of them.
Net plate_with_holes(int n, int rows) {
  Net net;
  flow_tests::add_box(net, {0, 0, 0}, {2.0 * n + 1, 2.0 * rows + 1, 1});
  for (int i = 0; i < n; ++i) {
    for (int k = 0; k < rows; ++k) {
      flow_tests::add_box(net, {2.0 * i + 1, 2.0 * k + 1, 0}, {2.0 * i + 2, 2.0 * k + 2, 1});
    }
  }
  return net;
}

}  // namespace

TEST_CASE("two boxes in a row stay two cells beside the outside") {
  MergedOf boxes(flow_tests::lattice(2, 1, 1));
  CHECK(boxes.cell_count() == 3);
  boxes.merge();
  CHECK(boxes.cell_count() == 3);
  CHECK(boxes.count(FaceState::inner) == 0);
}

TEST_CASE("the room below a spire and that within are one") {
  MergedOf spire(flow_tests::spire(1.0, 0.8));
  const size_t before = spire.cell_count();
  spire.merge();
  CHECK(before == 3);
  CHECK(spire.cell_count() == 2);
  CHECK(spire.count(FaceState::parting) == 9);
}

TEST_CASE("every hole of a plate becomes outside, and no face is left in it") {
  for (const auto& grid : {std::pair<int, int>{1, 1}, {4, 1}, {3, 3}}) {
    const int n = grid.first, rows = grid.second;
    CAPTURE(n);
    MergedOf plate(plate_with_holes(n, rows));
    const size_t holes = size_t(n * rows);
    CHECK(plate.cell_count() == 2 + holes);
    plate.merge();
    CHECK(plate.cell_count() == 2);
    CHECK(plate.count(FaceState::inner) == 2 * holes);
    CHECK(plate.count(FaceState::parting) == 6 + 4 * holes);
  }
}

TEST_CASE("a wireframe without flat faces is one cell") {
  MergedOf torus(flow_tests::torus_net(6, 4, 0.4, 12));
  CHECK(torus.cell_count() == 1);
  torus.merge();
  CHECK(torus.cell_count() == 1);
}
