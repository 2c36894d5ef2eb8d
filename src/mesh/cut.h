// A mesh cut open along some of its edges: every vertex has a copy in each sector of its fan
// between two cut edges, so that the sides of a crease no longer know of each other.
//
// In: a mesh, its twins (k_none also where it is no manifold: there it is cut in any case), and its
// marked half-edges (an edge counts when both of its half-edges are marked). Out: triangles over
// the copies, in the same order, and the vertex each copy came from. A vertex of one sector keeps
// its number (the end of a cut inside the mesh does); one copy of each other vertex keeps it too,
// the rest follow behind. O(triangles).
#pragma once

#include "mesh/mesh.h"

namespace wireskin::mesh {

struct Cut {
  Array<uint32_t> triangle;
  Array<uint32_t> origin;  // of each copy

  explicit Cut(Context& context) : triangle(context), origin(context) {}
  uint32_t vertices() const { return static_cast<uint32_t>(origin.size()); }
};

Status cut_open(uint32_t vertices, Span<const uint32_t> triangles, Span<const uint32_t> twins,
                Span<const uint8_t> marked, Cut* cut);

}  // namespace wireskin::mesh
