// Normals for the nodes of sharp curves where not all sides, or none, are known: needed only to put
// the curves round a node in order.
//
// In: curves, nodes. Out: a unit normal at every node of a crease. The axis of a node is across the
// plane that fits best the tips of the unit tangents that leave it: seen along it, the edges of a
// convex corner and the curves of a smooth point stand in their order. Its sense is that of the
// normals known there; or else it follows from a neighbour along a curve; where no node of a
// component has any, the axes point away from its middle. Fails with missing_normals, naming the
// node, where that decides nothing. O(knots + nodes^2 in the worst case of one long chain, else
// near linear).
#pragma once

#include "curves/curve.h"
#include "network/nodes.h"

namespace wireskin::network {

Status complete_node_normals(const curves::Curves& curves, Span<Node> nodes);

}  // namespace wireskin::network
