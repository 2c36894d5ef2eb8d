// Refines a triangulation of closed loops' vertices to a wished spacing: midpoint splits from
// coarse to fine, each followed by edge flips, and relaxation of the inner points.
//
// In and out: points in space, the vertices of the loops first (loop i: start[i] .. start[i + 1)),
// and the triangles of a surface whose border the loops are. Invariants: loop vertices and loop
// edges stay, inner points are appended, it stays a manifold of the same kind. The wished size is
// that of the loop's edges on the loop and changes to `spacing` inwards, by at most k_grading of
// the distance. Every flip raises the least angle of its two triangles, so flipping ends. O(points
// log(extent / spacing)). Sources: P. Liepa, "Filling Holes in Meshes", 2003; C. Lawson, "Software
// for C1 Surface Interpolation", 1977; M. Botsch, L. Kobbelt, "A Remeshing Approach to
// Multiresolution Modeling", 2004.
#pragma once

#include "mesh/mesh.h"

namespace wireskin::mesh {

// What the mesh holds beside its loops: all vertices before `vertices`, and edges between them, two
// vertices each, the lesser first, sorted.
struct HeldCurves {
  uint32_t vertices = 0;
  Span<const uint32_t> edge;
};

// Fails with too_large where the spacing asks for more vertices than indices can count.
Status refine_loops(Context& context, double spacing, Span<const uint32_t> start,
                    const HeldCurves& held, Array<Vec3>* position, Array<uint32_t>* triangle);
Status refine_loops(Context& context, double spacing, Span<const uint32_t> start,
                    Array<Vec3>* position, Array<uint32_t>* triangle);

// The same for any oriented manifold mesh: all points given are held, and so are the border's
// edges, in whatever loops they come. Points of one name are one place where the mesh was cut open:
// no point is joined to two of them. Without `relax` inner points stay where splits put them.
Status refine_patch(Context& context, double spacing, bool relax, Span<const uint32_t> name,
                    Array<Vec3>* position, Array<uint32_t>* triangle);

}  // namespace wireskin::mesh
