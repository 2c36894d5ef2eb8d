// Evens out the inside of a refined triangulation: sweeps of moving each free vertex to where its
// edges have the wished lengths; each move is followed by flips that make the triangulation
// Delaunay again, so it is so before and after.
//
// In: a triangulation with its outside marked and a size for each vertex; vertices from
// `first_free` on, all inside, may move; those before `first_loose` are at rest among themselves. A
// vertex moves only if no triangle round it turns over (decided exactly) and the worst one gets no
// worse, unless it stays a good one. Cost: O(1) a vertex and sweep; a vertex at rest sleeps until a
// neighbour moves. Source: P.-O. Persson, G. Strang, "A Simple Mesh Generator in MATLAB", 2004
// (springs of wished length); C. L. Lawson, "Software for C1 Surface Interpolation", 1977 (flips).
#pragma once

#include "planar/constrained_delaunay.h"

namespace wireskin::planar {

Status relax(Triangulation* t, Span<const double> sizes, uint32_t first_free, uint32_t first_loose,
             int sweeps);

}  // namespace wireskin::planar
