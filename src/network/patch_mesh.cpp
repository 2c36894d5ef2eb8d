#include "network/patch_mesh.h"

#include "base/in_parts.h"
#include "mesh/check.h"
#include "network/border_check.h"
#include "network/patch_in_plane.h"
#include "network/patch_in_space.h"
#include "network/shared_chords.h"
#include "network/size_limit.h"
#include "num/minmax.h"
#include "num/predicates.h"

namespace wireskin::network {

static constexpr size_t k_triangles_per_checkpoint = 8192;

namespace {

// Memory for one patch, reused: the mesh either way, and what both come to: the corners' places for
// the metric, and where the free vertices, those behind the domain's, may start in space.
struct PatchScratch {
  PatchDomain domain;
  planar::PolygonMesh planar;
  SpaceMesh spatial;
  Array<Vec3> place;
  Array<Vec3> inner;

  explicit PatchScratch(Context& context)
      : domain(context), planar(context), spatial(context), place(context), inner(context) {}
};

}  // namespace

static bool may_be_left_out(const Status& status) {
  return status.code == Code::patch_without_plane || status.code == Code::patch_folded ||
         status.code == Code::patch_several_loops;
}

// Adds the place to what went wrong with a patch: its number and a curve of its border.
static Status at_patch(Status status, const Network& network, uint32_t patch) {
  if (!may_be_left_out(status) && status.code != Code::too_large) return status;
  status.place.patch = patch;
  if (status.place.curve == k_none) {
    status.place.curve = network.segment[network.cycle(patch)[0] / 2].curve;
  }
  return status;
}

static Status append_patch(const PatchScratch& scratch, Span<const uint32_t> triangle,
                           uint32_t patch, SharedChords* chords) {
  PatchMesh* mesh = chords->mesh;
  const PatchDomain& domain = scratch.domain;
  const size_t first = mesh->patch.size(), more = triangle.size() / 3;
  TRY(make_room_in_parts(triangle.size(), &mesh->triangle));
  TRY(make_room_in_parts(more, &mesh->patch));
  TRY(make_room_in_parts(more, &mesh->shape));
  TRY(make_room_in_parts(scratch.inner.size(), &mesh->start));
  TRY(make_room_in_parts(scratch.inner.size(), &mesh->placed));
  for (size_t t = 0; t < more; ++t) {
    const uint32_t* corner = &triangle[3 * t];
    const auto global = [&](uint32_t v) {
      return v < domain.size() ? domain.vertex[v] : mesh->vertices + (v - domain.size());
    };
    const Vec3 at[] = {scratch.place[corner[0]], scratch.place[corner[1]],
                       scratch.place[corner[2]]};
    for (int k = 0; k < 3; ++k) mesh->triangle.push_reserved(global(corner[k]));
    mesh->patch.push_reserved(patch);
    mesh->shape.push_reserved(mesh::triangle_shape(at[0], at[1], at[2]));
    TRY(chords->note(domain, corner, at, patch, static_cast<uint32_t>(first + t)));
    if (t % k_triangles_per_checkpoint == k_triangles_per_checkpoint - 1)
      TRY(mesh->patch.context().checkpoint());
  }
  TRY(in_parts(mesh->patch.context(), scratch.inner.size(), [&](size_t i) {
    mesh->start.push_reserved(scratch.inner[i]);
    mesh->placed.push_reserved(scratch.spatial.raised);
  }));
  const uint64_t vertices = uint64_t{mesh->vertices} + scratch.inner.size();
  if (vertices > 0x7fffffff || mesh->triangle.size() > 0x7fffffff) {
    return fail(Code::too_large, "the spacing is too small for the network");
  }
  mesh->vertices = static_cast<uint32_t>(vertices);
  return {};
}

// What the mesh in the plane is to the others: corners there, starts in space.
static Status lift_patch(const Plane& plane, PatchScratch* scratch) {
  const Array<Vec2>& points = scratch->planar.points;
  const size_t n = scratch->domain.size();
  TRY(scratch->place.resize(points.size()));
  TRY(scratch->inner.resize(points.size() - n));
  return in_parts(scratch->place.context(), points.size(), [&](size_t i) {
    scratch->place[i] = {points[i].x, points[i].y, 0.0};
    if (i >= n) scratch->inner[i - n] = plane.lift(points[i]);
  });
}

#ifdef WIRESKIN_DEBUG
// In its plane the mesh is exact: no triangle is inverted.
static bool runs_counter_clockwise(const planar::PolygonMesh& mesh) {
  for (size_t t = 0; t < mesh.triangles.size(); t += 3) {
    if (!(orient2d(mesh.points[mesh.triangles[t]], mesh.points[mesh.triangles[t + 1]],
                   mesh.points[mesh.triangles[t + 2]]) > 0.0)) {
      return false;
    }
  }
  return true;
}
#endif

// `at`: the place of a vertex. The bound is that of every mesh, with room for splits of the chords.
template <typename At>
static Status check_areas(Context& context, Span<const uint32_t> triangle, const At& at) {
  constexpr double k_least_area = 16.0 * mesh::k_least_height;
  for (size_t t = 0; t < triangle.size(); t += 3) {
    const Vec3 a = at(triangle[t + 1]) - at(triangle[t]), b = at(triangle[t + 2]) - at(triangle[t]);
    const Vec3 c = b - a;
    const double longest2 = larger(dot(a, a), larger(dot(b, b), dot(c, c)));
    if (!(length(cross(a, b)) > k_least_area * longest2)) {
      return fail(Code::patch_folded, "the border of the patch encloses nothing");
    }
    if (t / 3 % k_triangles_per_checkpoint == k_triangles_per_checkpoint - 1) {
      TRY(context.checkpoint());
    }
  }
  return {};
}

static Status check_areas_in_space(const PatchScratch& scratch, Span<const uint32_t> triangle) {
  const PatchDomain& domain = scratch.domain;
  const size_t n = domain.size();
  return check_areas(scratch.place.context(), triangle,
                     [&](uint32_t v) { return v < n ? domain.position[v] : scratch.inner[v - n]; });
}

// Points in line within rounding have a triangle in the plane, where they are rounded again, and
// none in space; points above each other have one in space, and in the plane a needle, whose
// weights would drown those of all other triangles.
static Status check_areas_of_flat(const PatchScratch& scratch) {
  const Span<const uint32_t> triangle = scratch.planar.triangles.span();
  TRY(check_areas(scratch.place.context(), triangle, [&](uint32_t v) { return scratch.place[v]; }));
  return check_areas_in_space(scratch, triangle);
}

static bool may_be_meshed_otherwise(const Status& status) {
  return status.code == Code::patch_without_plane || status.code == Code::patch_folded;
}

static Status mesh_patch(const Network& network, const CurveVertices& vertices, double least_facing,
                         uint32_t patch, PatchScratch* scratch, SharedChords* chords) {
  PatchMesh* mesh = chords->mesh;
  const PatchDomain& domain = scratch->domain;
  TRY(scratch->domain.take(network, vertices, patch));
  const double spacing = border_length(domain.border) / static_cast<double>(domain.border.size());
  Plane plane;
  scratch->spatial.raised = false;
  Status status = fit_plane(domain.border, &plane);
  if (status.ok()) status = mesh_in_plane(domain, plane, spacing, least_facing, &scratch->planar);
  if (status.ok()) status = lift_patch(plane, scratch);
  if (status.ok()) status = check_areas_of_flat(*scratch);
  if (status.ok()) {
    WIRESKIN_ASSERT(runs_counter_clockwise(scratch->planar));
    TRY(mesh->way.push(PatchWay::plane));
    return append_patch(*scratch, scratch->planar.triangles.span(), patch, chords);
  }
  if (!may_be_meshed_otherwise(status)) return status;
  TRY(check_border(domain.border));
  TRY(check_border_size(domain.border, spacing));
  TRY(mesh_in_space(domain, vertices, spacing, &scratch->spatial));
  const Span<const Vec3> place = scratch->spatial.position.span();
  TRY(scratch->place.copy(place));
  TRY(scratch->inner.copy(place.part(domain.size(), place.size() - domain.size())));
  TRY(check_areas_in_space(*scratch, scratch->spatial.triangle.span()));
  TRY(mesh->way.push(PatchWay::minimal_area));
  if (scratch->spatial.coarse && mesh->coarse_patches++ == 0) mesh->first_coarse_patch = patch;
  return append_patch(*scratch, scratch->spatial.triangle.span(), patch, chords);
}

// Why the patch is not to be made, its number included.
static Status fault_of_patch(const Network& network, uint32_t patch, Span<const Status> faults) {
  Status status;
  for (uint32_t h : network.cycle(patch)) {
    if (status.ok() && !faults.empty()) status = faults[h / 2];
  }
  for (uint32_t s : network.inner[patch]) {
    if (status.ok() && !faults.empty()) status = faults[s];
  }
  status.place.patch = patch;
  return status;
}

Status mesh_patches(const Network& network, const CurveVertices& vertices, double least_facing,
                    bool partial, PatchMesh* mesh, Span<const Status> faults) {
  Context& context = mesh->triangle.context();
  SharedChords chords(context, mesh);
  PatchScratch scratch(context);
  TRY(scratch.domain.start(vertices));
  mesh->curve_vertices = mesh->vertices = static_cast<uint32_t>(vertices.position.size());
  TRY(mesh->start.copy(vertices.position.span()));
  TRY(mesh->placed.assign(mesh->vertices, 0));
  for (uint32_t p = 0; p < network.patches(); ++p) {
    TRY(chords.patch_start.push(static_cast<uint32_t>(mesh->patch.size())));
    Status status = fault_of_patch(network, p, faults);
    const bool known = !status.ok();
    scratch.spatial.raised = false;
    if (!known) status = mesh_patch(network, vertices, least_facing, p, &scratch, &chords);
    if (!known) status = at_patch(status, network, p);
    TRY(mesh->status.push(status));
    TRY(chords.raised.push(scratch.spatial.raised));
    if (!status.ok() && !(partial && (known || may_be_left_out(status)))) return status;
    if (!status.ok()) TRY(mesh->way.push(PatchWay::plane));
    TRY(context.progress(static_cast<double>(p + 1) / static_cast<double>(network.patches())));
  }
  TRY(chords.patch_start.push(static_cast<uint32_t>(mesh->patch.size())));
  if (mesh->vertices >= k_most_vertices) {
    return fail(
        Code::too_large,
        "the spacing is too small for the network: its surface has more than 2^26 vertices");
  }
  if (mesh->patch.empty() && !mesh->status.empty()) return mesh->status[0];
  return chords.split(network, vertices);
}

}  // namespace wireskin::network
