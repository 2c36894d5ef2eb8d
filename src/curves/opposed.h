// Whether two normals of a surface lie on different sides of it, as far as a chord of it tells.
//
// In: unit normals (zero: not known) at two places, and the direction of the chord between them.
// On a surface the chord is nearly tangent, and over it normals turn in its plane, by whatever the
// curve bends, and twist about it. So only their parts across the chord are compared, which bending
// leaves alone: opposed are parts more than 120 degrees apart, farther than a surface twists from
// one sample to the next, and farther than two normals that are each 30 degrees wrong. Normals
// nearly along the chord tell nothing. O(1).
#pragma once

#include "num/vec.h"

namespace wireskin::curves {

inline bool opposed(const Vec3& a, const Vec3& b, const Vec3& chord) {
  constexpr double k_least_part = 0.5, k_least_cosine = -0.5;
  const Vec3 along = unit(chord);
  const Vec3 p = a - dot(a, along) * along, q = b - dot(b, along) * along;
  const double pp = dot(p, p), qq = dot(q, q);
  if (!(pp > k_least_part * k_least_part && qq > k_least_part * k_least_part)) return false;
  return dot(p, q) < k_least_cosine * std::sqrt(pp * qq);
}

}  // namespace wireskin::curves
