#include "planar/relax.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <random>
#include <vector>

#include "num/predicates.h"

using namespace wireskin;
using namespace wireskin::planar;

namespace {

struct Heap {
  static void* allocate(size_t bytes, void*) { return std::malloc(bytes); }
  static void release(void* memory, size_t, void*) { std::free(memory); }
  Context context{Allocator{allocate, release, nullptr}, 0, {}};
};

// A square with `side` points a side and as many random points inside as a lattice would have.
void make_square(Triangulation* t, uint32_t side, unsigned seed, uint32_t* first_free) {
  std::vector<Vec2> border;
  const Vec2 corners[] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  for (int k = 0; k < 4; ++k) {
    for (uint32_t i = 0; i < side; ++i) {
      border.push_back(corners[k] +
                       (static_cast<double>(i) / side) * (corners[(k + 1) % 4] - corners[k]));
    }
  }
  *first_free = k_box_corners + 4 * side;
  REQUIRE(begin_box({border.data(), border.size()}, t).ok());
  for (const Vec2& p : border) REQUIRE(insert_point(t, p).ok());
  for (uint32_t i = 0; i < 4 * side; ++i) {
    REQUIRE(recover_edge(t, k_box_corners + i, k_box_corners + (i + 1) % (4 * side)).ok());
  }
  std::mt19937 random(seed);
  for (uint32_t i = 0; i < side * side; ++i) {
    const double x = static_cast<double>(random()) * 0x1p-32,
                 y = static_cast<double>(random()) * 0x1p-32;
    REQUIRE(insert_point(t, {0.02 + 0.96 * x, 0.02 + 0.96 * y}).ok());
  }
  REQUIRE(mark_outside(t).ok());
}

std::vector<double> sorted_sines(const Triangulation& t) {
  std::vector<double> sines;
  for (const Triangle& triangle : t.triangles) {
    if ((triangle.flags & k_outside) != 0) continue;
    double least = 1.0;
    for (int i = 0; i < 3; ++i) {
      const Vec2 p = t.points[triangle.vertex[i]];
      const Vec2 u = t.points[triangle.vertex[(i + 1) % 3]] - p;
      const Vec2 v = t.points[triangle.vertex[(i + 2) % 3]] - p;
      least = std::min(least, cross(u, v) / (length(u) * length(v)));
    }
    sines.push_back(least);
  }
  std::sort(sines.begin(), sines.end());
  return sines;
}

}  // namespace

TEST_CASE("random points become even, the border stays, the triangulation stays Delaunay") {
  for (unsigned seed = 0; seed < 10; ++seed) {
    Heap heap;
    Triangulation t(heap.context);
    uint32_t first_free = 0;
    make_square(&t, 12, seed, &first_free);
    const std::vector<Vec2> before(t.points.begin(), t.points.end());
    const std::vector<double> sines_before = sorted_sines(t);
    Array<double> sizes(heap.context);
    REQUIRE(sizes.assign(t.points.size(), 1.0 / 12).ok());
    REQUIRE(relax(&t, sizes.span(), first_free, first_free, 20).ok());
    CHECK(std::memcmp(before.data(), t.points.data(), first_free * sizeof(Vec2)) == 0);
    const std::vector<double> sines = sorted_sines(t);
    CHECK(sines[0] >= sines_before[0]);
    CHECK(sines[sines.size() / 10] > sines_before[sines.size() / 10] + 0.1);
    size_t folded = 0, not_delaunay = 0;
    for (uint32_t i = 0; i < t.triangles.size(); ++i) {
      const uint32_t* v = t.triangles[i].vertex;
      if (!(orient2d(t.points[v[0]], t.points[v[1]], t.points[v[2]]) > 0.0)) ++folded;
      for (uint32_t h = 4 * i; h < 4 * i + 3; ++h) {
        const uint32_t g = t.twin(h);
        if (g == k_none || t.constrained(h)) continue;
        CHECK(t.twin(g) == h);
        if (incircle(t.points[v[0]], t.points[v[1]], t.points[v[2]], t.points[t.apex(g)]) > 0.0) {
          ++not_delaunay;
        }
      }
    }
    CHECK(folded == 0);
    CHECK(not_delaunay == 0);
  }
}

TEST_CASE("a vertex whose neighbours are at the wished distance stays") {
  Heap heap;
  Triangulation t(heap.context);
  std::vector<Vec2> points;
  for (int i = 0; i < 6; ++i)
    points.push_back({std::cos(i * 1.0471975511965976), std::sin(i * 1.0471975511965976)});
  points.push_back({0.0, 0.0});
  REQUIRE(begin_box({points.data(), points.size()}, &t).ok());
  for (const Vec2& p : points) REQUIRE(insert_point(&t, p).ok());
  for (uint32_t i = 0; i < 6; ++i) REQUIRE(recover_edge(&t, 4 + i, 4 + (i + 1) % 6).ok());
  REQUIRE(mark_outside(&t).ok());
  Array<double> sizes(heap.context);
  REQUIRE(sizes.assign(t.points.size(), 1.0).ok());
  REQUIRE(relax(&t, sizes.span(), 10, 10, 5).ok());
  CHECK((t.points[10].x == 0.0 && t.points[10].y == 0.0));
  // Put off its place, it comes back to within the least step.
  t.points[10] = {0.3, -0.2};
  REQUIRE(relax(&t, sizes.span(), 10, 10, 20).ok());
  CHECK(length(t.points[10]) < 0.02);
}
