// The points of a hexagonal lattice inside a polygon that keep clear of its border: where the
// border is as fine as the lattice by a little less than one spacing, else by as much more as
// sizes need to grade from one to the other.
//
// In: a simple counter-clockwise border and the wished spacing. One row of the lattice lies on the
// border's longest edge, so the result turns with the polygon. Out: the points, row by row; none
// at all where the rows would cost more than the points are worth (the caller's refinement fills
// in).
// Cost: O(points + edges x rows near each, which is limited in proportion to the points).
#pragma once

#include "base/array.h"
#include "num/vec.h"

namespace wireskin::planar {

Status lattice_points(Span<const Vec2> border, double spacing, double expected,
                      Array<Vec2>* points);

}  // namespace wireskin::planar
