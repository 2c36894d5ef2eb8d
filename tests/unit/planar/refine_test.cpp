#include "planar/refine.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "num/predicates.h"

using namespace wireskin;
using namespace wireskin::planar;

namespace {

constexpr double k_pi = 3.14159265358979323846;

struct Refined {
  static void* allocate(size_t bytes, void*) { return std::malloc(bytes); }
  static void release(void* memory, size_t, void*) { std::free(memory); }

  Context context{Allocator{allocate, release, nullptr}, 0, {}};
  Triangulation t{context};
  Array<double> sizes{context};
  uint32_t first_free = 0;

  Refined(const std::vector<Vec2>& border, double size, double spacing, size_t most = 1000000) {
    const uint32_t count = static_cast<uint32_t>(border.size());
    first_free = k_box_corners + count;
    REQUIRE(begin_box({border.data(), count}, &t).ok());
    for (const Vec2& p : border) REQUIRE(insert_point(&t, p).ok());
    for (uint32_t i = 0; i < count; ++i) {
      REQUIRE(recover_edge(&t, k_box_corners + i, k_box_corners + (i + 1) % count).ok());
    }
    REQUIRE(mark_outside(&t).ok());
    REQUIRE(sizes.assign(first_free, size).ok());
    REQUIRE(refine(&t, &sizes, spacing, most).ok());
  }

  std::vector<double> least_angles() const {
    std::vector<double> angles;
    for (const Triangle& triangle : t.triangles) {
      if ((triangle.flags & k_outside) != 0) continue;
      double least = 180.0;
      for (int i = 0; i < 3; ++i) {
        const Vec2 p = t.points[triangle.vertex[i]];
        const Vec2 u = t.points[triangle.vertex[(i + 1) % 3]] - p;
        const Vec2 v = t.points[triangle.vertex[(i + 2) % 3]] - p;
        least = std::min(least, std::atan2(cross(u, v), dot(u, v)) * 180.0 / k_pi);
      }
      angles.push_back(least);
    }
    std::sort(angles.begin(), angles.end());
    return angles;
  }
};

std::vector<Vec2> disc(int count) {
  std::vector<Vec2> border;
  for (int i = 0; i < count; ++i) {
    border.push_back({std::cos(2 * k_pi * i / count), std::sin(2 * k_pi * i / count)});
  }
  return border;
}

}  // namespace

TEST_CASE("fronts alone fill a disc well") {
  const double spacing = 2 * k_pi / 120;
  const Refined r(disc(120), spacing, spacing);
  const std::vector<double> angles = r.least_angles();
  CHECK(angles[0] > 25.0);
  CHECK(angles[angles.size() / 2] > 45.0);
  const double expected = k_pi / (spacing * spacing * std::sqrt(3.0) / 2.0) - 60.0;
  CHECK(r.t.points.size() - r.first_free == doctest::Approx(expected).epsilon(0.25));
  CHECK(r.sizes.size() == r.t.points.size());
}

TEST_CASE("no two points come nearer than the least distance, no point lies in a border's lens") {
  const double spacing = 2 * k_pi / 60;
  const Refined r(disc(60), spacing, spacing);
  for (uint32_t i = r.first_free; i < r.t.points.size(); ++i) {
    const Vec2 p = r.t.points[i];
    for (uint32_t k = k_box_corners; k < i; ++k) {
      CHECK(length(p - r.t.points[k]) > 0.69 * spacing);
    }
    for (uint32_t k = 0; k < 60; ++k) {
      const Vec2 a = r.t.points[k_box_corners + k] - p;
      const Vec2 b = r.t.points[k_box_corners + (k + 1) % 60] - p;
      CHECK(dot(a, b) > -0.26 * length(a) * length(b));
      CHECK(cross(a, b) > 0.0);
    }
  }
}

TEST_CASE("sizes drift from the border's to the spacing at a limited rate a step") {
  const Refined r(disc(200), 2 * k_pi / 200, 0.2);
  double greatest = 0.0;
  for (uint32_t i = r.first_free; i < r.t.points.size(); ++i) {
    const double from_border = 1.0 - length(r.t.points[i]);
    CHECK(r.sizes[i] <= 2 * k_pi / 200 + 1.6 * k_size_growth * from_border + 1e-9);
    greatest = std::max(greatest, r.sizes[i]);
  }
  CHECK(greatest > 0.15);
  CHECK(r.least_angles()[0] > 22.0);
}

TEST_CASE("the greatest number of vertices is kept") {
  const Refined r(disc(60), 0.1, 0.001, 500);
  CHECK(r.t.points.size() == 500);
}

TEST_CASE("nothing is added where triangles are small enough") {
  const Refined r({{0, 0}, {1, 0}, {0.5, 0.8}}, 1.0, 1.0);
  CHECK(r.t.points.size() == r.first_free);
}
