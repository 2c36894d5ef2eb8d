#include "surface.h"

#include "curves/sides.h"
#include "mesh/curvature.h"
#include "network/crease.h"
#include "network/node_normals.h"
#include "network/patch_mesh.h"
#include "smooth/fair.h"

namespace wireskin {

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

// Checks every curve, unites the samples of each node and fits the splines.
static Status fit_curves(Context& context, const CurveSet& set, double size,
                         Array<network::Node>* nodes, curves::Curves* fitted, Counts* counts) {
  constexpr double k_node_tolerance = 1e-9;
  Array<uint32_t> node(context);
  counts->curves = static_cast<uint32_t>(set.closed.size());
  for (uint32_t c = 0; c < counts->curves; ++c) {
    TRY(at_curve(curves::check_samples(samples_of(set, {}, c)), c));
  }
  const network::SampleNumbers samples = {set.start,  set.number, set.position,
                                          set.normal, set.sharp,  set.right};
  TRY(network::find_nodes(samples, k_node_tolerance * size, nodes, &node));
  counts->nodes = static_cast<uint32_t>(nodes->size());
  for (size_t i = 0; i < node.size(); ++i) {
    if (node[i] == k_none) continue;
    set.position[i] = (*nodes)[node[i]].position;
    if (!(*nodes)[node[i]].crease) set.normal[i] = (*nodes)[node[i]].normal;
  }
  for (uint32_t c = 0; c < counts->curves; ++c) {
    // Neighbours that differed by less than the tolerance may have become one point.
    TRY(at_curve(curves::check_samples(samples_of(set, {}, c)), c));
    TRY(at_curve(curves::add_curve(samples_of(set, node.span(), c), fitted), c));
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

// Normals, curvature and the least angle of the finished mesh.
static Status measure(Context& context, Span<const uint8_t> on_border, Surface* surface) {
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
  surface->counts.least_angle =
      mesh::least_angle(surface->position.span(), surface->triangle.span());
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

namespace {

// What the methods work on: the mesh itself, or the one cut open along its creases.
struct Workpiece {
  Span<Vec3> position, normal;
  Span<uint32_t> triangle;
  Span<const uint8_t> held, on_border, bare;
};

}  // namespace

static Status apply_method(Context& context, const network::PatchMesh& patches,
                           const Workpiece& piece, smooth::Method method, Surface* surface) {
  Counts* counts = &surface->counts;
  if (method != smooth::Method::iterated && method != smooth::Method::fair) {
    const smooth::Domain domain = {piece.triangle,  patches.shape.span(),   piece.held,
                                   piece.on_border, smooth::Metric::planes, piece.bare};
    return smooth::smooth(context, domain, method, {piece.position, piece.normal},
                          &counts->residual);
  }
  smooth::FairReport report;
  smooth::FairOptions options;
  if (method == smooth::Method::iterated) options.displacement_steps = 0;
  const smooth::FairMesh mesh = {piece.position,        piece.normal, piece.triangle,
                                 surface->patch.span(), piece.held,   piece.on_border,
                                 patches.shape.span(),  piece.bare};
  TRY(smooth::fair(context, mesh, counts->patches, options, &report));
  counts->factorisations = report.factorisations;
  counts->iterations = report.iterations;
  counts->residual = report.residual;
  counts->guarded = report.guarded_patches;
  counts->greatest_step = report.greatest_step;
  return {};
}

static Status smooth_patches(Context& context, const network::PatchMesh& patches,
                             smooth::Method method, const mesh::Topology& topology,
                             Surface* surface) {
  const uint32_t n = patches.vertices;
  Array<uint8_t> held(context);
  Array<Vec3> normal(context);
  TRY(held.resize(n));
  TRY(normal.copy(surface->constraint_normal.span()));
  for (uint32_t v = 0; v < n; ++v) held[v] = v < patches.curve_vertices;
  const Workpiece piece = {surface->position.span(),  normal.span(),
                           surface->triangle.span(),  held.span(),
                           topology.on_border.span(), {}};
  TRY(apply_method(context, patches, piece, method, surface));
  return measure(context, topology.on_border.span(), surface);
}

static Status smooth_creased(Context& context, const network::PatchMesh& patches,
                             smooth::Method method, const mesh::Topology& topology,
                             network::CreasedMesh* creased, Surface* surface) {
  const Workpiece piece = {creased->position.span(),     creased->normal.span(),
                           creased->cut.triangle.span(), creased->held.span(),
                           creased->on_border.span(),    creased->bare.span()};
  TRY(apply_method(context, patches, piece, method, surface));
  network::merge_creases(*creased, surface->position.span(), surface->triangle.span());
  TRY(measure(context, topology.on_border.span(), surface));
  return network::measure_sides(
      context, *creased,
      {surface->normal.span(), surface->mean_curvature.span(), surface->constraint_normal.span()});
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

Status surface_curves(Context& context, const CurveSet& set, smooth::Method method, double spacing,
                      Surface* surface) {
  Counts* counts = &surface->counts;
  curves::Curves fitted(context);
  Array<network::Node> nodes(context);
  network::Network network(context);
  network::CurveVertices vertices(context);
  network::PatchMesh patches(context);
  mesh::Topology topology(context);

  TRY(context.enter(Stage::curves));
  const double size = diagonal(set.position);
  counts->spacing = spacing > 0.0 ? spacing : size / 100.0;
  TRY(fit_curves(context, set, size, &nodes, &fitted, counts));

  TRY(context.enter(Stage::network));
  TRY(network::find_patches(fitted, set.boundary, nodes.span(), &network));
  counts->segments = static_cast<uint32_t>(network.segment.size());
  counts->patches = network.patches();
  TRY(network::resample(fitted, nodes.span(), network, counts->spacing, &vertices));
  TRY(list_curve_edges(network, vertices, surface));

  TRY(context.enter(Stage::patches));
  TRY(network::mesh_patches(network, vertices, &patches));
  counts->free_vertices = patches.vertices - patches.curve_vertices;
  TRY(take_vertices(vertices, patches, surface));
  TRY(in_terms_of_nodes(
      count_topology(patches.vertices, patches.triangle.span(), &topology, counts), nodes.span()));
  if (!network::has_creases(vertices))
    return smooth_patches(context, patches, method, topology, surface);
  network::CreasedMesh creased(context);
  TRY(network::cut_along_creases(network, vertices, set.sharp, nodes.span(), patches,
                                 surface->position.span(), &creased));
  return smooth_creased(context, patches, method, topology, &creased, surface);
}

// Every component and every border must be held, or the surface would be free to float away.
static Status check_held(const TriangleSet& set, const mesh::Topology& topology) {
  Array<uint8_t> anchored(topology.component.context());
  TRY(anchored.assign(topology.components, 0));
  for (uint32_t v = 0; v < set.held.size(); ++v) {
    if (set.held[v]) anchored[topology.component[v]] = 1;
  }
  for (uint32_t v = 0; v < set.held.size(); ++v) {
    Place place;
    place.vertex = v;
    if (topology.on_border[v] && !set.held[v]) {
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
    if (!set.held[v]) continue;
    surface->vertex_curve[v] = 0;
    if (!set.normal.empty()) surface->constraint_normal[v] = set.normal[v];
  }
  return {};
}

Status surface_triangles(Context& context, const TriangleSet& set, smooth::Method method,
                         Surface* surface) {
  Counts* counts = &surface->counts;
  mesh::Topology topology(context);
  Array<mesh::TriangleShape> shapes(context);
  Array<Vec3> normal(context);
  const uint32_t n = static_cast<uint32_t>(set.position.size());

  TRY(context.enter(Stage::patches));
  TRY(count_topology(n, set.triangle, &topology, counts));
  TRY(mesh::check_areas(set.position, set.triangle));
  TRY(check_held(set, topology));
  counts->patches = 1;
  for (uint8_t held : set.held) counts->free_vertices += held == 0;
  counts->spacing = mean_edge_length(set.position, set.triangle);
  TRY(take_triangles(set, surface));
  TRY(normal.copy(surface->constraint_normal.span()));
  TRY(mesh::triangle_shapes(set.position, set.triangle, &shapes));

  const smooth::Domain domain = {set.triangle, shapes.span(), set.held, topology.on_border.span(),
                                 smooth::Metric::space};
  if (method == smooth::Method::iterated || method == smooth::Method::fair) {
    smooth::FairReport report;
    smooth::FairOptions options;
    if (method == smooth::Method::iterated) options.displacement_steps = 0;
    const smooth::FairMesh mesh = {surface->position.span(),
                                   normal.span(),
                                   surface->triangle.span(),
                                   surface->patch.span(),
                                   set.held,
                                   topology.on_border.span(),
                                   {}};
    TRY(smooth::fair(context, mesh, 1, options, &report));
    counts->residual = report.residual;
    counts->factorisations = report.factorisations;
    counts->iterations = report.iterations;
    return measure(context, topology.on_border.span(), surface);
  }
  TRY(smooth::smooth(context, domain, method, {surface->position.span(), normal.span()},
                     &counts->residual));
  return measure(context, topology.on_border.span(), surface);
}

}  // namespace wireskin
