// Normals and mean curvature at the vertices of a mesh.
//
// Mean curvature follows from any field of unit normals n given at the vertices: over the star of
// vertex i the sum of nbar x e over the edges e opposite to it, nbar the unit mean of the
// triangle's three normals, is 4 A H n with A a third of the star's area and H = (k1 + k2) / 2. H
// is positive on a sphere with outer normals, and H n is minus half the Laplacian of the position.
// With exact normals on a jittered sphere H is right to 1e-4 (tested). O(triangles). Sources: N.
// Max, "Weights for Computing Vertex Normals from Facet Normals", 1999; T. Stanko et al.,
// "Surfacing Curve Networks with Normal Control", 2016, formula (1), with the sign kept and the
// constant for barycentric areas.
#pragma once

#include "mesh/mesh.h"

namespace wireskin::mesh {

// Unit normals from the triangles round each vertex, each weighted by the sine of its angle over
// the product of its sides: exact where all vertices lie on a sphere.
Status vertex_normals(Context& context, Span<const Vec3> positions, Span<const uint32_t> triangles,
                      Span<Vec3> normals);

// H at every vertex. The star of a border vertex is not closed, so it takes the mean of its
// neighbours inside (of its neighbours on the border, where all are).
Status mean_curvature(Span<const Vec3> positions, Span<const Vec3> normals,
                      Span<const uint32_t> triangles, Span<const uint8_t> on_border,
                      Array<double>* curvature);

// Gives border vertices the mean of their neighbours inside, of those on the border where there are
// none.
Status fill_border(Context& context, Span<const uint32_t> triangles, Span<const uint8_t> on_border,
                   Span<double> values);

}  // namespace wireskin::mesh
