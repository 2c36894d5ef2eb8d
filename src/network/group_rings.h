// Rule 2 of network/group.h: closed curves that meet no other, which of their sides bound a band
// together, and which a cap.
//
// In: what the plane has joined (network/group_enclosed.h). Every side of a ring is a loop of its
// own; of a ring of boundary curves only one is to have surface. Out: sides joined in pairs so that
// the areas are small in sum (network/ring_pairs.h), and sides left alone that see both loops of a
// pair well joined to it. Both are settled: rule 3 does not join them again. Rings near other
// curves, and rings near such ones, are left to the rules that follow. O(n^2) in the distances of
// loops where there are rings at all; so many bands as network/ring_bands.h looks at.
#pragma once

#include "network/grouping.h"

namespace wireskin::network {

Status join_rings(Grouping* g);

}  // namespace wireskin::network
