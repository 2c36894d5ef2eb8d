// A first mesh of the band between two closed loops in space whose normals are known: rows of
// points on curves that leave either loop along its conormals.
//
// In: two loops as for mesh/loop_mesh.h, the wished spacing. Out: inner points and triangles over
// the loops' vertices and them, an annulus. The loops are matched by the closed walk round both
// that is least in the squares of the distances on its way (dynamic programming over k_probes
// places of each, from every start); matched places are joined by cubics whose end tangents are
// those of a circular arc. Unlike surfaces of little area such a band does not shrink to a neck,
// however far apart the loops are. O(k_probes^3 + points). Sources: E. Keppel, "Approximating
// Complex Surfaces by Triangulation of Contour Lines", 1975; H. Fuchs, Z. Kedem, S. Uselton,
// "Optimal Surface Reconstruction from Planar Contours", 1977.
#pragma once

#include "mesh/loop_mesh.h"

namespace wireskin::mesh {

// Fails as mesh_loops() does; with too_large where the spacing asks for too many points.
Status mesh_band(Context& context, const Loops& loops, double spacing, LoopMesh* mesh);

}  // namespace wireskin::mesh
