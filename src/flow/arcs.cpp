#include "flow/arcs.h"

#include "base/in_parts.h"
#include "base/sort_in_parts.h"
#include "flow/point_grid.h"
#include "num/minmax.h"

namespace wireskin::flow {

namespace {

struct ArcEdge {
  uint32_t a, b;  // a < b
  uint32_t curve;
};

// The segments as a graph: those at vertex v are edge_at[start[v] .. start[v + 1]).
struct ArcGraph {
  Array<ArcEdge> edge;
  Array<uint32_t> start, edge_at;
  Array<uint8_t> used;

  explicit ArcGraph(Context& context)
      : edge(context), start(context), edge_at(context), used(context) {}
  uint32_t degree(uint32_t v) const { return start[v + 1] - start[v]; }
  uint32_t other_end(uint32_t e, uint32_t v) const {
    return edge[e].a == v ? edge[e].b : edge[e].a;
  }
};

}  // namespace

static double diagonal_of(Span<const Vec3> points) {
  Vec3 low = points[0], high = points[0];
  for (const Vec3& p : points) {
    low = {smaller(low.x, p.x), smaller(low.y, p.y), smaller(low.z, p.z)};
    high = {larger(high.x, p.x), larger(high.y, p.y), larger(high.z, p.z)};
  }
  return length(high - low);
}

static uint32_t root_of(Span<uint32_t> parent, uint32_t i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

// The least index becomes the root, so that a point keeps the position of its first sample.
static void join_roots(Span<uint32_t> parent, uint32_t i, uint32_t j) {
  i = root_of(parent, i);
  j = root_of(parent, j);
  if (i < j) parent[j] = i;
  if (j < i) parent[i] = j;
}

// Samples of one number become one point, if they lie together.
static Status join_numbers(Context& context, const Polylines& curves, double tolerance,
                           Span<uint32_t> parent) {
  struct Numbered {
    uint32_t number, sample;
  };
  Array<Numbered> order(context);
  TRY(order.reserve(curves.number.size()));
  TRY(in_parts(context, curves.number.size(), [&](size_t s) {
    if (curves.number[s] != k_none) {
      order.push_reserved({curves.number[s], static_cast<uint32_t>(s)});
    }
  }));
  TRY(sort_in_parts(context, order.span(), [](const Numbered& a, const Numbered& b) {
    return a.number != b.number ? a.number < b.number : a.sample < b.sample;
  }));
  uint32_t first = 0;
  Pace pace(context);
  for (uint32_t i = 1; i < order.size(); ++i) {
    TRY(pace.after());
    if (order[i].number != order[first].number) {
      first = i;
      continue;
    }
    const uint32_t a = order[first].sample, b = order[i].sample;
    if (length(curves.position[a] - curves.position[b]) > tolerance) {
      Status status = fail(Code::node_mismatch, "samples of one node lie apart");
      status.place.node = order[i].number;
      return status;
    }
    join_roots(parent, a, b);
  }
  return {};
}

static Status join_coinciding(Context& context, Span<const Vec3> position, double tolerance,
                              Span<uint32_t> parent) {
  PointGrid grid(context);
  TRY(grid.build(position));
  for (uint32_t s = 0; s < position.size(); ++s) {
    if (s % 4096 == 0) TRY(context.checkpoint());
    if (root_of(parent, s) != s) continue;  // its root has looked round already
    grid.any_near(position[s], tolerance, [&](uint32_t other) {
      if (other > s && length(position[other] - position[s]) <= tolerance) {
        join_roots(parent, s, other);
      }
      return false;
    });
  }
  return {};
}

static Status find_vertices(Context& context, const Polylines& curves, Arcs* arcs) {
  const uint32_t n = static_cast<uint32_t>(curves.position.size());
  const double tolerance = k_coincidence * arcs->diagonal;
  Array<uint32_t> parent(context);
  TRY(parent.resize(n));
  TRY(arcs->sample_vertex.resize(n));
  TRY(arcs->vertex.reserve(n));
  TRY(in_parts(context, n, [&](size_t s) { parent[s] = static_cast<uint32_t>(s); }));
  TRY(join_numbers(context, curves, tolerance, parent.span()));
  TRY(join_coinciding(context, curves.position, tolerance, parent.span()));
  return in_parts(context, n, [&](size_t i) {
    const uint32_t s = static_cast<uint32_t>(i), root = root_of(parent.span(), s);
    if (root == s) {
      arcs->sample_vertex[s] = static_cast<uint32_t>(arcs->vertex.size());
      arcs->vertex.push_reserved(curves.position[s]);
    } else {
      arcs->sample_vertex[s] = arcs->sample_vertex[root];
    }
  });
}

// The segments, each once.
static Status gather_edges(const Polylines& curves, const Arcs& arcs, Array<ArcEdge>* edges) {
  Context& context = edges->context();
  Pace pace(context);
  TRY(edges->reserve(curves.position.size()));
  for (uint32_t c = 0; c + 1 < curves.start.size(); ++c) {
    const uint32_t first = curves.start[c], last = curves.start[c + 1];
    for (uint32_t s = first; s < last; ++s) {
      TRY(pace.after());
      if (s + 1 == last && curves.closed[c] == 0) break;
      const uint32_t a = arcs.sample_vertex[s];
      const uint32_t b = arcs.sample_vertex[s + 1 == last ? first : s + 1];
      if (a != b) edges->push_reserved({a < b ? a : b, a < b ? b : a, c});
    }
  }
  TRY(sort_in_parts(context, edges->span(), [](const ArcEdge& e, const ArcEdge& f) {
    if (e.a != f.a) return e.a < f.a;
    return e.b != f.b ? e.b < f.b : e.curve < f.curve;
  }));
  size_t kept = 0;
  TRY(in_parts(context, edges->size(), [&](size_t i) {
    const ArcEdge e = (*edges)[i];
    if (kept > 0 && (*edges)[kept - 1].a == e.a && (*edges)[kept - 1].b == e.b) return;
    (*edges)[kept++] = e;
  }));
  edges->shrink(kept);
  return {};
}

static Status link_edges(uint32_t vertices, ArcGraph* graph) {
  Context& context = graph->edge.context();
  TRY(assign_in_parts(size_t{vertices} + 1, 0, &graph->start));
  TRY(graph->edge_at.resize(2 * graph->edge.size()));
  TRY(assign_in_parts(graph->edge.size(), 0, &graph->used));
  TRY(in_parts(context, graph->edge.size(), [&](size_t e) {
    ++graph->start[graph->edge[e].a];
    ++graph->start[graph->edge[e].b];
  }));
  starts_from_counts(graph->start.span());
  TRY(in_parts(context, graph->edge.size(), [&](size_t i) {
    const uint32_t e = static_cast<uint32_t>(i);
    graph->edge_at[graph->start[graph->edge[e].a]++] = e;
    graph->edge_at[graph->start[graph->edge[e].b]++] = e;
  }));
  shift_starts_back(graph->start.span());
  return {};
}

static bool turns_sharply(const ArcGraph& graph, Span<const Vec3> vertex, uint32_t v) {
  const Vec3& p = vertex[v];
  const Vec3 a = vertex[graph.other_end(graph.edge_at[graph.start[v]], v)] - p;
  const Vec3 b = vertex[graph.other_end(graph.edge_at[graph.start[v] + 1], v)] - p;
  return dot(unit(a), unit(b)) > -k_cos_corner;
}

// Follows the polyline from v along edge e to the next node, or round to v itself.
static Status trace_arc(ArcGraph* graph, uint32_t v, uint32_t e, Pace* pace, Arcs* arcs) {
  const uint32_t first = v;
  double along = 0.0;
  do {
    TRY(pace->after());
    arcs->path.push_reserved(v);
    arcs->along.push_reserved(along);
    arcs->curve.push_reserved(graph->edge[e].curve);
    graph->used[e] = 1;
    const uint32_t next = graph->other_end(e, v);
    along += length(arcs->vertex[next] - arcs->vertex[v]);
    v = next;
    if (arcs->is_node[v] != 0 || v == first) break;
    const uint32_t* const at = &graph->edge_at[graph->start[v]];
    e = at[0] == e ? at[1] : at[0];
  } while (true);
  arcs->path.push_reserved(v);
  arcs->along.push_reserved(along);
  arcs->curve.push_reserved(arcs->curve.back());
  arcs->closed.push_reserved(arcs->is_node[first] == 0);
  arcs->start.push_reserved(static_cast<uint32_t>(arcs->path.size()));
  return {};
}

static Status trace_arcs(ArcGraph* graph, Arcs* arcs) {
  const size_t edges = graph->edge.size();
  const uint32_t vertices = static_cast<uint32_t>(arcs->vertex.size());
  TRY(arcs->path.reserve(2 * edges));
  TRY(arcs->along.reserve(2 * edges));
  TRY(arcs->curve.reserve(2 * edges));
  TRY(arcs->closed.reserve(edges));
  TRY(arcs->start.reserve(edges + 1));
  arcs->start.push_reserved(0);
  Pace pace(graph->edge.context());
  // Arcs between nodes first; what is left after that are circles without one.
  for (int pass = 0; pass < 2; ++pass) {
    for (uint32_t v = 0; v < vertices; ++v) {
      TRY(pace.after());
      if ((pass == 0) != (arcs->is_node[v] != 0)) continue;
      for (uint32_t i = graph->start[v]; i < graph->start[v + 1]; ++i) {
        const uint32_t e = graph->edge_at[i];
        if (graph->used[e] == 0) TRY(trace_arc(graph, v, e, &pace, arcs));
      }
    }
  }
  return {};
}

static Status gather_points(const Polylines& curves, const ArcGraph& graph, Arcs* arcs) {
  Array<uint8_t> seen(graph.used.context());
  Pace pace(seen.context());
  TRY(assign_in_parts(arcs->vertex.size(), 0, &seen));
  for (uint32_t c = 0; c + 1 < curves.start.size(); ++c) {
    for (uint32_t s = curves.start[c]; s < curves.start[c + 1]; ++s) {
      TRY(pace.after());
      const uint32_t v = arcs->sample_vertex[s];
      if (graph.degree(v) != 0 || seen[v] != 0) continue;
      seen[v] = 1;
      TRY(arcs->point.push(v));
      TRY(arcs->point_curve.push(c));
    }
  }
  return {};
}

Status find_arcs(Context& context, const Polylines& curves, Arcs* arcs) {
  WIRESKIN_ASSERT(!curves.position.empty());
  ArcGraph graph(context);
  arcs->diagonal = diagonal_of(curves.position);
  TRY(find_vertices(context, curves, arcs));
  const uint32_t vertices = static_cast<uint32_t>(arcs->vertex.size());
  arcs->given = vertices;
  TRY(gather_edges(curves, *arcs, &graph.edge));
  TRY(link_edges(vertices, &graph));
  TRY(arcs->is_node.resize(vertices));
  TRY(in_parts(context, vertices, [&](size_t i) {
    const uint32_t v = static_cast<uint32_t>(i), degree = graph.degree(v);
    arcs->is_node[v] = degree != 0 && (degree != 2 || turns_sharply(graph, arcs->vertex.span(), v));
  }));
  TRY(gather_points(curves, graph, arcs));
  return trace_arcs(&graph, arcs);
}

}  // namespace wireskin::flow
