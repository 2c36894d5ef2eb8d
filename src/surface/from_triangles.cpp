#include "surface/from_triangles.h"

#include "base/in_parts.h"
#include "surface/finish.h"
#include "surface/fit.h"
#include "surface/spoilt.h"
#include "surface/verify.h"

namespace wireskin {

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

// A caller's mesh has no parts that could go back, so if a component is spoilt, that is a failure.
static Status check_not_spoilt(Context& context, const TriangleSet& set,
                               const mesh::Topology& topology, Surface* surface) {
  Spoilt spoilt(context);
  Array<uint32_t> component(context);
  TRY(component.resize(set.triangle.size() / 3));
  TRY(in_parts(context, component.size(),
               [&](size_t t) { component[t] = topology.component[set.triangle[3 * t]]; }));
  const SmoothedMesh mesh = {surface->position.span(), surface->triangle.span(), component.span(),
                             set.position, set.triangle};
  TRY(find_spoilt(context, mesh, topology.components, &spoilt));
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
  TRY(check_not_spoilt(context, set, topology, surface));
  return verify_triangles(context, set, *surface);
}

}  // namespace wireskin
