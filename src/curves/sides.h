// Sharp curves have a normal field on each side: this one fits the fields on the right to curves
// whose positions and left normals are fitted already.
//
// In: curves, the samples' normals on the right (unit; zero along a whole curve: not known). Out:
// Curves::right at every knot, with its moments; smooth curves get their own normals there, so that
// a walk along any curve finds the normals of either side. O(knots).
#pragma once

#include "curves/curve.h"

namespace wireskin::curves {

// Curve c has the samples start[c] .. start[c + 1); sharp[c]: it has normals of its own there.
struct RightSamples {
  Span<const uint32_t> start;
  Span<const Vec3> normal;
  Span<const uint8_t> sharp;
};

Status fit_right_normals(const RightSamples& samples, Curves* curves);

// The curve with the normals of its right side in place of those of its left; the curve itself
// where no curve is sharp.
Curve seen_from_right(const Curves& curves, size_t curve);

// Whether the curve has normals: they are known at all of its knots or at none.
inline bool has_normals(const Curve& curve) {
  return dot(curve.normal.value[0], curve.normal.value[0]) > 0.0;
}

}  // namespace wireskin::curves
