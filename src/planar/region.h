// From points, border edges and inner edges, all named by index, to a constrained Delaunay
// triangulation whose triangles know whether they lie inside.
//
// A point of the plane is inside where a ray from it crosses the border an odd number of times:
// loops may nest, touch at points and stand in any order and direction; an edge given twice divides
// nothing. Edges of `lines` lie inside and divide nothing; points without edges lie inside too.
// With `join`, equal points become one, and an edge through another point is split there; edges
// that run over each other become one. Without, those are refused like edges that cross.
// Failures name the two edges, or the edge and the point, in Conflict: patch_folded for what
// crosses or touches, open_network for a border that is not closed, bad_argument for a point or a
// line outside, patch_without_plane where nothing is inside, index_out_of_range.
// Cost: O(n log n) expected, and the number of triangles that edges cross on their way.
#pragma once

#include "planar/constrained_delaunay.h"

namespace wireskin::planar {

struct Region {
  Span<const Vec2> points;
  Span<const uint32_t> border;  // two points an edge; its loops are closed
  Span<const uint32_t> lines;   // two points an edge
  bool join = true;

  size_t edges() const { return (border.size() + lines.size()) / 2; }
  // End 0 or 1 of an edge: first come those of the border.
  uint32_t end(size_t edge, size_t which) const {
    const size_t i = 2 * edge + which;
    return i < border.size() ? border[i] : lines[i - border.size()];
  }
  bool on_border(size_t edge) const { return 2 * edge < border.size(); }
};

// What stands in the way: edges (numbered as in Region) and points, k_none where there is none.
struct Conflict {
  uint32_t edge[2] = {k_none, k_none};
  uint32_t point[2] = {k_none, k_none};
};

// Vertex k_box_corners + i of *t is point i; a point that was joined with one of lower index, which
// (*joined)[i] says, has no triangles. Coordinates below 2^-100 of the greatest count as zero.
Status triangulate_region(const Region& region, Triangulation* t, Array<uint32_t>* joined,
                          Conflict* conflict);

}  // namespace wireskin::planar
