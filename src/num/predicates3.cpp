#include "num/predicates3.h"

#include "num/expansion.h"
#include "num/wide.h"

namespace wireskin {

struct ExactVec3 {
  Expansion<2> x, y, z;
};

static ExactVec3 exact_vector3(const Vec3& from, const Vec3& to) {
  return {exact_difference(to.x, from.x), exact_difference(to.y, from.y),
          exact_difference(to.z, from.z)};
}

// Differences of coordinates are multiples of 2^-152 below 2^151.
static constexpr int k_triple_parts = compact_parts(3, 303);
static constexpr int k_insphere_parts = compact_parts(5, 303);

// det(u, v, w).
static Expansion<k_triple_parts> exact_triple(const ExactVec3& u, const ExactVec3& v,
                                              const ExactVec3& w) {
  Expansion<k_triple_parts + 32> sum;
  add_product(v.y * w.z - v.z * w.y, u.x, &sum);
  add_product(v.z * w.x - v.x * w.z, u.y, &sum);
  add_product(v.x * w.y - v.y * w.x, u.z, &sum);
  return fitted<k_triple_parts>(sum);
}

static Expansion<24> exact_lift(const ExactVec3& u) {
  return u.x * u.x + u.y * u.y + u.z * u.z;
}

double orient3d_exact(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return exact_triple(exact_vector3(a, b), exact_vector3(a, c), exact_vector3(a, d)).leading();
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

// Each of the three terms is the outcome of four operations, and passes up to three sums: their
// errors, at most 2^-100 of the permanent each, stay far below the bound.
Filtered orient3d_wide(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  double permanent = 0.0;
  const TwoParts det =
      wide_triple(wide_vector(a, b), wide_vector(a, c), wide_vector(a, d), &permanent);
  return {det.high, std::fabs(det.high) > 0x1p-95 * permanent};
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

// Exact ties come from coordinates of few digits, whose differences are exact in one double: then
// the expansions are far shorter than their room.
double insphere_exact(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, const Vec3& p) {
  const ExactVec3 ap = exact_vector3(p, a);
  const ExactVec3 bp = exact_vector3(p, b);
  const ExactVec3 cp = exact_vector3(p, c);
  const ExactVec3 dp = exact_vector3(p, d);
  Expansion<k_insphere_parts + 2 * k_triple_parts> sum;
  add_product(exact_triple(bp, cp, dp), exact_lift(ap), &sum);
  add_product(exact_triple(ap, cp, dp), -exact_lift(bp), &sum);
  add_product(exact_triple(ap, bp, dp), exact_lift(cp), &sum);
  add_product(exact_triple(ap, bp, cp), -exact_lift(dp), &sum);
  return sum.leading();
}

}  // namespace wireskin
