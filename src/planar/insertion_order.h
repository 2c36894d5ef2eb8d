// The order in which points are best added to a triangulation: in rounds of growing size, each
// along a Hilbert curve, so that every walk is short and no input makes incremental insertion
// slow.
//
// In: points with finite coordinates. Out: a permutation of their indices, the same in every run.
// Cost: O(n), 32 bytes a point of scratch.
// Source: N. Amenta, S. Choi, G. Rote, "Incremental Constructions con BRIO", 2003; D. Hilbert,
// "Ueber die stetige Abbildung einer Linie auf ein Flaechenstueck", 1891.
#pragma once

#include "base/array.h"
#include "num/vec.h"

namespace wireskin::planar {

Status insertion_order(Span<const Vec2> points, Array<uint32_t>* order);

}  // namespace wireskin::planar
