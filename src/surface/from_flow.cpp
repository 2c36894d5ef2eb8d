#include "surface/from_flow.h"

#include "base/in_parts.h"
#include "base/sort.h"
#include "flow/crossings.h"
#include "mesh/curvature.h"
#include "num/minmax.h"
#include "surface/constraints.h"
#include "surface/finish.h"
#include "surface/flow_measure.h"
#include "surface/spoilt.h"

namespace wireskin {

// The segment of the caller's curve that ends at a place of an arc.
static uint32_t curve_before(const flow::Flow& flow, uint32_t i) {
  return flow.arcs.curve[flow.samples.step[i]];
}

// Drops the vertices that neither a triangle nor a curve uses.
static Status take_flow_vertices(const flow::Flow& flow, const flow::FlowMesh& mesh,
                                 Surface* surface, FlowOutcome* outcome) {
  const size_t samples = flow.samples.position.size();
  Context& context = outcome->vertex_of.context();
  Array<uint32_t> number(context);
  TRY(assign_in_parts(mesh.position.size(), k_none, &number));
  TRY(in_parts(context, mesh.triangle.size(), [&](size_t i) { number[mesh.triangle[i]] = 0; }));
  for (const uint32_t v : flow.samples.at) number[v] = 0;
  TRY(surface->position.reserve(mesh.position.size()));
  uint32_t used = 0;
  TRY(in_parts(context, number.size(), [&](size_t v) {
    if (number[v] == k_none) return;
    number[v] = used++;
    surface->position.push_reserved(mesh.position[v]);
  }));
  TRY(surface->triangle.resize(mesh.triangle.size()));
  TRY(in_parts(context, mesh.triangle.size(),
               [&](size_t i) { surface->triangle[i] = number[mesh.triangle[i]]; }));
  TRY(copy_in_parts(mesh.patch.span(), &surface->patch));
  number.shrink(samples);
  outcome->vertex_of = static_cast<Array<uint32_t>&&>(number);
  return {};
}

static Status take_flow_curves(const flow::Flow& flow, Span<const uint32_t> vertex_of,
                               Surface* surface) {
  const flow::Samples& samples = flow.samples;
  TRY(assign_in_parts(surface->position.size(), k_none, &surface->vertex_curve));
  TRY(surface->curve_edge.reserve(2 * samples.at.size()));
  TRY(surface->curve_edge_curve.reserve(samples.at.size()));
  for (uint32_t a = 0; a + 1 < samples.start.size(); ++a) {
    for (uint32_t i = samples.start[a]; i + 1 < samples.start[a + 1]; ++i) {
      const uint32_t curve = curve_before(flow, i + 1);
      surface->curve_edge_curve.push_reserved(curve);
      for (uint32_t end = 0; end < 2; ++end) {
        const uint32_t v = vertex_of[samples.at[i + end]];
        surface->curve_edge.push_reserved(v);
        if (curve < surface->vertex_curve[v]) surface->vertex_curve[v] = curve;
      }
    }
  }
  Array<uint32_t> curve_of_point(surface->vertex_curve.context());
  TRY(curve_of_point.assign(flow.arcs.vertex.size(), k_none));
  for (uint32_t i = 0; i < flow.arcs.point.size(); ++i) {
    curve_of_point[flow.arcs.point[i]] = flow.arcs.point_curve[i];
  }
  for (uint32_t s = 0; s < samples.vertex.size(); ++s) {
    const uint32_t v = samples.vertex[s];
    if (v == k_none || curve_of_point[v] == k_none || vertex_of[s] == k_none) continue;
    surface->vertex_curve[vertex_of[s]] = curve_of_point[v];
  }
  return {};
}

// The normal given at the first sample of each vertex of the arcs.
static Status normals_of_vertices(const flow::Flow& flow, Span<const Vec3> given,
                                  Array<Vec3>* normal) {
  TRY(normal->assign(flow.arcs.vertex.size(), Vec3{}));
  for (size_t s = given.size(); s-- > 0;) (*normal)[flow.arcs.sample_vertex[s]] = given[s];
  return {};
}

// The point between two samples that their normals bend the segment to: the cubic that is
// orthogonal to both (Vlachos et al., "Curved PN Triangles", 2001).
static Vec3 bent(const Vec3& p, const Vec3& q, const Vec3& normal_p, const Vec3& normal_q,
                 double share) {
  const Vec3 chord = q - p;
  const Vec3 at_p = (-dot(chord, normal_p)) * normal_p, at_q = dot(chord, normal_q) * normal_q;
  const double rest = 1.0 - share;
  return (share * rest) * (rest * at_p + share * at_q);
}

// Along arcs normals change evenly from one given sample to the next; vertices between two samples
// leave the segment for where the normals say that the surface is.
static Status take_flow_normals(const flow::Flow& flow, Span<const Vec3> given,
                                Span<const uint32_t> vertex_of, Surface* surface,
                                Array<Vec3>* offset) {
  const flow::Samples& samples = flow.samples;
  const flow::Arcs& arcs = flow.arcs;
  TRY(assign_in_parts(surface->position.size(), Vec3{}, offset));
  Array<Vec3> normal(surface->normal.context());
  TRY(normals_of_vertices(flow, given, &normal));
  for (uint32_t i = 0; i < samples.at.size(); ++i) {
    uint32_t before = samples.step[i], after = before + 1;
    while (arcs.path[before] >= arcs.given) --before;
    while (arcs.path[after] >= arcs.given) ++after;
    const uint32_t p = arcs.path[before], q = arcs.path[after];
    const double whole = arcs.along[after] - arcs.along[before];
    const double share = whole > 0.0 ? (samples.along[i] - arcs.along[before]) / whole : 0.0;
    const double clamped = smaller(larger(share, 0.0), 1.0);
    const uint32_t v = vertex_of[samples.at[i]];
    surface->constraint_normal[v] = unit((1.0 - clamped) * normal[p] + clamped * normal[q]);
    (*offset)[v] = bent(arcs.vertex[p], arcs.vertex[q], normal[p], normal[q], clamped);
    if (after == before + 1 || clamped == 0.0 || clamped == 1.0) continue;
    // The arc has left the segment already, as far as its samples told where to.
    const Vec3 straight = arcs.vertex[p] + clamped * (arcs.vertex[q] - arcs.vertex[p]);
    (*offset)[v] += straight - surface->position[v];
  }
  return {};
}

// Turns every component to the side that the given normals point to.
static Status turn_to_normals(Context& context, const mesh::Topology& topology, Surface* surface) {
  Array<double> agreement(context);
  TRY(agreement.assign(topology.components, 0.0));
  Array<uint32_t>& triangle = surface->triangle;
  for (size_t t = 0; t < triangle.size(); t += 3) {
    const Vec3& a = surface->position[triangle[t]];
    const Vec3 across =
        cross(surface->position[triangle[t + 1]] - a, surface->position[triangle[t + 2]] - a);
    for (size_t k = 0; k < 3; ++k) {
      agreement[topology.component[triangle[t]]] +=
          dot(across, surface->constraint_normal[triangle[t + k]]);
    }
  }
  for (size_t t = 0; t < triangle.size(); t += 3) {
    if (agreement[topology.component[triangle[t]]] >= 0.0) continue;
    const uint32_t second = triangle[t + 1];
    triangle[t + 1] = triangle[t + 2];
    triangle[t + 2] = second;
  }
  return {};
}

static Status smooth_flow_surface(Context& context, const mesh::Topology& topology,
                                  smooth::Method method, Surface* surface) {
  Array<uint8_t> constrained(context);
  Array<mesh::TriangleShape> shapes(context);
  Constraints constraints(context);
  TRY(constrained.resize(surface->position.size()));
  for (size_t v = 0; v < constrained.size(); ++v) {
    constrained[v] = surface->vertex_curve[v] != k_none;
  }
  TRY(mesh::triangle_shapes(surface->position.span(), surface->triangle.span(), &shapes));
  const TriangleSet set = {surface->position.span(), surface->constraint_normal.span(),
                           constrained.span(), surface->triangle.span(), 0.0};
  TRY(constrain_vertices(set, surface->counts.spacing, &constraints));
  return smooth_surface(context, {shapes.span(), smooth::Metric::space, topology.on_border.span()},
                        constraints, method, surface);
}

// Normals and curvatures of the patches as they are.
static Status measure_flow_surface(Context& context, const mesh::Topology& topology,
                                   bool measurable, Surface* surface) {
  const size_t n = surface->position.size();
  TRY(context.enter(Stage::result));
  TRY(surface->normal.resize(n));
  TRY(mesh::vertex_normals(context, surface->position.span(), surface->triangle.span(),
                           surface->normal.span()));
  TRY(assign_in_parts(n, 0.0, &surface->mean_curvature));
  TRY(assign_in_parts(n, 0.0, &surface->gaussian_curvature));
  Array<uint8_t> on_curve(context);
  TRY(on_curve.resize(n));
  for (size_t v = 0; v < n; ++v) on_curve[v] = surface->vertex_curve[v] != k_none;
  TRY(mesh::find_crease_normals(context, surface->position.span(), surface->triangle.span(),
                                on_curve.span(), &surface->crease_normals));
  TRY(mesh::least_angle(context, surface->position.span(), surface->triangle.span(),
                        &surface->counts.least_angle));
  if (!measurable) return {};
  TRY(count_inverted(context, surface));
  TRY(mesh::mean_curvature(surface->position.span(), surface->normal.span(),
                           surface->triangle.span(), topology.on_border.span(),
                           &surface->mean_curvature));
  TRY(mesh::gaussian_curvature(surface->position.span(), surface->triangle.span(),
                               topology.on_border.span(), &surface->gaussian_curvature));
  return mesh::dihedral_angles(context, surface->position.span(), surface->triangle.span(),
                               surface->patch.span(), on_curve.span(), true,
                               &surface->counts.dihedral);
}

static void count_flow(const flow::Flow& flow, const flow::Reconstruction& reconstruction,
                       const FlowSettings& settings, Surface* surface) {
  Counts& counts = surface->counts;
  for (const uint8_t node : flow.arcs.is_node) counts.nodes += node;
  counts.segments = flow.arcs.size();
  counts.patches = reconstruction.patches.size();
  counts.vertices = static_cast<uint32_t>(surface->position.size());
  counts.triangles = static_cast<uint32_t>(surface->patch.size());
  counts.spacing = settings.spacing;
  for (const uint32_t curve : surface->vertex_curve) counts.free_vertices += curve == k_none;
}

// Edges that more than one triangle passes in the same direction.
static Status count_branches(Span<const uint32_t> triangles, Context& context, uint32_t* count) {
  struct HalfEdge {
    uint32_t from, to, at;
  };
  Array<HalfEdge> edges(context);
  TRY(edges.reserve(triangles.size()));
  for (uint32_t h = 0; h < triangles.size(); ++h) {
    edges.push_reserved({triangles[h], triangles[mesh::next_half_edge(h)], h});
  }
  sort(edges.span(), [](const HalfEdge& a, const HalfEdge& b) {
    if (a.from != b.from) return a.from < b.from;
    return a.to != b.to ? a.to < b.to : a.at < b.at;
  });
  *count = 0;
  for (size_t i = 1, run = 1; i < edges.size(); ++i) {
    run = edges[i].from == edges[i - 1].from && edges[i].to == edges[i - 1].to ? run + 1 : 1;
    *count += run == 2;
  }
  return {};
}

// Curve vertices whose normal points away from the side that the surface shows.
static Status count_opposed(Context& context, const Surface& surface, uint32_t* opposed,
                            uint32_t* all) {
  Array<Vec3> normal(context);
  TRY(normal.resize(surface.position.size()));
  TRY(mesh::vertex_normals(context, surface.position.span(), surface.triangle.span(),
                           normal.span()));
  *opposed = *all = 0;
  for (size_t v = 0; v < normal.size(); ++v) {
    const Vec3& wish = surface.constraint_normal[v];
    *all += wish != Vec3{};
    *opposed += dot(wish, normal[v]) < 0.0;
  }
  return {};
}

// Smooths; `*too_thin`: whether that led nowhere for the shapes of the triangles.
static Status try_method(Context& context, const mesh::Topology& topology, smooth::Method method,
                         Span<const Vec3> start, Span<const uint32_t> unturned, Surface* surface,
                         bool* too_thin) {
  const Status status = smooth_flow_surface(context, topology, method, surface);
  *too_thin = status.code == Code::not_positive_definite;
  if (*too_thin) return {};
  TRY(status);
  Spoilt spoilt(context);
  const SmoothedMesh mesh = {surface->position.span(), surface->triangle.span(),
                             surface->patch.span(), start, unturned};
  TRY(find_spoilt(context, mesh, surface->counts.patches, &spoilt));
  *too_thin = spoilt.first != k_none;
  return {};
}

// What the smoothing changes, to be put back if it leads nowhere.
static Status smooth_or_restore(Context& context, const mesh::Topology& topology,
                                Span<const Vec3> offset, smooth::Method method, Surface* surface,
                                FlowOutcome* outcome) {
  constexpr size_t k_most_pairs = 1000;
  Array<Vec3> position(context);
  Array<uint32_t> triangle(context), pairs(context);
  TRY(copy_in_parts(surface->position.span(), &position));
  TRY(copy_in_parts(surface->triangle.span(), &triangle));
  for (size_t v = 0; v < offset.size(); ++v) surface->position[v] += offset[v];
  bool too_thin = false;
  TRY(try_method(context, topology, method, position.span(), triangle.span(), surface, &too_thin));
  outcome->normals = NormalsUse::too_thin;
  if (!too_thin) {
    TRY(flow::find_crossings(context, surface->position.span(), surface->triangle.span(),
                             k_most_pairs, &pairs));
    if (pairs.empty()) {
      outcome->normals = NormalsUse::used;
      return {};
    }
    outcome->normals = NormalsUse::crossing;
    outcome->normals_places = static_cast<uint32_t>(pairs.size() / 2);
  }
  surface->position = static_cast<Array<Vec3>&&>(position);
  surface->triangle = static_cast<Array<uint32_t>&&>(triangle);
  surface->patch_guarded.clear();
  surface->counts.guarded_patches = surface->counts.iterations = 0;
  surface->counts.inverted_triangles = 0;
  surface->counts.first_inverted_patch = k_none;
  surface->counts.residual = 0.0;
  surface->counts.normal_deviation = {};
  return {};
}

// Smooths where the normals can be used; else all is as before, and the outcome says why.
static Status try_to_smooth(Context& context, const mesh::Topology& topology,
                            Span<const Vec3> offset, smooth::Method method, Surface* surface,
                            FlowOutcome* outcome) {
  constexpr uint32_t k_most_opposed = 10;  // one in so many
  uint32_t free = 0, opposed = 0, all = 0;
  for (size_t v = 0; v < topology.on_border.size(); ++v) {
    free += topology.on_border[v] != 0 && surface->vertex_curve[v] == k_none;
  }
  outcome->normals = NormalsUse::free_border;
  outcome->normals_places = free;
  if (free > 0) return {};
  TRY(turn_to_normals(context, topology, surface));
  TRY(count_opposed(context, *surface, &opposed, &all));
  outcome->normals = NormalsUse::contradicting;
  outcome->normals_places = opposed;
  if (uint64_t{opposed} * k_most_opposed > all) return {};
  outcome->normals_places = 0;
  return smooth_or_restore(context, topology, offset, method, surface, outcome);
}

// Whether the mesh allows the normals to be used.
static Status judge_mesh(Context& context, const FlowSettings& settings, bool measurable,
                         const Surface& surface, FlowOutcome* outcome) {
  if (settings.normal.empty()) {
    const bool some = settings.bare_curves != k_none;
    outcome->normals = some ? NormalsUse::incomplete : NormalsUse::none;
    outcome->normals_places = some ? settings.bare_curves : 0;
  } else if (!outcome->manifold) {
    outcome->normals = NormalsUse::not_manifold;
    return count_branches(surface.triangle.span(), context, &outcome->normals_places);
  } else if (!measurable) {
    outcome->normals = NormalsUse::too_thin;
  }
  return {};
}

// As network/size_limit.h has it, but here the areas are known.
static Status check_flow_vertices(const flow::Patches& patches, double spacing) {
  constexpr double k_most_vertices = 67108864.0;  // 2^26
  if (!(spacing > 0.0)) return {};
  double sum = 0.0, most = 0.0;
  Place place;
  for (uint32_t p = 0; p < patches.size(); ++p) {
    const double vertices = patches.facts[p].area / (spacing * spacing);
    sum += vertices;
    if (!(vertices > most)) continue;
    most = vertices;
    place.patch = p;
  }
  if (sum < k_most_vertices) return {};
  return fail(Code::too_large,
              "the spacing is too small for the network: its surface would have more than 2^26 "
              "vertices",
              place);
}

Status surface_from_flow(Context& context, const flow::Flow& flow,
                         const flow::Reconstruction& reconstruction, const FlowSettings& settings,
                         Surface* surface, FlowOutcome* outcome) {
  {
    flow::FlowMesh mesh(context);
    TRY(check_flow_vertices(reconstruction.patches, settings.spacing));
    TRY(flow::mesh_patches(context, flow, reconstruction, settings.spacing, &mesh));
    outcome->held_back = mesh.held_back;
    outcome->crossings = mesh.crossings;
    TRY(take_flow_vertices(flow, mesh, surface, outcome));
  }
  TRY(take_flow_curves(flow, outcome->vertex_of.span(), surface));
  TRY(assign_in_parts(surface->position.size(), Vec3{}, &surface->constraint_normal));
  TRY(context.checkpoint());
  Array<Vec3> offset(context);
  if (!settings.normal.empty()) {
    TRY(take_flow_normals(flow, settings.normal, outcome->vertex_of.span(), surface, &offset));
  }
  mesh::Topology topology(context);
  const Status status = count_topology(static_cast<uint32_t>(surface->position.size()),
                                       surface->triangle.span(), &topology, &surface->counts);
  if (!status.ok() && status.code != Code::bad_mesh) return status;
  outcome->manifold = status.ok() && !surface->triangle.empty();
  count_flow(flow, reconstruction, settings, surface);
  Status areas;
  if (outcome->manifold) {
    areas = mesh::check_areas(context, surface->position.span(), surface->triangle.span());
  }
  if (!areas.ok() && areas.code != Code::bad_mesh) return areas;
  const bool measurable = outcome->manifold && areas.ok();
  TRY(judge_mesh(context, settings, measurable, *surface, outcome));
  if (outcome->normals == NormalsUse::none && !settings.normal.empty()) {
    TRY(try_to_smooth(context, topology, offset.span(), settings.method, surface, outcome));
  }
  if (outcome->normals != NormalsUse::used) {
    TRY(measure_flow_surface(context, topology, measurable, surface));
  }
  return measure_given(flow, settings.given, outcome->vertex_of.span(), surface);
}

}  // namespace wireskin
