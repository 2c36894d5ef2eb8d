#include "flow/flow.h"

#include "base/in_parts.h"
#include "flow/bend_arcs.h"
#include "num/minmax.h"

namespace wireskin::flow {

// So many samples have more tetrahedra than they are; known before any is made.
static Status check_sample_count(const Arcs& arcs, double step, uint32_t most_tets) {
  double samples = 0.0;
  for (uint32_t a = 0; a < arcs.size(); ++a) samples += arcs.length_of(a) / step;
  if (samples < most_tets) return {};
  return fail(Code::too_large, "the step is too small for the curves");
}

Status build_flow(Context& context, const Polylines& polylines, const FlowOptions& options,
                  Flow* flow) {
  TRY(context.enter(Stage::curves));
  TRY(find_arcs(context, polylines, &flow->arcs));
  flow->step = options.sampling;
  if (!(flow->step > 0.0)) flow->step = k_default_sampling * flow->arcs.diagonal;
  if (!(options.sampling > 0.0) && options.spacing > 0.0) {
    flow->step = smaller(flow->step, options.spacing);
  }
  TRY(check_sample_count(flow->arcs, flow->step, options.complex.most_tets));
  if (options.bend) TRY(bend_arcs(context, flow->step, &flow->arcs));
  TRY(sample_arcs(context, flow->arcs, flow->step, &flow->samples));
  TRY(find_tangents(flow->samples, &flow->tangents));
  TRY(context.enter(Stage::network));
  TRY(build_complex(context, flow->samples.position.span(), options.complex, &flow->complex));
  TRY(find_curve_edges(flow->complex, flow->samples, &flow->curves));
  StraightLines lines(context);
  FlatFaces faces(context);
  TRY(find_straight_lines(flow->complex, flow->samples, &lines));
  const Drawing drawing = {flow->complex, flow->samples, flow->curves, lines};
  TRY(find_flat_faces(context, drawing, options.noise, &faces));
  TRY(find_flat_cells(context, drawing, faces, options.lids, &flow->cells));
  return find_persistence(context, flow->complex, &flow->persistence, flow->cells.turn.span());
}

// Components of walls and curves, counted over all samples.
static Status count_components(Context& context, const Flow& flow, const Sheet& walls,
                               uint32_t* components, int64_t* euler) {
  const Complex& complex = flow.complex;
  Array<uint32_t> parent(context);
  TRY(parent.resize(complex.point.size()));
  int64_t vertices = 0, edges = 0, triangles = 0;
  for (uint32_t v = 0; v < parent.size(); ++v) {
    parent[v] = complex.same_as[v];
    if (parent[v] == v) ++vertices;
  }
  const auto root_of = [&](uint32_t v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  *components = static_cast<uint32_t>(vertices);
  TRY(in_parts(context, complex.edge_count(), [&](size_t e) {
    if (walls.degree[e] == 0 && !flow.curves.on_curve(static_cast<uint32_t>(e))) return;
    ++edges;
    const uint32_t a = root_of(complex.edge[2 * e]);
    const uint32_t b = root_of(complex.edge[2 * e + 1]);
    if (a == b) return;
    parent[a < b ? b : a] = a < b ? a : b;
    --*components;
  }));
  for (const uint8_t in : walls.in) triangles += in;
  *euler = vertices - edges + triangles;
  return {};
}

static Status count_reconstruction(Context& context, const Flow& flow, Reconstruction* result) {
  const Sheet& walls = result->topology.walls;
  Array<uint32_t> label(context);
  int64_t euler = 0;
  TRY(count_components(context, flow, walls, &result->betti[0], &euler));
  TRY(label_rooms(flow.complex, walls, &label));
  uint32_t rooms = 0;
  for (uint32_t i = 0; i < label.size(); ++i) rooms += label[i] == i;
  result->betti[2] = rooms - 1;
  const int64_t loops = int64_t{result->betti[0]} + int64_t{result->betti[2]} - euler;
  result->betti[1] = static_cast<uint32_t>(loops);
  for (uint32_t i = 0; i < flow.curves.edge_of.size(); ++i) {
    const uint32_t e = flow.curves.edge_of[i];
    if (e != k_none && walls.degree[e] == 0) TRY(result->bare.push(i));
  }
  for (const uint32_t degree : walls.degree) result->crowded_edges += degree > 2;
  const FlatCells& cells = flow.cells;
  for (size_t l = 0; l + 1 < cells.lid_start.size(); ++l) {
    bool closed = false;
    for (uint32_t i = cells.lid_start[l]; i < cells.lid_start[l + 1]; ++i) {
      closed = closed || walls.in[cells.lid_middle[i]] != 0;
    }
    result->open_lids += !closed;
  }
  for (const PatchFacts& p : result->patches.facts) result->open_patches += p.open;
  return {};
}

Status reconstruct(Context& context, const Flow& flow, const ReconstructionOptions& options,
                   Reconstruction* result) {
  TRY(context.enter(Stage::patches));
  TRY(reconstruct_topology(context, flow.complex, flow.curves, flow.cells, flow.persistence,
                           options.topology, &result->topology));
  TRY(thicken_and_prune(context, flow.complex, flow.curves, flow.cells, flow.persistence,
                        flow.tangents, options.thicken, &result->topology));
  TRY(cut_patches(context, flow.complex, flow.curves, flow.samples, flow.cells, flow.persistence,
                  result->topology, &result->patches));
  return count_reconstruction(context, flow, result);
}

}  // namespace wireskin::flow
