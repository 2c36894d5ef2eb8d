// Which loops bound a patch together, and which pieces lie inside which patch: the connected
// components of a network brought together.
//
// In: a network every cycle of which is a patch of its own, and the curve vertices. Out: the same
// network with patches of several loops and with inner segments and points. Four rules, in this
// order; where none applies every cycle stays a patch.
// 1. A component enclosed by a patch in its plane (network/enclosure.h) joins it by the cycle that
// runs clockwise there and faces the same way. A ring of boundary curves becomes a hole; what
// bounds nothing (dangling curves, points) holds the patch's inside.
// 2. Other loops face each other: where the conormals, which point into the patch along the
// surface, lead from either loop to the other, and a band between the two has less area than
// closing both alone would take: the spherical cap that leaves a loop along its conormals, 2 A / (1
// + m) for a circle of area A and the mean cosine m between its normals and its axis, times (2 / (1
// + m))^2. Nearest pairs join first, never loops that pass the same vertex.
// 3. What is left and lies on the guessed surface of a patch (network/nearest_patch.h) joins it as
// by rule 1: pieces that bound nothing, loops that run clockwise, rings. A piece also says which
// side of a ring has the surface.
// 4. A loop that still is alone and runs clockwise round its normals joins the patch at which most
// of its places look: the nearest border, along their conormals, whose conormals look back. O(n log
// n) and the pairs that are near each other.
#pragma once

#include "network/enclosure.h"

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
