#include "curves/sides.h"

#include <doctest/doctest.h>

#include "support/meshes.h"

using namespace unit;
using namespace wireskin::curves;

TEST_CASE("sides: sharp curves have their right normals there, smooth ones their own") {
  Heap heap;
  Curves curves(heap.context);
  std::vector<Vec3> position, left, right;
  const std::vector<uint32_t> start = {0, 9, 18};
  const std::vector<uint32_t> node(9, k_none);
  for (uint32_t c = 0; c < 2; ++c) {
    for (int i = 0; i < 9; ++i) {
      const double t = i / 8.0;
      position.push_back({t, static_cast<double>(c), 0.1 * t * t});
      left.push_back(wireskin::unit({0, std::sin(t), std::cos(t)}));
      right.push_back(c == 1 ? wireskin::unit({0, -std::sin(t), std::cos(t)}) : Vec3{});
    }
    must(add_curve(
        {view(position).part(start[c], 9), view(left).part(start[c], 9), view(node), false},
        &curves));
  }
  CHECK(curves.right.empty());
  CHECK(seen_from_right(curves, 1).normal.value.data() == curves[1].normal.value.data());
  const std::vector<uint8_t> sharp = {0, 1};
  must(fit_right_normals({view(start), view(right), view(sharp)}, &curves));
  for (uint32_t c = 0; c < 2; ++c) {
    const Curve from_left = curves[c], from_right = seen_from_right(curves, c);
    REQUIRE(from_right.arc.size() == 9);
    for (int i = 0; i < 80; ++i) {
      const double s = from_left.arc[8] * i / 80;
      const CurvePoint a = point_at(from_left, 0, 8, s), b = point_at(from_right, 0, 8, s);
      CHECK(a.position == b.position);
      const double x = a.position.x, sign = c == 0 ? 1.0 : -1.0;
      CHECK(wireskin::length(b.normal - Vec3{0, sign * std::sin(x), std::cos(x)}) < 2e-4);
    }
  }
}

TEST_CASE("sides: zero normals stay zero, and tell that there are none") {
  Heap heap;
  Curves curves(heap.context);
  const std::vector<Vec3> position = {{0, 0, 0}, {1, 0, 0}, {2, 1, 0}}, none(3);
  const std::vector<uint32_t> start = {0, 3}, node(3, k_none);
  const std::vector<uint8_t> sharp = {1};
  must(add_curve({view(position), view(none), view(node), false}, &curves));
  must(fit_right_normals({view(start), view(none), view(sharp)}, &curves));
  CHECK(!has_normals(curves[0]));
  CHECK(!has_normals(seen_from_right(curves, 0)));
  CHECK(point_at(curves[0], 0, 2, 0.5).normal == Vec3{});
}
