// Moves points by a tiny amount drawn from their own coordinates, so that radii that tie exactly
// (and that plain doubles would then order by their rounding) differ by far more than rounding.
//
// In: points and the amount as a part of the diagonal of their bounding box. Out: points moved by
// at most that much along each axis; the same place always moves the same way, whatever its number.
// Rotated, tied radii gave a wrong topology for half of the test networks without it; any amount
// between 1e-9 and 1e-5 of the diagonal gave the right one. Linear. Source of the need for points
// in general position: U. Bauer, H. Edelsbrunner, "The Morse Theory of Cech and Delaunay
// Complexes", 2017.
#pragma once

#include "base/array.h"
#include "num/vec.h"

namespace wireskin::flow {

// Of the bounding box.
double box_diagonal(Span<const Vec3> points);

// `moved` has as many elements as `points`.
void jitter_points(Span<const Vec3> points, double amount, uint64_t seed, Span<Vec3> moved);

}  // namespace wireskin::flow
