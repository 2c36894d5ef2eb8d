// Strings of beads as curves again, once places on them were made one point.
//
// In: beads (network/beads.h). Out: the curves, with a sample for each bead. A point comes to the
// mean of those of its former points that rank highest: nodes before insides of curves, these
// before ends. The samples between follow (network/bend.h); curves on which nothing moves keep
// their bits. Where a curve leaves a new node and comes back within `detour`, as at the tip of an
// overshoot, that stretch is left out, unless no curve would remain. O(beads), but for the beads
// within a detour of every new node.
#pragma once

#include "network/beads.h"

namespace wireskin::network {

Status write_beads(double detour, Beads* beads, Wires* out);

}  // namespace wireskin::network
