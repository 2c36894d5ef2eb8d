#include "num/vec.h"

#include <doctest/doctest.h>

#include "support/context.h"

using namespace unit;
using wireskin::cross;
using wireskin::dot;
using wireskin::length;
using wireskin::reject;

TEST_CASE("vec: products in the plane") {
  const Vec2 a = {3, 4}, b = {-2, 5};
  CHECK(dot(a, b) == 14);
  CHECK(cross(a, b) == 23);
  CHECK(cross(b, a) == -23);
  CHECK(length(a) == 5);
  CHECK((a + b).x == 1);
  CHECK((a - b).y == -1);
  CHECK((2.0 * a).y == 8);
}

TEST_CASE("vec: products in space") {
  const Vec3 x = {1, 0, 0}, y = {0, 1, 0}, z = {0, 0, 1};
  CHECK(cross(x, y) == z);
  CHECK(cross(y, z) == x);
  CHECK(cross(z, x) == y);
  const Vec3 a = {1, 2, 3}, b = {4, -5, 6};
  CHECK(dot(a, b) == 12);
  CHECK(cross(a, b) == Vec3{27, 6, -13});
  CHECK(length(Vec3{2, 3, 6}) == 7);
  CHECK(-a == Vec3{-1, -2, -3});
  CHECK(a != b);
  CHECK(a != Vec3{1, 2, 4});
  Vec3 sum = a;
  sum += b;
  CHECK(sum == Vec3{5, -3, 9});
  sum -= a;
  CHECK(sum == b);
  CHECK(0.5 * b == Vec3{2, -2.5, 3});
}

TEST_CASE("vec: unit vectors, and what is left across them") {
  CHECK(wireskin::unit(Vec3{0, -8, 0}) == Vec3{0, -1, 0});
  CHECK(wireskin::unit(Vec3{}) == Vec3{});
  Random random(3);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 a = {random(), random(), random()}, n = wireskin::unit({random(), random(), 2.0});
    CHECK(length(n) == doctest::Approx(1.0).epsilon(1e-15));
    const Vec3 across = reject(a, n);
    CHECK(std::fabs(dot(across, n)) < 1e-15);
    CHECK(length(a - across - dot(a, n) * n) < 1e-15);
  }
}
