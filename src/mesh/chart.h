// Lays a mesh inside closed loops flat in the unit disc without folds.
//
// In: a sphere with holes as mesh/loop_mesh.h makes them, the loops' vertices first. Out: a place
// in the plane for each vertex; the longest loop runs counter-clockwise round the unit circle, the
// others round holes, which a vertex of their own at the middle keeps open. Every free vertex is a
// mean of its neighbours with positive weights: the cotangent weights, that keep angles, with those
// of obtuse and sharp angles clamped. Such a map folds nothing, save by rounding: all triangles are
// checked exactly. One factorisation of the size of the mesh. Sources: W. T. Tutte, "How to Draw a
// Graph", 1963; M. Floater, "One-to-one Piecewise Linear Mappings over Triangulations", 2003.
#pragma once

#include "base/array.h"
#include "num/vec.h"

namespace wireskin::mesh {

// Fails with patch_folded (no place) where rounding folds the map.
Status lay_flat(Context& context, Span<const uint32_t> start, Span<const Vec3> position,
                Span<const uint32_t> triangle, Array<Vec2>* flat);

}  // namespace wireskin::mesh
