#include "mesh/nearest.h"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

using namespace wireskin;

static bool same(const Vec2& a, const Vec2& b) {
  return a.x == b.x && a.y == b.y;
}

TEST_CASE("the nearest place of a triangle") {
  const Vec3 a = {0, 0, 0}, b = {2, 0, 0}, c = {0, 2, 0};
  std::mt19937 random(5);
  std::uniform_real_distribution<double> some(-3.0, 3.0);
  for (int k = 0; k < 500; ++k) {
    const Vec3 p = {some(random), some(random), some(random)};
    const Vec3 w = mesh::nearest_weights(p, a, b, c);
    CHECK(w.x + w.y + w.z == doctest::Approx(1.0));
    const double found = length(w.x * a + w.y * b + w.z * c - p);
    double least = 1e9;
    for (int i = 0; i <= 60; ++i) {
      for (int j = 0; i + j <= 60; ++j) {
        least = std::fmin(least, length((i / 60.0) * b + (j / 60.0) * c - p));
      }
    }
    CHECK(found <= least + 1e-12);
    CHECK(found > least - 0.05);
  }
}

TEST_CASE("corners that are not touched have the weight zero, whatever side the point is on") {
  const Vec3 a = {0, 0, 0}, b = {2, 0, 0}, c = {0, 2, 0};
  CHECK(mesh::nearest_weights({1, -1, 3}, a, b, c) == Vec3{0.5, 0.5, 0});
  CHECK(mesh::nearest_weights({3, 3, 1}, a, b, c) == Vec3{0, 0.5, 0.5});
  CHECK(mesh::nearest_weights({-1, 0.5, 0}, a, b, c) == Vec3{0.75, 0, 0.25});
  CHECK(mesh::nearest_weights({-1, -1, 0}, a, b, c) == Vec3{1, 0, 0});
  CHECK(same(mesh::nearest_weights({5, 0, 1}, a, b), {0, 1}));
  CHECK(same(mesh::nearest_weights({0.5, 2, 1}, a, b), {0.75, 0.25}));
}

TEST_CASE("triangles and segments without size have a nearest point") {
  const Vec3 a = {0, 0, 0}, b = {2, 0, 0};
  CHECK(same(mesh::nearest_weights({1, 1, 1}, a, a), {1, 0}));
  const Vec3 w = mesh::nearest_weights({1, 1, 0}, a, b, a);
  CHECK(w.x + w.z == doctest::Approx(0.5));
  CHECK(w.y == doctest::Approx(0.5));
}

TEST_CASE(
    "a place is on the border where all corners that carry it are, but not inside a triangle") {
  const uint32_t triangle[3] = {0, 1, 7};
  CHECK(mesh::is_on_border({0.5, 0.5, 0}, triangle, 2));
  CHECK(mesh::is_on_border({0, 1, 0}, triangle, 2));
  CHECK(!mesh::is_on_border({0.5, 0, 0.5}, triangle, 2));
  CHECK(!mesh::is_on_border({0, 0, 1}, triangle, 2));
  CHECK(!mesh::is_on_border({0.2, 0.3, 0.5}, triangle, 8));
}
