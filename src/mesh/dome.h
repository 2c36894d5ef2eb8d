// Raises a mesh inside closed loops so that it leaves them along their normals: the clamped plate
// in every coordinate.
//
// In: the loops with unit normals, triangles over their vertices and inner points, all positions.
// Out: inner positions that minimise the square of the Laplacian, in the metric of the mesh as
// given, among those whose derivative across the loops is the unit conormal that points into the
// mesh (one, because the loops keep their lengths). Where a normal is not known the derivative is
// free. O(vertices^1.5) or so, one factorisation. Source: A. Jacobson, E. Tosun, O. Sorkine, D.
// Zorin, "Mixed Finite Elements for Variational Surface Modeling", 2010 (curve boundary
// conditions).
#pragma once

#include "mesh/loop_mesh.h"

namespace wireskin::mesh {

// Fails with not_positive_definite (no place) where triangles are too thin for the system.
Status raise_dome(Context& context, const Loops& loops, Span<const uint32_t> triangle,
                  Span<Vec3> position);

}  // namespace wireskin::mesh
