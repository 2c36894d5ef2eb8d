// Borders that no surface can have, sought where the plane of a patch fails: those that cross
// themselves in space, and those that run clockwise round their own normals, as the outside of an
// open surface does whose border is not tagged; and those whose normals ask for a one-sided surface
// or for crossings (network/linking.h).
//
// In: the loops of a border with their normals (zero: unknown). Out: a status without place.
// O(n log n) and the pairs of edges whose extents meet along an axis.
#pragma once

#include "network/border.h"

namespace wireskin::network {

// Beyond doubt: the vector area is large and points against the mean normal.
bool runs_clockwise(const Border& border);

// Fails with patch_folded or patch_without_plane.
Status check_border(const Border& border);

}  // namespace wireskin::network
