// The constrained Delaunay triangulation of one side of a constraint's corridor: of the region
// between a segment and a chain of edges on its left, each vertex of which sees the segment.
//
// In: `points`, the chain from one end of the segment to the other; edges may hang into the region,
// so a point may occur twice. Out: `triangles` over the places in the chain, counter-clockwise, and
// `inner`: the half-edge (4 * triangle + corner) along each edge of the region. A region without
// inside (two points) gives none.
// Cost: expected about linear, by reinserting the vertices in random order; a last pass of flips
// proves the result. Where that fails (hanging edges) the cost is quadratic at worst.
// Sources: J. R. Shewchuk, B. C. Brown, "Fast Segment Insertion and Incremental Construction of
// Constrained Delaunay Triangulations", 2015; short chains: M. V. Anglada, "An Improved Incremental
// Algorithm for Constructing Restricted Delaunay Triangulations", 1997.
#pragma once

#include "base/array.h"
#include "num/vec.h"

namespace wireskin::planar {

struct SideTriangle {
  uint32_t vertex[3];  // counter-clockwise
  uint32_t twin[3];    // k_none at the chain and the segment
};

struct SideTriangles {
  explicit SideTriangles(Context& context) : points(context), triangles(context), inner(context) {}

  Array<Vec2> points;
  Array<SideTriangle> triangles;
  Array<uint32_t> inner;  // [i]: along the chain from point i + 1 to i; the last: the segment
};

Status triangulate_side(SideTriangles* side);

}  // namespace wireskin::planar
