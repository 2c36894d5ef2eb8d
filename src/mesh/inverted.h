// Triangles that lie upside down: they face against the triangles round them.
//
// In: a manifold mesh and the patch of each triangle. A triangle is inverted if it faces against
// one of its neighbours in the patch and, at each of its corners that has other triangles of the
// patch, against their sum (by area). So in a plane inverted is what runs clockwise among others
// that do not; a crease between patches, a cusp or a sharp bend of several triangles has none. Out:
// how many there are, and the first. O(triangles), and those round each that faces a neighbour.
#pragma once

#include "mesh/mesh.h"

namespace wireskin::mesh {

struct Inverted {
  uint32_t count = 0;
  uint32_t first = k_none;  // triangle
};

// `patch` may be empty: there is one.
Status find_inverted(Context& context, Span<const Vec3> position, Span<const uint32_t> triangle,
                     Span<const uint32_t> patch, Inverted* inverted);

}  // namespace wireskin::mesh
