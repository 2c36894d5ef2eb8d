// Rule 4 of network/group.h: what lies on the guessed surface of a patch joins that patch.
//
// In: what the rules before have left alone: pieces that bound nothing and are not `settled`, loops
// that run clockwise round their normals, rings of boundary curves. Out: those that lie on the
// surface guessed of a patch from its border alone (network/nearest_patch.h) joined to it or held
// by it; a piece also says which side of a ring has the surface. O(guests times the triangles of
// the guesses near them).
#pragma once

#include "network/grouping.h"

namespace wireskin::network {

// `settled`: of each component, whether it has its holder already.
Status join_guests(Grouping* g, Span<const uint8_t> settled);

}  // namespace wireskin::network
