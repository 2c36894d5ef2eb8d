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

// The normals of a patch's own side along its border, in the order of border_of_patch; at a node
// the mean of the two segments that meet there. Zero where they are not known.
Status normals_of_border(const Network& network, const CurveVertices& vertices, uint32_t p,
                         Array<Vec3>* normals);

}  // namespace wireskin::network
