// The normals on both sides of the vertices on the curves, where some curves are sharp.
//
// In: curves with their fields on the right, segments, vertices. Out: CurveVertices::left and
// ::right, and for the vertices inside sharp segments the mean of both. At a node every segment has
// the normals of its own curve there. O(vertices).
#pragma once

#include "network/resample.h"

namespace wireskin::network {

// Fails with inconsistent_normals where opposite normals cancel out on a curve.
Status resample_sides(const curves::Curves& curves, const Network& network,
                      CurveVertices* vertices);

// The normal on the left of half-segment h at its vertex k, counted in its own direction; zero
// where it is not known.
Vec3 left_normal(const Network& network, const CurveVertices& vertices, uint32_t h, uint32_t k);

}  // namespace wireskin::network
