#include "num/predicates3.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdio>
#include <random>

#include "support/dyadic.h"

using namespace wireskin;
using scenes::Dyadic;

namespace {

int sign_of(double value) {
  return (value > 0.0) - (value < 0.0);
}

struct Exact3 {
  Dyadic x, y, z;
};

Exact3 between(const Vec3& from, const Vec3& to) {
  return {Dyadic(to.x) - Dyadic(from.x), Dyadic(to.y) - Dyadic(from.y),
          Dyadic(to.z) - Dyadic(from.z)};
}
Dyadic det(const Exact3& a, const Exact3& b, const Exact3& c) {
  return a.x * (b.y * c.z - b.z * c.y) + a.y * (b.z * c.x - b.x * c.z) +
         a.z * (b.x * c.y - b.y * c.x);
}
Dyadic square(const Exact3& a) {
  return a.x * a.x + a.y * a.y + a.z * a.z;
}

// How often each stage had the last word, and how often the rounded determinant would have lied.
struct Tally {
  size_t filter = 0, wide = 0, exact = 0, lies = 0, wrong = 0, zeros = 0;

  void orient(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const int truth = det(between(a, b), between(a, c), between(a, d)).sign();
    const Filtered f = orient3d_filter(a, b, c, d);
    const Filtered w = orient3d_wide(a, b, c, d);
    ++(f.certain ? filter : w.certain ? wide : exact);
    if (w.certain && sign_of(w.value) != truth) ++wrong;
    if (sign_of(f.value) != truth) {
      ++lies;
      if (f.certain) ++wrong;
    }
    if (sign_of(orient3d(a, b, c, d)) != truth) ++wrong;
    if (sign_of(orient3d_exact(a, b, c, d)) != truth) ++wrong;
    zeros += truth == 0 ? 1 : 0;
  }

  void sphere(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, const Vec3& p) {
    const Exact3 ap = between(p, a), bp = between(p, b), cp = between(p, c), dp = between(p, d);
    const int truth = (square(ap) * det(bp, cp, dp) - square(bp) * det(ap, cp, dp) +
                       square(cp) * det(ap, bp, dp) - square(dp) * det(ap, bp, cp))
                          .sign();
    const Filtered f = insphere_filter(a, b, c, d, p);
    const Filtered w = insphere_wide(a, b, c, d, p);
    ++(f.certain ? filter : w.certain ? wide : exact);
    if (sign_of(f.value) != truth) {
      ++lies;
      if (f.certain) ++wrong;
    }
    if (w.certain && sign_of(w.value) != truth) ++wrong;
    if (sign_of(insphere(a, b, c, d, p)) != truth) ++wrong;
    if (sign_of(insphere_exact(a, b, c, d, p)) != truth) ++wrong;
    zeros += truth == 0 ? 1 : 0;
  }

  void print(const char* name) const {
    std::printf("%-32s decided by filter %zu, wide %zu, exact %zu; rounded sign wrong %zu\n", name,
                filter, wide, exact, lies);
  }
};

double ulps(double value, int count) {
  const double step = std::nextafter(std::fabs(value), 1e308) - std::fabs(value);
  return value + count * step;
}

}  // namespace

TEST_CASE("signs of the unit tetrahedron and its sphere") {
  const Vec3 o, x = {1, 0, 0}, y = {0, 1, 0}, z = {0, 0, 1};
  CHECK(orient3d(o, x, y, z) > 0.0);
  CHECK(orient3d(o, y, x, z) < 0.0);
  CHECK(orient3d(o, x, y, {0.3, 0.4, 0.0}) == 0.0);
  CHECK(insphere(o, x, y, z, {0.5, 0.5, 0.5}) > 0.0);
  CHECK(insphere(o, x, y, z, {-0.01, 0.0, 0.0}) < 0.0);
  CHECK(insphere(o, x, y, z, {1, 1, 1}) == 0.0);
  CHECK(insphere(o, y, x, z, {0.5, 0.5, 0.5}) < 0.0);
}

TEST_CASE("orient3d on grids of neighbouring doubles round a plane") {
  Tally tally;
  for (int i = 0; i < 24; ++i) {
    for (int k = 0; k < 24; ++k) {
      const Vec3 p = {ulps(0.5, i), ulps(0.5, k), 0.5};
      tally.orient(p, {12, 12, 12}, {24, 24, 24}, {-3, 7, 1});
      tally.orient({17.3, 17.3, 17.3}, p, {24.00000000000005, 24.0, 24.1}, {-1, -1, 2});
    }
  }
  tally.print("orient3d, grids of ulps");
  CHECK(tally.wrong == 0);
  CHECK(tally.wide > 500);
  CHECK(tally.exact > 0);
  CHECK(tally.lies > 50);
}

TEST_CASE("orient3d in planes of one coordinate: zero, and the filter knows") {
  Tally tally;
  std::mt19937 random(7);
  const auto uniform = [&] { return static_cast<double>(random()) * 0x1p-31 - 1.0; };
  for (int round = 0; round < 300; ++round) {
    Vec3 p[4];
    const double common = round % 2 == 0 ? uniform() : std::ldexp(uniform(), round - 150);
    for (Vec3& q : p) q = {uniform(), uniform(), uniform()};
    for (Vec3& q : p) (round % 3 == 0 ? q.x : round % 3 == 1 ? q.y : q.z) = common;
    tally.orient(p[0], p[1], p[2], p[3]);
  }
  CHECK(tally.zeros == 300);
  CHECK(tally.filter == 300);
  CHECK(tally.wrong == 0);
}

TEST_CASE("insphere on points of one sphere but for their rounding") {
  Tally tally;
  std::mt19937 random(1);
  const auto uniform = [&] { return static_cast<double>(random()) * 0x1p-31 - 1.0; };
  for (int round = 0; round < 1500; ++round) {
    Vec3 p[5];
    for (Vec3& q : p) {
      q = unit(Vec3{uniform(), uniform(), uniform()});
      q = {0.3 + 0.7 * q.x, 0.7 * q.y - 0.2, 0.7 * q.z};
    }
    tally.sphere(p[0], p[1], p[2], p[3], p[4]);
    tally.sphere(p[0], p[1], p[2], p[3], {p[4].x, ulps(p[4].y, 2), p[4].z});
    tally.sphere(p[0], p[1], p[2], p[3], 0.99 * p[4]);
  }
  const Vec3 a = {5, 0, 0}, b = {0, 3, 4}, c = {-4, 0, 3}, d = {0, -5, 0};
  for (int i = -20; i <= 20; ++i) {
    tally.sphere(a, b, c, d, {0, 0, ulps(-5, i)});
    tally.sphere(a, b, c, d, {i * 0x1p-90, 0, -5});
    tally.sphere(a, b, {ulps(-4, i), 0, 3}, d, {3, 4, 0});
  }
  tally.print("insphere, one sphere");
  CHECK(tally.wrong == 0);
  CHECK(tally.filter > 1000);
  CHECK(tally.wide > 1000);
  CHECK(tally.exact > 5);
  CHECK(tally.lies > 100);
}

TEST_CASE("small integers: the zeros in space are zeros, also where differences do not fit") {
  Tally tally, shifted;
  std::mt19937 random(2);
  const auto pick = [&] {
    return Vec3{static_cast<double>(random() % 3), static_cast<double>(random() % 3),
                static_cast<double>(random() % 3)};
  };
  // A tie of coordinates with unlike magnitudes: five points of a plane through the origin.
  const auto plane = [&] {
    const double s =
        std::ldexp(1.0 + static_cast<double>(random() % 7), -static_cast<int>(random() % 70));
    const double t =
        std::ldexp(1.0 + static_cast<double>(random() % 7), -static_cast<int>(random() % 70));
    return Vec3{s, t, s};
  };
  for (int i = 0; i < 3000; ++i) {
    tally.orient(pick(), pick(), pick(), pick());
    tally.sphere(pick(), pick(), pick(), pick(), pick());
    if (i < 500) shifted.sphere(plane(), plane(), plane(), plane(), plane());
  }
  tally.print("small integers");
  CHECK(tally.wrong == 0);
  CHECK(tally.zeros > 1000);
  CHECK(shifted.wrong == 0);
  CHECK(shifted.zeros == 500);
}

TEST_CASE("coordinates of unlike magnitude in space, and both ends of the promised range") {
  std::mt19937_64 random(3);
  Tally tally;
  const auto pick = [&](double factor) {
    const double value = factor * (0.5 + static_cast<double>(random() >> 11) * 0x1p-54);
    return std::ldexp(random() % 2 == 0 ? value : -value, static_cast<int>(random() % 50));
  };
  for (const double factor : {1.0, 0x1p-50 * k_greatest_coordinate3, 2.0 * k_least_coordinate3}) {
    for (int i = 0; i < 700; ++i) {
      const auto point = [&] { return Vec3{pick(factor), pick(factor), pick(factor)}; };
      const Vec3 a = point(), b = point(), c = point(), d = point();
      tally.orient(a, b, c, d);
      tally.orient(a, b, c, a + 0.375 * (b - a) + 0.25 * (c - a));
      tally.sphere(a, b, c, d, point());
      // A box: opposite corners, as nearly as rounding lets it.
      tally.sphere(a, {b.x, a.y, a.z}, {a.x, b.y, a.z}, {a.x, a.y, b.z}, b);
      tally.sphere(a, {b.x, a.y, a.z}, {a.x, b.y, a.z}, {a.x, a.y, b.z}, {b.x, b.y, ulps(b.z, 1)});
    }
  }
  tally.print("unlike magnitudes in space");
  CHECK(tally.wrong == 0);
  CHECK(tally.wide + tally.exact > 500);
}
