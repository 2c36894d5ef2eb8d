// Interpolating cubic splines through points of space: natural, clamped or periodic ends.
//
// In: strictly ascending knots and one value a knot; for a periodic spline the last value repeats
// the first. Out: a C2 piecewise cubic, stored by its values and second derivatives ("moments") at
// the knots, which solve a diagonally dominant tridiagonal system. O(n) time and memory. At a knot
// the spline has the knot's value bit for bit. Source: C. de Boor, "A Practical Guide to Splines",
// 1978, chapter IV.
#pragma once

#include "base/in_parts.h"
#include "num/vec.h"

namespace wireskin::curves {

enum class SplineEnd { natural, clamped, periodic };

// A view; the arrays belong to whoever fitted it.
struct Spline {
  Span<const double> knot;
  Span<const Vec3> value;
  Span<const Vec3> moment;  // the second derivative at each knot

  size_t intervals() const { return knot.size() - 1; }
};

// Memory of the linear systems, kept between fits.
struct SplineScratch {
  Array<double> diagonal, off, correction;

  explicit SplineScratch(Context& context) : diagonal(context), off(context), correction(context) {}
};

// Fills the moments. At least two knots (periodic: at least four values, the last repeating the
// first). `tangent_first` and `tangent_last` are the derivatives at the ends, read when the ends
// are clamped.
Status fit_spline(Span<const double> knots, Span<const Vec3> values, SplineEnd end,
                  const Vec3& tangent_first, const Vec3& tangent_last, Pace* pace,
                  Span<Vec3> moments, SplineScratch* scratch);

// The derivative at the first knot of the parabola through the first three values; of the straight
// line where there are two. With `last`, the same at the other end.
Vec3 parabola_tangent(Span<const double> knots, Span<const Vec3> values, bool last);

// Value and derivative at parameter t of interval i, knot[i] <= t <= knot[i + 1].
Vec3 spline_value(const Spline& spline, size_t i, double t);
inline Vec3 spline_derivative(const Spline& spline, size_t i, double t) {
  const double left = spline.knot[i], right = spline.knot[i + 1];
  const double h = right - left;
  const double a = (right - t) / h, b = (t - left) / h;
  return (1.0 / h) * (spline.value[i + 1] - spline.value[i]) +
         (h * (1.0 - 3.0 * a * a) / 6.0) * spline.moment[i] +
         (h * (3.0 * b * b - 1.0) / 6.0) * spline.moment[i + 1];
}

}  // namespace wireskin::curves
