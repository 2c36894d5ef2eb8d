#include "curves/curve.h"

#include "base/search.h"
#include "curves/opposed.h"

namespace wireskin::curves {

// Normals turning by more than this between neighbouring samples (120 degrees) are taken for a
// contradiction: no sampling that shows the surface turns that fast, but a flipped normal does.
static constexpr double k_least_normal_cosine = -0.5;

static Status fail_sample(Code code, const char* sentence, size_t sample) {
  return fail_at_sample(code, sentence, k_none, static_cast<uint32_t>(sample));
}

// From the sample before to the one behind, as far as there are any.
static Vec3 direction_at(const Samples& samples, size_t i) {
  const size_t n = samples.position.size(), last = n - 1;
  const size_t before = i > 0 ? i - 1 : samples.closed ? last : 0;
  const size_t behind = i < last ? i + 1 : samples.closed ? 0 : last;
  return samples.position[behind] - samples.position[before];
}

// Whether the normals of two neighbouring samples point to different sides of the surface.
static bool sides_differ(const Samples& samples, size_t before, size_t i) {
  const Vec3 &a = samples.normal[before], &b = samples.normal[i];
  return opposed(a, b, samples.position[i] - samples.position[before]) &&
         lies_across(a, direction_at(samples, before)) && lies_across(b, direction_at(samples, i));
}

// The unit direction across the curve within the surface.
static Vec3 conormal(const Samples& samples, size_t i) {
  return unit(cross(direction_at(samples, i), samples.normal[i]));
}

// Whether the curve bends over between two samples, as at the tip of a thin section that has no
// sample there: it turns back, both normals lie along the chord, out of the tip or both into it,
// and conormals, which bending leaves alone, agree but for a twist.
static bool bends_over(const Samples& samples, size_t before, size_t i) {
  constexpr double k_least_along = 0.5, k_twist_cosine = 0.5;
  const Vec3 chord = unit(samples.position[i] - samples.position[before]);
  const double from = dot(samples.normal[before], chord), to = dot(samples.normal[i], chord);
  const bool turns_back = dot(direction_at(samples, before), direction_at(samples, i)) < 0.0;
  return turns_back && from * to < 0.0 && std::fabs(from) > k_least_along &&
         std::fabs(to) > k_least_along &&
         dot(conormal(samples, before), conormal(samples, i)) > k_twist_cosine;
}

Status check_samples(const Samples& samples, Pace* pace) {
  const size_t n = samples.position.size();
  if (n < (samples.closed ? 3u : 2u)) {
    return fail(Code::too_few_samples, samples.closed
                                           ? "a closed curve needs at least three samples"
                                           : "a curve needs at least two samples");
  }
  bool moves = false;
  for (size_t i = 1; i < n && !moves; ++i) moves = samples.position[i] != samples.position[0];
  if (!moves) return fail(Code::zero_length_curve, "all samples of the curve are the same point");
  for (size_t i = samples.closed ? 0 : 1; i < n; ++i) {
    TRY(pace->after());
    const size_t before = i == 0 ? n - 1 : i - 1;
    if (samples.position[i] == samples.position[before]) {
      return fail_sample(Code::duplicate_samples,
                         i == 0 ? "the first sample of the closed curve repeats the last"
                                : "the sample repeats the one before it",
                         i);
    }
    if (sides_differ(samples, before, i)) {
      return fail_sample(Code::inconsistent_normals,
                         "the normal points to the other side than at the sample before; if only "
                         "signs are wrong, the option orient makes them agree",
                         i);
    }
    if (dot(samples.normal[i], samples.normal[before]) < k_least_normal_cosine) {
      return fail_sample(
          Code::inconsistent_normals,
          bends_over(samples, before, i)
              ? "the curve turns round a tip between the sample before and this one, by more than "
                "120 degrees, and has no sample there: give it one at the tip"
              : "the normal turns by more than 120 degrees from the sample before, and the curve "
                "does not turn with it: samples are too far apart there or, if only signs are "
                "wrong, the option orient makes them agree",
          i);
    }
  }
  return {};
}

static Status measure_spacing(const Samples& samples, Pace* pace, double* mean) {
  const size_t n = samples.position.size();
  double sum = 0.0;
  for (size_t i = 1; i < n; ++i) {
    TRY(pace->after());
    sum += length(samples.position[i] - samples.position[i - 1]);
  }
  if (samples.closed) sum += length(samples.position[0] - samples.position[n - 1]);
  *mean = sum / static_cast<double>(samples.closed ? n : n - 1);
  return {};
}

static uint32_t first_node(const Samples& samples) {
  for (size_t i = 0; i < samples.node.size(); ++i) {
    if (samples.node[i] != k_none) return static_cast<uint32_t>(i);
  }
  return 0;
}

// A sample that must stay pushes out a droppable one just before it.
Status thin(const Samples& samples, Pace* pace, Array<uint32_t>* kept) {
  const uint32_t start = samples.closed ? first_node(samples) : 0;
  const uint32_t n = static_cast<uint32_t>(samples.position.size());
  double mean = 0.0;
  TRY(measure_spacing(samples, pace, &mean));
  const double least = 0.5 * mean;
  TRY(kept->reserve(n + 1));
  kept->clear();
  const auto near = [&](uint32_t a, uint32_t b) {
    return length(samples.position[a] - samples.position[b]) < least;
  };
  for (uint32_t k = 0; k < n; ++k) {
    TRY(pace->after());
    const uint32_t i = samples.closed ? (start + k) % n : k;
    const bool end = k == 0 || (!samples.closed && k == n - 1);
    if (samples.node[i] == k_none && !end) {
      if (!near(i, kept->back())) kept->push_reserved(i);
      continue;
    }
    if (kept->size() > 1 && samples.node[kept->back()] == k_none && near(i, kept->back()))
      kept->pop();
    kept->push_reserved(i);
  }
  if (samples.closed && samples.node[kept->back()] == k_none && near(kept->back(), (*kept)[0])) {
    kept->pop();
  }
  bool whole = kept->size() >= (samples.closed ? 3u : 2u);
  for (size_t k = samples.closed ? 0 : 1; whole && k < kept->size(); ++k) {
    TRY(pace->after());
    const uint32_t before = (*kept)[k == 0 ? kept->size() - 1 : k - 1];
    whole = samples.position[(*kept)[k]] != samples.position[before];
  }
  // A polygon of very uneven sides, or a small loop from a node back to it, would collapse to a
  // line to and fro or to a point.
  if (!whole) {
    kept->clear();
    for (uint32_t k = 0; k < n; ++k) {
      TRY(pace->after());
      kept->push_reserved(samples.closed ? (start + k) % n : k);
    }
  }
  return {};
}

// Five-point Gauss-Legendre quadrature of the speed from the start of interval i to t.
static double arc_in_interval(const Spline& spline, size_t i, double t) {
  constexpr double k_node[3] = {0.0, 0.53846931010568309104, 0.90617984593866399280};
  constexpr double k_weight[3] = {0.56888888888888888889, 0.47862867049936646804,
                                  0.23692688505618908751};
  const double half = 0.5 * (t - spline.knot[i]);
  const double middle = spline.knot[i] + half;
  double sum = k_weight[0] * length(spline_derivative(spline, i, middle));
  for (int k = 1; k < 3; ++k) {
    sum += k_weight[k] * (length(spline_derivative(spline, i, middle - half * k_node[k])) +
                          length(spline_derivative(spline, i, middle + half * k_node[k])));
  }
  return half * sum;
}

// The parameter at which the arc from the start of interval i is `target`: Newton's method, kept in
// its bracket by bisection.
static double parameter_of_arc(const Spline& spline, size_t i, double target, double whole) {
  double low = spline.knot[i], high = spline.knot[i + 1];
  double t = low + (high - low) * (target / whole);
  for (int step = 0; step < 60; ++step) {
    const double excess = arc_in_interval(spline, i, t) - target;
    if (excess > 0.0) {
      high = t;
    } else {
      low = t;
    }
    const double speed = length(spline_derivative(spline, i, t));
    double next = speed > 0.0 ? t - excess / speed : low;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (std::fabs(next - t) <= 1e-15 * std::fabs(high) || next == t) return next;
    t = next;
  }
  return t;
}

Curve Curves::operator[](size_t curve) const {
  const size_t first = start[curve], count = start[curve + 1] - first;
  const Span<const double> knots = knot.span().part(first, count);
  return {{knots, position.span().part(first, count), position_moment.span().part(first, count)},
          {knots, normal.span().part(first, count), normal_moment.span().part(first, count)},
          arc.span().part(first, count),
          sample.span().part(first, count),
          node.span().part(first, count)};
}

Status reserve_knots(size_t room, Curves* curves) {
  if (room <= curves->room) return {};
  TRY(curves->knot.reserve(room));
  TRY(curves->arc.reserve(room));
  TRY(curves->position.reserve(room));
  TRY(curves->position_moment.reserve(room));
  TRY(curves->normal.reserve(room));
  TRY(curves->normal_moment.reserve(room));
  TRY(curves->sample.reserve(room));
  TRY(curves->node.reserve(room));
  curves->room = room;
  return {};
}

// Room for `count` more knots, not yet filled. Grows all arrays by half at least, so that many
// short curves cost linear time.
static Status extend(size_t count, Curves* curves) {
  const size_t size = curves->knot.size() + count;
  if (size >= k_none) return fail(Code::too_large, "too many samples for 32-bit indices");
  if (curves->start.empty()) TRY(curves->start.push(0));
  const size_t half_more = curves->room + curves->room / 2;
  if (size > curves->room) TRY(reserve_knots(size > half_more ? size : half_more, curves));
  TRY(curves->knot.resize(size));
  TRY(curves->arc.resize(size));
  TRY(curves->position.resize(size));
  TRY(curves->position_moment.resize(size));
  TRY(curves->normal.resize(size));
  TRY(curves->normal_moment.resize(size));
  TRY(curves->sample.resize(size));
  TRY(curves->node.resize(size));
  return curves->start.push(static_cast<uint32_t>(size));
}

static Status fit(Span<const double> knots, Span<const Vec3> values, bool closed, Pace* pace,
                  Span<Vec3> moments, SplineScratch* scratch) {
  return fit_spline(knots, values, closed ? SplineEnd::periodic : SplineEnd::clamped,
                    parabola_tangent(knots, values, false), parabola_tangent(knots, values, true),
                    pace, moments, scratch);
}

Status fit_curve(const Samples& samples, Span<const uint32_t> kept, Pace* pace, Curves* curves) {
  constexpr size_t k_steps_of_arc = 4;
  SplineScratch scratch(curves->start.context());
  const size_t first = curves->knot.size(), count = kept.size() + (samples.closed ? 1 : 0);
  TRY(extend(count, curves));
  const Span<double> knots = curves->knot.span().part(first, count);
  const Span<Vec3> positions = curves->position.span().part(first, count);
  const Span<Vec3> normals = curves->normal.span().part(first, count);
  for (size_t k = 0; k < count; ++k) {
    TRY(pace->after());
    const uint32_t sample = kept[k < kept.size() ? k : 0];
    positions[k] = samples.position[sample];
    normals[k] = samples.normal[sample];
    knots[k] = k == 0 ? 0.0 : knots[k - 1] + length(positions[k] - positions[k - 1]);
    curves->sample[first + k] = sample;
    curves->node[first + k] = samples.node[sample];
  }
  if (count == 1) {  // a point
    curves->position_moment[first] = curves->normal_moment[first] = Vec3{};
    curves->arc[first] = 0.0;
    return {};
  }
  TRY(fit(knots, positions, samples.closed, pace, curves->position_moment.span().part(first, count),
          &scratch));
  TRY(fit(knots, normals, samples.closed, pace, curves->normal_moment.span().part(first, count),
          &scratch));
  const Spline spline = (*curves)[curves->size() - 1].position;
  double arc = 0.0;
  for (size_t k = 0; k < count; ++k) {
    TRY(pace->after(k_steps_of_arc));
    if (k > 0) arc += arc_in_interval(spline, k - 1, knots[k]);
    curves->arc[first + k] = arc;
  }
  return {};
}

Status add_curve(const Samples& samples, Curves* curves) {
  Array<uint32_t> kept(curves->start.context());
  Pace pace(curves->start.context());
  TRY(thin(samples, &pace, &kept));
  return fit_curve(samples, kept.span(), &pace, curves);
}

CurvePoint point_at(const Curve& curve, uint32_t first, uint32_t last, double s) {
  const size_t low =
      last_holding(size_t{first}, size_t{last}, [&](size_t i) { return curve.arc[i] <= s; });
  const double inside = s - curve.arc[low];
  const double whole = curve.arc[low + 1] - curve.arc[low];
  double t = curve.position.knot[low];
  if (inside > 0.0) {
    t = inside < whole ? parameter_of_arc(curve.position, low, inside, whole)
                       : curve.position.knot[low + 1];
  }
  // Of normals that nearly cancel out rounding leaves some direction, which means nothing.
  constexpr double k_least_normal = 1e-3;
  const Vec3 normal = spline_value(curve.normal, low, t);
  const bool cancels = !(dot(normal, normal) > k_least_normal * k_least_normal);
  return {spline_value(curve.position, low, t), cancels ? Vec3{} : unit(normal)};
}

Vec3 tangent_at_knot(const Curve& curve, uint32_t knot) {
  const size_t last = curve.position.intervals();
  if (knot == last) return spline_derivative(curve.position, last - 1, curve.position.knot[last]);
  return spline_derivative(curve.position, knot, curve.position.knot[knot]);
}

}  // namespace wireskin::curves
