// Lets the mesh inside closed loops pass through curves and points that lie on it or near it.
//
// In: the mesh, the loops' vertices first; the points to pass through and the edges between them
// and loop vertices. Each point is projected to the nearest place of the mesh; there the edges are
// drawn in a flat chart of the mesh (mesh/chart.h) and made part of a constrained Delaunay
// triangulation, which decides exactly whether they cross. Out: loop vertices, the points where
// they are given, then free vertices: those of the mesh but for the ones nearest to the curves,
// refined, and shifted by the least bending field that carries the curves from the mesh to their
// own place and holds the loops. Invariants: every edge given is an edge of the mesh, which stays a
// manifold of the same kind. Cost: two factorisations of the size of the mesh, and the points and
// edges given times the vertices. Sources: those of mesh/chart.h, planar/region.h and mesh/dome.h.
#pragma once

#include "base/array.h"
#include "num/vec.h"

namespace wireskin::mesh {

// With n loop vertices, number v < n is a loop vertex and n + i is point[i].
struct Inlay {
  Span<const Vec3> point;
  Span<const uint32_t> edge;  // two numbers each, the lesser first, sorted
};

// Fails with patch_folded where the curves cross each other or the loops, or lie beside the mesh;
// the place's vertex is then the number of a point concerned, or k_none.
Status inlay_curves(Context& context, Span<const uint32_t> start, const Inlay& inlay,
                    double spacing, Array<Vec3>* position, Array<uint32_t>* triangle);

}  // namespace wireskin::mesh
