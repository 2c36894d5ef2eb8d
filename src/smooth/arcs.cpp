#include "smooth/arcs.h"

#include "base/in_parts.h"
#include "mesh/mesh.h"

namespace wireskin::smooth {

// Curves that turn by more at a vertex (cosine of 45 degrees) have a node there.
static constexpr double k_straight = 0.7;

namespace {

// The neighbours of v along curves: neighbour[start[v] .. start[v + 1]).
struct CurveGraph {
  Array<uint32_t> start, neighbour;
  Array<uint8_t> is_node;

  explicit CurveGraph(Context& context) : start(context), neighbour(context), is_node(context) {}
  // Where one comes out who enters an ordinary vertex from `before`.
  uint32_t after(uint32_t before, uint32_t here) const {
    const uint32_t* next = &neighbour[start[here]];
    return next[0] == before ? next[1] : next[0];
  }
};

}  // namespace

// Two vertices for each curve edge.
static Status list_given_edges(Context& context, const GivenCurves& curves,
                               Array<uint32_t>* edges) {
  constexpr uint32_t k_edges_per_checkpoint = 1u << 14;
  Array<uint32_t> twins(context);
  TRY(mesh::find_twins(static_cast<uint32_t>(curves.position.size()), curves.triangle, &twins));
  for (uint32_t h = 0; h < twins.size(); ++h) {
    if ((h + 1) % k_edges_per_checkpoint == 0) TRY(context.checkpoint());
    const uint32_t g = twins[h];
    if (g != k_none && (g < h || curves.patch[g / 3] == curves.patch[h / 3])) continue;
    const uint32_t a = curves.triangle[h], b = curves.triangle[mesh::next_half_edge(h)];
    if (!curves.given[a] || !curves.given[b]) continue;
    TRY(edges->push(a));
    TRY(edges->push(b));
  }
  return {};
}

static bool runs_through(Span<const Vec3> position, const CurveGraph& graph, uint32_t v) {
  if (graph.start[v + 1] - graph.start[v] != 2) return false;
  const uint32_t* next = &graph.neighbour[graph.start[v]];
  const Vec3 a = unit(position[next[0]] - position[v]);
  const Vec3 b = unit(position[next[1]] - position[v]);
  return dot(a, b) < -k_straight;
}

static Status find_curve_graph(Context& context, const GivenCurves& curves, CurveGraph* graph) {
  const uint32_t n = static_cast<uint32_t>(curves.position.size());
  Array<uint32_t> edges(context), filled(context);
  TRY(list_given_edges(context, curves, &edges));
  TRY(assign_in_parts(size_t{n} + 1, 0, &graph->start));
  TRY(graph->neighbour.resize(edges.size()));
  TRY(graph->is_node.assign(n, 0));
  TRY(filled.assign(n, 0));
  for (uint32_t v : edges) ++graph->start[v + 1];
  TRY(in_parts(context, n, [&](size_t v) { graph->start[v + 1] += graph->start[v]; }));
  TRY(in_parts(context, edges.size(), [&](size_t e) {
    const uint32_t v = edges[e];
    graph->neighbour[graph->start[v] + filled[v]++] = edges[e ^ 1];
  }));
  return in_parts(context, n, [&](size_t v) {
    graph->is_node[v] =
        filled[v] > 0 && !runs_through(curves.position, *graph, static_cast<uint32_t>(v));
  });
}

Status find_arcs(Context& context, const GivenCurves& curves, uint32_t least_edges, Arcs* arcs) {
  CurveGraph graph(context);
  TRY(find_curve_graph(context, curves, &graph));
  TRY(arcs->start.push(0));
  for (uint32_t node = 0; node < graph.is_node.size(); ++node) {
    if (!graph.is_node[node]) continue;
    for (uint32_t k = graph.start[node]; k < graph.start[node + 1]; ++k) {
      const size_t first = arcs->vertex.size();
      uint32_t before = node, here = graph.neighbour[k];
      TRY(arcs->vertex.push(node));
      while (!graph.is_node[here]) {
        TRY(arcs->vertex.push(here));
        const uint32_t ahead = graph.after(before, here);
        before = here;
        here = ahead;
      }
      TRY(arcs->vertex.push(here));
      // An arc is met from both its ends, a loop twice from its one.
      const bool met_first = node < here || (node == here && arcs->vertex[first + 1] < before);
      if (met_first && arcs->vertex.size() - first > least_edges) {
        TRY(arcs->start.push(static_cast<uint32_t>(arcs->vertex.size())));
      } else {
        arcs->vertex.shrink(first);
      }
    }
    TRY(context.checkpoint());
  }
  return {};
}

}  // namespace wireskin::smooth
