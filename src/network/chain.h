// Pieces of curves become maximal curves: through every point at which exactly two ends meet,
// unless the curves turn there by a corner or differ in what they are.
//
// In: welded curves. Out: the same samples, each joint once, pieces turned round where needed (the
// sides of sharp ones change places); a chain whose last end is its first becomes a closed curve.
// Curves that join nothing keep samples, direction and order, a chain stands where its first piece
// stood. A turn is a corner if it exceeds `corner`; by the automatic rule, if it exceeds 60
// degrees, or 35 and twice the turns at the samples next to it, so that coarse circles stay whole.
// O(samples).
#pragma once

#include "network/wires.h"

namespace wireskin::network {

enum class Chaining {
  // Joins ends, but leaves a joint that the caller made by a node number between two curves of more
  // than two samples.
  automatic,
  none,
  all
};

// `corner` in radians; zero: the automatic rule.
Status chain_wires(Chaining chaining, double corner, Wires* wires);

}  // namespace wireskin::network
