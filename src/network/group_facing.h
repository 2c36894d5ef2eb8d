// Rule 4 of network/group.h: loops face each other where a band between them has less area than
// closing both alone would take.
//
// In: the loops that nothing was joined to yet, rings of boundary curves by both sides. Out: pairs
// joined, the band with the least area first. Conormals must lead from either loop to the other
// (network/facing.h); closing a loop alone takes the spherical cap that leaves it along its
// conormals, for a circle of area A and the mean cosine m between its normals and its axis 2 A /
// (1 + m), times (2 / (1 + m))^2 for what it bends. Loops that pass the same vertex never join.
// A join is ambiguous where another choice has hardly more area. O(n^2) in the loops that are near
// each other.
#pragma once

#include "network/grouping.h"

namespace wireskin::network {

Status join_facing(Grouping* g);

}  // namespace wireskin::network
