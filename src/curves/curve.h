// From samples of curves to splines of positions and normals that can be evaluated by arc length.
//
// In: samples (positions, unit normals, which of them are nodes), open or closed. Samples nearer
// than half the curve's mean spacing to the last one kept are dropped (nodes and ends stay), then
// both splines share the chord-length parameter of those kept. A closed curve with nodes begins at
// its first node. Out: the splines, the arc length at every knot, and which sample each knot came
// from. Invariants: knots of nodes carry the sample's position bit for bit. O(samples). Source: T.
// Stanko et al., "Surfacing Curve Networks with Normal Control", 2016, section 3.3.
#pragma once

#include "curves/spline.h"

namespace wireskin::curves {

struct Samples {
  Span<const Vec3> position;
  Span<const Vec3> normal;    // unit vectors
  Span<const uint32_t> node;  // index of the node at each sample, k_none for ordinary ones
  bool closed = false;        // the last sample is followed by the first
};

// One fitted curve: a view. A closed curve repeats its first knot at the end.
struct Curve {
  Spline position;
  Spline normal;                // not unit between knots: normalise after evaluation
  Span<const double> arc;       // arc length from the first knot to each knot
  Span<const uint32_t> sample;  // of each knot
  Span<const uint32_t> node;    // of each knot
};

// All fitted curves one after the other; curve c has the knots start[c] .. start[c + 1).
struct Curves {
  Array<uint32_t> start;
  Array<double> knot, arc;
  Array<Vec3> position, position_moment, normal, normal_moment;
  Array<uint32_t> sample, node;
  size_t room = 0;  // knots that fit without growing
  // Normals on the right of the curves, see curves/sides.h; empty where no curve is sharp.
  Array<Vec3> right, right_moment;

  explicit Curves(Context& context)
      : start(context),
        knot(context),
        arc(context),
        position(context),
        position_moment(context),
        normal(context),
        normal_moment(context),
        sample(context),
        node(context),
        right(context),
        right_moment(context) {}
  size_t size() const { return start.empty() ? 0 : start.size() - 1; }
  Curve operator[](size_t curve) const;
};

// Checks that neighbouring samples differ, that there are enough of them and that normals do not
// jump. The place of a failure names the sample; the caller knows the curve.
Status check_samples(const Samples& samples, Pace* pace);

// The samples to interpolate, in order along the curve; a closed curve begins at its first node.
Status thin(const Samples& samples, Pace* pace, Array<uint32_t>* kept);

// Room for so many knots in all, for callers who know: growing copies.
Status reserve_knots(size_t count, Curves* curves);

// Fits one more curve through the samples `kept`, in that order; the others are not read. Smoothing
// comes between thinning and this. An open curve of one sample is a point: one knot, no interval.
Status fit_curve(const Samples& samples, Span<const uint32_t> kept, Pace* pace, Curves* curves);

// Thins and fits at once.
Status add_curve(const Samples& samples, Curves* curves);

struct CurvePoint {
  Vec3 position;
  Vec3 normal;  // unit; zero where opposite normals cancel out
};

// The point at arc length s of the stretch from knot `first` to knot `last`,
// arc[first] <= s <= arc[last].
CurvePoint point_at(const Curve& curve, uint32_t first, uint32_t last, double s);

// Finding it takes a microsecond or two, as long as so many steps of a usual pass.
inline constexpr size_t k_steps_of_point = 8;

// The direction of the curve at a knot (not unit).
Vec3 tangent_at_knot(const Curve& curve, uint32_t knot);

}  // namespace wireskin::curves
