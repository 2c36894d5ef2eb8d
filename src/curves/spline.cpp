#include "curves/spline.h"

namespace wireskin::curves {

// Slope of the chord over interval i.
static Vec3 chord_slope(Span<const double> knots, Span<const Vec3> values, size_t i) {
  return (1.0 / (knots[i + 1] - knots[i])) * (values[i + 1] - values[i]);
}

// Solves a tridiagonal system with a symmetric, diagonally dominant matrix by elimination without
// pivoting, in place: `diagonal` and `rhs` are overwritten, `rhs` becomes the solution. off[i]
// couples unknowns i and i + 1.
template <typename Value>
static Status solve_tridiagonal(Span<double> diagonal, Span<const double> off, Span<Value> rhs,
                                Pace* pace) {
  const size_t n = diagonal.size();
  for (size_t i = 1; i < n; ++i) {
    TRY(pace->after());
    const double factor = off[i - 1] / diagonal[i - 1];
    diagonal[i] -= factor * off[i - 1];
    rhs[i] = rhs[i] - factor * rhs[i - 1];
  }
  rhs[n - 1] = (1.0 / diagonal[n - 1]) * rhs[n - 1];
  for (size_t i = n - 1; i-- > 0;) {
    TRY(pace->after());
    rhs[i] = (1.0 / diagonal[i]) * (rhs[i] - off[i] * rhs[i + 1]);
  }
  return {};
}

// Moments of an open spline: continuity of the slope at inner knots, and at the ends either no
// curvature (natural) or the given slope (clamped).
static Status open_moments(Span<const double> knots, Span<const Vec3> values, bool clamped,
                           const Vec3& tangent_first, const Vec3& tangent_last, Pace* pace,
                           Span<double> diagonal, Span<double> off, Span<Vec3> moments) {
  const size_t last = knots.size() - 1;
  for (size_t i = 0; i < last; ++i) off[i] = knots[i + 1] - knots[i];
  for (size_t i = 1; i < last; ++i) {
    TRY(pace->after());
    diagonal[i] = 2.0 * (off[i - 1] + off[i]);
    moments[i] = 6.0 * (chord_slope(knots, values, i) - chord_slope(knots, values, i - 1));
  }
  if (clamped) {
    diagonal[0] = 2.0 * off[0];
    diagonal[last] = 2.0 * off[last - 1];
    moments[0] = 6.0 * (chord_slope(knots, values, 0) - tangent_first);
    moments[last] = 6.0 * (tangent_last - chord_slope(knots, values, last - 1));
    return solve_tridiagonal(diagonal, off, moments, pace);
  }
  moments[0] = moments[last] = Vec3{};
  if (last == 1) return {};
  return solve_tridiagonal(diagonal.part(1, last - 1), Span<const double>(off.part(1, last - 1)),
                           moments.part(1, last - 1), pace);
}

// Moments of a closed spline. The cyclic matrix is a tridiagonal one plus a matrix of rank one
// (Sherman and Morrison): A = T + u u^T / g with u = (g, 0, ..., 0, corner).
static Status periodic_moments(Span<const double> knots, Span<const Vec3> values, Pace* pace,
                               Span<double> diagonal, Span<double> off, Span<double> correction,
                               Span<Vec3> moments) {
  const size_t n = knots.size() - 1;
  for (size_t i = 0; i < n; ++i) off[i] = knots[i + 1] - knots[i];
  const double corner = off[n - 1];
  for (size_t i = 0; i < n; ++i) {
    TRY(pace->after());
    const size_t before = i == 0 ? n - 1 : i - 1;
    diagonal[i] = 2.0 * (off[before] + off[i]);
    moments[i] = 6.0 * (chord_slope(knots, values, i) - chord_slope(knots, values, before));
    correction[i] = 0.0;
  }
  const double g = -diagonal[0];
  diagonal[0] -= g;
  diagonal[n - 1] -= corner * corner / g;
  correction[0] = g;
  correction[n - 1] = corner;
  // Both systems have the same matrix, and solving overwrites it: keep a copy at the array's end.
  const Span<double> copy = correction.part(n, n);
  for (size_t i = 0; i < n; ++i) copy[i] = diagonal[i];
  const Span<const double> beside = off.part(0, n);
  TRY(solve_tridiagonal(diagonal.part(0, n), beside, moments.part(0, n), pace));
  TRY(solve_tridiagonal(copy, beside, correction.part(0, n), pace));
  const double ratio = corner / g;
  const double scale = 1.0 / (1.0 + correction[0] + ratio * correction[n - 1]);
  const Vec3 projection = scale * (moments[0] + ratio * moments[n - 1]);
  for (size_t i = 0; i < n; ++i) {
    TRY(pace->after());
    moments[i] -= correction[i] * projection;
  }
  moments[n] = moments[0];
  return {};
}

Vec3 parabola_tangent(Span<const double> knots, Span<const Vec3> values, bool last) {
  const size_t n = knots.size();
  if (n == 2) return chord_slope(knots, values, 0);
  const size_t first = last ? n - 3 : 0;
  const Vec3 slope0 = chord_slope(knots, values, first);
  const Vec3 slope1 = chord_slope(knots, values, first + 1);
  const Vec3 second = (1.0 / (knots[first + 2] - knots[first])) * (slope1 - slope0);
  if (last) return slope1 + (knots[first + 2] - knots[first + 1]) * second;
  return slope0 - (knots[first + 1] - knots[first]) * second;
}

Vec3 spline_value(const Spline& spline, size_t i, double t) {
  const double left = spline.knot[i], right = spline.knot[i + 1];
  if (t == left) return spline.value[i];
  if (t == right) return spline.value[i + 1];
  const double h = right - left;
  const double a = (right - t) / h, b = (t - left) / h;
  const double a3 = (a * a * a - a) * (h * h / 6.0), b3 = (b * b * b - b) * (h * h / 6.0);
  return a * spline.value[i] + b * spline.value[i + 1] + a3 * spline.moment[i] +
         b3 * spline.moment[i + 1];
}

Status fit_spline(Span<const double> knots, Span<const Vec3> values, SplineEnd end,
                  const Vec3& tangent_first, const Vec3& tangent_last, Pace* pace,
                  Span<Vec3> moments, SplineScratch* scratch) {
  const size_t n = knots.size();
  WIRESKIN_ASSERT(n >= (end == SplineEnd::periodic ? 4u : 2u));
  WIRESKIN_ASSERT(values.size() == n && moments.size() == n);
  TRY(scratch->diagonal.resize(n));
  TRY(scratch->off.resize(n));
  if (end == SplineEnd::periodic) {
    TRY(scratch->correction.resize(2 * (n - 1)));
    return periodic_moments(knots, values, pace, scratch->diagonal.span(), scratch->off.span(),
                            scratch->correction.span(), moments);
  }
  return open_moments(knots, values, end == SplineEnd::clamped, tangent_first, tangent_last, pace,
                      scratch->diagonal.span(), scratch->off.span(), moments);
}

}  // namespace wireskin::curves
