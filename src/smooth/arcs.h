// The curves of a mesh, taken apart at their nodes.
//
// In: a mesh with the patch of each triangle, and the vertices whose position and normal are given.
// Curve edges are those between two such vertices on an open border or between two patches. A node
// is a vertex where not exactly two of them meet, or where they turn by more than 45 degrees. Out:
// the arcs from node to node, each once; closed curves without a node are left out. O(triangles).
#pragma once

#include "base/array.h"
#include "num/vec.h"

namespace wireskin::smooth {

struct GivenCurves {
  Span<const Vec3> position;
  Span<const Vec3> normal;  // unit, of the vertices that are given
  Span<const uint32_t> triangle;
  Span<const uint32_t> patch;  // of each triangle
  Span<const uint8_t> given;   // of each vertex
};

// Arc a has the vertices vertex[start[a] .. start[a + 1]).
struct Arcs {
  Array<uint32_t> start, vertex;

  explicit Arcs(Context& context) : start(context), vertex(context) {}
  uint32_t count() const { return static_cast<uint32_t>(start.size()) - 1; }
  Span<const uint32_t> arc(uint32_t a) const {
    return {&vertex[start[a]], size_t{start[a + 1]} - start[a]};
  }
};

// Only arcs of at least `least_edges` edges.
Status find_arcs(Context& context, const GivenCurves& curves, uint32_t least_edges, Arcs* arcs);

}  // namespace wireskin::smooth
