#include "network/plane.h"

namespace wireskin::network {

// The mean of unit normals must be at least this long for its direction to mean anything.
static constexpr double k_least_mean_normal = 0.05;

Status border_of_patch(const Network& network, const CurveVertices& vertices, uint32_t p,
                       Array<uint32_t>* border) {
  border->clear();
  for (uint32_t h : network.cycle(p)) {
    const uint32_t s = h / 2, edges = vertices.edges[s];
    for (uint32_t k = 0; k < edges; ++k) {
      TRY(border->push(segment_vertex(network, vertices, s, h % 2 == 0 ? k : edges - k)));
    }
  }
  return {};
}

// Twice the vector area of the border.
static Vec3 vector_area(const CurveVertices& vertices, Span<const uint32_t> border,
                        const Vec3& base) {
  Vec3 area;
  for (size_t i = 0; i < border.size(); ++i) {
    const uint32_t next = border[i + 1 == border.size() ? 0 : i + 1];
    area += cross(vertices.position[border[i]] - base, vertices.position[next] - base);
  }
  return area;
}

Status fit_plane(const CurveVertices& vertices, Span<const uint32_t> border,
                 Span<const Vec3> normal, Plane* plane) {
  Vec3 positions, normals;
  size_t known = 0;
  const double share = 1.0 / static_cast<double>(border.size());
  for (size_t i = 0; i < border.size(); ++i) {
    positions += share * vertices.position[border[i]];
    normals += share * normal[i];
    known += normal[i] != Vec3{};
  }
  if (known == 0) {
    normals = unit(vector_area(vertices, border, positions));
    known = border.size();
  }
  if (!(length(normals) >= k_least_mean_normal * share * static_cast<double>(known))) {
    return fail(Code::patch_without_plane,
                "the normals of the patch's border cancel out, so it has no plane");
  }
  plane->origin = positions;
  plane->normal = unit(normals);
  // What is left of a vector nearly along the normal is rounding and may point anywhere.
  constexpr double k_least_sine = 1e-3;
  const Vec3 first = vertices.position[border[0]] - positions;
  Vec3 axis = reject(first, plane->normal);
  if (!(dot(axis, axis) > k_least_sine * k_least_sine * dot(first, first))) {
    const bool along_x = std::fabs(plane->normal.x) > 0.8;
    axis = reject(along_x ? Vec3{0, 1, 0} : Vec3{1, 0, 0}, plane->normal);
  }
  plane->u = unit(axis);
  plane->v = cross(plane->normal, plane->u);
  return {};
}

}  // namespace wireskin::network
