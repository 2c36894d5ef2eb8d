#include "network/network.h"

#include "network/rotation.h"

namespace wireskin::network {

namespace {

struct Cycles {
  Array<uint32_t> next;   // of each half-segment
  Array<uint32_t> cycle;  // of each half-segment
  uint32_t count = 0;

  explicit Cycles(Context& context) : next(context), cycle(context) {}
};

}  // namespace

// The stretches between the nodes of one curve.
static Status cut_curve(const curves::Curve& curve, uint32_t index, bool boundary,
                        Array<Segment>* segments) {
  const uint32_t last = static_cast<uint32_t>(curve.node.size()) - 1;
  const bool closed = curve.sample[0] == curve.sample[last];
  if (closed && curve.node[0] == k_none) {
    return segments->push({index, 0, last, k_none, k_none, boundary});
  }
  const uint32_t ends[] = {0, last};
  for (uint32_t end : ends) {
    if (curve.node[end] != k_none) continue;
    return fail_at_sample(Code::open_network, "the curve ends here without meeting another curve",
                          index, curve.sample[end]);
  }
  uint32_t first = 0;
  for (uint32_t knot = 1; knot <= last; ++knot) {
    if (curve.node[knot] == k_none) continue;
    TRY(segments->push({index, first, knot, curve.node[first], curve.node[knot], boundary}));
    first = knot;
  }
  return {};
}

static void number_cycles(Cycles* cycles) {
  for (uint32_t h = 0; h < cycles->next.size(); ++h) {
    if (cycles->cycle[h] != k_none) continue;
    for (uint32_t g = h; cycles->cycle[g] == k_none; g = cycles->next[g]) {
      cycles->cycle[g] = cycles->count;
    }
    ++cycles->count;
  }
}

// Twice the area that the cycle through h encloses, seen along the sum of its normals (of its
// nodes' where the curves have none); the sign tells a patch, counter-clockwise, from the outside
// of one.
static double signed_area(const Graph& graph, Span<const uint32_t> next, uint32_t h) {
  const Segment& first = graph.segment_of(h);
  const Vec3 base = graph.curves[first.curve].position.value[first.first_knot];
  Vec3 area, normals, nodes;
  uint32_t g = h;
  do {
    const Segment& segment = graph.segment_of(g);
    const curves::Curve curve = graph.side_of(g);
    const double sign = g % 2 == 0 ? 1.0 : -1.0;
    for (uint32_t k = segment.first_knot; k < segment.last_knot; ++k) {
      const Vec3 a = curve.position.value[k] - base, b = curve.position.value[k + 1] - base;
      area += sign * cross(a, b);
      normals += curve.normal.value[k];
    }
    if (segment.from != k_none) nodes += graph.nodes[graph.from(g)].normal;
    g = next[g];
  } while (g != h);
  return dot(area, dot(normals, normals) > 0.0 ? normals : nodes);
}

static bool two_sided(const Cycles& cycles, uint32_t h) {
  return cycles.cycle[h] == cycles.cycle[opposite(h)];
}

// The cycle on the other side of h's cycle all the way round where that is the same one from both
// sides, else k_none.
static uint32_t rival_of(const Cycles& cycles, uint32_t h) {
  const uint32_t c = cycles.cycle[h], rival = cycles.cycle[opposite(h)];
  if (rival == c) return k_none;
  uint32_t g = h, count = 0, back = opposite(h);
  do {
    if (cycles.cycle[opposite(g)] != rival) return k_none;
    g = cycles.next[g];
    ++count;
  } while (g != h);
  do {
    back = cycles.next[back];
    --count;
  } while (back != opposite(h) && count != 0);
  return back == opposite(h) && count == 0 ? rival : k_none;
}

namespace {

// What is known of each cycle.
struct Judged {
  Array<uint8_t> outside;  // no surface there
  Array<uint8_t> ring;     // as in Network

  explicit Judged(Context& context) : outside(context), ring(context) {}
};

}  // namespace

// Of a cycle all of whose segments are boundary and none of whose neighbours is a patch for sure:
// counter-clockwise ones have the surface.
static void judge_by_area(const Graph& graph, const Cycles& cycles, uint32_t h, Judged* judged) {
  const uint32_t c = cycles.cycle[h], rival = rival_of(cycles, h);
  const double area = signed_area(graph, cycles.next.span(), h);
  if (rival == k_none) {
    judged->outside[c] = area < 0.0;
    return;
  }
  judged->ring[c] = judged->ring[rival] = 1;
  judged->outside[area < 0.0 ? c : rival] = 1;
}

// Of each cycle a curve that hangs by one end in it where its other segments are all boundary, else
// k_none.
static Status find_hanging(const Graph& graph, const Cycles& cycles, Array<uint32_t>* hanging) {
  Array<uint8_t> bounded(hanging->context());  // has an untagged segment on one side only
  TRY(hanging->assign(cycles.count, k_none));
  TRY(bounded.assign(cycles.count, 0));
  for (uint32_t h = 0; h < cycles.next.size(); ++h) {
    const uint32_t c = cycles.cycle[h];
    if (graph.segment_of(h).boundary) continue;
    if (!two_sided(cycles, h)) bounded[c] = 1;
    if ((*hanging)[c] == k_none) (*hanging)[c] = h;
  }
  for (uint32_t c = 0; c < cycles.count; ++c) {
    if (bounded[c]) (*hanging)[c] = k_none;
  }
  return {};
}

// What is wrong at a boundary segment h that has no surface, or surface on both sides.
static Status name_bad_border(const Graph& graph, const Cycles& cycles, Span<const uint8_t> inner,
                              Span<const uint32_t> hanging, uint32_t h) {
  const uint32_t a = cycles.cycle[h], b = cycles.cycle[opposite(h)];
  const char* sentence =
      "this boundary curve has patches of other curves on both sides: every curve of a border must "
      "be tagged as boundary, and no other, and normals must not point away from the surface";
  uint32_t at = h;
  if (a == b) {
    sentence =
        "the same patch lies on both sides of this boundary curve: it hangs by one end, or normals "
        "where it ends point away from the surface";
  } else if (!inner[a] && !inner[b]) {
    sentence = "the normals do not tell on which side of this boundary curve the surface lies";
  } else {
    const uint32_t found = hanging[a] != k_none ? hanging[a] : hanging[b];
    if (found != k_none) {
      at = found;
      sentence = "this curve leads away from a border, out to where there is no surface";
    }
  }
  const Segment& segment = graph.segment_of(at);
  return fail_at_sample(Code::open_network, sentence, segment.curve,
                        graph.curve_of(at).sample[segment.first_knot]);
}

// Cycles all of whose segments are boundary lie outside when a neighbour across is a patch for
// sure, or else when they run clockwise.
static Status find_outside(const Graph& graph, const Cycles& cycles, Judged* judged,
                           Array<Status>* faults) {
  Context& context = judged->outside.context();
  Array<uint8_t> inner(context);  // has a segment that is no boundary
  TRY(inner.assign(cycles.count, 0));
  TRY(judged->outside.assign(cycles.count, 0));
  TRY(judged->ring.assign(cycles.count, 0));
  const uint32_t halves = static_cast<uint32_t>(cycles.next.size());
  for (uint32_t h = 0; h < halves; ++h) {
    if (!graph.segment_of(h).boundary) inner[cycles.cycle[h]] = 1;
  }
  for (uint32_t h = 0; h < halves; ++h) {
    const uint32_t c = cycles.cycle[h];
    if (!inner[c] && inner[cycles.cycle[opposite(h)]]) judged->outside[c] = 1;
  }
  Array<uint8_t> measured(context);
  TRY(measured.assign(cycles.count, 0));
  for (uint32_t h = 0; h < halves; ++h) {
    const uint32_t c = cycles.cycle[h];
    if (inner[c] || judged->outside[c] || judged->ring[c] || measured[c]) continue;
    if (two_sided(cycles, h)) continue;
    measured[c] = 1;
    judge_by_area(graph, cycles, h, judged);
    if (c % 256 == 255) TRY(context.checkpoint());
  }
  Array<uint32_t> hanging(context);
  TRY(find_hanging(graph, cycles, &hanging));
  for (uint32_t h = 0; h < halves; h += 2) {
    const Segment& segment = graph.segment_of(h);
    const uint32_t a = cycles.cycle[h], b = cycles.cycle[opposite(h)];
    const int sides = !judged->outside[a] + !judged->outside[b];
    if (!segment.boundary || sides == 1) continue;
    const Status status = name_bad_border(graph, cycles, inner.span(), hanging.span(), h);
    if (faults == nullptr) return status;
    (*faults)[h / 2] = status;
    if (h % 4096 == 4094) TRY(context.checkpoint());
  }
  // What lies there is to be named as a patch that fails, on either side of a ring too.
  for (uint32_t h = 0; faults != nullptr && h < halves; ++h) {
    if ((*faults)[h / 2].ok()) continue;
    judged->outside[cycles.cycle[h]] = judged->ring[cycles.cycle[h]] = 0;
  }
  return {};
}

// Lists the loop of a cycle that begins with h, which has another cycle on its other side: where
// the way goes on along a segment inside the patch, the next one clockwise is taken instead.
static void list_loop(const Cycles& cycles, uint32_t h, Span<uint8_t> done, Lists* loops) {
  uint32_t g = h;
  do {
    done[g] = 1;
    loops->item.push_reserved(g);
    g = cycles.next[g];
    while (two_sided(cycles, g)) g = cycles.next[opposite(g)];
  } while (g != h);
}

static uint32_t root_of_node(Span<uint32_t> parent, uint32_t v) {
  while (parent[v] != v) v = parent[v] = parent[parent[v]];
  return v;
}

// Loops and the segments between them must form a tree when every loop is shrunk to a point; else
// the patch has a handle. `parent`: of each node, itself on entry and on return.
static Status check_handles(const Graph& graph, Span<const uint32_t> loops,
                            Span<const uint32_t> inner, uint32_t patch, Span<uint32_t> parent) {
  Status status;
  for (uint32_t h : loops) {
    const Segment& s = graph.segment_of(h);
    if (s.from != k_none) parent[root_of_node(parent, s.from)] = root_of_node(parent, s.to);
  }
  for (uint32_t i : inner) {
    const uint32_t a = root_of_node(parent, graph.segments[i].from);
    const uint32_t b = root_of_node(parent, graph.segments[i].to);
    parent[a] = b;
    if (a != b || !status.ok()) continue;
    Place place;
    place.patch = patch;
    place.curve = graph.segments[i].curve;
    status = fail(Code::patch_several_loops,
                  "the border of the patch passes a curve on both sides, round a handle", place);
  }
  const auto reset = [&](const Segment& s) {
    if (s.from == k_none) return;
    parent[s.from] = s.from;
    parent[s.to] = s.to;
  };
  for (uint32_t h : loops) reset(graph.segment_of(h));
  for (uint32_t i : inner) reset(graph.segments[i]);
  return status;
}

// The loops and the inner segments of the cycle through h become a patch, or a loose piece where it
// has no loops.
static Status collect_patch(const Graph& graph, const Cycles& cycles, uint32_t h, bool ring,
                            Span<uint8_t> done, Span<uint32_t> parent, Network* network,
                            Array<Status>* faults) {
  const uint32_t first_loop = network->loop.count();
  Array<uint32_t> inner(network->segment.context());
  uint32_t g = h;
  do {
    if (two_sided(cycles, g)) {
      if (!done[opposite(g)]) TRY(inner.push(g / 2));
      done[g] = 1;
    } else if (!done[g]) {
      list_loop(cycles, g, done, &network->loop);
      TRY(network->loop.close());
    }
    g = cycles.next[g];
  } while (g != h);
  const uint32_t loops = network->loop.count();
  Lists* list = loops == first_loop ? &network->loose : &network->inner;
  Span<const uint32_t> halves;
  if (loops > first_loop) {
    TRY(network->patch_start.push(loops));
    TRY(network->ring.push(ring));
    TRY(network->point.close());
    halves = network->cycle(network->patches() - 1);
  }
  for (uint32_t s : inner) TRY(list->item.push(s));
  TRY(list->close());
  if (inner.empty()) return {};
  const bool loose = loops == first_loop;
  const Status status =
      check_handles(graph, halves, inner.span(), loose ? k_none : network->patches() - 1, parent);
  if (status.ok() || loose || faults == nullptr) return status;
  (*faults)[inner[0]] = status;
  return {};
}

static Status collect_patches(const Graph& graph, const Cycles& cycles, const Judged& judged,
                              Network* network, Array<Status>* faults) {
  Context& context = network->patch_start.context();
  Array<uint8_t> done(context);
  Array<uint32_t> parent(context);
  TRY(done.assign(cycles.next.size(), 0));
  TRY(parent.resize(graph.nodes.size()));
  for (uint32_t i = 0; i < parent.size(); ++i) parent[i] = i;
  TRY(network->patch_start.push(0));
  TRY(network->loop.item.reserve(cycles.next.size()));
  for (uint32_t h = 0; h < cycles.next.size(); ++h) {
    const uint32_t c = cycles.cycle[h];
    if (judged.outside[c] || done[h]) continue;
    TRY(collect_patch(graph, cycles, h, judged.ring[c] != 0, done.span(), parent.span(), network,
                      faults));
    if (h % 4096 == 4095) TRY(context.checkpoint());
  }
  return {};
}

Status find_patches(const curves::Curves& curves, Span<const uint8_t> boundary,
                    Span<const Node> nodes, Network* network, Array<Status>* faults) {
  Context& context = network->segment.context();
  for (uint32_t c = 0; c < curves.size(); ++c) {
    TRY(cut_curve(curves[c], c, boundary[c] != 0, &network->segment));
  }
  const Graph graph = {curves, nodes, network->segment.span()};
  Cycles cycles(context);
  Judged judged(context);
  TRY(cycles.next.resize(2 * network->segment.size()));
  TRY(cycles.cycle.assign(2 * network->segment.size(), k_none));
  if (faults != nullptr) TRY(faults->assign(network->segment.size(), Status{}));
  TRY(link_half_segments(graph, cycles.next.span(), faults));
  number_cycles(&cycles);
  TRY(find_outside(graph, cycles, &judged, faults));
  return collect_patches(graph, cycles, judged, network, faults);
}

}  // namespace wireskin::network
