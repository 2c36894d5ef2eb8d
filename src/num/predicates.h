// The two questions on which planar triangulation rests, answered exactly: on which side of a line
// does a point lie, and is it inside a circle.
//
// A result's sign is always right; its magnitude is an approximation. Holds for coordinates that
// are zero or between k_least_coordinate and k_greatest_coordinate in magnitude: then no product
// of four differences over- or underflows, in the filter or in the exact stage.
// Cost: a few nanoseconds where the rounding error cannot reach the sign, which the filter proves;
// else (points on one line or circle to about 1e-16) the same determinant in expansion arithmetic.
// Source: J. R. Shewchuk, "Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric
// Predicates", 1997 (error bounds of section 4, stage A).
#pragma once

#include <cmath>

#include "num/vec.h"

namespace wireskin {

inline constexpr double k_greatest_coordinate = 0x1p+200;
inline constexpr double k_least_coordinate = 0x1p-200;

// The rounded determinant, and whether its sign is proved.
struct Filtered {
  double value;
  bool certain;
};

inline Filtered orient2d_filter(const Vec2& a, const Vec2& b, const Vec2& c) {
  constexpr double k_bound = (3.0 + 0x1p-49) * 0x1p-53;
  const double left = (a.x - c.x) * (b.y - c.y);
  const double right = (a.y - c.y) * (b.x - c.x);
  const double det = left - right;
  return {det, std::fabs(det) >= k_bound * (std::fabs(left) + std::fabs(right))};
}

inline Filtered incircle_filter(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  constexpr double k_bound = (10.0 + 0x1.8p-47) * 0x1p-53;
  const Vec2 ad = a - d;
  const Vec2 bd = b - d;
  const Vec2 cd = c - d;
  const double bc = bd.x * cd.y, cb = cd.x * bd.y;
  const double ca = cd.x * ad.y, ac = ad.x * cd.y;
  const double ab = ad.x * bd.y, ba = bd.x * ad.y;
  const double a_lift = dot(ad, ad);
  const double b_lift = dot(bd, bd);
  const double c_lift = dot(cd, cd);
  const double det = a_lift * (bc - cb) + b_lift * (ca - ac) + c_lift * (ab - ba);
  const double permanent = a_lift * (std::fabs(bc) + std::fabs(cb)) +
                           b_lift * (std::fabs(ca) + std::fabs(ac)) +
                           c_lift * (std::fabs(ab) + std::fabs(ba));
  return {det, std::fabs(det) > k_bound * permanent};
}

// The stages behind the filters. incircle_wide computes in pairs of doubles, for the many
// quadruples that lie on one circle but for the rounding of their coordinates.
double orient2d_exact(const Vec2& a, const Vec2& b, const Vec2& c);
Filtered incircle_wide(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d);
double incircle_exact(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d);

// Positive where a, b, c turn counter-clockwise, zero where they lie on one line. About twice the
// signed area of the triangle.
inline double orient2d(const Vec2& a, const Vec2& b, const Vec2& c) {
  const Filtered filtered = orient2d_filter(a, b, c);
  return filtered.certain ? filtered.value : orient2d_exact(a, b, c);
}

// Positive where d lies inside the circle through a, b, c (given counter-clockwise; the sign turns
// with their order), zero where the four lie on one circle or line.
inline double incircle(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  const Filtered filtered = incircle_filter(a, b, c, d);
  if (filtered.certain) return filtered.value;
  const Filtered wide = incircle_wide(a, b, c, d);
  return wide.certain ? wide.value : incircle_exact(a, b, c, d);
}

}  // namespace wireskin
