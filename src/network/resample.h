// The vertices on the curves: every segment divided evenly by arc length.
//
// In: fitted curves, nodes, segments, the wished spacing. Out: the nodes (vertex i is node i, bit
// for bit), then the inner vertices of each segment in order, with unit normals. A segment has the
// number of edges nearest to its length over the spacing, but enough that no two segments share an
// edge: three where it returns to its own node, two where another one joins the same nodes.
// O(vertices).
#pragma once

#include "network/network.h"

namespace wireskin::network {

struct CurveVertices {
  Array<Vec3> position;
  Array<Vec3> normal;     // unit
  Array<uint32_t> curve;  // of each vertex; at a node the least
  Array<uint32_t> edges;  // of each segment
  Array<uint32_t> first;  // of each segment: its first inner vertex
  uint32_t nodes = 0;     // the first vertices
  double length = 0.0;    // of all segments together

  explicit CurveVertices(Context& context)
      : position(context), normal(context), curve(context), edges(context), first(context) {}
};

// Fails with too_large, or with inconsistent_normals where opposite normals cancel out on a curve.
Status resample(const curves::Curves& curves, Span<const Node> nodes, const Network& network,
                double spacing, CurveVertices* vertices);

// Vertex k of segment s, 0 <= k <= edges[s].
uint32_t segment_vertex(const Network& network, const CurveVertices& vertices, uint32_t s,
                        uint32_t k);

}  // namespace wireskin::network
