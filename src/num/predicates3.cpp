#include "num/predicates3.h"

#include "num/expansion.h"
#include "num/wide.h"

namespace wireskin {

double orient3d_exact(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Expansion<2> ux = exact_difference(b.x, a.x);
  const Expansion<2> uy = exact_difference(b.y, a.y);
  const Expansion<2> uz = exact_difference(b.z, a.z);
  const Expansion<2> vx = exact_difference(c.x, a.x);
  const Expansion<2> vy = exact_difference(c.y, a.y);
  const Expansion<2> vz = exact_difference(c.z, a.z);
  const Expansion<2> wx = exact_difference(d.x, a.x);
  const Expansion<2> wy = exact_difference(d.y, a.y);
  const Expansion<2> wz = exact_difference(d.z, a.z);
  const Expansion<64> x_term = (vy * wz - vz * wy) * ux;
  const Expansion<64> y_term = (vz * wx - vx * wz) * uy;
  const Expansion<64> z_term = (vx * wy - vy * wx) * uz;
  return (x_term + y_term + z_term).leading();
}

struct WideVec3 {
  TwoParts x, y, z;
};

static WideVec3 wide_vector(const Vec3& from, const Vec3& to) {
  return {two_sum(to.x, -from.x), two_sum(to.y, -from.y), two_sum(to.z, -from.z)};
}

// det(u, v, w); adds its magnitude without cancellation to *permanent.
static TwoParts wide_triple(const WideVec3& u, const WideVec3& v, const WideVec3& w,
                            double* permanent) {
  const TwoParts vw[3][2] = {{wide_product(v.y, w.z), wide_product(v.z, w.y)},
                             {wide_product(v.z, w.x), wide_product(v.x, w.z)},
                             {wide_product(v.x, w.y), wide_product(v.y, w.x)}};
  const TwoParts* const factor[3] = {&u.x, &u.y, &u.z};
  TwoParts det = {0.0, 0.0};
  for (int i = 0; i < 3; ++i) {
    det = wide_sum(det, wide_product(*factor[i], wide_difference(vw[i][0], vw[i][1])));
    *permanent +=
        std::fabs(factor[i]->high) * (std::fabs(vw[i][0].high) + std::fabs(vw[i][1].high));
  }
  return det;
}

// lift(u) det(v, w, t), again with its permanent.
static TwoParts wide_lift_term(const WideVec3& u, const WideVec3& v, const WideVec3& w,
                               const WideVec3& t, double* permanent) {
  const TwoParts xx = wide_product(u.x, u.x);
  const TwoParts yy = wide_product(u.y, u.y);
  const TwoParts lift = wide_sum(wide_sum(xx, yy), wide_product(u.z, u.z));
  double triple_permanent = 0.0;
  const TwoParts triple = wide_triple(v, w, t, &triple_permanent);
  *permanent += lift.high * triple_permanent;
  return wide_product(lift, triple);
}

// No more than twelve operations lie between a difference, which is exact, and the sum of the
// terms: errors, each at most 2^-100 of the permanent, stay below a half of the bound.
Filtered insphere_wide(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, const Vec3& p) {
  const WideVec3 ap = wide_vector(p, a);
  const WideVec3 bp = wide_vector(p, b);
  const WideVec3 cp = wide_vector(p, c);
  const WideVec3 dp = wide_vector(p, d);
  double permanent = 0.0;
  const TwoParts from_a = wide_lift_term(ap, bp, cp, dp, &permanent);
  const TwoParts from_b = wide_lift_term(bp, ap, cp, dp, &permanent);
  const TwoParts from_c = wide_lift_term(cp, ap, bp, dp, &permanent);
  const TwoParts from_d = wide_lift_term(dp, ap, bp, cp, &permanent);
  const TwoParts det = wide_sum(wide_difference(from_a, from_b), wide_difference(from_c, from_d));
  return {det.high, std::fabs(det.high) > 0x1p-95 * permanent};
}

static Expansion<4> exact_minor(double ax, double by, double ay, double bx) {
  return exact_product(ax, by) - exact_product(ay, bx);
}

// det(u, v, w) of vectors that are exact in one double each.
static Expansion<24> exact_triple(const Vec3& u, const Vec3& v, const Vec3& w) {
  return scale(exact_minor(v.y, w.z, v.z, w.y), u.x) + scale(exact_minor(v.z, w.x, v.x, w.z), u.y) +
         scale(exact_minor(v.x, w.y, v.y, w.x), u.z);
}

static Expansion<6> exact_lift(const Vec3& u) {
  return exact_product(u.x, u.x) + exact_product(u.y, u.y) + exact_product(u.z, u.z);
}

// The difference, and whether it is exact.
static bool plain_difference(const Vec3& from, const Vec3& to, Vec3* difference) {
  const TwoParts x = two_sum(to.x, -from.x);
  const TwoParts y = two_sum(to.y, -from.y);
  const TwoParts z = two_sum(to.z, -from.z);
  *difference = {x.high, y.high, z.high};
  return x.low == 0.0 && y.low == 0.0 && z.low == 0.0;
}

static Expansion<96> exact_volume(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return (exact_triple(b, c, d) - exact_triple(a, c, d)) +
         (exact_triple(a, b, d) - exact_triple(a, b, c));
}

// For points whose differences need two doubles: the determinant of the coordinates themselves,
// whose room is smaller than that of products of such differences (90 kilobytes of stack).
static double insphere_of_coordinates(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d,
                                      const Vec3& p) {
  const Vec3* const point[5] = {&a, &b, &c, &d, &p};
  Expansion<5760> sum[2];
  for (int i = 0; i < 5; ++i) {
    const Vec3* rest[4];
    int count = 0;
    for (int k = 0; k < 5; ++k) {
      if (k != i) rest[count++] = point[k];
    }
    const Expansion<96> volume = exact_volume(*rest[0], *rest[1], *rest[2], *rest[3]);
    const Expansion<1152> term = (i % 2 == 0 ? -volume : volume) * exact_lift(*point[i]);
    add_expansions(sum[i & 1], term, &sum[(i + 1) & 1]);
  }
  return sum[1].leading();
}

// Exact ties come from coordinates of few digits, whose differences are exact in one double.
double insphere_exact(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, const Vec3& p) {
  Vec3 ap, bp, cp, dp;
  const bool plain = plain_difference(p, a, &ap) && plain_difference(p, b, &bp) &&
                     plain_difference(p, c, &cp) && plain_difference(p, d, &dp);
  if (!plain) return insphere_of_coordinates(a, b, c, d, p);
  const Expansion<576> ab =
      exact_triple(bp, cp, dp) * exact_lift(ap) - exact_triple(ap, cp, dp) * exact_lift(bp);
  const Expansion<576> cd =
      exact_triple(ap, bp, dp) * exact_lift(cp) - exact_triple(ap, bp, cp) * exact_lift(dp);
  return (ab + cd).leading();
}

}  // namespace wireskin
