// A triangle mesh of a region of the plane whose border and inner curves are kept bit for bit:
// constrained Delaunay, with interior points at the wished spacing, graded to that of the curves.
//
// In: a Region (region.h: loops, holes, lines, points inside), coordinates finite and at most
// k_greatest_coordinate / 4; `spacing`, the wished distance between interior points. Out: the
// region's points in order, then the interior ones; triangles counter-clockwise; each edge of the
// region is an edge of the mesh (or with `join` some of them) and no point is ever added on one.
// *mesh is written on success only, but for its `conflict`, which says what stood in the way.
// Failures are those of triangulate_region; too_large for a spacing that asks for too many points.
// All are decided exactly. A place names a point as its vertex.
// Cost: O(n log n) in the points given plus interior points.
#pragma once

#include "planar/region.h"

namespace wireskin::planar {

struct PolygonMesh {
  explicit PolygonMesh(Context& context) : points(context), triangles(context), joined(context) {}

  Array<Vec2> points;
  Array<uint32_t> triangles;  // 3 a triangle
  Array<uint32_t> joined;     // of each point given, the one that triangles name in its stead
  Conflict conflict;
};

Status mesh_region(Context& context, const Region& region, double spacing, PolygonMesh* mesh);

// The inside of a single loop that runs counter-clockwise. One that touches or crosses itself is
// patch_folded, one that runs clockwise or has no area is patch_without_plane.
Status mesh_polygon(Context& context, Span<const Vec2> border, double spacing, PolygonMesh* mesh);

}  // namespace wireskin::planar
