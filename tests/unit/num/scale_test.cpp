#include "num/scale.h"

#include <doctest/doctest.h>

#include <cmath>

#include "support/context.h"

using namespace unit;
using wireskin::binary_exponent;
using wireskin::power_of_two;
using wireskin::Scale;

TEST_CASE("scale: powers of two and their exponents, all of them") {
  for (int e = -1022; e <= 1023; ++e) CHECK(power_of_two(e) == std::ldexp(1.0, e));
  Random random(1);
  for (int e = -1073; e <= 1024; ++e) {
    const double least = std::ldexp(1.0, e - 1);
    CHECK(binary_exponent(least) == e);
    if (e > -1073) CHECK(binary_exponent(std::nextafter(least, 0.0)) == e - 1);
    int expected = 0;
    const double x = std::ldexp(0.75 + 0.24 * random(), e);
    std::frexp(x, &expected);
    CHECK(binary_exponent(x) == expected);
  }
}

TEST_CASE("scale: exponents of subnormal numbers and of the greatest") {
  CHECK(binary_exponent(4.9406564584124654e-324) == -1073);
  CHECK(binary_exponent(2.2250738585072009e-308) == -1022);
  CHECK(binary_exponent(2.2250738585072014e-308) == -1021);
  CHECK(binary_exponent(1.7976931348623157e308) == 1024);
  CHECK(binary_exponent(1.0) == 1);
  CHECK(binary_exponent(0.75) == 0);
}

TEST_CASE("scale: exact, there and back, for every exponent") {
  Random random(2);
  for (int e = -1073; e <= 1024; ++e) {
    const double x = std::ldexp(0.75 + 0.25 * random(), 0);
    const Scale up(e), down(-e);
    CHECK(down(x) == std::ldexp(x, -e));
    CHECK(up(x) == std::ldexp(x, e));
    if (e > -1021) CHECK(down(up(x)) == x);
  }
  const Vec3 v = Scale(3)(Vec3{1, -2, 0.5});
  CHECK(v == Vec3{8, -16, 4});
}

TEST_CASE("scale: the least and the greatest numbers come to about one") {
  for (double x : {4.9406564584124654e-324, 1e-310, 2.2250738585072014e-308, 1.0, 1e300,
                   1.7976931348623157e308}) {
    const int e = binary_exponent(x);
    const double scaled = Scale(-e)(x);
    CHECK(scaled >= 0.5);
    CHECK(scaled < 1.0);
    CHECK(Scale(e)(scaled) == x);
  }
}
