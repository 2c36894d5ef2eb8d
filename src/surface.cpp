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
#include "surface/verify.h"

namespace wireskin {

// A plane that sees a patch more steeply than this on the whole distorts the mesh; the methods that
// leave the planes behind then start better from a triangulation in space.
static constexpr double k_least_facing = 0.25;

namespace {

// What becomes of the curves on the way to the surface.
struct Draft {
  Array<Vec3> given;  // the caller's samples, from which noise may be taken out
  curves::Curves fitted;
  Array<network::Node> nodes;
  network::Network network;
  Array<Status> faults;  // with `partial`, of each segment: why no patch is to be made at it
  network::CurveVertices vertices;
  network::PatchMesh patches;
  Array<uint32_t> original;  // the number of each patch that is left; empty where all are

  explicit Draft(Context& context)
      : given(context),
        fitted(context),
        nodes(context),
        network(context),
        faults(context),
        vertices(context),
        patches(context),
        original(context) {}
  Context& context() const { return given.context(); }
};

}  // namespace

static Status fit(const CurveSet& set, const Settings& settings, Draft* draft, Counts* counts) {
  Context& context = draft->context();
  TRY(context.enter(Stage::curves));
  const double size = diagonal(set.position);
  counts->spacing = settings.spacing > 0.0 ? settings.spacing : size / 100.0;
  for (uint32_t c = 0; c < set.soft.size(); ++c) TRY(check_cutoff(set.soft[c], size, c));
  TRY(draft->given.copy(set.position));
  return fit_curves(context, set, size, settings.smoothing, &draft->nodes, &draft->fitted, counts);
}

// The curves' vertices for the network as it is now.
static Status resample_again(const Counts& counts, Draft* draft) {
  network::CurveVertices fresh(draft->context());
  TRY(network::resample(draft->fitted, draft->nodes.span(), draft->network, counts.spacing,
                        &fresh));
  draft->vertices = static_cast<network::CurveVertices&&>(fresh);
  return {};
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
static Status find_borders(Draft* draft, Counts* counts) {
  network::Network& network = draft->network;
  Array<uint32_t> original(draft->context());
  TRY(network::drop_outsides(draft->fitted, draft->vertices, &draft->nodes, &network,
                             &draft->faults, &original));
  if (original.empty()) return {};
  counts->found_borders = counts->patches - network.patches();
  counts->patches = network.patches();
  counts->segments = static_cast<uint32_t>(network.segment.size());
  renumber_ambiguous(original.span(), counts);
  return resample_again(*counts, draft);
}

static Status find_network(const CurveSet& set, const Settings& settings, Draft* draft,
                           Counts* counts) {
  network::Network& network = draft->network;
  TRY(draft->context().enter(Stage::network));
  TRY(network::find_patches(draft->fitted, set.boundary, draft->nodes.span(), &network,
                            settings.partial ? &draft->faults : nullptr));
  counts->segments = static_cast<uint32_t>(network.segment.size());
  counts->patches = network.patches();
  TRY(network::check_vertex_count(draft->fitted, network, counts->spacing));
  TRY(network::resample(draft->fitted, draft->nodes.span(), network, counts->spacing,
                        &draft->vertices));
  network::Ambiguity ambiguity;
  TRY(network::group_patches(draft->vertices, &network, &ambiguity));
  counts->ambiguous_patches = ambiguity.patches;
  counts->first_ambiguous_patch = ambiguity.first;
  counts->patches = network.patches();
  return settings.find_borders ? find_borders(draft, counts) : Status{};
}

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

static void count_ways(const network::PatchMesh& patches, Surface* surface) {
  Counts* counts = &surface->counts;
  for (size_t p = 0; p < patches.way.size(); ++p) {
    surface->patches.way[p] = static_cast<uint8_t>(patches.way[p]);
    const bool made = patches.status[p].ok();
    counts->failed_patches += !made;
    counts->minimal_area_patches += made && patches.way[p] == network::PatchWay::minimal_area;
  }
  counts->coarse_patches = patches.coarse_patches;
  counts->first_coarse_patch = patches.first_coarse_patch;
}

// Meshes all patches; with `partial` those that can be, the network being cut down to them.
static Status make_patches(const Settings& settings, Draft* draft, Surface* surface) {
  const bool in_space =
      settings.method == smooth::Method::iterated || settings.method == smooth::Method::fair;
  const double least_facing = in_space ? k_least_facing : -1.0;
  network::PatchMesh& patches = draft->patches;
  TRY(draft->context().enter(Stage::patches));
  TRY(list_patch_curves(draft->network, &surface->patches));
  TRY(network::mesh_patches(draft->network, draft->vertices, least_facing, settings.partial,
                            &patches, draft->faults.span()));
  TRY(surface->patches.way.resize(patches.way.size()));
  TRY(surface->patches.status.copy(patches.status.span()));
  count_ways(patches, surface);
  if (surface->counts.failed_patches == 0) return {};
  TRY(network::drop_patches(surface->patches.status.span(), &draft->nodes, &draft->network,
                            &draft->original));
  TRY(resample_again(surface->counts, draft));
  network::PatchMesh fresh(draft->context());
  TRY(network::mesh_patches(draft->network, draft->vertices, least_facing, false, &fresh));
  patches = static_cast<network::PatchMesh&&>(fresh);
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

// The mesh as it is before any smoothing, with room for the free vertices behind those of the
// curves.
static Status take_mesh(const Draft& draft, Surface* surface) {
  const network::CurveVertices& vertices = draft.vertices;
  const network::PatchMesh& patches = draft.patches;
  TRY(list_curve_edges(draft.network, vertices, surface));
  surface->counts.patches = draft.network.patches();
  surface->counts.free_vertices = patches.vertices - patches.curve_vertices;
  TRY(assign_in_parts(patches.vertices, Vec3{}, &surface->position));
  TRY(assign_in_parts(patches.vertices, Vec3{}, &surface->constraint_normal));
  TRY(assign_in_parts(patches.vertices, k_none, &surface->vertex_curve));
  TRY(in_parts(draft.context(), vertices.position.size(), [&](size_t v) {
    surface->position[v] = vertices.position[v];
    surface->constraint_normal[v] = vertices.normal[v];
    surface->vertex_curve[v] = vertices.curve[v];
  }));
  TRY(copy_in_parts(patches.triangle, &surface->triangle));
  return copy_in_parts(patches.patch, &surface->patch);
}

static Status smooth_draft(const CurveSet& set, smooth::Method method, Draft* draft,
                           Surface* surface) {
  Context& context = draft->context();
  network::PatchMesh& patches = draft->patches;
  mesh::Topology topology(context);
  Constraints constraints(context);
  Array<uint32_t> inner_edge(context);
  TRY(in_terms_of_nodes(
      count_topology(patches.vertices, surface->triangle.span(), &topology, &surface->counts),
      draft->nodes.span()));
  TRY(verify_surface(context, draft->network, patches.start.span(), *surface));
  TRY(list_inner_edges(draft->network, draft->vertices, &inner_edge));
  TRY(constrain_curves(set, patches.curve_vertices, *surface, &constraints));
  const Start start = {patches.shape.span(), smooth::Metric::planes, topology.on_border.span(),
                       patches.start.span(), patches.placed.span(),  inner_edge.span(),
                       &patches.shape};
  if (network::has_creases(draft->vertices)) {
    network::CreasedMesh creased(context);
    TRY(network::cut_along_creases(draft->network, draft->vertices, set.sharp, draft->nodes.span(),
                                   patches, surface->position.span(), &creased));
    TRY(smooth_creased(context, start, constraints, method, &creased, surface));
  } else {
    patches.triangle.free();  // the surface has its own
    patches.patch.free();
    TRY(smooth_surface(context, start, constraints, method, surface));
  }
  return verify_surface(context, draft->network, surface->position.span(), *surface);
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

// Gives patches the numbers that they had before some were left out.
static Status number_as_found(Span<const uint32_t> original, Surface* surface) {
  Counts* counts = &surface->counts;
  if (original.empty()) return {};
  TRY(in_parts(surface->patch.context(), surface->patch.size(),
               [&](size_t t) { surface->patch[t] = original[surface->patch[t]]; }));
  counts->patches += counts->failed_patches;
  uint32_t& inverted = counts->first_inverted_patch;
  if (inverted != k_none) inverted = original[inverted];
  return renumber_guarded(original, counts->patches, &surface->patch_guarded);
}

Status surface_curves(Context& context, const CurveSet& set, const Settings& settings,
                      Surface* surface) {
  Draft draft(context);
  TRY(fit(set, settings, &draft, &surface->counts));
  TRY(find_network(set, settings, &draft, &surface->counts));
  TRY(make_patches(settings, &draft, surface));
  TRY(take_mesh(draft, surface));
  TRY(smooth_draft(set, settings.method, &draft, surface));
  TRY(number_as_found(draft.original.span(), surface));
  return measure_constraints(set, draft.given.span(), surface);
}

}  // namespace wireskin
