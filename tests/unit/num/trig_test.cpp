#include "num/trig.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "support/context.h"

using namespace unit;
using wireskin::arc_tangent;
using wireskin::k_pi;

// The ratio to the value of the C library; both may be off by half a unit in the last place.
static double relative_error(double y, double x) {
  const double expected = std::atan2(y, x);
  return std::fabs(arc_tangent(y, x) - expected) / std::fabs(expected);
}

TEST_CASE("trig: known angles in all quadrants") {
  CHECK(arc_tangent(0, 0) == 0.0);
  CHECK(arc_tangent(0, 1) == 0.0);
  CHECK(arc_tangent(0, -1) == k_pi);
  CHECK(arc_tangent(1, 0) == 0.5 * k_pi);
  CHECK(arc_tangent(-1, 0) == -0.5 * k_pi);
  const double root = std::sqrt(3.0);
  const double known[][3] = {{1, 1, 1.0 / 4},       {1, -1, 3.0 / 4},     {-1, -1, -3.0 / 4},
                             {-1, 1, -1.0 / 4},     {1, root, 1.0 / 6},   {root, 1, 1.0 / 3},
                             {root, -1, 2.0 / 3},   {1, -root, 5.0 / 6},  {-1, -root, -5.0 / 6},
                             {-root, -1, -2.0 / 3}, {-root, 1, -1.0 / 3}, {-1, root, -1.0 / 6}};
  for (const auto& k : known) {
    CHECK(std::fabs(arc_tangent(k[0], k[1]) - k[2] * k_pi) <= 5e-16 * std::fabs(k[2] * k_pi));
  }
}

TEST_CASE("trig: agrees with the C library on random input") {
  Random random(4);
  double worst = 0.0;
  for (int i = 0; i < 200000; ++i) worst = std::fmax(worst, relative_error(random(), random()));
  for (int i = 0; i < 200000; ++i) {
    const double scale = std::exp2(40.0 * random());
    worst = std::fmax(worst, relative_error(scale * random(), random()));
  }
  MESSAGE("greatest relative error: ", worst);
  CHECK(worst <= 5e-16);
}

TEST_CASE("trig: tiny and huge ratios") {
  for (double tiny : {1e-10, 1e-100, 1e-300}) {
    CHECK(relative_error(tiny, 1) <= 5e-16);
    CHECK(relative_error(-tiny, 1) <= 5e-16);
    CHECK(relative_error(tiny, -1) <= 5e-16);
    CHECK(relative_error(1, tiny) <= 5e-16);
    CHECK(relative_error(-1, -tiny) <= 5e-16);
    CHECK(relative_error(1 / tiny, tiny) <= 5e-16);
  }
}

TEST_CASE("trig: what has no direction has no angle") {
  const double inf = std::numeric_limits<double>::infinity(), nan = std::nan("");
  for (const double y : {nan, inf, -inf}) {
    for (const double x : {nan, inf, -inf}) CHECK(std::isnan(arc_tangent(y, x)));
  }
  CHECK(std::isnan(arc_tangent(nan, 1.0)));
  CHECK(std::isnan(arc_tangent(1.0, nan)));
  CHECK(arc_tangent(inf, 1.0) == 0.5 * k_pi);
  CHECK(arc_tangent(1.0, -inf) == k_pi);
}

TEST_CASE("trig: odd in y, and never beyond half a turn") {
  Random random(5);
  for (int i = 0; i < 10000; ++i) {
    const double y = std::fabs(random()), x = random();
    CHECK(arc_tangent(-y, x) == -arc_tangent(y, x));
    CHECK(arc_tangent(y, x) >= 0.0);
    CHECK(arc_tangent(y, x) <= k_pi);
  }
}

TEST_CASE("trig: angles between vectors, small and straight ones too") {
  using wireskin::angle_between;
  CHECK(angle_between({1, 0, 0}, {0, 5, 0}) == 0.5 * k_pi);
  CHECK(angle_between({1, 0, 0}, {2, 0, 0}) == 0.0);
  CHECK(angle_between({1, 0, 0}, {-2, 0, 0}) == k_pi);
  CHECK(angle_between({1, 0, 0}, {1, 1e-9, 0}) == doctest::Approx(1e-9).epsilon(1e-14));
  const double short_of_straight = k_pi - angle_between({1, 0, 0}, {-1, 1e-7, 0});
  CHECK(short_of_straight == doctest::Approx(1e-7).epsilon(1e-8));
}
