// Makes the signs of normals agree over a network.
//
// In: curves whose normals may point to either side. First the samples of each curve are made to
// agree with their neighbours, a normal being carried over an edge by reflection in the plane
// halfway (exact on spheres); then curves with each other over the points that they share, along
// the spanning tree of best agreement. The sign of a whole component is the given one of two thirds
// of its samples; where there is no such majority, the one that points away from its middle.
// Samples without normals and sharp curves, which have two sides, are passed over. Out: normals
// turned in place; the pairs that contradict each other still. O(s log s).
//
// Source: H. Hoppe, T. DeRose, T. Duchamp, J. McDonald, W. Stuetzle, "Surface Reconstruction from
// Unorganized Points", 1992, for the spanning tree.
#pragma once

#include "network/wires.h"

namespace wireskin::network {

// Two samples whose normals do not fit together, and the angle between these in radians.
struct Contradiction {
  Origin a, b;
  double angle = 0.0;
};

// Carries a normal from one sample to the next.
inline Vec3 carry_normal(const Vec3& from, const Vec3& to, const Vec3& normal) {
  const Vec3 along = unit(to - from);
  return normal - (2.0 * dot(normal, along)) * along;
}

// One curve after the other.
Status orient_along(Wires* wires, Array<uint8_t>* turned, Array<Contradiction>* contradictions);

// Curves to each other, and the sign of the whole. `turned`: of each sample, whether orient_along
// turned it; brought up to date.
Status orient_across(Wires* wires, Span<uint8_t> turned, Array<Contradiction>* contradictions);

}  // namespace wireskin::network
