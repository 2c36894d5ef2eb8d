// The check that every mesh of the library passes, and that says of a bad one where it is bad.
//
// In: positions, triangles (three vertices each, counter-clockwise from outside) and what is
// expected of them. Looks, in this order, for: indices out of range and triangles with a vertex
// twice; edges of three triangles and neighbours of opposite orientation; vertices whose triangles
// form more than one fan, or that have none; edges of curves that are no edge of the mesh; a wrong
// Euler characteristic; coordinates that are not finite; triangles without area, or whose height is
// below k_least_height of their longest edge; triangles that face against their patch's normal;
// neighbours in one patch that are folded onto each other; inverted triangles (mesh/inverted.h).
// Out: ok, or index_out_of_range, not_a_number or bad_mesh with the vertex or triangle in the
// place; for a missing edge its first end is the vertex. Cost: O(vertices + triangles + edges).
#pragma once

#include "mesh/mesh.h"

namespace wireskin::mesh {

// About the rounding of a few operations on coordinates of the size of the mesh.
inline constexpr double k_least_height = 1e-14;
// Cosine between the normals of two neighbours below which they count as folded: 179.5 degrees.
inline constexpr double k_folded_cosine = -0.99996;

struct Expectations {
  Span<const Vec3> position;
  Span<const uint32_t> triangle;
  Span<const uint32_t> edge = {};      // two vertices an edge that the mesh must have
  Span<const uint32_t> patch = {};     // of each triangle; empty: one patch
  Span<const Vec3> patch_normal = {};  // which way its triangles face, zero: not known; or empty
  const int32_t* euler_characteristic = nullptr;  // null: not known
  // No look at folds and inverted triangles: where the curves themselves have a cusp.
  bool may_fold = false;
  // No look at the areas of triangles: where the caller's own have next to none.
  bool may_be_flat = false;
};

Status check(Context& context, const Expectations& mesh);

}  // namespace wireskin::mesh
