#include "network/enclosure.h"

namespace wireskin::network {

static uint32_t root_of_component(Span<uint32_t> parent, uint32_t v) {
  while (parent[v] != v) v = parent[v] = parent[parent[v]];
  return v;
}

Status Enclosure::find_components(const Network& network, const CurveVertices& vertices) {
  const uint32_t n = static_cast<uint32_t>(vertices.position.size());
  TRY(component_.resize(n));
  for (uint32_t v = 0; v < n; ++v) component_[v] = v;
  for (uint32_t s = 0; s < network.segment.size(); ++s) {
    for (uint32_t k = 0; k < vertices.edges[s]; ++k) {
      const uint32_t a =
          root_of_component(component_.span(), segment_vertex(network, vertices, s, k));
      const uint32_t b =
          root_of_component(component_.span(), segment_vertex(network, vertices, s, k + 1));
      (a < b ? component_[b] : component_[a]) = a < b ? a : b;
    }
  }
  uint32_t count = 0;  // roots are the least of their members, so they are numbered before these
  for (uint32_t v = 0; v < n; ++v) {
    component_[v] = component_[v] == v ? count++ : component_[component_[v]];
  }
  TRY(start_.assign(size_t{count} + 1, 0));
  TRY(member_.resize(n));
  for (uint32_t v = 0; v < n; ++v) ++start_[component_[v]];
  starts_from_counts(start_.span());
  for (uint32_t v = 0; v < n; ++v) member_[start_[component_[v]]++] = v;
  for (uint32_t c = count; c > 0; --c) start_[c] = start_[c - 1];
  start_[0] = 0;
  return {};
}

// Whether a ray from p to the right crosses the polygon an odd number of times.
static bool inside(Span<const Vec2> polygon, const Vec2& p) {
  bool odd = false;
  for (size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const Vec2 a = polygon[i], b = polygon[j];
    if ((a.y > p.y) == (b.y > p.y)) continue;
    if (p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) odd = !odd;
  }
  return odd;
}

Status Enclosure::check(const CurveVertices& vertices, Span<const uint32_t> border,
                        Span<const Vec2> polygon, const Plane& plane) const {
  constexpr double k_share_of_width = 0.05;
  double highest = 0.0, widest = 0.0;
  for (size_t i = 0; i < border.size(); ++i) {
    const double height = std::fabs(plane.height(vertices.position[border[i]]));
    if (height > highest) highest = height;
    if (length(polygon[i]) > widest) widest = length(polygon[i]);
  }
  const double reach = highest + k_share_of_width * 2.0 * widest;
  const uint32_t own = component_[border[0]];
  for (uint32_t c = 0; c + 1 < start_.size(); ++c) {
    bool enclosed = c != own;
    for (uint32_t k = start_[c]; enclosed && k < start_[c + 1]; ++k) {
      const Vec3& p = vertices.position[member_[k]];
      const Vec2 q = plane.project(p);
      enclosed = length(q) <= widest && std::fabs(plane.height(p)) <= reach && inside(polygon, q);
    }
    if (!enclosed) continue;
    Place place;
    place.curve = vertices.curve[member_[start_[c]]];
    return fail(Code::patch_several_loops,
                "the curve lies inside the patch without being connected to its border", place);
  }
  return {};
}

}  // namespace wireskin::network
