// A triangle mesh of little area within closed loops in space, where the border has no plane.
//
// In: the loops' positions (finite, extent about one) and unit normals, the patch on their left
// seen from the normals' tips; the wished spacing. Out: inner points and triangles over the loops'
// vertices (0 .. n - 1) and the inner ones (from n): a sphere with a hole for each loop, bordered
// by the loops in their direction. *mesh is written on success only. First the loops' vertices
// alone by dynamic programming, least in the sum of area * (1 + k (1 - cos)) with the angle between
// a triangle and the mean of its normals, k 2 or for several loops 8, which bridges make one; then
// mesh/loop_refine.h, at 2, 4 and 8 times the spacing where that leaves a needle, and not at all
// where these do. O(n log n + inner points): k_most_kept vertices or so take part in the first.
// Sources: G. Barequet, M. Sharir, "Filling Gaps in the Boundary of a Polyhedron", 1995; P. Liepa,
// "Filling Holes in Meshes", 2003.
#pragma once

#include "base/array.h"
#include "num/vec.h"

namespace wireskin::mesh {

struct LoopMesh {
  Array<Vec3> inner;
  Array<uint32_t> triangle;  // three vertices each
  bool coarse = false;       // at more than the spacing

  explicit LoopMesh(Context& context) : inner(context), triangle(context) {}
};

// Loop i has the vertices start[i] .. start[i + 1).
struct Loops {
  Span<const uint32_t> start;
  Span<const Vec3> position, normal;  // normals are zero where not known

  uint32_t count() const { return static_cast<uint32_t>(start.size() - 1); }
  uint32_t next(uint32_t loop, uint32_t v) const {
    return v + 1 == start[loop + 1] ? start[loop] : v + 1;
  }
  uint32_t previous(uint32_t loop, uint32_t v) const {
    return (v == start[loop] ? start[loop + 1] : v) - 1;
  }
};

// Fail with patch_folded (no place) where neighbours coincide or the loops enclose no area.
Status mesh_loops(Context& context, const Loops& loops, double spacing, LoopMesh* mesh);
Status mesh_loop(Context& context, Span<const Vec3> position, Span<const Vec3> normal,
                 double spacing, LoopMesh* mesh);

}  // namespace wireskin::mesh
