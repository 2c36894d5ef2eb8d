#include "num/predicates.h"

#include <doctest/doctest.h>

#include <cstdio>
#include <limits>
#include <random>

#include "support/dyadic.h"

using namespace wireskin;
using scenes::Dyadic;

namespace {

int sign_of(double value) {
  return (value > 0.0) - (value < 0.0);
}

struct Exact2 {
  Dyadic x, y;
};

Exact2 between(Vec2 from, Vec2 to) {
  return {Dyadic(to.x) - Dyadic(from.x), Dyadic(to.y) - Dyadic(from.y)};
}

Dyadic exact_cross(const Exact2& a, const Exact2& b) {
  return a.x * b.y - a.y * b.x;
}
Dyadic exact_square(const Exact2& a) {
  return a.x * a.x + a.y * a.y;
}

int true_orientation(Vec2 a, Vec2 b, Vec2 c) {
  return exact_cross(between(c, a), between(c, b)).sign();
}

int true_incircle(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  const Exact2 ad = between(d, a), bd = between(d, b), cd = between(d, c);
  return (exact_square(ad) * exact_cross(bd, cd) + exact_square(bd) * exact_cross(cd, ad) +
          exact_square(cd) * exact_cross(ad, bd))
      .sign();
}

// How often each stage had the last word, and how often the rounded determinant would have lied.
struct Tally {
  size_t filter = 0, wide = 0, exact = 0, lies = 0, wrong = 0;

  void orient(Vec2 a, Vec2 b, Vec2 c) {
    const int truth = true_orientation(a, b, c);
    const Filtered f = orient2d_filter(a, b, c);
    ++(f.certain ? filter : exact);
    if (sign_of(f.value) != truth) {
      ++lies;
      if (f.certain) ++wrong;
    }
    if (sign_of(orient2d(a, b, c)) != truth) ++wrong;
    if (sign_of(orient2d_exact(a, b, c)) != truth) ++wrong;
  }

  void circle(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
    const int truth = true_incircle(a, b, c, d);
    const Filtered f = incircle_filter(a, b, c, d);
    const Filtered w = incircle_wide(a, b, c, d);
    ++(f.certain ? filter : w.certain ? wide : exact);
    if (sign_of(f.value) != truth) {
      ++lies;
      if (f.certain) ++wrong;
    }
    if (w.certain && sign_of(w.value) != truth) ++wrong;
    if (sign_of(incircle(a, b, c, d)) != truth) ++wrong;
    if (sign_of(incircle_exact(a, b, c, d)) != truth) ++wrong;
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

TEST_CASE("orient2d on a grid of neighbouring doubles round a line") {
  // L. Kettner et al., "Classroom Examples of Robustness Problems in Geometric Computations", 2008.
  Tally tally;
  for (int i = 0; i < 64; ++i) {
    for (int k = 0; k < 64; ++k) {
      const Vec2 p = {ulps(0.5, i), ulps(0.5, k)};
      tally.orient(p, {12.0, 12.0}, {24.0, 24.0});
      tally.orient({17.3, 17.3}, p, {24.00000000000005, 24.0000000000000517765});
      tally.orient({-1.0, -0.1}, {1.0, 1.1}, p);
    }
  }
  tally.print("orient2d, grids of ulps");
  CHECK(tally.wrong == 0);
  CHECK(tally.exact > 1000);
  CHECK(tally.filter > 1000);
  CHECK(tally.lies > 100);
}

TEST_CASE("incircle on grids of neighbouring doubles round a circle") {
  Tally tally;
  std::mt19937 random(1);
  const auto angle = [&] { return 6.283185307179586 * static_cast<double>(random()) * 0x1p-32; };
  for (int round = 0; round < 40; ++round) {
    Vec2 p[4];
    for (Vec2& q : p) {
      const double t = angle();
      q = {0.3 + 0.7 * std::cos(t), -0.2 + 0.7 * std::sin(t)};
    }
    for (int i = -6; i <= 6; ++i) {
      for (int k = -6; k <= 6; ++k)
        tally.circle(p[0], p[1], p[2], {ulps(p[3].x, i), ulps(p[3].y, k)});
    }
  }
  // Exactly on a circle, and off it by one unit in the last place.
  const Vec2 a = {5, 0}, b = {3, 4}, c = {-4, 3}, d = {0, -5};
  for (int i = -20; i <= 20; ++i) {
    tally.circle(a, b, c, {d.x, ulps(d.y, i)});
    tally.circle(a, b, c, {i * 0x1p-150, d.y});
    tally.circle(a, {ulps(b.x, i), b.y}, c, d);
  }
  tally.print("incircle, grids of ulps");
  CHECK(tally.wrong == 0);
  CHECK(tally.exact > 10);
  CHECK(tally.wide > 1000);
  CHECK(tally.lies > 100);
}

TEST_CASE("small integers: the zeros are zeros") {
  Tally tally;
  std::mt19937 random(2);
  const auto pick = [&] {
    return Vec2{static_cast<double>(random() % 5), static_cast<double>(random() % 5)};
  };
  size_t zeros = 0;
  for (int i = 0; i < 4000; ++i) {
    const Vec2 a = pick(), b = pick(), c = pick(), d = pick();
    tally.orient(a, b, c);
    tally.circle(a, b, c, d);
    zeros += incircle(a, b, c, d) == 0.0 ? 1 : 0;
  }
  CHECK(tally.wrong == 0);
  CHECK(zeros > 500);
}

TEST_CASE("coordinates of unlike magnitude") {
  Tally tally;
  std::mt19937_64 random(3);
  const auto pick = [&] {
    const double value = static_cast<double>(random() >> 11) * 0x1p-53;
    return std::ldexp(random() % 2 == 0 ? value : -value, -static_cast<int>(random() % 60));
  };
  for (int i = 0; i < 4000; ++i) {
    const Vec2 a = {pick(), pick()}, b = {pick(), pick()}, c = {pick(), pick()};
    tally.orient(a, b, c);
    // c on the line or d on the circle, as nearly as rounding lets it.
    tally.orient(a, b, a + 0.375 * (b - a));
    const Vec2 centre = 0.5 * (a + b);
    const Vec2 r = b - centre;
    tally.circle(a, b, c, {centre.x - r.y, centre.y + r.x});
    tally.circle(a, {centre.x + r.y, centre.y - r.x}, b, {centre.x - r.y, centre.y + r.x});
  }
  tally.print("unlike magnitudes");
  CHECK(tally.wrong == 0);
  CHECK(tally.wide + tally.exact > 500);
}

TEST_CASE("both ends of the promised range") {
  std::mt19937 random(4);
  for (const double factor : {0.25 * k_greatest_coordinate, 2.0 * k_least_coordinate}) {
    Tally tally;
    for (int i = 0; i < 500; ++i) {
      const auto near_one = [&] { return ulps(1.0, static_cast<int>(random() % 9)); };
      const Vec2 a = {factor * near_one(), 0.0}, b = {0.0, factor * near_one()};
      const Vec2 c = {-factor * near_one(), 0.0}, d = {0.0, -factor * near_one()};
      tally.circle(a, b, c, d);
      tally.orient(a, b, {0.5 * (a.x + b.x), 0.5 * (a.y + b.y)});
    }
    CHECK(tally.wrong == 0);
    CHECK(tally.wide + tally.exact > 100);
  }
}
