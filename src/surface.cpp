#include "surface.h"

#include "base/in_parts.h"
#include "base/sort.h"
#include "network/group.h"
#include "network/outsides.h"
#include "network/partial.h"
#include "network/patch_mesh.h"
#include "network/size_limit.h"
#include "surface/finish.h"
#include "surface/fit.h"
#include "surface/spoilt.h"
#include "surface/verify.h"

namespace wireskin {

// A plane that sees a patch more steeply than this on the whole distorts the mesh; the methods that
// leave the planes behind then start better from a triangulation in space.
static constexpr double k_least_facing = 0.25;

// The curves as resampled, edge by edge.
static Status list_curve_edges(const network::Network& network,
                               const network::CurveVertices& vertices, Surface* surface) {
  for (uint32_t s = 0; s < network.segment.size(); ++s) {
    for (uint32_t k = 0; k < vertices.edges[s]; ++k) {
      TRY(surface->curve_edge.push(network::segment_vertex(network, vertices, s, k)));
      TRY(surface->curve_edge.push(network::segment_vertex(network, vertices, s, k + 1)));
      TRY(surface->curve_edge_curve.push(network.segment[s].curve));
    }
  }
  return {};
}

// The edges of curves inside patches.
static Status list_inner_edges(const network::Network& network,
                               const network::CurveVertices& vertices, Array<uint32_t>* edges) {
  for (uint32_t s : network.inner.item) {
    for (uint32_t k = 0; k < vertices.edges[s]; ++k) {
      TRY(edges->push(network::segment_vertex(network, vertices, s, k)));
      TRY(edges->push(network::segment_vertex(network, vertices, s, k + 1)));
    }
  }
  return {};
}

// The curves of each patch, each once.
static Status list_patch_curves(const network::Network& network, PatchList* patches) {
  TRY(patches->curve_start.push(0));
  Array<uint32_t> own(patches->curve.context());
  for (uint32_t p = 0; p < network.patches(); ++p) {
    own.clear();
    for (uint32_t h : network.cycle(p)) TRY(own.push(network.segment[h / 2].curve));
    for (uint32_t s : network.inner[p]) TRY(own.push(network.segment[s].curve));
    // Equal numbers are equal in every way, so their order does not matter.
    sort(own.span(), [](uint32_t a, uint32_t b) { return a < b; });
    for (size_t i = 0; i < own.size(); ++i) {
      if (i == 0 || own[i] != own[i - 1]) TRY(patches->curve.push(own[i]));
    }
    TRY(patches->curve_start.push(static_cast<uint32_t>(patches->curve.size())));
  }
  return {};
}

// Meshes all patches; with `partial` those that can be, the network being cut down to them.
// `original`: the number of each patch that is left; empty where all are.
static Status make_patches(const curves::Curves& fitted, const Settings& settings,
                           Span<const Status> faults, Array<network::Node>* nodes,
                           network::Network* network, network::CurveVertices* vertices,
                           network::PatchMesh* patches, Array<uint32_t>* original,
                           Surface* surface) {
  const bool in_space =
      settings.method == smooth::Method::iterated || settings.method == smooth::Method::fair;
  const double least_facing = in_space ? k_least_facing : -1.0;
  Counts* counts = &surface->counts;
  Context& context = nodes->context();
  TRY(list_patch_curves(*network, &surface->patches));
  TRY(network::mesh_patches(*network, *vertices, least_facing, settings.partial, patches, faults));
  TRY(surface->patches.way.resize(patches->way.size()));
  for (size_t p = 0; p < patches->way.size(); ++p) {
    surface->patches.way[p] = static_cast<uint8_t>(patches->way[p]);
    const bool made = patches->status[p].ok();
    counts->failed_patches += !made;
    counts->minimal_area_patches += made && patches->way[p] == network::PatchWay::minimal_area;
  }
  TRY(surface->patches.status.copy(patches->status.span()));
  counts->coarse_patches = patches->coarse_patches;
  counts->first_coarse_patch = patches->first_coarse_patch;
  if (counts->failed_patches == 0) return {};
  TRY(network::drop_patches(surface->patches.status.span(), nodes, network, original));
  network::CurveVertices fresh_vertices(context);
  network::PatchMesh fresh_patches(context);
  TRY(network::resample(fitted, nodes->span(), *network, counts->spacing, &fresh_vertices));
  TRY(network::mesh_patches(*network, fresh_vertices, least_facing, false, &fresh_patches));
  *vertices = static_cast<network::CurveVertices&&>(fresh_vertices);
  *patches = static_cast<network::PatchMesh&&>(fresh_patches);
  return {};
}

// Patches that share a node but no curve there are no manifold: say so in terms of the network.
static Status in_terms_of_nodes(Status status, Span<const network::Node> nodes) {
  if (status.code == Code::bad_mesh && status.place.vertex < nodes.size()) {
    Place place;
    place.node = nodes[status.place.vertex].number;
    return fail(Code::open_network, "patches touch at this node without sharing a curve", place);
  }
  return status;
}

// Makes room for the free vertices behind those of the curves.
static Status take_vertices(const network::CurveVertices& vertices,
                            const network::PatchMesh& patches, Surface* surface) {
  const size_t given = vertices.position.size();
  Context& context = surface->position.context();
  TRY(assign_in_parts(patches.vertices, Vec3{}, &surface->position));
  TRY(assign_in_parts(patches.vertices, Vec3{}, &surface->constraint_normal));
  TRY(assign_in_parts(patches.vertices, k_none, &surface->vertex_curve));
  TRY(in_parts(context, given, [&](size_t v) {
    surface->position[v] = vertices.position[v];
    surface->constraint_normal[v] = vertices.normal[v];
    surface->vertex_curve[v] = vertices.curve[v];
  }));
  TRY(copy_in_parts(patches.triangle, &surface->triangle));
  return copy_in_parts(patches.patch, &surface->patch);
}

// The patches that were left out were not held back.
static Status renumber_guarded(Span<const uint32_t> original, uint32_t patches,
                               Array<uint8_t>* guarded) {
  if (guarded->empty()) return {};
  Array<uint8_t> all(guarded->context());
  TRY(all.assign(patches, 0));
  for (size_t p = 0; p < guarded->size(); ++p) all[original[p]] = (*guarded)[p];
  return guarded->copy(all.span());
}

// An outside that might have been joined otherwise is no patch any more, so no question either.
static void renumber_ambiguous(Span<const uint32_t> original, Counts* counts) {
  const uint32_t before = counts->first_ambiguous_patch;
  if (before == k_none) return;
  counts->first_ambiguous_patch = k_none;
  for (uint32_t p = 0; p < original.size(); ++p) {
    if (original[p] == before) counts->first_ambiguous_patch = p;
  }
  if (counts->first_ambiguous_patch == k_none) --counts->ambiguous_patches;
}

// Leaves the outside of an open surface open, whose curves no one tagged.
static Status find_borders(const curves::Curves& fitted, Array<network::Node>* nodes,
                           network::Network* network, network::CurveVertices* vertices,
                           Array<Status>* faults, Counts* counts) {
  Context& context = nodes->context();
  Array<uint32_t> original(context);
  TRY(network::drop_outsides(fitted, *vertices, nodes, network, faults, &original));
  if (original.empty()) return {};
  counts->found_borders = counts->patches - network->patches();
  counts->patches = network->patches();
  counts->segments = static_cast<uint32_t>(network->segment.size());
  renumber_ambiguous(original.span(), counts);
  network::CurveVertices fresh(context);
  TRY(network::resample(fitted, nodes->span(), *network, counts->spacing, &fresh));
  *vertices = static_cast<network::CurveVertices&&>(fresh);
  return {};
}

Status surface_curves(Context& context, const CurveSet& set, const Settings& settings,
                      Surface* surface) {
  Counts* counts = &surface->counts;
  curves::Curves fitted(context);
  Array<network::Node> nodes(context);
  network::Network network(context);
  network::CurveVertices vertices(context);
  network::PatchMesh patches(context);
  mesh::Topology topology(context);
  Constraints constraints(context);
  Array<Vec3> given(context);
  Array<uint32_t> original(context), inner_edge(context);
  Array<Status> faults(context);

  TRY(context.enter(Stage::curves));
  const double size = diagonal(set.position);
  counts->spacing = settings.spacing > 0.0 ? settings.spacing : size / 100.0;
  for (uint32_t c = 0; c < set.soft.size(); ++c) TRY(check_cutoff(set.soft[c], size, c));
  TRY(given.copy(set.position));
  TRY(fit_curves(context, set, size, settings.smoothing, &nodes, &fitted, counts));

  TRY(context.enter(Stage::network));
  TRY(network::find_patches(fitted, set.boundary, nodes.span(), &network,
                            settings.partial ? &faults : nullptr));
  counts->segments = static_cast<uint32_t>(network.segment.size());
  counts->patches = network.patches();
  TRY(network::check_vertex_count(fitted, network, counts->spacing));
  TRY(network::resample(fitted, nodes.span(), network, counts->spacing, &vertices));
  network::Ambiguity ambiguity;
  TRY(network::group_patches(vertices, &network, &ambiguity));
  counts->ambiguous_patches = ambiguity.patches;
  counts->first_ambiguous_patch = ambiguity.first;
  counts->patches = network.patches();
  if (settings.find_borders) {
    TRY(find_borders(fitted, &nodes, &network, &vertices, &faults, counts));
  }

  TRY(context.enter(Stage::patches));
  TRY(make_patches(fitted, settings, faults.span(), &nodes, &network, &vertices, &patches,
                   &original, surface));
  TRY(list_curve_edges(network, vertices, surface));
  TRY(list_inner_edges(network, vertices, &inner_edge));
  counts->patches = network.patches();
  counts->free_vertices = patches.vertices - patches.curve_vertices;
  TRY(take_vertices(vertices, patches, surface));
  TRY(in_terms_of_nodes(
      count_topology(patches.vertices, surface->triangle.span(), &topology, counts), nodes.span()));

  TRY(verify_surface(context, network, patches.start.span(), *surface));

  TRY(constrain_curves(set, patches.curve_vertices, *surface, &constraints));
  const Start start = {patches.shape.span(), smooth::Metric::planes, topology.on_border.span(),
                       patches.start.span(), patches.placed.span(),  inner_edge.span(),
                       &patches.shape};
  if (network::has_creases(vertices)) {
    network::CreasedMesh creased(context);
    TRY(network::cut_along_creases(network, vertices, set.sharp, nodes.span(), patches,
                                   surface->position.span(), &creased));
    TRY(smooth_creased(context, start, constraints, settings.method, &creased, surface));
  } else {
    patches.triangle.free();  // the surface has its own
    patches.patch.free();
    TRY(smooth_surface(context, start, constraints, settings.method, surface));
  }
  TRY(verify_surface(context, network, surface->position.span(), *surface));
  if (!original.empty()) {  // the smoothing counted those that are left
    TRY(in_parts(context, surface->patch.size(),
                 [&](size_t t) { surface->patch[t] = original[surface->patch[t]]; }));
    counts->patches += counts->failed_patches;
    uint32_t& inverted = counts->first_inverted_patch;
    if (inverted != k_none) inverted = original[inverted];
    TRY(renumber_guarded(original.span(), counts->patches, &surface->patch_guarded));
  }
  return measure_constraints(set, given.span(), surface);
}

// Every component and every border must be held, or the surface would be free to float away.
static Status check_held(const TriangleSet& set, const mesh::Topology& topology) {
  Context& context = topology.component.context();
  Array<uint8_t> anchored(context);
  TRY(anchored.assign(topology.components, 0));
  TRY(in_parts(context, set.constrained.size(), [&](size_t v) {
    if (set.constrained[v]) anchored[topology.component[v]] = 1;
  }));
  Pace pace(context);
  for (uint32_t v = 0; v < set.constrained.size(); ++v) {
    TRY(pace.after());
    Place place;
    place.vertex = v;
    if (topology.on_border[v] && !set.constrained[v]) {
      return fail(Code::unconstrained, "a vertex of an open border is not constrained", place);
    }
    if (!anchored[topology.component[v]]) {
      return fail(Code::unconstrained, "no vertex of this component is constrained", place);
    }
  }
  return {};
}

static Status mean_edge_length(Context& context, Span<const Vec3> positions,
                               Span<const uint32_t> triangles, double* mean) {
  double sum = 0.0;
  TRY(in_parts(context, triangles.size(), [&](size_t h) {
    const uint32_t next = triangles[mesh::next_half_edge(static_cast<uint32_t>(h))];
    sum += length(positions[next] - positions[triangles[h]]);
  }));
  *mean = sum / static_cast<double>(triangles.size());
  return {};
}

static Status take_triangles(const TriangleSet& set, Surface* surface) {
  const size_t n = set.position.size();
  TRY(copy_in_parts(set.position, &surface->position));
  TRY(copy_in_parts(set.triangle, &surface->triangle));
  TRY(assign_in_parts(set.triangle.size() / 3, 0, &surface->patch));
  TRY(surface->patches.way.push(0));
  TRY(surface->patches.status.push(Status{}));
  TRY(surface->patches.curve_start.assign(2, 0));
  TRY(assign_in_parts(n, Vec3{}, &surface->constraint_normal));
  TRY(assign_in_parts(n, k_none, &surface->vertex_curve));
  return in_parts(surface->position.context(), n, [&](size_t v) {
    if (!set.constrained[v]) return;
    surface->vertex_curve[v] = 0;
    if (!set.normal.empty()) surface->constraint_normal[v] = set.normal[v];
  });
}

// A caller's mesh has no parts that could go back, so if it is spoilt, that is a failure.
static Status check_not_spoilt(Context& context, const TriangleSet& set, Surface* surface) {
  Spoilt spoilt(context);
  const SmoothedMesh mesh = {surface->position.span(),
                             surface->triangle.span(),
                             surface->patch.span(),
                             set.constrained,
                             set.position,
                             set.triangle};
  TRY(find_spoilt(context, mesh, 1, &spoilt));
  if (spoilt.first == k_none) return {};
  Place place;
  place.triangle = spoilt.first;
  return fail(Code::not_positive_definite,
              "smoothing leaves the triangle without area, or takes it far away", place);
}

Status surface_triangles(Context& context, const TriangleSet& set, const Settings& settings,
                         Surface* surface) {
  Counts* counts = &surface->counts;
  mesh::Topology topology(context);
  Array<mesh::TriangleShape> shapes(context);
  Constraints constraints(context);
  const uint32_t n = static_cast<uint32_t>(set.position.size());

  TRY(context.enter(Stage::patches));
  TRY(count_topology(n, set.triangle, &topology, counts));
  TRY(mesh::check_areas(context, set.position, set.triangle));
  TRY(check_held(set, topology));
  counts->patches = 1;
  for (uint8_t constrained : set.constrained) counts->free_vertices += constrained == 0;
  TRY(mean_edge_length(context, set.position, set.triangle, &counts->spacing));
  TRY(take_triangles(set, surface));
  TRY(mesh::triangle_shapes(set.position, set.triangle, &shapes));
  TRY(check_cutoff(set.soft, diagonal(set.position), k_none));
  TRY(constrain_vertices(set, counts->spacing, &constraints));
  const Start start = {shapes.span(), smooth::Metric::space, topology.on_border.span(),
                       set.position};
  TRY(smooth_surface(context, start, constraints, settings.method, surface));
  TRY(check_not_spoilt(context, set, surface));
  return verify_triangles(context, set, *surface);
}

}  // namespace wireskin
