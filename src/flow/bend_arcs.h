// Arcs given by few samples become the smooth curves through them, so that sheets do not merge at
// the facets of their polylines, short of the curves, and then are no manifold to be smoothed.
//
// In: arcs and the step at which they will be sampled. Out: the same arcs with more vertices on
// their paths, where samples are farther apart than a quarter of the step: on cubics through the
// samples, whose tangents are those of the parabolas through three neighbours along the chains that
// arcs form. Corners (of more than 35 degrees) stay corners, straight stretches stay straight, bit
// for bit, and beside a short segment a long one bends only as far as the short one reaches. Given
// vertices keep their places and numbers, new ones follow. O(vertices). Source: C. de Boor, "A
// Practical Guide to Splines", 1978, chapter IV (Bessel's cubics).
#pragma once

#include "flow/arcs.h"

namespace wireskin::flow {

Status bend_arcs(Context& context, double step, Arcs* arcs);

}  // namespace wireskin::flow
