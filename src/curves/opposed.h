// Whether two normals of a surface lie on different sides of it, as far as a chord of it tells.
//
// In: unit normals (zero: not known) at two places, and the direction of the chord between them.
// On a surface the chord is nearly tangent, and over it normals turn in its plane, by whatever the
// curve bends, and twist about it. So only their parts across the chord are compared, which bending
// leaves alone: opposed are parts more than 120 degrees apart, farther than a surface twists from
// one sample to the next, and farther than two normals that are each 30 degrees wrong. Normals
// nearly along the chord tell nothing, nor do those nearly along a curve (lies_across). O(1).
#pragma once

#include "num/vec.h"

namespace wireskin::curves {

// Whether the normal is at least 30 degrees off the direction.
inline bool lies_across(const Vec3& normal, const Vec3& direction) {
  const Vec3 part = reject(normal, unit(direction));
  return dot(part, part) > 0.25;
}

inline bool opposed(const Vec3& a, const Vec3& b, const Vec3& chord) {
  constexpr double k_least_cosine = -0.5;
  if (!lies_across(a, chord) || !lies_across(b, chord)) return false;
  const Vec3 along = unit(chord), p = reject(a, along), q = reject(b, along);
  return dot(p, q) < k_least_cosine * (length(p) * length(q));
}

}  // namespace wireskin::curves
