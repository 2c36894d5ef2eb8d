// The plane of a patch: through the mean position of its border, across the mean normal; across the
// vector area of the border where it has no normals.
//
// In: the loops of a border. Out: plane coordinates, so that a border that runs
// counter-clockwise seen from the tip of the normal does so in the plane. The first axis points
// from the mean to the first vertex, so that a rotated network gives rotated patches. O(border).
// Source: T. Stanko et al., "Surfacing Curve Networks with Normal Control", 2016, section 3.3.
#pragma once

#include "network/border.h"

namespace wireskin::network {

struct Plane {
  Vec3 origin, u, v, normal;

  Vec2 project(const Vec3& p) const { return {dot(p - origin, u), dot(p - origin, v)}; }
  Vec3 lift(Vec2 p) const { return origin + p.x * u + p.y * v; }
  double height(const Vec3& p) const { return dot(p - origin, normal); }
};

// Fails with patch_without_plane (no place) where the normals cancel out.
Status fit_plane(const Border& border, Plane* plane);

// The plane of that normal through the mean of the border.
Plane plane_across(const Border& border, const Vec3& normal);

// Rounds plane coordinates, and a spacing, to a grid of 2^-32 of the polygon's extent. Which
// triangles a patch gets then does not hang on the last bits of its border, which depend on the
// direction in which curves were given.
void round_to_grid(Span<Vec2> polygon, double* spacing);

}  // namespace wireskin::network
