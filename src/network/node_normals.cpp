#include "network/node_normals.h"

namespace wireskin::network {

namespace {

// A stretch of curve between two nodes, with the unit tangents of the curve at its ends.
struct Link {
  uint32_t from, to;
  Vec3 first, last;
};

// Of the tips of the unit tangents that leave a node: number, sum and the sum of their squares.
struct Tips {
  double count;
  Vec3 sum;
  Vec3 row[3];
  Vec3 tangent[2];  // the first two
};

enum class Sense : uint8_t { unknown, reached, known };

}  // namespace

static Status find_links(const curves::Curves& curves, Array<Link>* links) {
  for (uint32_t c = 0; c < curves.size(); ++c) {
    const curves::Curve curve = curves[c];
    uint32_t before = k_none;
    for (uint32_t k = 0; k < curve.node.size(); ++k) {
      if (curve.node[k] == k_none) continue;
      if (before != k_none) {
        TRY(links->push({curve.node[before], curve.node[k], unit(tangent_at_knot(curve, before)),
                         unit(tangent_at_knot(curve, k))}));
      }
      before = k;
    }
  }
  return {};
}

static void add_tip(const Vec3& tangent, Tips* tips) {
  if (tips->count < 2.0) tips->tangent[tips->count > 0.0] = tangent;
  tips->count += 1.0;
  tips->sum += tangent;
  tips->row[0] += tangent.x * tangent;
  tips->row[1] += tangent.y * tangent;
  tips->row[2] += tangent.z * tangent;
}

// The eigenvector of the least eigenvalue of a symmetric matrix: the adjugate has it for its
// greatest, and squaring leaves that alone.
static Vec3 least_eigenvector(const Vec3 (&row)[3]) {
  Vec3 a[3] = {cross(row[1], row[2]), cross(row[2], row[0]), cross(row[0], row[1])};
  for (int k = 0; k < 8; ++k) {
    const double trace = a[0].x + a[1].y + a[2].z;
    if (!(trace > 0.0)) return {};
    Vec3 square[3];
    for (int i = 0; i < 3; ++i) {
      const Vec3 r = (1.0 / trace) * a[i];
      square[i] = (1.0 / trace) * (r.x * a[0] + r.y * a[1] + r.z * a[2]);
    }
    for (int i = 0; i < 3; ++i) a[i] = square[i];
  }
  const Vec3& xy = a[0].x >= a[1].y ? a[0] : a[1];
  const double greatest = a[0].x >= a[1].y ? a[0].x : a[1].y;
  return unit(greatest >= a[2].z ? xy : a[2]);
}

// Any vector across a unit vector.
static Vec3 across(const Vec3& t) {
  return unit(std::fabs(t.x) < 0.7 ? cross(t, {1, 0, 0}) : cross(t, {0, 1, 0}));
}

// Two curves have only one order: any direction across them will do.
static Vec3 axis_of(const Tips& tips) {
  if (tips.count < 3.0) {
    const Vec3 normal = cross(tips.tangent[0], tips.tangent[1]);
    return length(normal) > 0.1 ? unit(normal) : across(tips.tangent[0]);
  }
  const double share = 1.0 / tips.count;
  const Vec3 row[3] = {tips.row[0] - share * tips.sum.x * tips.sum,
                       tips.row[1] - share * tips.sum.y * tips.sum,
                       tips.row[2] - share * tips.sum.z * tips.sum};
  return least_eigenvector(row);
}

// The cosine between the normal at one end of a link, carried along it to the other, and the axis
// there, both taken across the curve; 0 where the curve turns back.
static double carried_cosine(const Vec3& normal, const Vec3& from, const Vec3& to,
                             const Vec3& axis) {
  const double sum = 1.0 + dot(from, to);
  if (!(sum > 0.1)) return 0.0;
  const Vec3 start = unit(reject(normal, from));
  const Vec3 carried = start - (dot(to, start) / sum) * (from + to);
  return dot(carried, unit(reject(axis, to)));
}

// Gives every node its axis. Where the sense is known it is taken from the normal, and the normal
// itself stays where it is complete or the axis tells something else.
static void find_axes(Span<const Tips> tips, Span<Node> nodes, Span<Sense> sense) {
  constexpr double k_agrees = 0.05;
  for (size_t i = 0; i < nodes.size(); ++i) {
    const bool known = nodes[i].normal != Vec3{};
    sense[i] = known ? Sense::known : Sense::unknown;
    if (nodes[i].certain && known) continue;
    const Vec3 axis = axis_of(tips[i]);
    const double cosine = dot(axis, nodes[i].normal);
    if (!known) {
      nodes[i].normal = axis;
    } else if (tips[i].count > 2.0 && std::fabs(cosine) > k_agrees) {
      nodes[i].normal = cosine > 0.0 ? axis : -axis;
    }
  }
}

// Carries the sense of those that have one to their neighbours until nothing changes.
static Status spread(Context& context, Span<const Link> links, Span<Node> nodes,
                     Span<Sense> sense) {
  constexpr double k_least_cosine = 0.2;
  bool changed = true;
  while (changed) {
    changed = false;
    for (const Link& link : links) {
      if ((sense[link.from] == Sense::unknown) == (sense[link.to] == Sense::unknown)) continue;
      const bool forward = sense[link.to] == Sense::unknown;
      const uint32_t to = forward ? link.to : link.from, from = forward ? link.from : link.to;
      const double cosine = carried_cosine(nodes[from].normal, forward ? link.first : link.last,
                                           forward ? link.last : link.first, nodes[to].normal);
      if (!(std::fabs(cosine) > k_least_cosine)) continue;
      if (cosine < 0.0) nodes[to].normal = -nodes[to].normal;
      sense[to] = Sense::reached;
      changed = true;
    }
    TRY(context.checkpoint());
  }
  return {};
}

static Status fail_without_sense(const Node& node) {
  Place place;
  place.node = node.number;
  return fail(Code::missing_normals,
              "nothing tells the outer side here: no normal is known at the node, nor do its "
              "neighbours decide it",
              place);
}

// Turns the nodes just reached from `seed` outward, away from their middle.
static Status turn_outward(uint32_t seed, Span<Sense> sense, Span<Node> nodes) {
  Vec3 middle;
  double count = 0.0;
  for (size_t i = 0; i < nodes.size(); ++i) {
    if (sense[i] != Sense::reached) continue;
    middle += nodes[i].position;
    count += 1.0;
  }
  middle = (1.0 / count) * middle;
  double outward = 0.0, whole = 0.0;
  for (size_t i = 0; i < nodes.size(); ++i) {
    if (sense[i] != Sense::reached) continue;
    outward += dot(nodes[i].normal, nodes[i].position - middle);
    whole += length(nodes[i].position - middle);
  }
  constexpr double k_clearly = 0.1;
  if (!(std::fabs(outward) > k_clearly * whole)) return fail_without_sense(nodes[seed]);
  for (size_t i = 0; i < nodes.size(); ++i) {
    if (sense[i] != Sense::reached) continue;
    sense[i] = Sense::known;
    if (outward < 0.0) nodes[i].normal = -nodes[i].normal;
  }
  return {};
}

Status complete_node_normals(const curves::Curves& curves, Span<Node> nodes) {
  Context& context = curves.start.context();
  Array<Link> links(context);
  Array<Tips> tips(context);
  Array<Sense> sense(context);
  TRY(find_links(curves, &links));
  TRY(tips.assign(nodes.size(), Tips{}));
  TRY(sense.resize(nodes.size()));
  for (const Link& link : links) {
    add_tip(link.first, &tips[link.from]);
    add_tip(-link.last, &tips[link.to]);
  }
  find_axes(tips.span(), nodes, sense.span());
  TRY(spread(context, links.span(), nodes, sense.span()));
  for (Sense& s : sense) s = s == Sense::reached ? Sense::known : s;
  for (uint32_t i = 0; i < nodes.size(); ++i) {
    if (sense[i] != Sense::unknown || tips[i].count < 3.0) continue;
    for (const Link& link : links) {
      const bool decided = (link.from == i && sense[link.to] == Sense::known) ||
                           (link.to == i && sense[link.from] == Sense::known);
      if (decided) return fail_without_sense(nodes[i]);
    }
    sense[i] = Sense::reached;
    TRY(spread(context, links.span(), nodes, sense.span()));
    TRY(turn_outward(i, sense.span(), nodes));
  }
  return {};
}

}  // namespace wireskin::network
