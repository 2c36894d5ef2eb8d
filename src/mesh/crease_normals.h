// Normals of corners: where a mesh has creases, one normal a vertex blends their sides.
//
// In: a mesh cut open along its creases and the normals of its copies; or a mesh, a manifold or
// not, and which of its vertices lie on curves: its creases are then the edges between two of these
// at which it turns by more than 20 degrees, and all edges at which other than two triangles of one
// orientation meet. Out: the corners, ascending, of vertices that creases, or fans that only touch
// there, part into several sectors, each with the normal of its own sector. O(triangles).
#pragma once

#include "mesh/cut.h"

namespace wireskin::mesh {

struct CornerNormals {
  Array<uint32_t> corner;  // half-edges, which leave the vertex of the corner
  Array<Vec3> normal;      // of each, unit

  explicit CornerNormals(Context& context) : corner(context), normal(context) {}
};

// `vertices`: of the mesh before it was cut; `normal`: of each copy.
Status corner_normals(const Cut& cut, uint32_t vertices, Span<const Vec3> normal,
                      CornerNormals* result);

Status find_crease_normals(Context& context, Span<const Vec3> positions,
                           Span<const uint32_t> triangles, Span<const uint8_t> on_curve,
                           CornerNormals* result);

}  // namespace wireskin::mesh
