// Rule 1 of network/group.h: a component that a patch encloses in its plane joins that patch.
//
// In: the components, and which patch encloses each (network/enclosure.h). Out: of a component that
// bounds something the cycle that runs clockwise in the plane and faces the same way, the largest
// such, joined to the patch round it, so that a ring of boundary curves becomes a hole; a component
// that bounds nothing (dangling curves, points) gets its holder, or a doubtful one where it faces
// another way. The outermost join first: what lies in a hole is enclosed by nothing. O(border) for
// each component, and sorting.
#pragma once

#include "network/grouping.h"

namespace wireskin::network {

// `g->enclosing` is to be filled.
Status join_enclosed(Grouping* g);

}  // namespace wireskin::network
