#include "flow/face_crossings.h"

#include <doctest/doctest.h>

#include "flow/unseen_more.h"
#include "unit/flow/faces.h"

using namespace unit;
using flow_tests::Net;
using namespace wireskin::flow;

namespace {

struct Across : LinesOf {
  CurvesAcross across{heap.context};

  explicit Across(const Net& net) : LinesOf(net) { must(find_curves_across(drawing, &across)); }
  FacePlane plane_of(uint32_t t) const {
    const Vec3& at = flow.complex.point[flow.complex.triangle[3 * size_t{t}]];
    return {at, wireskin::unit(cross_of_triangle(flow.complex, t)), 1e-3 * flow.complex.diagonal};
  }
  Vec3 middle_of(uint32_t t) const {
    const uint32_t* const v = &flow.complex.triangle[3 * size_t{t}];
    const auto& p = flow.complex.point;
    return (4.0 / 3.0) * (p[v[0]] + p[v[1]] + p[v[2]]);  // in the units of the net
  }
  // Triangles in the plane z = height, of some size, that a curve does or does not cross.
  size_t count(double height, bool crossed) {
    size_t found = 0;
    for (uint32_t t = 0; t < flow.complex.triangle_count(); ++t) {
      const uint32_t* const v = &flow.complex.triangle[3 * size_t{t}];
      bool within = area_of(t) > 1e-4;
      for (uint32_t k = 0; k < 3; ++k) {
        within = within && std::fabs(4.0 * flow.complex.point[v[k]].z - height) < 1e-3;
      }
      if (!within) continue;
      found += is_crossed(drawing, plane_of(t), t, t, &across) == crossed;
    }
    return found;
  }
};

}  // namespace

TEST_CASE("nothing crosses the triangles of a cube's faces") {
  Across cube(flow_tests::lattice(1, 1, 1));
  CHECK(cube.count(0.0, false) > 50);
  CHECK(cube.count(0.0, true) == 0);
}

// No sample lies in the hole, so triangles there have all their corners on its rim.
TEST_CASE("nothing crosses triangles within a hole, something those that reach over its rim") {
  Across square(flow_tests::box_with_hole(1.0));
  const auto off_middle = [](const Vec3& p) {
    return std::fmax(std::fabs(p.x - 1.5), std::fabs(p.y - 1.5));
  };
  size_t within = 0;
  for (uint32_t t = 0; t < square.flow.complex.triangle_count(); ++t) {
    const Vec3 p = square.middle_of(t);
    if (std::fabs(p.z) > 1e-6 || square.area_of(t) < 1e-3) continue;
    const uint32_t* const v = &square.flow.complex.triangle[3 * size_t{t}];
    bool inside = off_middle(p) < 0.5;
    for (uint32_t k = 0; k < 3; ++k) {
      inside = inside && off_middle(4.0 * square.flow.complex.point[v[k]]) < 0.5 + 1e-3;
    }
    if (!inside) continue;
    ++within;
    CHECK_FALSE(is_crossed(square.drawing, square.plane_of(t), t, t, &square.across));
  }
  CHECK(within > 50);
  Net turned = flow_tests::box_with_circles();
  for (Vec3& p : turned.vertex) p = {p.x, p.z, p.y};
  CHECK(Across(turned).count(0.0, false) > 50);
  CHECK(Across(turned).count(0.0, true) > 0);
}

TEST_CASE("a plane has what is within its tolerance") {
  const FacePlane plane = {{0, 0, 1}, {0, 0, 1}, 0.1};
  CHECK(near_plane(plane, {5, 5, 1.09}));
  CHECK(near_plane(plane, {5, 5, 0.91}));
  CHECK_FALSE(near_plane(plane, {0, 0, 1.11}));
}
