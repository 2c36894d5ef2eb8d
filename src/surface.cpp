#include "surface.h"

#include "curves/distance.h"
#include "curves/sides.h"
#include "mesh/curvature.h"
#include "network/crease.h"
#include "network/node_normals.h"
#include "network/patch_mesh.h"
#include "smooth/fair.h"

namespace wireskin {

// A plane that sees a patch more steeply than this on the whole distorts the mesh; the methods that
// leave the planes behind then start better from a triangulation in space.
static constexpr double k_least_facing = 0.25;

static double diagonal(Span<const Vec3> points) {
  Vec3 low = points[0], high = points[0];
  for (const Vec3& p : points) {
    low = {p.x < low.x ? p.x : low.x, p.y < low.y ? p.y : low.y, p.z < low.z ? p.z : low.z};
    high = {p.x > high.x ? p.x : high.x, p.y > high.y ? p.y : high.y, p.z > high.z ? p.z : high.z};
  }
  return length(high - low);
}

static curves::Samples samples_of(const CurveSet& set, Span<const uint32_t> node, uint32_t curve) {
  const size_t first = set.start[curve], count = set.start[curve + 1] - first;
  return {set.position.part(first, count), set.normal.part(first, count),
          node.empty() ? node : node.part(first, count), set.closed[curve] != 0};
}

// The same with the normals on the right of a sharp curve.
static curves::Samples right_samples_of(const CurveSet& set, uint32_t curve) {
  curves::Samples samples = samples_of(set, {}, curve);
  samples.normal = set.right.part(set.start[curve], samples.position.size());
  return samples;
}

static Status at_curve(Status status, uint32_t curve) {
  if (!status.ok()) status.place.curve = curve;
  return status;
}

// What sharp curves need besides: the normals on their right, and those of their nodes.
static Status fit_sides(const CurveSet& set, Span<network::Node> nodes, curves::Curves* fitted) {
  for (uint32_t c = 0; c < set.sharp.size(); ++c) {
    if (set.sharp[c]) TRY(at_curve(curves::check_samples(right_samples_of(set, c)), c));
  }
  TRY(curves::fit_right_normals({set.start, set.right, set.sharp}, fitted));
  return network::complete_node_normals(*fitted, nodes);
}

// Gives the samples of every node its position and normal; at creases curves keep their own.
static void unite_nodes(const CurveSet& set, Span<const uint32_t> node,
                        Span<const network::Node> nodes) {
  for (size_t i = 0; i < node.size(); ++i) {
    if (node[i] == k_none) continue;
    set.position[i] = nodes[node[i]].position;
    if (!nodes[node[i]].crease) set.normal[i] = nodes[node[i]].normal;
  }
}

// Thins all curves, takes the noise out of what is kept, and lets nodes move with their curves.
static Status smooth_curves(Context& context, const CurveSet& set, Span<const uint32_t> node,
                            const network::SmoothingOptions& options, Span<network::Node> nodes,
                            Array<uint32_t>* kept_start, Array<uint32_t>* kept, Counts* counts) {
  Array<uint32_t> thinned(context);
  TRY(kept_start->push(0));
  for (uint32_t c = 0; c < counts->curves; ++c) {
    // Neighbours that differed by less than the tolerance may have become one point.
    TRY(at_curve(curves::check_samples(samples_of(set, {}, c)), c));
    TRY(at_curve(curves::thin(samples_of(set, node, c), &thinned), c));
    for (uint32_t i : thinned) TRY(kept->push(i));
    TRY(kept_start->push(static_cast<uint32_t>(kept->size())));
  }
  if (options.noise == network::Noise::none) return {};
  // Where curves are sharp a node has no one normal, so normals stay as they are; the constant
  // field in their place has no noise.
  Array<Vec3> constant(context);
  const bool creased = !set.sharp.empty();
  if (creased) TRY(constant.assign(set.normal.size(), Vec3{0, 0, 1}));
  const Span<Vec3> normals = creased ? constant.span() : set.normal;
  TRY(network::smooth_samples(
      context,
      {set.start, kept_start->span(), kept->span(), node, {}, set.closed, set.position, normals},
      options, &counts->noise));
  for (size_t i = 0; i < node.size(); ++i) {
    if (node[i] == k_none) continue;
    nodes[node[i]].position = set.position[i];
    if (!creased) nodes[node[i]].normal = set.normal[i];
  }
  return {};
}

// Checks every curve, unites the samples of each node, smooths and fits the splines.
static Status fit_curves(Context& context, const CurveSet& set, double size,
                         const network::SmoothingOptions& smoothing, Array<network::Node>* nodes,
                         curves::Curves* fitted, Counts* counts) {
  constexpr double k_node_tolerance = 1e-9;
  Array<uint32_t> node(context), kept_start(context), kept(context);
  counts->curves = static_cast<uint32_t>(set.closed.size());
  for (uint32_t c = 0; c < counts->curves; ++c) {
    TRY(at_curve(curves::check_samples(samples_of(set, {}, c)), c));
  }
  const network::SampleNumbers samples = {set.start,  set.number, set.position,
                                          set.normal, set.sharp,  set.right};
  TRY(network::find_nodes(samples, k_node_tolerance * size, nodes, &node));
  counts->nodes = static_cast<uint32_t>(nodes->size());
  unite_nodes(set, node.span(), nodes->span());
  TRY(smooth_curves(context, set, node.span(), smoothing, nodes->span(), &kept_start, &kept,
                    counts));
  for (uint32_t c = 0; c < counts->curves; ++c) {
    const Span<const uint32_t> own =
        kept.span().part(kept_start[c], kept_start[c + 1] - kept_start[c]);
    TRY(at_curve(curves::fit_curve(samples_of(set, node.span(), c), own, fitted), c));
    TRY(context.progress(static_cast<double>(c + 1) / counts->curves));
  }
  return set.sharp.empty() ? Status{} : fit_sides(set, nodes->span(), fitted);
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

// Neighbours, the check of the mesh, and the counts that follow from them.
static Status count_topology(uint32_t vertices, Span<const uint32_t> triangles,
                             mesh::Topology* topology, Counts* counts) {
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

// Normals, curvatures and the figures of the report, of the finished mesh.
static Status measure(Context& context, Span<const uint8_t> on_border, Span<const uint8_t> on_curve,
                      Surface* surface) {
  TRY(context.enter(Stage::result));
  for (const Vec3& p : surface->position) {
    if (p.x - p.x == 0.0 && p.y - p.y == 0.0 && p.z - p.z == 0.0) continue;
    return fail(Code::not_positive_definite, "the solution of the linear system is not finite");
  }
  TRY(surface->normal.resize(surface->position.size()));
  mesh::vertex_normals(surface->position.span(), surface->triangle.span(), surface->normal.span());
  TRY(context.progress(0.3));
  TRY(mesh::mean_curvature(surface->position.span(), surface->normal.span(),
                           surface->triangle.span(), on_border, &surface->mean_curvature));
  TRY(mesh::gaussian_curvature(surface->position.span(), surface->triangle.span(), on_border,
                               &surface->gaussian_curvature));
  TRY(context.progress(0.6));
  Counts* counts = &surface->counts;
  counts->least_angle = mesh::least_angle(surface->position.span(), surface->triangle.span());
  counts->normal_deviation =
      mesh::deviation(surface->normal.span(), surface->constraint_normal.span());
  TRY(mesh::dihedral_angles(context, surface->position.span(), surface->triangle.span(),
                            surface->patch.span(), on_curve, &counts->dihedral));
  return context.progress(0.8);
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

// Half the length of the curve edges at each vertex: how much of its curve a vertex stands for.
static Status curve_shares(const Surface& surface, Array<double>* share) {
  TRY(share->assign(surface.position.size(), 0.0));
  for (size_t e = 0; e < surface.curve_edge.size(); e += 2) {
    const uint32_t a = surface.curve_edge[e], b = surface.curve_edge[e + 1];
    const double half = 0.5 * length(surface.position[b] - surface.position[a]);
    (*share)[a] += half;
    (*share)[b] += half;
  }
  return {};
}

namespace {

// What smoothing needs beside the surface itself.
struct Constraints {
  Array<uint8_t> on_curve, held;
  Array<double> cutoff, share;  // empty: nothing is soft

  explicit Constraints(Context& context)
      : on_curve(context), held(context), cutoff(context), share(context) {}
};

struct Start {
  Span<const mesh::TriangleShape> shape;
  smooth::Metric metric;
  Span<const uint8_t> on_border;
};

}  // namespace

namespace {

// What the methods work on: the mesh itself, or the one cut open along its creases.
struct Workpiece {
  Span<Vec3> position, normal;
  Span<uint32_t> triangle;
  Span<const uint8_t> on_curve, held, on_border, bare;
  smooth::Soft soft;
};

}  // namespace

static Status apply_method(Context& context, const Start& start, const Workpiece& piece,
                           smooth::Method method, Surface* surface) {
  Counts* counts = &surface->counts;
  if (method != smooth::Method::iterated && method != smooth::Method::fair) {
    const smooth::Domain domain = {piece.triangle,  start.shape,  piece.on_curve, piece.held,
                                   piece.on_border, start.metric, piece.soft,     piece.bare};
    return smooth::smooth(context, domain, method, {piece.position, piece.normal},
                          &counts->residual);
  }
  smooth::FairReport report;
  smooth::FairOptions options;
  if (method == smooth::Method::iterated) options.displacement_steps = 0;
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
                                 piece.bare};
  TRY(smooth::fair(context, mesh, counts->patches, options, &report));
  counts->residual = report.residual;
  counts->guarded_patches = report.guarded_patches;
  counts->iterations = report.iterations;
  return {};
}

// Smooths the surface by the chosen method and measures the result.
static Status smooth_surface(Context& context, const Start& start, const Constraints& constraints,
                             smooth::Method method, Surface* surface) {
  Array<Vec3> normal(context), anchor(context);
  TRY(normal.copy(surface->constraint_normal.span()));
  if (!constraints.cutoff.empty()) TRY(anchor.copy(surface->position.span()));
  const Workpiece piece = {surface->position.span(),
                           normal.span(),
                           surface->triangle.span(),
                           constraints.on_curve.span(),
                           constraints.held.span(),
                           start.on_border,
                           {},
                           {constraints.cutoff.span(), constraints.share.span(), anchor.span(),
                            surface->constraint_normal.span(), surface->counts.spacing}};
  TRY(apply_method(context, start, piece, method, surface));
  return measure(context, start.on_border, constraints.on_curve.span(), surface);
}

// The same on the mesh cut open along the creases.
static Status smooth_creased(Context& context, const Start& start, const Constraints& constraints,
                             smooth::Method method, network::CreasedMesh* creased,
                             Surface* surface) {
  const size_t copies = creased->position.size();
  Array<Vec3> anchor(context), given_normal(context);
  Array<double> cutoff(context), share(context);
  Array<uint8_t> on_curve(context), held(context);
  TRY(on_curve.resize(copies));
  TRY(held.resize(copies));
  if (!constraints.cutoff.empty()) {
    TRY(cutoff.resize(copies));
    TRY(share.resize(copies));
    TRY(anchor.copy(creased->position.span()));
    TRY(given_normal.copy(creased->normal.span()));
  }
  for (size_t c = 0; c < copies; ++c) {
    const uint32_t v = creased->cut.origin[c];
    on_curve[c] = constraints.on_curve[v];
    held[c] = constraints.held[v];
    if (cutoff.empty()) continue;
    cutoff[c] = constraints.cutoff[v];
    share[c] = constraints.share[v];
  }
  const Workpiece piece = {
      creased->position.span(),
      creased->normal.span(),
      creased->cut.triangle.span(),
      on_curve.span(),
      held.span(),
      creased->on_border.span(),
      creased->bare.span(),
      {cutoff.span(), share.span(), anchor.span(), given_normal.span(), surface->counts.spacing}};
  TRY(apply_method(context, start, piece, method, surface));
  network::merge_creases(*creased, surface->position.span(), surface->triangle.span());
  TRY(measure(context, start.on_border, on_curve.span().part(0, surface->position.size()),
              surface));
  return network::measure_sides(
      context, *creased, surface->patch.span(),
      {surface->normal.span(), surface->mean_curvature.span(), surface->constraint_normal.span(),
       &surface->counts.normal_deviation, &surface->counts.dihedral});
}

// Curve vertices hold, or pull where their curve is soft; where curves meet, one that holds wins,
// else the shortest cutoff.
static Status constrain_curves(const CurveSet& set, uint32_t curve_vertices, const Surface& surface,
                               Constraints* constraints) {
  const size_t n = surface.position.size();
  TRY(constraints->on_curve.resize(n));
  TRY(constraints->held.resize(n));
  bool any = false;
  for (double cutoff : set.soft) any = any || cutoff > 0.0;
  for (size_t v = 0; v < n; ++v) {
    constraints->on_curve[v] = constraints->held[v] = v < curve_vertices;
  }
  if (!any) return {};
  TRY(curve_shares(surface, &constraints->share));
  TRY(constraints->cutoff.assign(n, -1.0));
  for (size_t e = 0; e < surface.curve_edge.size(); ++e) {
    double& cutoff = constraints->cutoff[surface.curve_edge[e]];
    const uint32_t curve = surface.curve_edge_curve[e / 2];
    const bool sharp = !set.sharp.empty() && set.sharp[curve];  // these hold in any case
    const double own = sharp ? 0.0 : set.soft[curve];
    if (cutoff < 0.0 || own < cutoff) cutoff = own;
  }
  for (size_t v = 0; v < n; ++v) {
    if (constraints->cutoff[v] < 0.0) constraints->cutoff[v] = 0.0;
    if (constraints->cutoff[v] > 0.0) constraints->held[v] = 0;
  }
  return {};
}

// How far the caller's samples lie from the curves of the result.
static Status measure_constraints(const CurveSet& set, Span<const Vec3> given, Surface* surface) {
  Context& context = surface->position.context();
  Array<Vec3> line(context);
  double sum = 0.0;
  size_t edge = 0;
  for (uint32_t c = 0; c < set.closed.size(); ++c) {
    line.clear();
    for (; edge < surface->curve_edge_curve.size() && surface->curve_edge_curve[edge] == c;
         ++edge) {
      if (line.empty()) TRY(line.push(surface->position[surface->curve_edge[2 * edge]]));
      TRY(line.push(surface->position[surface->curve_edge[2 * edge + 1]]));
    }
    const size_t first = set.start[c], count = set.start[c + 1] - first;
    const curves::LineDistance distance =
        curves::distance_to_line(given.part(first, count), line.span(), set.closed[c] != 0);
    sum += distance.sum_of_squares;
    if (distance.greatest > surface->counts.greatest_distance) {
      surface->counts.greatest_distance = distance.greatest;
    }
  }
  surface->counts.mean_square_distance = sum / static_cast<double>(given.size());
  return {};
}

// Makes room for the free vertices behind those of the curves.
static Status take_vertices(const network::CurveVertices& vertices,
                            const network::PatchMesh& patches, Surface* surface) {
  const size_t given = vertices.position.size();
  TRY(surface->position.assign(patches.vertices, Vec3{}));
  TRY(surface->constraint_normal.assign(patches.vertices, Vec3{}));
  TRY(surface->vertex_curve.assign(patches.vertices, k_none));
  for (size_t v = 0; v < given; ++v) {
    surface->position[v] = vertices.position[v];
    surface->constraint_normal[v] = vertices.normal[v];
    surface->vertex_curve[v] = vertices.curve[v];
  }
  TRY(surface->triangle.copy(patches.triangle.span()));
  return surface->patch.copy(patches.patch.span());
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

  TRY(context.enter(Stage::curves));
  const double size = diagonal(set.position);
  counts->spacing = settings.spacing > 0.0 ? settings.spacing : size / 100.0;
  TRY(given.copy(set.position));
  TRY(fit_curves(context, set, size, settings.smoothing, &nodes, &fitted, counts));

  TRY(context.enter(Stage::network));
  TRY(network::find_patches(fitted, set.boundary, nodes.span(), &network));
  counts->segments = static_cast<uint32_t>(network.segment.size());
  counts->patches = network.patches();
  TRY(network::resample(fitted, nodes.span(), network, counts->spacing, &vertices));
  TRY(list_curve_edges(network, vertices, surface));

  TRY(context.enter(Stage::patches));
  const bool in_space =
      settings.method == smooth::Method::iterated || settings.method == smooth::Method::fair;
  TRY(network::mesh_patches(network, vertices, in_space ? k_least_facing : -1.0, &patches));
  for (network::PatchWay way : patches.way) {
    counts->minimal_area_patches += way == network::PatchWay::minimal_area;
  }
  counts->free_vertices = patches.vertices - patches.curve_vertices;
  TRY(take_vertices(vertices, patches, surface));
  TRY(in_terms_of_nodes(
      count_topology(patches.vertices, surface->triangle.span(), &topology, counts), nodes.span()));

  TRY(constrain_curves(set, patches.curve_vertices, *surface, &constraints));
  const Start start = {patches.shape.span(), smooth::Metric::planes, topology.on_border.span()};
  if (network::has_creases(vertices)) {
    network::CreasedMesh creased(context);
    TRY(network::cut_along_creases(network, vertices, set.sharp, nodes.span(), patches,
                                   surface->position.span(), &creased));
    TRY(smooth_creased(context, start, constraints, settings.method, &creased, surface));
  } else {
    TRY(smooth_surface(context, start, constraints, settings.method, surface));
  }
  return measure_constraints(set, given.span(), surface);
}

// Every component and every border must be held, or the surface would be free to float away.
static Status check_held(const TriangleSet& set, const mesh::Topology& topology) {
  Array<uint8_t> anchored(topology.component.context());
  TRY(anchored.assign(topology.components, 0));
  for (uint32_t v = 0; v < set.constrained.size(); ++v) {
    if (set.constrained[v]) anchored[topology.component[v]] = 1;
  }
  for (uint32_t v = 0; v < set.constrained.size(); ++v) {
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

static double mean_edge_length(Span<const Vec3> positions, Span<const uint32_t> triangles) {
  double sum = 0.0;
  for (uint32_t h = 0; h < triangles.size(); ++h) {
    sum += length(positions[triangles[mesh::next_half_edge(h)]] - positions[triangles[h]]);
  }
  return sum / static_cast<double>(triangles.size());
}

static Status take_triangles(const TriangleSet& set, Surface* surface) {
  const size_t n = set.position.size();
  TRY(surface->position.copy(set.position));
  TRY(surface->triangle.copy(set.triangle));
  TRY(surface->patch.assign(set.triangle.size() / 3, 0));
  TRY(surface->constraint_normal.assign(n, Vec3{}));
  TRY(surface->vertex_curve.assign(n, k_none));
  for (size_t v = 0; v < n; ++v) {
    if (!set.constrained[v]) continue;
    surface->vertex_curve[v] = 0;
    if (!set.normal.empty()) surface->constraint_normal[v] = set.normal[v];
  }
  return {};
}

// As constrain_curves; where constrained vertices form no edges, a vertex stands for the mean
// length of its edges.
static Status constrain_vertices(const TriangleSet& set, Constraints* constraints) {
  const size_t n = set.position.size();
  const bool soft = set.soft > 0.0;
  TRY(constraints->on_curve.copy(set.constrained));
  TRY(constraints->held.assign(n, 0));
  for (size_t v = 0; v < n; ++v) constraints->held[v] = set.constrained[v] != 0 && !soft;
  if (!soft) return {};
  Context& context = constraints->share.context();
  Array<double> all(context);
  Array<uint32_t> count(context);
  TRY(constraints->cutoff.assign(n, 0.0));
  TRY(constraints->share.assign(n, 0.0));
  TRY(all.assign(n, 0.0));
  TRY(count.assign(n, 0));
  for (uint32_t h = 0; h < set.triangle.size(); ++h) {
    // Inner edges are met twice, those of a border once; a quarter and a half of a length is near
    // enough.
    const uint32_t a = set.triangle[h], b = set.triangle[mesh::next_half_edge(h)];
    const double edge = length(set.position[b] - set.position[a]);
    all[a] += edge;
    ++count[a];
    if (!set.constrained[a] || !set.constrained[b]) continue;
    constraints->share[a] += 0.5 * edge;
    constraints->share[b] += 0.5 * edge;
  }
  for (size_t v = 0; v < n; ++v) {
    if (!set.constrained[v]) continue;
    constraints->cutoff[v] = set.soft;
    if (constraints->share[v] == 0.0)
      constraints->share[v] = all[v] / static_cast<double>(count[v]);
  }
  return {};
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
  TRY(mesh::check_areas(set.position, set.triangle));
  TRY(check_held(set, topology));
  counts->patches = 1;
  for (uint8_t constrained : set.constrained) counts->free_vertices += constrained == 0;
  counts->spacing = mean_edge_length(set.position, set.triangle);
  TRY(take_triangles(set, surface));
  TRY(mesh::triangle_shapes(set.position, set.triangle, &shapes));
  TRY(constrain_vertices(set, &constraints));
  return smooth_surface(context, {shapes.span(), smooth::Metric::space, topology.on_border.span()},
                        constraints, settings.method, surface);
}

}  // namespace wireskin
