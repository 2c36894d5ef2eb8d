// From the caller's samples to fitted curves: checks, nodes, noise, splines.
//
// In: all samples of a network. Out: its nodes and the splines of its curves, and the noise found.
// The samples are changed in place: those of a node get its position and normal, and noise is taken
// out. O(samples log samples) without smoothing; see network/smoothing.h.
#pragma once

#include "curves/curve.h"
#include "network/nodes.h"
#include "surface.h"

namespace wireskin {

double diagonal(Span<const Vec3> points);

// `size`: the diagonal of the network. Failures name curve and sample.
Status fit_curves(Context& context, const CurveSet& set, double size,
                  const network::SmoothingOptions& smoothing, Array<network::Node>* nodes,
                  curves::Curves* fitted, Counts* counts);

}  // namespace wireskin
