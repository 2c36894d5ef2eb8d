// The two questions on which spatial triangulation rests, answered exactly: on which side of a
// plane does a point lie, and is it inside a sphere.
//
// A result's sign is always right; its magnitude is an approximation. Holds for coordinates that
// are zero or between k_least_coordinate3 and k_greatest_coordinate3 in magnitude: then no product
// of five differences over- or underflows, in the filters or in the exact stage.
// Cost: about ten nanoseconds where a bound on the rounding error, from the largest differences
// alone, proves the sign; behind it stand pairs of doubles and last expansion arithmetic.
// Source: J. R. Shewchuk, "Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric
// Predicates", 1997; O. Devillers, S. Pion, "Efficient Exact Geometric Predicates for Delaunay
// Triangulations", 2003 (the bound).
#pragma once

#include "num/minmax.h"
#include "num/predicates.h"

namespace wireskin {

inline constexpr double k_greatest_coordinate3 = 0x1p+150;
inline constexpr double k_least_coordinate3 = 0x1p-100;

// Shewchuk's bound for this determinant is (7 + 56 eps) eps times its permanent, which is at most
// 6 X Y Z for the largest differences X, Y, Z; 42.5 eps leaves room for the rounding of the bound.
// Where it is zero all four lie in a plane x, y or z = const., and so is the determinant, exactly.
inline Filtered orient3d_filter(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  constexpr double k_bound = 42.5 * 0x1p-53;
  const Vec3 u = b - a;
  const Vec3 v = c - a;
  const Vec3 w = d - a;
  const double det =
      u.x * (v.y * w.z - v.z * w.y) + u.y * (v.z * w.x - v.x * w.z) + u.z * (v.x * w.y - v.y * w.x);
  const double x = larger(std::fabs(u.x), larger(std::fabs(v.x), std::fabs(w.x)));
  const double y = larger(std::fabs(u.y), larger(std::fabs(v.y), std::fabs(w.y)));
  const double z = larger(std::fabs(u.z), larger(std::fabs(v.z), std::fabs(w.z)));
  return {det, std::fabs(det) >= k_bound * (x * y * z)};
}

// Likewise (16 + 224 eps) eps times a permanent of at most 72 X Y Z M^2, M the largest of the
// three.
inline Filtered insphere_filter(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d,
                                const Vec3& p) {
  constexpr double k_bound = 1160.0 * 0x1p-53;
  const Vec3 ap = a - p;
  const Vec3 bp = b - p;
  const Vec3 cp = c - p;
  const Vec3 dp = d - p;
  const double ab = ap.x * bp.y - bp.x * ap.y;
  const double bc = bp.x * cp.y - cp.x * bp.y;
  const double cd = cp.x * dp.y - dp.x * cp.y;
  const double da = dp.x * ap.y - ap.x * dp.y;
  const double ac = ap.x * cp.y - cp.x * ap.y;
  const double bd = bp.x * dp.y - dp.x * bp.y;
  const double abc = ap.z * bc - bp.z * ac + cp.z * ab;
  const double bcd = bp.z * cd - cp.z * bd + dp.z * bc;
  const double cda = cp.z * da + dp.z * ac + ap.z * cd;
  const double dab = dp.z * ab + ap.z * bd + bp.z * da;
  const double det =
      (dot(cp, cp) * dab - dot(dp, dp) * abc) + (dot(ap, ap) * bcd - dot(bp, bp) * cda);
  const double x =
      larger(larger(std::fabs(ap.x), std::fabs(bp.x)), larger(std::fabs(cp.x), std::fabs(dp.x)));
  const double y =
      larger(larger(std::fabs(ap.y), std::fabs(bp.y)), larger(std::fabs(cp.y), std::fabs(dp.y)));
  const double z =
      larger(larger(std::fabs(ap.z), std::fabs(bp.z)), larger(std::fabs(cp.z), std::fabs(dp.z)));
  const double most = larger(x, larger(y, z));
  return {det, std::fabs(det) > k_bound * (x * y * z) * (most * most)};
}

// The stages behind the filters, the wide ones in pairs of doubles for the many cases that are
// degenerate but for the rounding of their coordinates.
Filtered orient3d_wide(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);
double orient3d_exact(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);
Filtered insphere_wide(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, const Vec3& p);
double insphere_exact(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, const Vec3& p);

// Positive where the tetrahedron is positively oriented: det(b - a, c - a, d - a) > 0; zero where
// the four points lie in one plane. About six times the signed volume.
inline double orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Filtered filtered = orient3d_filter(a, b, c, d);
  if (filtered.certain) return filtered.value;
  const Filtered wide = orient3d_wide(a, b, c, d);
  return wide.certain ? wide.value : orient3d_exact(a, b, c, d);
}

// Positive where p lies inside the sphere through a, b, c, d (positively oriented; the sign turns
// with their order), zero where the five lie on one sphere or plane.
inline double insphere(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, const Vec3& p) {
  const Filtered filtered = insphere_filter(a, b, c, d, p);
  if (filtered.certain) return filtered.value;
  const Filtered wide = insphere_wide(a, b, c, d, p);
  return wide.certain ? wide.value : insphere_exact(a, b, c, d, p);
}

}  // namespace wireskin
