// Borders that no surface can have, sought where the plane of a patch fails: those that cross
// themselves in space, and those that run clockwise round their own normals, as the outside of an
// open surface does whose border is not tagged.
//
// In: the positions and unit normals (zero: unknown) of a border in order. Out: a status without
// place. O(n^2), with cheap rejections.
#pragma once

#include "base/array.h"
#include "num/vec.h"

namespace wireskin::network {

// Fails with patch_folded or patch_without_plane.
Status check_border(Context& context, Span<const Vec3> position, Span<const Vec3> normal);

}  // namespace wireskin::network
