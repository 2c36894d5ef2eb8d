#include "network/side_normals.h"

#include "base/in_parts.h"
#include "curves/sides.h"

namespace wireskin::network {

// The normals of one side of segment s, `curve` being its curve as seen from there.
static Status fill_side(const curves::Curve& curve, const Segment& segment, Pace* pace,
                        Span<Vec3> side) {
  const size_t edges = side.size() - 1;
  const double from = curve.arc[segment.first_knot];
  const double length = curve.arc[segment.last_knot] - from;
  side[0] = curve.normal.value[segment.first_knot];
  side[edges] = curve.normal.value[segment.last_knot];
  if (!has_normals(curve)) {
    for (Vec3& n : side) n = Vec3{};
    return {};
  }
  for (size_t k = 1; k < edges; ++k) {
    TRY(pace->after(curves::k_steps_of_point));
    const double part = static_cast<double>(k) / static_cast<double>(edges);
    side[k] = point_at(curve, segment.first_knot, segment.last_knot, from + part * length).normal;
    if (dot(side[k], side[k]) > 0.5) continue;
    return fail_at_sample(Code::inconsistent_normals,
                          "the normals of neighbouring samples cancel out", segment.curve,
                          curve.sample[segment.first_knot]);
  }
  return {};
}

Status resample_sides(const curves::Curves& curves, const Network& network,
                      CurveVertices* vertices) {
  const size_t segments = network.segment.size();
  TRY(vertices->side_start.resize(segments + 1));
  uint32_t total = 0;
  for (size_t s = 0; s < segments; ++s) {
    vertices->side_start[s] = total;
    total += vertices->edges[s] + 1;
  }
  vertices->side_start[segments] = total;
  TRY(vertices->left.resize(total));
  TRY(vertices->right.resize(total));
  Pace pace(vertices->left.context());
  for (uint32_t s = 0; s < segments; ++s) {
    const Segment& segment = network.segment[s];
    const size_t first = vertices->side_start[s], count = size_t{vertices->edges[s]} + 1;
    const Span<Vec3> left = vertices->left.span().part(first, count);
    const Span<Vec3> right = vertices->right.span().part(first, count);
    TRY(fill_side(curves[segment.curve], segment, &pace, left));
    TRY(fill_side(seen_from_right(curves, segment.curve), segment, &pace, right));
    for (uint32_t k = 0; k < count; ++k) {
      const uint32_t v = segment_vertex(network, *vertices, s, k);
      const bool inside = segment.from == k_none || (k > 0 && k + 1 < count);
      if (inside && left[k] != right[k]) vertices->normal[v] = unit(left[k] + right[k]);
    }
    TRY(vertices->left.context().checkpoint());
  }
  return {};
}

Vec3 left_normal(const Network& network, const CurveVertices& vertices, uint32_t h, uint32_t k) {
  const uint32_t s = h / 2, edges = vertices.edges[s];
  if (vertices.side_start.empty()) {
    return vertices.normal[segment_vertex(network, vertices, s, h % 2 == 0 ? k : edges - k)];
  }
  const uint32_t first = vertices.side_start[s];
  return h % 2 == 0 ? vertices.left[first + k] : vertices.right[first + edges - k];
}

}  // namespace wireskin::network
