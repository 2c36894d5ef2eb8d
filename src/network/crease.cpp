#include "network/crease.h"

#include "base/in_parts.h"
#include "mesh/curvature.h"

namespace wireskin::network {

namespace {

// Half-edges of the mesh by the vertex that they leave.
struct Corners {
  Span<const uint32_t> triangle;
  Array<uint32_t> start, corner;

  Corners(Context& context, Span<const uint32_t> t)
      : triangle(t), start(context), corner(context) {}

  uint32_t half_edge(uint32_t from, uint32_t to) const {
    for (uint32_t k = start[from]; k < start[from + 1]; ++k) {
      if (triangle[mesh::next_half_edge(corner[k])] == to) return corner[k];
    }
    return k_none;
  }
};

}  // namespace

// Calls visit(side, segment, entry, next entry, half-edge) for both sides of every edge of the
// curves that has a triangle there: the normals of `side` at the half-edge's two ends are its
// entries.
template <typename Visit>
static void for_curve_sides(const Network& network, const CurveVertices& vertices,
                            const Corners& corners, const Visit& visit) {
  for (uint32_t s = 0; s < network.segment.size(); ++s) {
    const uint32_t first = vertices.side_start[s];
    for (uint32_t k = 0; k < vertices.edges[s]; ++k) {
      const uint32_t a = segment_vertex(network, vertices, s, k);
      const uint32_t b = segment_vertex(network, vertices, s, k + 1);
      const uint32_t left = corners.half_edge(a, b), right = corners.half_edge(b, a);
      if (left != k_none) visit(s, vertices.left[first + k], vertices.left[first + k + 1], left);
      if (right != k_none)
        visit(s, vertices.right[first + k + 1], vertices.right[first + k], right);
    }
  }
}

static Status cut_mesh(const Network& network, const CurveVertices& vertices,
                       Span<const uint8_t> sharp, const Corners& corners, uint32_t count,
                       CreasedMesh* creased) {
  Array<uint8_t> marked(creased->held.context());
  Array<uint32_t> twins(creased->held.context());
  TRY(mesh::find_twins(count, corners.triangle, &twins));
  TRY(marked.assign(corners.triangle.size(), 0));
  for_curve_sides(network, vertices, corners,
                  [&](uint32_t s, const Vec3&, const Vec3&, uint32_t h) {
                    if (sharp[network.segment[s].curve]) marked[h] = 1;
                  });
  return mesh::cut_open(count, corners.triangle, twins.span(), marked.span(), &creased->cut);
}

// The mean of the normals known in every sector, and whether it opposes one of them.
static Status find_sector_normals(const Network& network, const CurveVertices& vertices,
                                  const Corners& corners, Span<const Node> nodes,
                                  CreasedMesh* creased) {
  const Span<Vec3> normal = creased->normal.span();
  const Span<const uint32_t> triangle = creased->cut.triangle.span();
  for (Vec3& n : normal) n = Vec3{};
  for_curve_sides(network, vertices, corners,
                  [&](uint32_t, const Vec3& here, const Vec3& there, uint32_t h) {
                    normal[triangle[h]] += here;
                    normal[triangle[mesh::next_half_edge(h)]] += there;
                  });
  for (Vec3& n : normal) n = unit(n);
  Status status;
  const auto compare = [&](uint32_t s, const Vec3& n, uint32_t copy) {
    const uint32_t v = creased->cut.origin[copy];
    if (n == Vec3{} || dot(n, normal[copy]) > 0.0 || !status.ok()) return;
    Place place;
    place.curve = network.segment[s].curve;
    if (v < nodes.size()) place.node = nodes[v].number;
    status = fail(Code::inconsistent_normals,
                  "the normal opposes those of the other curves of this sector of the node", place);
  };
  for_curve_sides(network, vertices, corners,
                  [&](uint32_t s, const Vec3& here, const Vec3& there, uint32_t h) {
                    compare(s, here, triangle[h]);
                    compare(s, there, triangle[mesh::next_half_edge(h)]);
                  });
  return status;
}

Status cut_along_creases(const Network& network, const CurveVertices& vertices,
                         Span<const uint8_t> sharp, Span<const Node> nodes, const PatchMesh& mesh,
                         Span<const Vec3> position, CreasedMesh* creased) {
  Context& context = creased->held.context();
  Corners corners(context, mesh.triangle.span());
  mesh::Topology topology(context);
  Array<uint32_t> twins(context);
  TRY(mesh::find_corners(mesh.vertices, corners.triangle, &corners.start, &corners.corner));
  TRY(cut_mesh(network, vertices, sharp, corners, mesh.vertices, creased));
  const uint32_t copies = creased->cut.vertices();
  TRY(creased->position.resize(copies));
  TRY(creased->normal.resize(copies));
  TRY(creased->held.resize(copies));
  TRY(creased->bare.resize(copies));
  TRY(find_sector_normals(network, vertices, corners, nodes, creased));
  for (uint32_t c = 0; c < copies; ++c) {
    const uint32_t v = creased->cut.origin[c];
    creased->position[c] = position[v];
    creased->held[c] = v < mesh.curve_vertices;
    creased->bare[c] = creased->held[c] && creased->normal[c] == Vec3{};
  }
  TRY(mesh::find_twins(copies, creased->cut.triangle.span(), &twins));
  TRY(mesh::find_topology(copies, creased->cut.triangle.span(), twins.span(), &topology));
  return creased->on_border.copy(topology.on_border.span());
}

Status merge_creases(Context& context, const CreasedMesh& creased, Span<Vec3> position,
                     Span<uint32_t> triangle) {
  TRY(in_parts(context, creased.position.size(),
               [&](size_t c) { position[creased.cut.origin[c]] = creased.position[c]; }));
  return in_parts(context, triangle.size(),
                  [&](size_t h) { triangle[h] = creased.cut.origin[creased.cut.triangle[h]]; });
}

Status measure_sides(Context& context, const CreasedMesh& creased, Span<const Vec3> given_normal,
                     Span<const uint32_t> patch, const VertexMeasures& measures) {
  const size_t n = measures.normal.size(), copies = creased.position.size();
  Array<Vec3> normal(context), given(context);
  Array<double> curvature(context), count(context);
  TRY(normal.resize(copies));
  TRY(count.assign(n, 0.0));
  const Span<const uint32_t> triangle = creased.cut.triangle.span();
  TRY(mesh::vertex_normals(context, creased.position.span(), triangle, normal.span()));
  TRY(mesh::mean_curvature(creased.position.span(), normal.span(), triangle,
                           creased.on_border.span(), &curvature));
  TRY(given.assign(copies, Vec3{}));
  TRY(in_parts(context, n, [&](size_t v) {
    measures.normal[v] = measures.constraint_normal[v] = Vec3{};
    measures.mean_curvature[v] = 0.0;
  }));
  TRY(in_parts(context, copies, [&](size_t c) {
    const uint32_t v = creased.cut.origin[c];
    measures.normal[v] += normal[c];
    measures.mean_curvature[v] += curvature[c];
    if (creased.held[c] && !creased.bare[c]) given[c] = given_normal[c];
    measures.constraint_normal[v] += given[c];
    count[v] += 1.0;
  }));
  TRY(in_parts(context, n, [&](size_t v) {
    // The sides of a knife's edge cancel out: then the first copy's normal stands for both.
    const bool cancels = measures.normal[v] == Vec3{};
    measures.normal[v] = unit(cancels ? normal[v] : measures.normal[v]);
    measures.mean_curvature[v] /= count[v];
    measures.constraint_normal[v] = unit(measures.constraint_normal[v]);
  }));
  TRY(mesh::corner_normals(creased.cut, static_cast<uint32_t>(n), normal.span(),
                           measures.crease_normals));
  TRY(mesh::normal_deviation(context, normal.span(), given.span(), measures.normal_deviation));
  return mesh::dihedral_angles(context, creased.position.span(), triangle, patch,
                               creased.held.span(), true, measures.dihedral);
}

}  // namespace wireskin::network
