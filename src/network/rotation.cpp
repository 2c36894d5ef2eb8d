#include "network/rotation.h"

#include "base/sort.h"

namespace wireskin::network {

namespace {

struct Leaving {
  uint32_t half_segment;
  double angle;
};

// The half-segment of a border that leaves a node with all curves of the surface, which follow it
// counter-clockwise; and how far they are from the border at least. k_none where there are none, or
// on both sides.
struct BorderSide {
  uint32_t left = k_none;
  double gap = 0.0;
};

}  // namespace

static Status fail_at_node(Code code, const char* sentence, const Graph& graph, uint32_t node,
                           uint32_t h) {
  const Segment& segment = graph.segment_of(h);
  const curves::Curve curve = graph.curve_of(h);
  Place place;
  place.node = graph.nodes[node].number;
  place.curve = segment.curve;
  place.sample = curve.sample[h % 2 == 0 ? segment.first_knot : segment.last_knot];
  return fail(code, sentence, place);
}

// How directions are taken: the tangent (0), a secant over that part of the shortest segment at the
// node, or the chord to the next sample.
static constexpr double k_chord = -1.0;
static constexpr double k_parts[] = {0.0, 1.0 / 32.0, 0.25, 0.5, 1.0, k_chord};
// More would be of no use where all that is wanted are different directions.
static constexpr int k_parts_for_order = 3;

// The direction in which half-segment h leaves its node.
static Vec3 direction(const Graph& graph, uint32_t h, double distance) {
  const Segment& segment = graph.segment_of(h);
  const curves::Curve curve = graph.curve_of(h);
  const bool forward = h % 2 == 0;
  const uint32_t knot = forward ? segment.first_knot : segment.last_knot;
  if (distance == 0.0) {
    const Vec3 tangent = tangent_at_knot(curve, knot);
    return forward ? tangent : -tangent;
  }
  if (distance < 0.0) {
    return curve.position.value[forward ? knot + 1 : knot - 1] - curve.position.value[knot];
  }
  const double s = forward ? curve.arc[knot] + distance : curve.arc[knot] - distance;
  return point_at(curve, segment.first_knot, segment.last_knot, s).position -
         curve.position.value[knot];
}

// Grows with the angle from the x axis, counter-clockwise, from 0 to 4; no trigonometry needed.
static double diamond_angle(double x, double y) {
  const double t = y / (std::fabs(x) + std::fabs(y));
  if (x < 0.0) return 2.0 - t;
  return y < 0.0 ? 4.0 + t : t;
}

static double shortest_length(const Graph& graph, Span<const Leaving> leaving) {
  double shortest = -1.0;
  for (const Leaving& l : leaving) {
    const Segment& segment = graph.segment_of(l.half_segment);
    const curves::Curve curve = graph.curve_of(l.half_segment);
    const double length = curve.arc[segment.last_knot] - curve.arc[segment.first_knot];
    if (shortest < 0.0 || length < shortest) shortest = length;
  }
  return shortest;
}

// Angles of all half-segments that leave a node, in the plane across its normal.
static Status measure_angles(const Graph& graph, uint32_t node, double distance,
                             Span<Leaving> leaving) {
  const Vec3& n = graph.nodes[node].normal;
  const double ax = std::fabs(n.x), ay = std::fabs(n.y), az = std::fabs(n.z);
  const Vec3 axis = ax <= ay && ax <= az ? Vec3{1, 0, 0} : ay <= az ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
  const Vec3 u = unit(reject(axis, n));
  const Vec3 v = cross(n, u);
  for (Leaving& l : leaving) {
    const Vec3 d = direction(graph, l.half_segment, distance);
    const double x = dot(d, u), y = dot(d, v);
    constexpr double k_least_sine = 1e-3;
    if (!(x * x + y * y > k_least_sine * k_least_sine * dot(d, d))) {
      return fail_at_node(Code::tangent_normal, "the normal of the node is parallel to the curve",
                          graph, node, l.half_segment);
    }
    l.angle = diamond_angle(x, y);
  }
  return {};
}

static bool all_differ(Span<const Leaving> sorted) {
  constexpr double k_least_gap = 1e-6;
  for (size_t i = 0; i < sorted.size(); ++i) {
    const bool wraps = i + 1 == sorted.size();
    const double next = wraps ? sorted[0].angle + 4.0 : sorted[i + 1].angle;
    if (sorted.size() > 1 && next - sorted[i].angle < k_least_gap) return false;
  }
  return true;
}

static Status sort_by_part(const Graph& graph, uint32_t node, double part, Span<Leaving> leaving) {
  const double shortest = shortest_length(graph, leaving);
  TRY(measure_angles(graph, node, part * shortest, leaving));
  sort(leaving, [](const Leaving& a, const Leaving& b) {
    return a.angle != b.angle ? a.angle < b.angle : a.half_segment < b.half_segment;
  });
  return {};
}

// Sorts the half-segments that leave a node counter-clockwise.
static Status sort_round_node(const Graph& graph, uint32_t node, Span<Leaving> leaving) {
  for (int k = 0; k < k_parts_for_order; ++k) {
    TRY(sort_by_part(graph, node, k_parts[k], leaving));
    if (all_differ(leaving)) return {};
  }
  return fail_at_node(Code::inconsistent_normals,
                      "two curves leave the node in the same direction, seen along its normal: is one of "
                      "them given twice?",
                      graph, node, leaving[0].half_segment);
}

// The two border half-segments of a node where there are just two of them; whether other ones leave
// it, too.
static bool border_pair(const Graph& graph, Span<const Leaving> round, uint32_t* pair) {
  uint32_t count = 0;
  for (const Leaving& l : round) {
    if (!graph.segment_of(l.half_segment).boundary) continue;
    if (count < 2) pair[count] = l.half_segment;
    ++count;
  }
  if (count != 2) pair[0] = pair[1] = k_none;
  return count == 2 && round.size() > 2;
}

static BorderSide border_side(const Graph& graph, Span<const Leaving> sorted) {
  const size_t n = sorted.size();
  const auto at_border = [&](size_t i) {
    return graph.segment_of(sorted[i % n].half_segment).boundary;
  };
  const auto gap = [&](size_t i) {
    const double turn = sorted[(i + 1) % n].angle - sorted[i % n].angle;
    return turn < 0.0 ? turn + 4.0 : turn;
  };
  BorderSide side;
  for (size_t i = 0; i < n; ++i) {
    if (!at_border(i) || at_border(i + 1) || !at_border(i + n - 1)) continue;
    const double before = gap(i + n - 2), after = gap(i);
    side = {sorted[i].half_segment, before < after ? before : after};
  }
  return side;
}

// Tries other directions until all curves lie to the left of `left`, or of either border
// half-segment for k_none; if nothing helps the order stays as it was.
static Status sort_at_border(const Graph& graph, uint32_t node, uint32_t left,
                             Span<Leaving> leaving, Array<Leaving>* kept) {
  TRY(kept->copy(leaving));
  for (const double part : k_parts) {
    const Status status = sort_by_part(graph, node, part, leaving);
    if (!status.ok() && status.code != Code::tangent_normal) return status;
    if (!status.ok() || !all_differ(leaving)) continue;
    const BorderSide side = border_side(graph, leaving);
    if (side.left != k_none && (left == k_none || side.left == left)) return {};
  }
  for (size_t i = 0; i < leaving.size(); ++i) leaving[i] = (*kept)[i];
  return {};
}

namespace {

// The half-segments that leave each node, in order.
struct Rotation {
  Array<uint32_t> start;  // of each node
  Array<Leaving> leaving;

  explicit Rotation(Context& context) : start(context), leaving(context) {}
  Span<Leaving> round(uint32_t node) {
    return leaving.span().part(start[node], start[node + 1] - start[node]);
  }
};

// What the borders know: of each half-segment that leaves a node along a border, the other one
// there; of each node the side of the curves; of each border segment whether it was visited.
struct Borders {
  Array<uint32_t> other;
  Array<BorderSide> side;
  Array<uint8_t> visited;

  explicit Borders(Context& context) : other(context), side(context), visited(context) {}
};

}  // namespace

static Status list_borders(const Graph& graph, Rotation* rotation, Borders* borders) {
  Array<Leaving> kept(borders->other.context());
  TRY(borders->other.assign(2 * graph.segments.size(), k_none));
  TRY(borders->side.assign(graph.nodes.size(), BorderSide{}));
  TRY(borders->visited.assign(graph.segments.size(), 0));
  for (uint32_t node = 0; node < graph.nodes.size(); ++node) {
    const Span<Leaving> round = rotation->round(node);
    uint32_t pair[2];
    const bool meets_curves = border_pair(graph, round, pair);
    if (pair[0] == k_none) continue;
    borders->other[pair[0]] = pair[1];
    borders->other[pair[1]] = pair[0];
    if (!meets_curves) continue;
    if (border_side(graph, round).left == k_none) {
      TRY(sort_at_border(graph, node, k_none, round, &kept));
    }
    borders->side[node] = border_side(graph, round);
  }
  return {};
}

// Calls visit(a, b, node) at each node of the border that begins with h, where half-segment a comes
// in and b leaves, until the border ends or has come back.
template <typename Visit>
static void walk_border(const Graph& graph, const Borders& borders, uint32_t h,
                        const Visit& visit) {
  uint32_t g = h;
  do {
    const uint32_t next = borders.other[opposite(g)];
    if (next == k_none) return;
    visit(g, next, graph.from(next));
    g = next;
  } while (g != h);
}

// A border one side of which has the surface: the nodes that see it on the other side are sorted
// again.
static Status agree_on_side(const Graph& graph, uint32_t first, Rotation* rotation,
                            Borders* borders) {
  uint32_t h = first;  // where the border begins, if it does
  walk_border(graph, *borders, opposite(first),
              [&](uint32_t, uint32_t b, uint32_t) { h = opposite(b); });
  double left = 0.0;
  borders->visited[h / 2] = 1;
  walk_border(graph, *borders, h, [&](uint32_t a, uint32_t b, uint32_t node) {
    const BorderSide& side = borders->side[node];
    if (side.left == b) left += side.gap;
    if (side.left == opposite(a)) left -= side.gap;
    borders->visited[b / 2] = 1;
  });
  Array<Leaving> kept(borders->other.context());
  Status status;
  walk_border(graph, *borders, h, [&](uint32_t a, uint32_t b, uint32_t node) {
    const uint32_t wanted = left > 0.0 ? b : opposite(a);
    const uint32_t seen = borders->side[node].left;
    if (seen == k_none || seen == wanted || !status.ok()) return;
    status = sort_at_border(graph, node, wanted, rotation->round(node), &kept);
  });
  return status;
}

static Status sort_borders(const Graph& graph, Rotation* rotation) {
  Borders borders(rotation->start.context());
  TRY(list_borders(graph, rotation, &borders));
  for (uint32_t s = 0; s < graph.segments.size(); ++s) {
    if (!graph.segments[s].boundary || borders.visited[s] || graph.segments[s].from == k_none) {
      continue;
    }
    TRY(agree_on_side(graph, 2 * s, rotation, &borders));
    TRY(rotation->start.context().checkpoint());
  }
  return {};
}

// In the order of half-segments round each node, not sorted yet.
static Status list_leaving(const Graph& graph, uint32_t halves, Rotation* rotation) {
  Array<uint32_t> fill(rotation->start.context());
  TRY(rotation->start.assign(graph.nodes.size() + 1, 0));
  TRY(rotation->leaving.resize(halves));
  for (uint32_t h = 0; h < halves; ++h) {
    if (graph.from(h) != k_none) ++rotation->start[graph.from(h)];
  }
  starts_from_counts(rotation->start.span());
  TRY(fill.copy(rotation->start.span()));
  for (uint32_t h = 0; h < halves; ++h) {
    if (graph.from(h) != k_none) rotation->leaving[fill[graph.from(h)]++] = {h, 0.0};
  }
  return {};
}

// Sorts the half-segments round all nodes by their directions there.
static Status sort_nodes(const Graph& graph, Rotation* rotation, Array<Status>* faults) {
  for (uint32_t node = 0; node < graph.nodes.size(); ++node) {
    const Span<Leaving> round = rotation->round(node);
    if (node % 4096 == 4095) TRY(rotation->start.context().checkpoint());
    if (round.empty()) continue;
    const Status status = sort_round_node(graph, node, round);
    if (status.ok()) continue;
    if (faults == nullptr) return status;
    for (const Leaving& l : round) (*faults)[l.half_segment / 2] = status;
  }
  return {};
}

Status link_half_segments(const Graph& graph, Span<uint32_t> next, Array<Status>* faults) {
  Context& context = graph.curves.start.context();
  Rotation rotation(context);
  TRY(list_leaving(graph, static_cast<uint32_t>(next.size()), &rotation));
  TRY(sort_nodes(graph, &rotation, faults));
  TRY(sort_borders(graph, &rotation));
  for (uint32_t h = 0; h < next.size(); ++h) next[h] = h;  // so it stays for curves without node
  for (uint32_t node = 0; node < graph.nodes.size(); ++node) {
    const Span<const Leaving> round = rotation.round(node);
    for (size_t i = 0; i < round.size(); ++i) {
      const size_t clockwise = i == 0 ? round.size() - 1 : i - 1;
      next[opposite(round[i].half_segment)] = round[clockwise].half_segment;
    }
  }
  return {};
}

}  // namespace wireskin::network
