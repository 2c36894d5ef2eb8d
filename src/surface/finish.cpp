#include "surface/finish.h"

#include "base/in_parts.h"
#include "curves/distance.h"
#include "mesh/curvature.h"
#include "mesh/inverted.h"
#include "smooth/fair.h"
#include "surface/spoilt.h"

namespace wireskin {

Status count_topology(uint32_t vertices, Span<const uint32_t> triangles, mesh::Topology* topology,
                      Counts* counts) {
  Array<uint32_t> twins(topology->component.context());
  counts->vertices = vertices;
  counts->triangles = static_cast<uint32_t>(triangles.size() / 3);
  TRY(mesh::find_twins(vertices, triangles, &twins));
  TRY(mesh::find_topology(vertices, triangles, twins.span(), topology));
  counts->components = topology->components;
  counts->boundary_loops = topology->boundary_loops;
  counts->euler_characteristic = topology->euler_characteristic;
  return {};
}

Status count_inverted(Context& context, Surface* surface) {
  mesh::Inverted inverted;
  TRY(mesh::find_inverted(context, surface->position.span(), surface->triangle.span(),
                          surface->patch.span(), &inverted));
  Counts* counts = &surface->counts;
  counts->inverted_triangles = inverted.count;
  counts->first_inverted_patch = inverted.count > 0 ? surface->patch[inverted.first] : k_none;
  return {};
}

// Normals, curvatures and the figures of the report, of the finished mesh.
static Status measure(Context& context, Span<const uint8_t> on_border, Span<const uint8_t> on_curve,
                      Surface* surface) {
  TRY(surface->normal.resize(surface->position.size()));
  TRY(mesh::vertex_normals(context, surface->position.span(), surface->triangle.span(),
                           surface->normal.span()));
  TRY(context.progress(0.3));
  TRY(mesh::mean_curvature(surface->position.span(), surface->normal.span(),
                           surface->triangle.span(), on_border, &surface->mean_curvature));
  TRY(mesh::gaussian_curvature(surface->position.span(), surface->triangle.span(), on_border,
                               &surface->gaussian_curvature));
  TRY(context.progress(0.6));
  Counts* counts = &surface->counts;
  TRY(mesh::least_angle(context, surface->position.span(), surface->triangle.span(),
                        &counts->least_angle));
  TRY(mesh::normal_deviation(context, surface->normal.span(), surface->constraint_normal.span(),
                             &counts->normal_deviation));
  TRY(mesh::dihedral_angles(context, surface->position.span(), surface->triangle.span(),
                            surface->patch.span(), on_curve, !surface->curve_edge.empty(),
                            &counts->dihedral));
  TRY(count_inverted(context, surface));
  return context.progress(0.8);
}

namespace {

// What the methods work on: the mesh itself, or the one cut open along its creases.
struct Workpiece {
  Span<Vec3> position, normal;
  Span<uint32_t> triangle;
  Span<const uint8_t> on_curve, held, on_border, bare;
  smooth::Soft soft;
  Span<const Vec3> start = {};
  Span<const uint8_t> placed = {};
  Span<const uint32_t> inner_edge = {};
  Span<const uint32_t> origin = {};  // in the mesh not cut open
};

}  // namespace

static Status check_finite(Context& context, Span<const Vec3> position) {
  bool is_finite = true;
  TRY(in_parts(context, position.size(), [&](size_t v) {
    const Vec3& p = position[v];
    is_finite = is_finite && p.x - p.x == 0.0 && p.y - p.y == 0.0 && p.z - p.z == 0.0;
  }));
  if (is_finite) return {};
  return fail(Code::not_positive_definite, "the solution of the linear system is not finite");
}

// Spoilt patches go back to what they were, and are held as those are that a method guards.
static Status hold_back_spoilt(Context& context, const Workpiece& piece,
                               Span<const uint32_t> unturned, Surface* surface) {
  Counts* counts = &surface->counts;
  Array<uint8_t>& guarded = surface->patch_guarded;
  Array<uint8_t> back(context);
  const SmoothedMesh mesh = {piece.position, piece.triangle, surface->patch.span(),
                             piece.start,    unturned,       piece.origin};
  TRY(put_back_spoilt(context, mesh, counts->patches, &back));
  if (back.empty()) return {};
  if (guarded.empty()) TRY(guarded.assign(counts->patches, 0));
  for (size_t p = 0; p < back.size(); ++p) {
    counts->guarded_patches += back[p] && !guarded[p];
    guarded[p] = guarded[p] || back[p];
  }
  return {};
}

static Status apply_method(Context& context, const Start& start, const Workpiece& piece,
                           smooth::Method method, Surface* surface) {
  Counts* counts = &surface->counts;
  Array<uint32_t> vertex_patch(context);
  TRY(assign_in_parts(piece.position.size(), 0, &vertex_patch));
  TRY(mesh::patches_of_vertices(context, piece.triangle, surface->patch.span(),
                                vertex_patch.span()));
  const smooth::Places places = {piece.start, vertex_patch.span()};
  if (method != smooth::Method::iterated && method != smooth::Method::fair) {
    const smooth::Domain domain = {piece.triangle,  start.shape,  piece.on_curve, piece.held,
                                   piece.on_border, start.metric, piece.soft,     piece.bare,
                                   places,          start.spent};
    return smooth::smooth(context, domain, method, {piece.position, piece.normal},
                          &counts->residual);
  }
  smooth::FairReport report;
  smooth::FairOptions options;
  if (method == smooth::Method::iterated) options.displacement_steps = 0;
  TRY(surface->patch_guarded.assign(counts->patches, 0));
  const bool planes = start.metric == smooth::Metric::planes;
  const smooth::FairMesh mesh = {piece.position,
                                 piece.normal,
                                 piece.triangle,
                                 surface->patch.span(),
                                 piece.on_curve,
                                 piece.held,
                                 piece.on_border,
                                 piece.soft,
                                 planes ? start.shape : Span<const mesh::TriangleShape>{},
                                 piece.bare,
                                 surface->patch_guarded.span(),
                                 places,
                                 piece.start,
                                 piece.placed,
                                 piece.inner_edge};
  TRY(smooth::fair(context, mesh, counts->patches, options, &report));
  counts->residual = report.residual;
  counts->guarded_patches = report.guarded_patches;
  counts->iterations = report.iterations;
  return {};
}

// Smooths; what that spoils of a mesh from curves, which was sound and whose patches have nothing
// to do with each other but the curves, goes back. Of other meshes the caller has to see to it.
static Status smooth_piece(Context& context, const Start& start, const Workpiece& piece,
                           smooth::Method method, Surface* surface) {
  const bool from_curves = start.metric == smooth::Metric::planes;
  const bool turns = method == smooth::Method::iterated || method == smooth::Method::fair;
  Array<uint32_t> unturned(context);
  if (from_curves && turns) TRY(copy_in_parts(piece.triangle, &unturned));
  TRY(apply_method(context, start, piece, method, surface));
  TRY(context.enter(Stage::result));
  TRY(check_finite(context, piece.position));
  if (!from_curves) return {};
  return hold_back_spoilt(context, piece, turns ? unturned.span() : piece.triangle, surface);
}

// Held vertices whose normal nobody knows, as points may be; empty where there are none.
static Status find_bare(const Constraints& constraints, const Surface& surface,
                        Array<uint8_t>* bare) {
  Context& context = bare->context();
  bool any = false;
  if (surface.curve_edge.empty()) return {};
  TRY(in_parts(context, surface.position.size(), [&](size_t v) {
    any = any || (constraints.held[v] && surface.constraint_normal[v] == Vec3{});
  }));
  if (!any) return {};
  TRY(bare->resize(surface.position.size()));
  return in_parts(context, bare->size(), [&](size_t v) {
    (*bare)[v] = constraints.held[v] && surface.constraint_normal[v] == Vec3{};
  });
}

// Smooths the surface by the chosen method and measures the result.
Status smooth_surface(Context& context, const Start& start, const Constraints& constraints,
                      smooth::Method method, Surface* surface) {
  Array<Vec3> normal(context), anchor(context);
  Array<uint8_t> bare(context);
  TRY(copy_in_parts(surface->constraint_normal, &normal));
  if (!constraints.cutoff.empty()) TRY(copy_in_parts(surface->position, &anchor));
  TRY(find_bare(constraints, *surface, &bare));
  const Workpiece piece = {surface->position.span(),
                           normal.span(),
                           surface->triangle.span(),
                           constraints.on_curve.span(),
                           constraints.held.span(),
                           start.on_border,
                           bare.span(),
                           {constraints.cutoff.span(), constraints.share.span(), anchor.span(),
                            surface->constraint_normal.span(), surface->counts.spacing},
                           start.position,
                           start.placed,
                           start.inner_edge};
  TRY(smooth_piece(context, start, piece, method, surface));
  return measure(context, start.on_border, constraints.on_curve.span(), surface);
}

// The same on the mesh cut open along the creases.
Status smooth_creased(Context& context, const Start& start, const Constraints& constraints,
                      smooth::Method method, network::CreasedMesh* creased, Surface* surface) {
  const size_t copies = creased->position.size();
  Array<Vec3> anchor(context), given_normal(context);
  Array<double> cutoff(context), share(context);
  Array<uint8_t> on_curve(context), held(context), placed(context);
  Array<Vec3> place(context);
  TRY(place.resize(copies));
  TRY(placed.resize(copies));
  TRY(in_parts(context, copies, [&](size_t c) {
    place[c] = start.position[creased->cut.origin[c]];
    placed[c] = start.placed.empty() ? 0 : start.placed[creased->cut.origin[c]];
  }));
  TRY(on_curve.resize(copies));
  TRY(held.resize(copies));
  if (!constraints.cutoff.empty()) {
    TRY(cutoff.resize(copies));
    TRY(share.resize(copies));
    TRY(copy_in_parts(creased->position.span(), &anchor));
  }
  TRY(copy_in_parts(creased->normal.span(), &given_normal));
  TRY(in_parts(context, copies, [&](size_t c) {
    const uint32_t v = creased->cut.origin[c];
    on_curve[c] = constraints.on_curve[v];
    held[c] = constraints.held[v];
    if (cutoff.empty()) return;
    cutoff[c] = constraints.cutoff[v];
    share[c] = constraints.share[v];
  }));
  const Workpiece piece = {
      creased->position.span(),
      creased->normal.span(),
      creased->cut.triangle.span(),
      on_curve.span(),
      held.span(),
      creased->on_border.span(),
      creased->bare.span(),
      {cutoff.span(), share.span(), anchor.span(), given_normal.span(), surface->counts.spacing},
      place.span(),
      placed.span(),
      {},
      creased->cut.origin.span()};
  TRY(smooth_piece(context, start, piece, method, surface));
  TRY(network::merge_creases(context, *creased, surface->position.span(),
                             surface->triangle.span()));
  TRY(measure(context, start.on_border, on_curve.span().part(0, surface->position.size()),
              surface));
  return network::measure_sides(
      context, *creased, given_normal.span(), surface->patch.span(),
      {surface->normal.span(), surface->mean_curvature.span(), surface->constraint_normal.span(),
       &surface->crease_normals, &surface->counts.normal_deviation, &surface->counts.dihedral});
}

Status measure_constraints(const CurveSet& set, Span<const Vec3> given, Surface* surface) {
  Context& context = surface->position.context();
  Array<Vec3> line(context);
  Pace pace(context);
  double sum = 0.0;
  size_t edge = 0;
  for (uint32_t c = 0; c < set.closed.size(); ++c) {
    TRY(pace.after());
    line.clear();
    for (; edge < surface->curve_edge_curve.size() && surface->curve_edge_curve[edge] == c;
         ++edge) {
      TRY(pace.after());
      if (line.empty()) TRY(line.push(surface->position[surface->curve_edge[2 * edge]]));
      TRY(line.push(surface->position[surface->curve_edge[2 * edge + 1]]));
    }
    if (line.empty()) continue;  // a point, or a curve of patches that were left out
    const size_t first = set.start[c], count = set.start[c + 1] - first;
    curves::LineDistance distance;
    TRY(curves::distance_to_line(given.part(first, count), line.span(), set.closed[c] != 0, &pace,
                                 &distance));
    sum += distance.sum_of_squares;
    if (distance.greatest > surface->counts.greatest_distance) {
      surface->counts.greatest_distance = distance.greatest;
    }
  }
  surface->counts.mean_square_distance = sum / static_cast<double>(given.size());
  return {};
}

}  // namespace wireskin
