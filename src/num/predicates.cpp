#include "num/predicates.h"

#include "num/expansion.h"
#include "num/wide.h"

namespace wireskin {

struct ExactVec2 {
  Expansion<2> x, y;
};

static ExactVec2 exact_vector(const Vec2& from, const Vec2& to) {
  return {exact_difference(to.x, from.x), exact_difference(to.y, from.y)};
}

static Expansion<16> exact_cross(const ExactVec2& a, const ExactVec2& b) {
  return a.x * b.y - a.y * b.x;
}

static Expansion<16> exact_square(const ExactVec2& a) {
  return a.x * a.x + a.y * a.y;
}

double orient2d_exact(const Vec2& a, const Vec2& b, const Vec2& c) {
  return exact_cross(exact_vector(c, a), exact_vector(c, b)).leading();
}

struct WideVec2 {
  TwoParts x, y;
};

// One of the three terms of the determinant; adds its magnitude without cancellation to *permanent.
static TwoParts wide_term(const WideVec2& a, const WideVec2& b, const WideVec2& c,
                          double* permanent) {
  const TwoParts lift = wide_sum(wide_product(a.x, a.x), wide_product(a.y, a.y));
  const TwoParts left = wide_product(b.x, c.y);
  const TwoParts right = wide_product(c.x, b.y);
  *permanent += lift.high * (std::fabs(left.high) + std::fabs(right.high));
  return wide_product(lift, wide_difference(left, right));
}

// Five operations lie between a coordinate difference, which is exact, and the sum of the terms,
// and the sum adds two more: errors, each at most 2^-100 of the permanent, stay below a quarter of
// the bound.
Filtered incircle_wide(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  const WideVec2 ad = {two_sum(a.x, -d.x), two_sum(a.y, -d.y)};
  const WideVec2 bd = {two_sum(b.x, -d.x), two_sum(b.y, -d.y)};
  const WideVec2 cd = {two_sum(c.x, -d.x), two_sum(c.y, -d.y)};
  double permanent = 0.0;
  TwoParts det = wide_term(ad, bd, cd, &permanent);
  det = wide_sum(det, wide_term(bd, cd, ad, &permanent));
  det = wide_sum(det, wide_term(cd, ad, bd, &permanent));
  return {det.high, std::fabs(det.high) > 0x1p-95 * permanent};
}

// Differences of coordinates are multiples of 2^-252 below 2^201.
double incircle_exact(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  const ExactVec2 ad = exact_vector(d, a);
  const ExactVec2 bd = exact_vector(d, b);
  const ExactVec2 cd = exact_vector(d, c);
  Expansion<compact_parts(4, 453) + 32> sum;
  add_product(exact_cross(bd, cd), exact_square(ad), &sum);
  add_product(exact_cross(cd, ad), exact_square(bd), &sum);
  add_product(exact_cross(ad, bd), exact_square(cd), &sum);
  return sum.leading();
}

}  // namespace wireskin
