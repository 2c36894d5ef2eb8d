// A triangle mesh of a simple polygon whose border is kept bit for bit: constrained Delaunay, with
// interior points at the wished spacing, graded to the border's own.
//
// In: `border`, counter-clockwise, coordinates finite and at most k_greatest_coordinate;
// `spacing`, the wished distance between interior points. Out: the border's points in order, then
// the interior ones; triangles counter-clockwise; no point is ever added on the border. *mesh is
// written on success only. A border that touches or crosses itself is patch_folded, one that runs
// clockwise or has no area is patch_without_plane, both decided exactly (coordinates below 2^-100
// of the greatest count as zero).
// Statuses have no place.
// Cost: O(n log n) in border points plus interior points.
#pragma once

#include "base/array.h"
#include "num/vec.h"

namespace wireskin::planar {

struct PolygonMesh {
  explicit PolygonMesh(Context& context) : points(context), triangles(context) {}

  Array<Vec2> points;
  Array<uint32_t> triangles;  // 3 a triangle
};

Status mesh_polygon(Context& context, Span<const Vec2> border, double spacing, PolygonMesh* mesh);

}  // namespace wireskin::planar
