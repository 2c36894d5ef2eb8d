// Keeping a moving mesh good without changing its shape: intrinsic-Delaunay edge flips in space,
// and relaxation of free vertices within their tangent planes. And taking out folds, which does
// change it, there.
//
// In and out: positions and triangles; held vertices stay, edges between two held vertices and
// edges of two patches are never flipped. A flip happens where the angles opposite to an edge add
// up to more than 180 degrees, when both new triangles face the way of the old ones, the new edge
// does not exist yet and does not join two held vertices. Relaxation moves a vertex half the way to
// the area-weighted mean of the centroids round it. O(triangles) a sweep. Sources: N. Dyn, K.
// Hormann, S.-J. Kim, D. Levin, "Optimizing 3D Triangulations Using Discrete Curvature Analysis",
// 2001; M. Botsch, L. Kobbelt, "A Remeshing Approach to Multiresolution Modeling", 2004.
#pragma once

#include "mesh/mesh.h"

namespace wireskin::mesh {

struct Movable {
  Span<Vec3> position;
  Span<uint32_t> triangle;
  Span<const uint32_t> patch;  // of each triangle
  Span<const uint8_t> held;    // of each vertex
};

// Takes out folds: edges inside a patch, not between held vertices, whose two triangles face
// against each other. Edges there are flipped where the surface then turns less, and the free
// vertices round a fold, in a wider ring the longer it lasts, move half the way to the mean of
// their neighbours. `folds`: how many are left, by patch. Patches without folds stay as they are.
Status unfold(Context& context, const Movable& mesh, Span<uint32_t> folds);

// Relax, flip, relax. `flips`: how many edges were flipped.
Status care(Context& context, const Movable& mesh, uint32_t* flips);

}  // namespace wireskin::mesh
