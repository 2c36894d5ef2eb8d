// Whether curves that come near each other are meant to meet there, or pass side by side.
//
// In: the curves and one of their approaches. Seen along the gap the two curves cross if, going
// round the place, branches of both come by turns: a, b, a, b. What runs along the other curve
// within ten degrees, or along the gap, is no branch; so a closed curve beside another one, two
// that are parallel for a while, and the corner of one that points to the other do not cross.
// Branches are seen two gaps away from the place, since that is where the gap stops to matter. At a
// node all curves there are looked at together. Where a curve ends at nothing there is nothing to
// cross: an end may meet whatever is near. O(curves at the place) and at most 64 samples each.
#pragma once

#include "network/beads.h"

namespace wireskin::network {

// Whether curves with these unit directions run along each other, either way.
bool run_along(const Vec3& a, const Vec3& b);

struct Branch {
  Vec3 direction;  // unit, across the gap
  double turn;     // ascends with the angle round the gap
  bool of_a;
};

// `scratch` is overwritten.
Status cross_or_end(const Beads& beads, const Approach& approach, Array<Branch>* scratch,
                    bool* result);

}  // namespace wireskin::network
