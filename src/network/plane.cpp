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

Status fit_plane(const CurveVertices& vertices, Span<const uint32_t> border, Plane* plane) {
  Vec3 positions, normals;
  const double share = 1.0 / static_cast<double>(border.size());
  for (uint32_t v : border) {
    positions += share * vertices.position[v];
    normals += share * vertices.normal[v];
  }
  if (!(length(normals) >= k_least_mean_normal)) {
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
