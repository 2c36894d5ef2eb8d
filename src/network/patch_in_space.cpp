#include "network/patch_in_space.h"

#include "mesh/band.h"
#include "mesh/branches.h"
#include "mesh/dome.h"
#include "mesh/inlay.h"
#include "num/minmax.h"

namespace wireskin::network {

// Where the normals agree less with the axis of the border, what spreads linearly from it is flat:
// the patch starts raised along them.
static constexpr double k_least_closing = 0.3;
// The coarse mesh has edges so much longer than wished, but about so many along the border's
// length.
static constexpr double k_coarser = 4.0, k_edges_of_coarse_border = 60.0;

// Whether some triangle is so thin that the systems to come would be singular.
static bool has_needles(const SpaceMesh& mesh) {
  constexpr double k_needle = 1e-5;
  const Span<const Vec3> position = mesh.position.span();
  for (size_t t = 0; t < mesh.triangle.size(); t += 3) {
    const Vec3 a = position[mesh.triangle[t + 1]] - position[mesh.triangle[t]];
    const Vec3 b = position[mesh.triangle[t + 2]] - position[mesh.triangle[t]], c = b - a;
    if (!(length(cross(a, b)) > k_needle * (dot(a, a) + dot(b, b) + dot(c, c)))) return true;
  }
  return false;
}

static mesh::Loops loops_of(const Border& border) {
  return {border.start.span(), border.position.span(), border.normal.span()};
}

// One round: `*sound` says whether it left the mesh fit for the next one.
static Status raise_once(const Border& border, uint32_t held, SpaceMesh* mesh, bool* sound) {
  *sound = false;
  if (has_needles(*mesh)) return {};
  const Status raised = mesh::raise_dome(mesh->position.context(), loops_of(border), held,
                                         mesh->triangle.span(), mesh->position.span());
  if (raised.code == Code::not_positive_definite) return {};
  TRY(raised);
  *sound = !has_needles(*mesh);
  return {};
}

static Status refine_and_raise(const Border& border, const mesh::HeldCurves& held, double spacing,
                               int rounds, SpaceMesh* mesh, bool* sound) {
  Context& context = mesh->position.context();
  for (int round = 0; *sound && round < rounds; ++round) {
    TRY(mesh::refine_loops(context, spacing, border.start.span(), held, &mesh->position,
                           &mesh->triangle));
    TRY(raise_once(border, held.vertices, mesh, sound));
  }
  return {};
}

static Status take_mesh(const Border& border, mesh::LoopMesh* made, SpaceMesh* mesh) {
  TRY(mesh->position.copy(border.position.span()));
  for (const Vec3& p : made->inner) TRY(mesh->position.push(p));
  mesh->triangle = static_cast<Array<uint32_t>&&>(made->triangle);
  return {};
}

static Status take_loop_mesh(const Border& border, double spacing, SpaceMesh* mesh) {
  mesh::LoopMesh flat(mesh->position.context());
  TRY(mesh::mesh_loops(mesh->position.context(), loops_of(border), spacing, &flat));
  mesh->coarse = flat.coarse;
  return take_mesh(border, &flat, mesh);
}

// Tubes from several loops to where they meet.
static Status take_branches(const Border& border, double spacing, SpaceMesh* mesh) {
  Context& context = mesh->position.context();
  mesh::LoopMesh branches(context);
  TRY(mesh::mesh_branches(context, loops_of(border), spacing, &branches));
  TRY(take_mesh(border, &branches, mesh));
  if (has_needles(*mesh)) return take_loop_mesh(border, spacing, mesh);
  return mesh::refine_loops(context, spacing, border.start.span(), &mesh->position,
                            &mesh->triangle);
}

static Status take_band(const Border& border, double spacing, SpaceMesh* mesh) {
  Context& context = mesh->position.context();
  mesh::LoopMesh band(context);
  TRY(mesh::mesh_band(context, loops_of(border), spacing, &band));
  TRY(take_mesh(border, &band, mesh));
  if (has_needles(*mesh)) return {};
  TRY(mesh::refine_loops(context, spacing, border.start.span(), &mesh->position, &mesh->triangle));
  mesh->band = !has_needles(*mesh);
  return {};
}

Status mesh_border_in_space(const Border& border, double spacing, SpaceMesh* mesh) {
  constexpr int k_coarse_rounds = 2, k_fine_rounds = 1;
  mesh->raised = dot(mean_normal(border), unit(vector_area(border))) < k_least_closing;
  mesh->band = mesh->coarse = false;
  if (mesh->raised && border.loops() == 2) {
    TRY(take_band(border, spacing, mesh));
    if (mesh->band) return {};
  }
  if (mesh->raised) {
    const double coarse = larger(
        spacing, smaller(k_coarser * spacing, border_length(border) / k_edges_of_coarse_border));
    const mesh::HeldCurves held = {border.size(), {}};
    bool sound = true;
    TRY(border.loops() > 2 ? take_branches(border, coarse, mesh)
                           : take_loop_mesh(border, coarse, mesh));
    TRY(raise_once(border, border.size(), mesh, &sound));
    TRY(refine_and_raise(border, held, coarse, k_coarse_rounds, mesh, &sound));
    TRY(refine_and_raise(border, held, spacing, k_fine_rounds, mesh, &sound));
    mesh->coarse = false;  // that was of the first mesh
    if (sound) return {};
    if (border.loops() > 2) return take_branches(border, spacing, mesh);
  }
  return take_loop_mesh(border, spacing, mesh);
}

// Raises a dome again and refines it where that stretched it, with more held than the border.
static Status raise_again(const Border& border, const mesh::HeldCurves& held, double spacing,
                          SpaceMesh* mesh) {
  constexpr int k_rounds = 2;
  SpaceMesh raised(mesh->position.context());
  TRY(raised.position.copy(mesh->position.span()));
  TRY(raised.triangle.copy(mesh->triangle.span()));
  bool sound = true;
  TRY(raise_once(border, held.vertices, &raised, &sound));
  TRY(refine_and_raise(border, held, spacing, k_rounds, &raised, &sound));
  if (!sound) return {};
  mesh->position = static_cast<Array<Vec3>&&>(raised.position);
  mesh->triangle = static_cast<Array<uint32_t>&&>(raised.triangle);
  return {};
}

// Lets the mesh in space pass through the curves and points inside the patch.
static Status inlay(const PatchDomain& domain, double spacing, SpaceMesh* mesh) {
  Context& context = domain.vertex.context();
  const Border& border = domain.border;
  const uint32_t rim = border.size(), n = domain.size();
  Array<DomainEdge> lines(context);
  Array<uint32_t> edges(context);
  for (size_t e = 0; e < domain.inner_edge.size(); e += 2) {
    const uint32_t a = domain.inner_edge[e], b = domain.inner_edge[e + 1];
    TRY(lines.push(a < b ? DomainEdge{a, b} : DomainEdge{b, a}));
  }
  sort_edges(lines.span());
  for (const DomainEdge& line : lines) {
    TRY(edges.push(line.a));
    TRY(edges.push(line.b));
  }
  const mesh::Inlay curves = {domain.position.span().part(rim, n - rim), edges.span()};
  TRY(mesh::inlay_curves(context, border.start.span(), curves, spacing, &mesh->position,
                         &mesh->triangle));
  if (has_needles(*mesh)) {
    return fail(Code::patch_folded, "curves inside the patch lie too near each other");
  }
  if (!mesh->raised || mesh->band) return {};
  return raise_again(border, {n, edges.span()}, spacing, mesh);
}

// Names the curve of the local vertex that a failure speaks of.
static Status at_local_vertex(Status status, const CurveVertices& vertices,
                              const PatchDomain& domain) {
  const uint32_t v = status.place.vertex;
  status.place.vertex = k_none;
  if (v < domain.vertex.size()) status.place.curve = vertices.curve[domain.vertex[v]];
  return status;
}

Status mesh_in_space(const PatchDomain& domain, const CurveVertices& vertices, double spacing,
                     SpaceMesh* mesh) {
  const Border& border = domain.border;
  const uint32_t rim = border.size();
  for (uint32_t i = 0; i < rim; ++i) {
    if (domain.loop[i] == i) continue;
    return fail(Code::patch_folded,
                "no plane shows the patch without folds, and its border passes a point twice");
  }
  TRY(mesh_border_in_space(border, spacing, mesh));
  // A curve of a single edge from loop to loop brings no vertex.
  if (domain.size() == rim && domain.inner_edge.empty()) return {};
  return at_local_vertex(inlay(domain, spacing, mesh), vertices, domain);
}

}  // namespace wireskin::network
