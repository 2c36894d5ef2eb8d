#include "mesh/inverted.h"

#include <doctest/doctest.h>

#include <cmath>

#include "mesh/check.h"
#include "support/context.h"

using namespace unit;
using namespace wireskin;
using namespace wireskin::mesh;

namespace {

// A grid of n x n squares over the unit square, each in two triangles, counter-clockwise from
// above, raised by f.
struct Sheet {
  uint32_t n;
  std::vector<Vec3> position;
  std::vector<uint32_t> triangle, patch;

  template <typename Height>
  Sheet(uint32_t squares, Height f) : n(squares) {
    for (uint32_t j = 0; j <= n; ++j) {
      for (uint32_t i = 0; i <= n; ++i) {
        const double x = static_cast<double>(i) / n, y = static_cast<double>(j) / n;
        position.push_back({x, y, f(x, y)});
      }
    }
    for (uint32_t j = 0; j < n; ++j) {
      for (uint32_t i = 0; i < n; ++i) {
        const uint32_t a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
        triangle.insert(triangle.end(), {a, b, c, a, c, d});
        patch.insert(patch.end(), {0, 0});
      }
    }
  }
  uint32_t at(uint32_t i, uint32_t j) const { return j * (n + 1) + i; }
  Inverted find() const {
    Heap heap;
    Inverted inverted;
    must(find_inverted(heap.context, view(position), view(triangle), view(patch), &inverted));
    return inverted;
  }
  Code check() const {
    Heap heap;
    Expectations e;
    e.position = view(position);
    e.triangle = view(triangle);
    e.patch = view(patch);
    return wireskin::mesh::check(heap.context, e).code;
  }
};

double flat(double, double) {
  return 0.0;
}

}  // namespace

TEST_CASE("inverted: none on sound sheets, however they are curved or creased between patches") {
  CHECK(Sheet(8, flat).find().count == 0);
  CHECK(Sheet(20, [](double x, double y) { return std::sin(9 * x) * std::cos(7 * y); })
            .find()
            .count == 0);
  CHECK(Sheet(9, [](double x, double) { return 30 * std::fabs(x - 4.0 / 9); }).find().count == 0);
  Sheet folded(6, flat);  // along x = 1/2, one half onto the other, each a patch
  for (Vec3& p : folded.position) {
    if (p.x > 0.5) p = {1 - p.x, p.y, 0.001 * (p.x - 0.5)};
  }
  for (uint32_t t = 0; t < folded.patch.size(); ++t) folded.patch[t] = t / 2 % 6 >= 3;
  CHECK(folded.find().count == 0);
  CHECK(folded.check() == Code::ok);
}

TEST_CASE("inverted: a vertex pulled across the far side of its ring turns triangles over") {
  Sheet sheet(6, flat);
  const uint32_t v = sheet.at(3, 3);
  CHECK(sheet.check() == Code::ok);
  sheet.position[v] = {0.5 + 0.26, 0.5 + 0.02, 0.0};
  const Inverted inverted = sheet.find();
  CHECK(inverted.count >= 1);
  for (uint32_t k = 0; k < 3; ++k) {
    const Vec3& p = sheet.position[sheet.triangle[3 * inverted.first + k]];
    CHECK(length(p - sheet.position[v]) < 0.5);
  }
  const Vec3 *a = &sheet.position[sheet.triangle[3 * inverted.first]],
             *b = &sheet.position[sheet.triangle[3 * inverted.first + 1]],
             *c = &sheet.position[sheet.triangle[3 * inverted.first + 2]];
  CHECK(cross(*b - *a, *c - *a).z < 0.0);
  CHECK(sheet.check() == Code::bad_mesh);
}

TEST_CASE("inverted: an ear at a corner is judged by its other corners") {
  // Of three triangles in a row the last is folded back onto the others.
  Heap heap;
  const std::vector<Vec3> position{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.6, 0.1, 0}};
  const std::vector<uint32_t> triangle{0, 1, 2, 0, 2, 3, 2, 1, 4}, patch{0, 0, 0};
  Inverted inverted;
  must(find_inverted(heap.context, view(position), view(triangle), view(patch), &inverted));
  CHECK(inverted.count == 1);
  CHECK(inverted.first == 2);
}
