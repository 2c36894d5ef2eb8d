// Which loops bound a patch together, and which pieces lie inside which patch.
//
// In: a network every cycle of which is a patch of its own, and the curve vertices. Out: the same
// network with patches of several loops and with inner segments and points. Four rules, in this
// order, each in a file of its own; where none applies every cycle stays a patch.
// 1. A component that a patch encloses in its plane joins it (group_enclosed.h).
// 2. Closed curves apart from the rest are joined in pairs, with little area (group_rings.h).
// 3. Loops that see each other along the surface join (group_sight.h).
// 4. What lies on the guessed surface of a patch joins it (group_guests.h).
// Rules 1 to 3 make new patches before rule 4 looks. O(n log^2 n) and the pairs that are near.
#pragma once

#include "network/resample.h"

namespace wireskin::network {

// Patches of several loops that might as well have been others: how many, and the first of them.
struct Ambiguity {
  uint32_t patches = 0;
  uint32_t first = k_none;
};

// `ambiguity` may be null. Fails with open_network for pieces that lie in no patch, and for a
// boundary curve none of whose sides is the inside by its normals.
Status group_patches(const CurveVertices& vertices, Network* network,
                     Ambiguity* ambiguity = nullptr);

}  // namespace wireskin::network
