#include "network/plane.h"

#include "num/scale.h"

namespace wireskin::network {

// The mean of unit normals must be at least this long for its direction to mean anything.
static constexpr double k_least_mean_normal = 0.05;

// Where a border begins must not depend on the order or the direction of the curves, or these would
// change the triangulation: at its least point, nodes (whose bits are the caller's) before others.
static bool begins_before(const CurveVertices& vertices, uint32_t nodes, uint32_t a, uint32_t b) {
  if ((a < nodes) != (b < nodes)) return a < nodes;
  const Vec3 &p = vertices.position[a], &q = vertices.position[b];
  if (p.x != q.x) return p.x < q.x;
  return p.y != q.y ? p.y < q.y : p.z < q.z;
}

Status border_of_patch(const Network& network, const CurveVertices& vertices, uint32_t p,
                       Array<uint32_t>* border) {
  Array<uint32_t> round(border->context());
  for (uint32_t h : network.cycle(p)) {
    const uint32_t s = h / 2, edges = vertices.edges[s];
    for (uint32_t k = 0; k < edges; ++k) {
      TRY(round.push(segment_vertex(network, vertices, s, h % 2 == 0 ? k : edges - k)));
    }
  }
  size_t first = 0;
  for (size_t i = 1; i < round.size(); ++i) {
    if (begins_before(vertices, vertices.nodes, round[i], round[first])) first = i;
  }
  TRY(border->resize(round.size()));
  for (size_t i = 0; i < round.size(); ++i) (*border)[i] = round[(first + i) % round.size()];
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

static double nearest_multiple(double x, const Scale& to_grid, const Scale& from_grid) {
  const double steps = to_grid(x);
  return from_grid(
      static_cast<double>(static_cast<int64_t>(steps < 0.0 ? steps - 0.5 : steps + 0.5)));
}

void round_to_grid(Span<Vec2> polygon, double* spacing) {
  constexpr int k_bits = 32;
  double extent = 0.0;
  for (const Vec2& p : polygon) {
    const double x = std::fabs(p.x), y = std::fabs(p.y);
    extent = x > extent ? x : extent;
    extent = y > extent ? y : extent;
  }
  if (!(extent > 0.0) || !(*spacing < 16.0 * extent)) return;
  const int exponent = binary_exponent(extent);
  const Scale to_grid(k_bits - exponent), from_grid(exponent - k_bits);
  for (Vec2& p : polygon) {
    p = {nearest_multiple(p.x, to_grid, from_grid), nearest_multiple(p.y, to_grid, from_grid)};
  }
  const double rounded = nearest_multiple(*spacing, to_grid, from_grid);
  if (rounded > 0.0) *spacing = rounded;
}

}  // namespace wireskin::network
