// The nearest points of segments and triangles in space.
//
// In: a point and corners. Out: weights at the corners, not negative, with the sum one; a weight of
// a corner that the nearest point does not touch is exactly zero. Corners may coincide. O(1).
// Source: P. Schneider, D. Eberly, "Geometric Tools for Computer Graphics", 2003.
#pragma once

#include "num/vec.h"

namespace wireskin::mesh {

Vec2 nearest_weights(const Vec3& p, const Vec3& a, const Vec3& b);
Vec3 nearest_weights(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

// Whether a place of a triangle, given by its weights, lies on the border of a mesh whose first
// `rim` vertices are those of its border: what is beside the mesh projects to there.
bool is_on_border(const Vec3& weights, const uint32_t* triangle, uint32_t rim);

}  // namespace wireskin::mesh
