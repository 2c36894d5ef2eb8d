#include "flow/face_rims.h"

#include <doctest/doctest.h>

#include "flow/unseen_more.h"
#include "unit/flow/faces.h"

using namespace unit;
using flow_tests::Net;
using namespace wireskin::flow;

namespace {

struct Faults : RimsOf {
  using RimsOf::RimsOf;
  CurveFault fault(uint32_t arc) const {
    return fault_of(faces, lines, rims, arc, [](uint32_t) { return true; });
  }
};

}  // namespace

TEST_CASE("each edge of a cube has two faces, which make a crease") {
  const Faults cube(flow_tests::lattice(1, 1, 1));
  REQUIRE(cube.rims.arc_count() == 12);
  for (uint32_t a = 0; a < 12; ++a) {
    CHECK(cube.fault(a).faces == 2);
    CHECK_FALSE(cube.fault(a).flat);
  }
}

TEST_CASE("the edge between two squares in a plane has two that are flat") {
  const Faults grid(flow_tests::lattice(2, 1, 0));
  size_t flat = 0, one = 0;
  for (uint32_t a = 0; a < grid.rims.arc_count(); ++a) {
    flat += grid.fault(a).flat;
    one += grid.fault(a).faces == 1;
  }
  CHECK(flat == 1);
  CHECK(one == 6);
}

TEST_CASE("of the faces at an arc those count that are to count") {
  const Faults cubes(flow_tests::lattice(2, 1, 1));
  size_t three = 0;
  for (uint32_t a = 0; a < cubes.rims.arc_count(); ++a) {
    three += cubes.fault(a).faces == 3;
    const uint32_t first = cubes.rims.face[cubes.rims.rim[cubes.rims.start[a]]];
    const CurveFault only =
        fault_of(cubes.faces, cubes.lines, cubes.rims, a, [&](uint32_t f) { return f == first; });
    CHECK(only.faces == 1);
    CHECK(fault_of(cubes.faces, cubes.lines, cubes.rims, a, 0, [](uint32_t) {
            return true;
          }).faces == 0);
  }
  CHECK(three == 4);
}
