#include "network/patch_in_plane.h"

#include "mesh/mesh.h"

namespace wireskin::network {

// Whether the triangles lie on the left of every edge of the loops: holes run clockwise, the outer
// loop does not.
static bool on_the_left(const planar::PolygonMesh& mesh, Span<DomainEdge> directed) {
  sort_edges(directed);
  for (size_t h = 0; h < mesh.triangles.size(); ++h) {
    const uint32_t a = mesh.triangles[h];
    const uint32_t b = mesh.triangles[mesh::next_half_edge(static_cast<uint32_t>(h))];
    if (has_edge(directed, {b, a})) return false;
  }
  return true;
}

// Loops that all are outer ones, beside each other, bound several discs in the plane and not the
// patch.
static uint32_t outer_loops(const PatchDomain& domain, Span<const Vec2> flat) {
  const Border& border = domain.border;
  uint32_t count = 0;
  for (uint32_t l = 0; l < border.loops(); ++l) {
    const Vec2 base = flat[domain.loop[border.start[l]]];
    double area = 0.0;
    for (uint32_t i = border.start[l]; i < border.start[l + 1]; ++i) {
      const Vec2 a = flat[domain.loop[i]] - base;
      const Vec2 b = flat[domain.loop[next_on_border(border, l, i)]] - base;
      area += a.x * b.y - a.y * b.x;
    }
    count += area > 0.0;
  }
  return count;
}

static Status mesh_flat(const PatchDomain& domain, Span<Vec2> flat, double spacing,
                        planar::PolygonMesh* mesh) {
  Context& context = domain.vertex.context();
  const Border& border = domain.border;
  round_to_grid(flat, &spacing);
  if (border.loops() == 1 && border.size() == domain.size()) {
    return planar::mesh_polygon(context, flat, spacing, mesh);
  }
  if (outer_loops(domain, flat) > 1) {
    return fail(Code::patch_without_plane, "the plane shows the loops beside each other");
  }
  Array<uint32_t> edges(context);
  Array<DomainEdge> directed(context);
  for (uint32_t l = 0; l < border.loops(); ++l) {
    for (uint32_t i = border.start[l]; i < border.start[l + 1]; ++i) {
      const uint32_t a = domain.loop[i], b = domain.loop[next_on_border(border, l, i)];
      TRY(edges.push(a));
      TRY(edges.push(b));
      TRY(directed.push({a, b}));
    }
  }
  const planar::Region region = {flat, edges.span(), domain.inner_edge.span(), false};
  Status status = planar::mesh_region(context, region, spacing, mesh);
  const bool outside = status.code == Code::bad_argument || status.code == Code::open_network;
  if (outside) status = fail(Code::patch_folded, "a curve inside the patch leaves it");
  status.place = {};  // its vertices are ours
  TRY(status);
  if (!on_the_left(*mesh, directed.span())) {
    return fail(Code::patch_without_plane, "a loop of the patch runs the wrong way round");
  }
  return {};
}

Status mesh_in_plane(const PatchDomain& domain, const Plane& plane, double spacing,
                     double least_facing, planar::PolygonMesh* mesh) {
  Array<Vec2> flat(domain.vertex.context());
  double facing = 0.0;
  size_t known = 0;
  for (const Vec3& normal : domain.border.normal) {
    facing += dot(normal, plane.normal);
    known += normal != Vec3{};
  }
  if (known > 0 && facing < least_facing * static_cast<double>(known)) {
    return fail(Code::patch_without_plane, "the plane of the patch sees too much of it edge-on");
  }
  TRY(flat.resize(domain.size()));
  for (size_t i = 0; i < flat.size(); ++i) flat[i] = plane.project(domain.position[i]);
  return mesh_flat(domain, flat.span(), spacing, mesh);
}

}  // namespace wireskin::network
