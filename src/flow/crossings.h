// Which triangles of a mesh run into each other: an exact test.
//
// Two triangles cross if they have a point in common that is no common vertex and on no common
// edge. Triangles of the mesh that lie in one plane and overlap cross too; so do two of the same
// corners. Degenerate ones (no area) are taken as they are. A grid finds the candidates, so the
// cost is near-linear for triangles of about one size.
#pragma once

#include "base/array.h"
#include "num/vec.h"

namespace wireskin::flow {

// `a` and `b` are three vertex numbers each.
bool triangles_cross(Span<const Vec3> position, const uint32_t* a, const uint32_t* b);

// Pairs of crossing triangles, the lesser first, two entries each; at most `most` pairs.
Status find_crossings(Context& context, Span<const Vec3> position, Span<const uint32_t> triangle,
                      size_t most, Array<uint32_t>* pairs);

}  // namespace wireskin::flow
