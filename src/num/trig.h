// Own trigonometry, because that of the C libraries differs in the last bits between targets.
//
// A table of the angles of k / 8 by the subtraction formula, then the Taylor series of the
// arctangent; relative error below 5e-16 over the whole range (checked against the C library in the
// tests). About 25 multiplications and two divisions. Source: M. Abramowitz, I. A. Stegun,
// "Handbook of Mathematical Functions", 1964, 4.4.
#pragma once

#include "num/vec.h"

namespace wireskin {

inline constexpr double k_pi = 3.14159265358979323846;

// The angle of the vector (x, y) against the x axis, in radians, in [0, pi] for y >= 0. For y < 0
// the result is negative. (0, 0) has the angle 0, one that is not a number, or infinite in both
// directions, has none: NaN.
double arc_tangent(double y, double x);

// The angle between two vectors in radians, 0 to pi, accurate for small and for straight angles.
inline double angle_between(const Vec3& a, const Vec3& b) {
  return arc_tangent(length(cross(a, b)), dot(a, b));
}

}  // namespace wireskin
