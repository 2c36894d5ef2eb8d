#include "mesh/check.h"

#include "mesh/inverted.h"
#include "num/minmax.h"

namespace wireskin::mesh {

static Status bad_triangle(const char* sentence, size_t triangle) {
  Place place;
  place.triangle = static_cast<uint32_t>(triangle);
  return fail(Code::bad_mesh, sentence, place);
}

static Status bad_vertex(Code code, const char* sentence, size_t vertex) {
  Place place;
  place.vertex = static_cast<uint32_t>(vertex);
  return fail(code, sentence, place);
}

static Status check_sizes(const Expectations& mesh) {
  const size_t triangles = mesh.triangle.size() / 3;
  if (mesh.triangle.size() % 3 != 0 || mesh.position.size() >= k_none) {
    return fail(Code::bad_mesh, "the triangles are not three vertices each");
  }
  if (!mesh.patch.empty() && mesh.patch.size() != triangles) {
    return fail(Code::bad_mesh, "not every triangle has a patch");
  }
  for (size_t t = 0; t < triangles && !mesh.patch_normal.empty(); ++t) {
    const uint32_t patch = mesh.patch.empty() ? 0 : mesh.patch[t];
    if (patch >= mesh.patch_normal.size()) {
      return bad_triangle("the triangle is of a patch that does not exist", t);
    }
  }
  return {};
}

static bool is_finite(const Vec3& p) {
  return std::fabs(p.x) <= DBL_MAX && std::fabs(p.y) <= DBL_MAX && std::fabs(p.z) <= DBL_MAX;
}

static Status check_positions(Span<const Vec3> position) {
  for (size_t v = 0; v < position.size(); ++v) {
    if (is_finite(position[v])) continue;
    return bad_vertex(Code::not_a_number, "the vertex has a coordinate that is not finite", v);
  }
  return {};
}

// Every edge of a curve must be an edge of the mesh. Each vertex's neighbours are marked with its
// own number, once for all edges that it begins.
static Status check_edges(Context& context, const Expectations& mesh) {
  const uint32_t vertices = static_cast<uint32_t>(mesh.position.size());
  const size_t edges = mesh.edge.size() / 2;
  Array<uint32_t> start(context), corner(context), first_edge(context), edge(context),
      mark(context);
  TRY(find_corners(vertices, mesh.triangle, &start, &corner));
  TRY(first_edge.assign(size_t{vertices} + 1, 0));
  TRY(edge.resize(edges));
  TRY(mark.assign(vertices, k_none));
  for (size_t e = 0; e < 2 * edges; ++e) {
    if (mesh.edge[e] >= vertices) {
      return bad_vertex(Code::index_out_of_range, "an edge names a vertex that does not exist",
                        mesh.edge[e]);
    }
    if (e % 2 == 0) ++first_edge[mesh.edge[e]];
  }
  starts_from_counts(first_edge.span());
  for (uint32_t e = 0; e < edges; ++e) edge[first_edge[mesh.edge[2 * e]]++] = e;
  for (uint32_t v = 0, e = 0; v < vertices; ++v) {
    if (e == first_edge[v]) continue;
    for (uint32_t c = start[v]; c < start[v + 1]; ++c) {
      mark[mesh.triangle[next_half_edge(corner[c])]] = v;
      mark[mesh.triangle[previous_half_edge(corner[c])]] = v;
    }
    for (; e < first_edge[v]; ++e) {
      if (mark[mesh.edge[2 * edge[e] + 1]] == v) continue;
      return bad_vertex(Code::bad_mesh, "an edge of a curve that begins here is not in the mesh",
                        v);
    }
  }
  return {};
}

static Vec3 area_vector(const Expectations& mesh, size_t t) {
  const Vec3& a = mesh.position[mesh.triangle[3 * t]];
  return cross(mesh.position[mesh.triangle[3 * t + 1]] - a,
               mesh.position[mesh.triangle[3 * t + 2]] - a);
}

// A triangle's height over its longest edge is its doubled area over that edge's length.
static Status check_shapes(const Expectations& mesh) {
  for (size_t t = 0; t < mesh.triangle.size() / 3; ++t) {
    const Vec3& a = mesh.position[mesh.triangle[3 * t]];
    const Vec3& b = mesh.position[mesh.triangle[3 * t + 1]];
    const Vec3& c = mesh.position[mesh.triangle[3 * t + 2]];
    const double longest2 = larger(dot(b - a, b - a), larger(dot(c - b, c - b), dot(a - c, a - c)));
    const Vec3 area = area_vector(mesh, t);
    if (!mesh.may_be_flat && !(length(area) > k_least_height * longest2)) {
      return bad_triangle("the triangle has no area", t);
    }
    if (mesh.patch_normal.empty()) continue;
    const Vec3& normal = mesh.patch_normal[mesh.patch.empty() ? 0 : mesh.patch[t]];
    if (dot(area, normal) < 0.0) return bad_triangle("the triangle faces against its patch", t);
  }
  return {};
}

static Status check_folds(const Expectations& mesh, Span<const uint32_t> twins) {
  for (uint32_t h = 0; h < twins.size(); ++h) {
    if (twins[h] == k_none || twins[h] < h) continue;
    const uint32_t t = h / 3, other = twins[h] / 3;
    if (!mesh.patch.empty() && mesh.patch[t] != mesh.patch[other]) continue;
    const Vec3 normal = unit(area_vector(mesh, t));
    if (dot(normal, unit(area_vector(mesh, other))) < k_folded_cosine) {
      return bad_triangle("the triangle is folded onto its neighbour", t);
    }
  }
  return {};
}

static Status check_inverted(Context& context, const Expectations& mesh) {
  Inverted inverted;
  TRY(find_inverted(context, mesh.position, mesh.triangle, mesh.patch, &inverted));
  if (inverted.count == 0) return {};
  return bad_triangle("the triangle is inverted: it faces against those round it", inverted.first);
}

Status check(Context& context, const Expectations& mesh) {
  Array<uint32_t> twins(context);
  Topology topology(context);
  const uint32_t vertices = static_cast<uint32_t>(mesh.position.size());
  TRY(check_sizes(mesh));
  TRY(find_twins(vertices, mesh.triangle, &twins));
  TRY(find_topology(vertices, mesh.triangle, twins.span(), &topology));
  TRY(check_edges(context, mesh));
  if (mesh.euler_characteristic != nullptr &&
      topology.euler_characteristic != *mesh.euler_characteristic) {
    return fail(Code::bad_mesh, "the mesh has another Euler characteristic than its network");
  }
  TRY(check_positions(mesh.position));
  TRY(check_shapes(mesh));
  if (mesh.may_fold) return {};
  TRY(check_folds(mesh, twins.span()));
  return check_inverted(context, mesh);
}

}  // namespace wireskin::mesh
