// Raises a mesh inside closed loops so that it leaves them along their normals, curved as they are.
//
// In: the loops with unit normals, triangles over their vertices and inner points, all positions.
// Out: inner positions whose Laplacian, in the metric of the mesh as given, fits -2 h n best in the
// square, n being the normals of that mesh, among those whose derivative across the loops is the
// unit conormal that points into the mesh (one, because the loops keep their lengths). h is one
// number: the mean normal curvature of the loops where a single loop is closed like a sphere, half
// of it where several are joined like the ends of a tube. Where a normal is not known the
// derivative is free. Repeated, it tends to spheres and tubes. One factorisation. Source: A.
// Jacobson, E. Tosun, O. Sorkine, D. Zorin, "Mixed Finite Elements for Variational Surface
// Modeling", 2010 (curve boundary conditions).
#pragma once

#include "mesh/loop_mesh.h"

namespace wireskin::mesh {

// Fails with not_positive_definite (no place) where triangles are too thin for the system.
// Vertices before `held` stay, the loops' own and those of curves inside.
Status raise_dome(Context& context, const Loops& loops, uint32_t held,
                  Span<const uint32_t> triangle, Span<Vec3> position);

// Completes a field of shifts that is given at the vertices before `held`: least in the squares of
// its Laplacian, level across the border. A field that the mesh is too thin for stays zero inside;
// so does one that would grow to more than a hundred times what is given.
Status spread_shift(Context& context, uint32_t held, Span<const Vec3> position,
                    Span<const uint32_t> triangle, Span<Vec3> shift);

}  // namespace wireskin::mesh
