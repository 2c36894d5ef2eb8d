// A triangle mesh of little area within a closed loop in space: what a patch starts from where its
// border has no plane to be projected to.
//
// In: the loop's positions (finite, scaled so that the extent is about one) and unit normals,
// counter-clockwise seen from the normals' tips; the wished spacing. Out: inner points and
// triangles over the loop's vertices (0 .. n - 1) and the inner ones (from n). Invariants: a disc
// whose border is the loop in its direction; no vertex is added on it. *mesh is written on success
// only. First a triangulation of the loop's vertices alone by dynamic programming, least in the sum
// of area * (1 + 2 (1 - cos)) with the angle between a triangle and the mean of its normals; then
// mesh/loop_refine.h. Of a long loop at most k_most_kept vertices take part in the first, so its
// cost is bounded: O(n log n + inner points) in all. Sources: G. Barequet, M. Sharir, "Filling Gaps
// in the Boundary of a Polyhedron", 1995; P. Liepa, "Filling Holes in Meshes", 2003.
#pragma once

#include "base/array.h"
#include "num/vec.h"

namespace wireskin::mesh {

struct LoopMesh {
  Array<Vec3> inner;
  Array<uint32_t> triangle;  // three vertices each

  explicit LoopMesh(Context& context) : inner(context), triangle(context) {}
};

// Fails with patch_folded (no place) where neighbours coincide or the loop encloses no area.
Status mesh_loop(Context& context, Span<const Vec3> position, Span<const Vec3> normal,
                 double spacing, LoopMesh* mesh);

}  // namespace wireskin::mesh
