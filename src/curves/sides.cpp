#include "curves/sides.h"

namespace wireskin::curves {

static Status fit_right_of_curve(const RightSamples& samples, size_t c, Curves* curves,
                                 SplineScratch* scratch) {
  const size_t first = curves->start[c], count = curves->start[c + 1] - first;
  const Span<const double> knots = curves->knot.span().part(first, count);
  const Span<Vec3> values = curves->right.span().part(first, count);
  const Span<Vec3> moments = curves->right_moment.span().part(first, count);
  for (size_t k = 0; k < count; ++k) {
    values[k] = samples.normal[samples.start[c] + curves->sample[first + k]];
  }
  const bool closed = curves->sample[first] == curves->sample[first + count - 1];
  return fit_spline(knots, values, closed ? SplineEnd::periodic : SplineEnd::clamped,
                    parabola_tangent(knots, values, false), parabola_tangent(knots, values, true),
                    moments, scratch);
}

Status fit_right_normals(const RightSamples& samples, Curves* curves) {
  SplineScratch scratch(curves->start.context());
  TRY(curves->right.copy(curves->normal.span()));
  TRY(curves->right_moment.copy(curves->normal_moment.span()));
  for (size_t c = 0; c < curves->size(); ++c) {
    if (samples.sharp[c]) TRY(fit_right_of_curve(samples, c, curves, &scratch));
    if (c % 256 == 255) TRY(curves->start.context().checkpoint());
  }
  return {};
}

Curve seen_from_right(const Curves& curves, size_t curve) {
  Curve view = curves[curve];
  if (curves.right.empty()) return view;
  const size_t first = curves.start[curve], count = curves.start[curve + 1] - first;
  view.normal.value = curves.right.span().part(first, count);
  view.normal.moment = curves.right_moment.span().part(first, count);
  return view;
}

}  // namespace wireskin::curves
