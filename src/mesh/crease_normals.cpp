#include "mesh/crease_normals.h"

#include "base/in_parts.h"
#include "mesh/curvature.h"

namespace wireskin::mesh {

// A coarse round shape turns less than this between its triangles; what turns more is an edge.
constexpr double k_crease_cosine = 0.93969262078590838;  // of 20 degrees

Status corner_normals(const Cut& cut, uint32_t vertices, Span<const Vec3> normal,
                      CornerNormals* result) {
  result->corner.clear();
  result->normal.clear();
  if (cut.vertices() == vertices) return {};
  Array<uint8_t> parted(result->corner.context());
  TRY(assign_in_parts(vertices, 0, &parted));
  for (uint32_t c = vertices; c < cut.vertices(); ++c) parted[cut.origin[c]] = 1;
  Pace pace(result->corner.context());
  for (uint32_t h = 0; h < cut.triangle.size(); ++h) {
    TRY(pace.after());
    const uint32_t copy = cut.triangle[h];
    if (!parted[cut.origin[copy]]) continue;
    TRY(result->corner.push(h));
    TRY(result->normal.push(normal[copy]));
  }
  return {};
}

namespace {

// Of one vertex's edges to each neighbour: how many half-edges leave for it, and arrive from it.
struct EdgeCount {
  uint32_t leaving = 0, arriving = 0;
  uint32_t last = k_none;  // the last that arrives
};

}  // namespace

// The twins of those edges that have exactly two half-edges, one each way; k_none at all others.
static Status find_manifold_twins(uint32_t vertices, Span<const uint32_t> triangles,
                                  Array<uint32_t>* twins) {
  Context& context = twins->context();
  Array<uint32_t> start(context), corner(context);
  Array<EdgeCount> to(context);
  TRY(find_corners(vertices, triangles, &start, &corner));
  TRY(assign_in_parts(vertices, EdgeCount{}, &to));
  TRY(twins->resize(triangles.size()));
  return in_parts(context, vertices, [&](size_t v) {
    const Span<const uint32_t> leaving = corner.span().part(start[v], start[v + 1] - start[v]);
    for (const uint32_t h : leaving) {
      const uint32_t arriving = previous_half_edge(h);
      EdgeCount& from = to[triangles[arriving]];
      ++to[triangles[next_half_edge(h)]].leaving;
      ++from.arriving;
      from.last = arriving;
    }
    for (const uint32_t h : leaving) {
      const EdgeCount& edge = to[triangles[next_half_edge(h)]];
      (*twins)[h] = edge.leaving == 1 && edge.arriving == 1 ? edge.last : k_none;
    }
    for (const uint32_t h : leaving) {
      to[triangles[next_half_edge(h)]] = to[triangles[previous_half_edge(h)]] = EdgeCount{};
    }
  });
}

static Vec3 face_normal(Span<const Vec3> positions, Span<const uint32_t> triangles, uint32_t h) {
  const uint32_t* v = &triangles[h - h % 3];
  return unit(cross(positions[v[1]] - positions[v[0]], positions[v[2]] - positions[v[0]]));
}

Status find_crease_normals(Context& context, Span<const Vec3> positions,
                           Span<const uint32_t> triangles, Span<const uint8_t> on_curve,
                           CornerNormals* result) {
  const uint32_t vertices = static_cast<uint32_t>(positions.size());
  Array<uint32_t> twins(context);
  Array<uint8_t> crease(context);
  Array<Vec3> place(context), normal(context);
  Cut cut(context);
  TRY(find_manifold_twins(vertices, triangles, &twins));
  TRY(assign_in_parts(triangles.size(), 0, &crease));
  TRY(in_parts(context, triangles.size(), [&](size_t i) {
    const uint32_t h = static_cast<uint32_t>(i), twin = twins[h];
    if (twin == k_none || twin < h) return;
    if (!on_curve[triangles[h]] || !on_curve[triangles[next_half_edge(h)]]) return;
    const Vec3 here = face_normal(positions, triangles, h);
    const Vec3 there = face_normal(positions, triangles, twin);
    if (here == Vec3{} || there == Vec3{}) return;  // a triangle without area turns nowhere
    crease[h] = crease[twin] = dot(here, there) < k_crease_cosine;
  }));
  TRY(cut_open(vertices, triangles, twins.span(), crease.span(), &cut));
  TRY(place.resize(cut.vertices()));
  TRY(normal.resize(cut.vertices()));
  TRY(in_parts(context, cut.vertices(), [&](size_t c) { place[c] = positions[cut.origin[c]]; }));
  TRY(vertex_normals(context, place.span(), cut.triangle.span(), normal.span()));
  return corner_normals(cut, vertices, normal.span(), result);
}

}  // namespace wireskin::mesh
