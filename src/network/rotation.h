// The rotation system of a network: the cyclic order of the segments round every node, and with it
// the way on for who comes to a node with a patch on the left.
//
// In: the segments with their nodes and curves. Out: of each half-segment the next one of its cycle
// (clockwise of where it comes from). The order is that of the tangents, seen from the tip of the
// node's normal; where these do not tell curves apart, that of secants of growing length. On a
// border all other curves leave to one side of it, the same along the whole border: where tangents
// deny that, as splines do where a polygon turns sharply or another curve meets the border at a
// small angle, secants and chords are asked, too, and the clearer nodes of the border decide on
// the side. O(samples + segments log segments). Source: J. Edmonds, "A Combinatorial Representation
// for Polyhedral Surfaces", 1960 (rotation systems); the order where tangents fail is our own.
#pragma once

#include "curves/sides.h"
#include "network/network.h"

namespace wireskin::network {

// Half-segments are numbered as in network.h.
struct Graph {
  const curves::Curves& curves;
  Span<const Node> nodes;
  Span<const Segment> segments;

  const Segment& segment_of(uint32_t h) const { return segments[h / 2]; }
  uint32_t from(uint32_t h) const { return h % 2 == 0 ? segment_of(h).from : segment_of(h).to; }
  curves::Curve curve_of(uint32_t h) const { return curves[segment_of(h).curve]; }
  // With the normals on the left of the half-segment.
  curves::Curve side_of(uint32_t h) const {
    return h % 2 == 0 ? curve_of(h) : seen_from_right(curves, segment_of(h).curve);
  }
};

// `next` has two elements for each segment. Fails with tangent_normal or inconsistent_normals at
// nodes whose segments have no order; if `faults` is given, these segments get that status there,
// and any order.
Status link_half_segments(const Graph& graph, Span<uint32_t> next, Array<Status>* faults);

}  // namespace wireskin::network
