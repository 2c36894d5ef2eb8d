#include "curves/opposed.h"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

using wireskin::reject;
using wireskin::unit;
using wireskin::Vec3;
using wireskin::curves::opposed;

// A unit vector up to `degrees` from n.
static Vec3 near(const Vec3& n, double degrees, std::mt19937& random) {
  std::normal_distribution<double> normal;
  const Vec3 across = unit(reject(Vec3{normal(random), normal(random), normal(random)}, n));
  const double angle = degrees * std::acos(-1.0) / 180.0;
  return std::cos(angle) * n + std::sin(angle) * across;
}

TEST_CASE("on a circle a normal is opposed to its neighbours exactly where it is flipped") {
  for (const double turn : {1e-6, 0.1, 0.8, 1.5}) {
    const Vec3 a = {1, 0, 0}, b = {std::cos(turn), std::sin(turn), 0};
    CHECK(!opposed(a, b, b - a));
    CHECK(opposed(a, -b, b - a));
    CHECK(opposed(-a, b, a - b));
    CHECK(!opposed(-a, -b, b - a));
  }
}

TEST_CASE("at the corners of a cube, where normals turn by 70 degrees") {
  const Vec3 a = unit(Vec3{1, 1, 1}), b = unit(Vec3{-1, 1, 1});
  CHECK(!opposed(a, b, {-1, 0, 0}));
  CHECK(opposed(a, -b, {-1, 0, 0}));  // though they are 109 degrees apart only
}

TEST_CASE("30 degrees of noise at both ends neither look like a flip nor hide one") {
  std::mt19937 random(3);
  for (int k = 0; k < 20000; ++k) {
    const Vec3 n = near({0, 0, 1}, 0.0, random), chord = {1, 0, 0};
    const Vec3 a = near(n, 30.0, random), b = near(n, 30.0, random);
    REQUIRE(!opposed(a, b, chord));
    REQUIRE(opposed(a, -b, chord));
  }
}

TEST_CASE("a ruling of a saddle, along which the normal twists by nearly a right angle") {
  const auto normal = [](double x) { return unit(Vec3{0, -5.0 * x, 1}); };  // of z = 5 x y at y = 0
  CHECK(!opposed(normal(0.0), normal(1.0), {1, 0, 0}));
  CHECK(!opposed(normal(-0.3), normal(0.3), {1, 0, 0}));
  CHECK(opposed(normal(0.0), -normal(0.3), {1, 0, 0}));
}

TEST_CASE("nothing is said of normals along the chord, unknown ones and chords of no length") {
  CHECK(!opposed({1, 0, 0}, {-1, 0, 0}, {1, 0, 0}));
  CHECK(!opposed(unit(Vec3{1, 0.2, 0}), unit(Vec3{1, -0.2, 0}), {1, 0, 0}));
  CHECK(!opposed({0, 0, 0}, {0, 0, 1}, {1, 0, 0}));
  CHECK(opposed({0, 0, 1}, {0, 0, -1}, {0, 0, 0}));
}
