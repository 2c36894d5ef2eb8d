#include "curves/sides.h"

namespace wireskin::curves {

static Status fit_right_of_curve(const RightSamples& samples, size_t c, Pace* pace, Curves* curves,
                                 SplineScratch* scratch) {
  const size_t first = curves->start[c], count = curves->start[c + 1] - first;
  const Span<const double> knots = curves->knot.span().part(first, count);
  const Span<Vec3> values = curves->right.span().part(first, count);
  const Span<Vec3> moments = curves->right_moment.span().part(first, count);
  for (size_t k = 0; k < count; ++k) {
    TRY(pace->after());
    values[k] = samples.normal[samples.start[c] + curves->sample[first + k]];
  }
  const bool closed = curves->sample[first] == curves->sample[first + count - 1];
  return fit_spline(knots, values, closed ? SplineEnd::periodic : SplineEnd::clamped,
                    parabola_tangent(knots, values, false), parabola_tangent(knots, values, true),
                    pace, moments, scratch);
}

Status fit_right_normals(const RightSamples& samples, Curves* curves) {
  SplineScratch scratch(curves->start.context());
  Pace pace(curves->start.context());
  TRY(copy_in_parts(curves->normal, &curves->right));
  TRY(copy_in_parts(curves->normal_moment, &curves->right_moment));
  for (size_t c = 0; c < curves->size(); ++c) {
    TRY(pace.after());
    if (samples.sharp[c]) TRY(fit_right_of_curve(samples, c, &pace, curves, &scratch));
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
