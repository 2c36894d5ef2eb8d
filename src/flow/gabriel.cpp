#include "flow/gabriel.h"

#include "num/wide.h"

namespace wireskin::flow {

struct WideVector {
  TwoParts x, y, z;
};

static WideVector wide_between(const Vec3& from, const Vec3& to) {
  return {two_sum(to.x, -from.x), two_sum(to.y, -from.y), two_sum(to.z, -from.z)};
}

static TwoParts wide_dot(const WideVector& u, const WideVector& v) {
  const TwoParts xy = wide_sum(wide_product(u.x, v.x), wide_product(u.y, v.y));
  return wide_sum(xy, wide_product(u.z, v.z));
}

static WideVector wide_cross(const WideVector& u, const WideVector& v) {
  return {wide_difference(wide_product(u.y, v.z), wide_product(u.z, v.y)),
          wide_difference(wide_product(u.z, v.x), wide_product(u.x, v.z)),
          wide_difference(wide_product(u.x, v.y), wide_product(u.y, v.x))};
}

bool inside_edge_ball(const Vec3& a, const Vec3& b, const Vec3& p) {
  const Vec3 u = a - p;
  const Vec3 v = b - p;
  const double sum = dot(u, v);
  const double size = std::fabs(u.x * v.x) + std::fabs(u.y * v.y) + std::fabs(u.z * v.z);
  // Three roundings of the differences and product, two of the sum.
  if (std::fabs(sum) > 0x1p-50 * size) return sum < 0.0;
  const TwoParts wide = wide_dot(wide_between(p, a), wide_between(p, b));
  return wide.high < -0x1p-90 * size;
}

static TwoParts wide_triple(const WideVector& u, const WideVector& v, const WideVector& w) {
  return wide_dot(u, wide_cross(v, w));
}

// With n = u x v and o = p - a the centre is a + (v.v n x u + u.u v x n) / 2 n.n, so p is inside
// where o.o n.n - o.(v.v n x u + u.u v x n) is negative.
static bool inside_triangle_ball_wide(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p,
                                      double size) {
  const WideVector u = wide_between(a, b);
  const WideVector v = wide_between(a, c);
  const WideVector o = wide_between(a, p);
  const WideVector n = wide_cross(u, v);
  const TwoParts along_nu = wide_product(wide_dot(v, v), wide_triple(o, n, u));
  const TwoParts along_vn = wide_product(wide_dot(u, u), wide_triple(o, v, n));
  const TwoParts whole = wide_product(wide_dot(o, o), wide_dot(n, n));
  const TwoParts power = wide_difference(whole, wide_sum(along_nu, along_vn));
  return power.high < -0x1p-90 * size;
}

struct ExactNormal {
  Expansion<4> x, y, z;
};

static ExactNormal exact_normal(const Vec3& u, const Vec3& v) {
  return {exact_product(u.y, v.z) - exact_product(u.z, v.y),
          exact_product(u.z, v.x) - exact_product(u.x, v.z),
          exact_product(u.x, v.y) - exact_product(u.y, v.x)};
}

static Expansion<6> exact_dot(const Vec3& u, const Vec3& v) {
  return exact_product(u.x, v.x) + exact_product(u.y, v.y) + exact_product(u.z, v.z);
}

// Differences of coordinates are multiples of 2^-152 below 2^151.
static constexpr int k_fourth_parts = compact_parts(4, 303);
static constexpr int k_sixth_parts = compact_parts(6, 303);

static Expansion<k_fourth_parts> exact_normal_dot(const ExactNormal& m, const ExactNormal& n) {
  Expansion<k_fourth_parts + 8> sum;
  add_product(m.x, n.x, &sum);
  add_product(m.y, n.y, &sum);
  add_product(m.z, n.z, &sum);
  return fitted<k_fourth_parts>(sum);
}

// For vectors that are exact in one double each, as those between near points are. By the triple
// product o.(n x w) = n.(w x o).
static bool inside_triangle_ball_exact(const Vec3& u, const Vec3& v, const Vec3& o) {
  const ExactNormal n = exact_normal(u, v);
  Expansion<k_sixth_parts + 2 * k_fourth_parts> power;
  add_product(exact_normal_dot(n, n), exact_dot(o, o), &power);
  add_product(exact_normal_dot(n, exact_normal(u, o)), -exact_dot(v, v), &power);
  add_product(exact_normal_dot(n, exact_normal(v, o)), exact_dot(u, u), &power);
  return power.leading() < 0.0;
}

static bool exact_vector_between(const Vec3& from, const Vec3& to) {
  return two_sum(to.x, -from.x).low == 0.0 && two_sum(to.y, -from.y).low == 0.0 &&
         two_sum(to.z, -from.z).low == 0.0;
}

bool inside_triangle_ball(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p) {
  const Vec3 u = b - a;
  const Vec3 v = c - a;
  const Vec3 o = p - a;
  const Vec3 n = cross(u, v);
  const double uu = dot(u, u);
  const double vv = dot(v, v);
  const double oo = dot(o, o);
  const double power = oo * dot(n, n) - dot(o, vv * cross(n, u) + uu * cross(v, n));
  // All terms are at most |u|^2 |v|^2 |o| (|u| + |v| + |o|), which is at most this; each of their
  // fewer than thirty roundings adds 2^-53 of it at most.
  const double size = uu * vv * (2.0 * oo + uu + vv);
  if (std::fabs(power) > 0x1p-47 * size) return power < 0.0;
  if (exact_vector_between(a, b) && exact_vector_between(a, c) && exact_vector_between(a, p)) {
    return inside_triangle_ball_exact(u, v, o);
  }
  return inside_triangle_ball_wide(a, b, c, p, size);
}

}  // namespace wireskin::flow
