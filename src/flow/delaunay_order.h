// The order in which points of space are best added to a triangulation: in rounds of growing size,
// each along a Hilbert curve, so that walks are short and no input makes incremental insertion
// slow.
//
// In: points with finite coordinates. Out: their numbers in that order, points at the same place
// once (by the least number), and for each point the number that stands for its place. The order
// depends on the coordinates alone, not on the numbers: what is built in it is the same for any
// numbering, even where ties are decided by the order.
// Cost: linear but for points in one of 2^60 cells, 32 bytes a point of scratch.
// Source: N. Amenta, S. Choi, G. Rote, "Incremental Constructions con BRIO", 2003; J. Skilling,
// "Programming the Hilbert Curve", 2004.
#pragma once

#include "base/array.h"
#include "num/vec.h"

namespace wireskin::flow {

// Mixes the bits of a place; equal places give equal numbers (0.0 and -0.0 are the same place).
uint64_t hash_place(const Vec3& p, uint64_t seed);

Status delaunay_order(Context& context, Span<const Vec3> points, Array<uint32_t>* order,
                      Array<uint32_t>* same_as);

}  // namespace wireskin::flow
