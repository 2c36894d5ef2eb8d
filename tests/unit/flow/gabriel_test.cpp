#include "flow/gabriel.h"

#include <doctest/doctest.h>

#include "support/context.h"
#include "support/dyadic.h"

using namespace wireskin;
using flow::inside_edge_ball;
using flow::inside_triangle_ball;
using scenes::Dyadic;
using unit::Random;

namespace {

struct Exact3 {
  Dyadic x, y, z;
};

Exact3 between(const Vec3& from, const Vec3& to) {
  return {Dyadic(to.x) - Dyadic(from.x), Dyadic(to.y) - Dyadic(from.y),
          Dyadic(to.z) - Dyadic(from.z)};
}
Dyadic exact_dot(const Exact3& a, const Exact3& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
Exact3 exact_cross(const Exact3& a, const Exact3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
Exact3 combine(const Dyadic& s, const Exact3& a, const Dyadic& t, const Exact3& b) {
  return {s * a.x + t * b.x, s * a.y + t * b.y, s * a.z + t * b.z};
}

struct Tally {
  size_t inside = 0, on = 0, outside = 0, wrong = 0;

  void edge(const Vec3& a, const Vec3& b, const Vec3& p) {
    count(exact_dot(between(p, a), between(p, b)).sign(), inside_edge_ball(a, b, p));
  }
  void triangle(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p) {
    const Exact3 u = between(a, b), v = between(a, c), o = between(a, p), n = exact_cross(u, v);
    const Exact3 centre =
        combine(exact_dot(v, v), exact_cross(n, u), exact_dot(u, u), exact_cross(v, n));
    const Dyadic power = exact_dot(o, o) * exact_dot(n, n) - exact_dot(o, centre);
    count(power.sign(), inside_triangle_ball(a, b, c, p));
  }
  void count(int power, bool said_inside) {
    ++(power < 0 ? inside : power > 0 ? outside : on);
    if (said_inside != (power < 0)) ++wrong;
  }
};

Vec3 integers(Random& random, uint32_t most) {
  const double x = random.below(most), y = random.below(most), z = random.below(most);
  return {x, y, z};
}

}  // namespace

TEST_CASE("the balls of the unit edge and of an equilateral triangle") {
  CHECK(inside_edge_ball({0, 0, 0}, {2, 0, 0}, {1, 0.99, 0}));
  CHECK_FALSE(inside_edge_ball({0, 0, 0}, {2, 0, 0}, {1, 1, 0}));
  CHECK_FALSE(inside_edge_ball({0, 0, 0}, {2, 0, 0}, {1, 0, -1.01}));
  const Vec3 a = {1, 0, 0}, b = {0, 1, 0}, c = {0, 0, 1};
  CHECK(inside_triangle_ball(a, b, c, {0.3, 0.3, 0.3}));
  CHECK_FALSE(inside_triangle_ball(a, b, c, {0, 0, -1}));
  CHECK_FALSE(inside_triangle_ball(a, b, c, a));
}

TEST_CASE(
    "small integers, random points and points close to the spheres against exact arithmetic") {
  Random random(11);
  Tally tally;
  for (int i = 0; i < 4000; ++i) {
    const Vec3 a = integers(random, 4), b = integers(random, 4), c = integers(random, 4);
    tally.edge(a, b, c);
    tally.triangle(a, b, c, integers(random, 4));
  }
  CHECK(tally.on > 500);
  for (int i = 0; i < 2000; ++i) {
    Vec3 p[4];
    for (Vec3& q : p) q = wireskin::unit(Vec3{random(), random(), random()});
    tally.triangle(p[0], p[1], p[2], p[3]);
    // A great circle's triangle, so that every point of the sphere is on the ball but for rounding.
    const Vec3 w = wireskin::unit(reject(p[2], p[0]));
    const Vec3 x = 0.6 * p[0] + 0.8 * w, y = -0.8 * p[0] + 0.6 * w;
    tally.triangle(p[0], x, y, p[3]);
    tally.edge(p[0], -p[0], p[3]);
    // Nearly on one line.
    const Vec3 step = 0x1p-20 * p[1];
    tally.triangle(p[0], p[0] + step, p[0] + 2.0 * step, p[0] + 3.0 * step);
  }
  CHECK(tally.inside > 3000);
  CHECK(tally.outside > 3000);
  CHECK(tally.wrong == 0);
}
