// Whether a point lies inside the smallest circumscribed ball of an edge or a triangle: the signs
// on which it rests which simplices growing balls round the points swallow alone.
//
// Decided in doubles where a bound on the rounding error proves the sign, else exactly where the
// differences of the points are exact, else in pairs of doubles: then what is closer to the sphere
// than 2^-90 of the terms counts as on it, which is not inside. A wrong answer there cannot break
// anything, because values are made monotone afterwards (complex.h).
// Cost: a few nanoseconds; ten to a hundred times that close to a sphere.
#pragma once

#include "num/vec.h"

namespace wireskin::flow {

bool inside_edge_ball(const Vec3& a, const Vec3& b, const Vec3& p);
bool inside_triangle_ball(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p);

}  // namespace wireskin::flow
