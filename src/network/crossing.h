// Whether curves that come near each other are meant to meet there, or pass side by side.
//
// In: the curves and one of their approaches. Seen along the gap the two curves cross if, going
// round the place, branches of both come by turns: a, b, a, b. What runs along the other curve
// within ten degrees, or along the gap, is no branch; so a closed curve beside another one, and two
// that are parallel for a while, do not cross. Branches are seen two gaps away from the place,
// since that is where the gap stops to matter, and at a node those of all curves together. Where a
// curve ends at nothing there is nothing to cross: an end may meet whatever is near. Between these
// stands the corner, or node, that points to the other curve: all its branches lead away from that,
// in space or seen along the gap; but corners of boundary curves do not, as holes have them.
// O(curves at the place), at most 64 samples each.
#pragma once

#include "network/beads.h"

namespace wireskin::network {

// Whether curves with these unit directions run along each other, either way.
bool run_along(const Vec3& a, const Vec3& b);

struct Branch {
  Vec3 direction;  // unit, across the gap
  double turn;     // ascends with the angle round the gap
  bool of_a;
  bool away;  // leads away from the other curve
  bool along = false;
};

enum class Contact : uint8_t { meets, points, beside };

// `scratch` is overwritten.
Status judge_contact(const Beads& beads, const Approach& approach, Array<Branch>* scratch,
                     Contact* contact);

}  // namespace wireskin::network
