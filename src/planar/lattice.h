// The points of a hexagonal lattice inside a region that keep clear of its curves: where those are
// as fine as the lattice by a little less than one spacing, else by as much more as sizes need to
// grade from one to the other.
//
// In: the edges of the border and of curves inside, single points, and the wished spacing. Inside
// is where a row has crossed the border an odd number of times. One row of the lattice lies on the
// longest edge, so the result turns with the region. Out: the points, row by row; none at all where
// the rows would cost more than the points are worth (the caller's refinement fills in).
// Cost: O(points + edges x rows near each, which is limited in proportion to the points).
#pragma once

#include "base/array.h"
#include "num/vec.h"

namespace wireskin::planar {

// An edge, or a point where a == b, with the edge length wished there.
struct LatticeObstacle {
  Vec2 a, b;
  double size;
  bool border;  // divides inside from outside
};

Status lattice_points(Span<const LatticeObstacle> obstacles, double spacing, double expected,
                      Array<Vec2>* points);

}  // namespace wireskin::planar
