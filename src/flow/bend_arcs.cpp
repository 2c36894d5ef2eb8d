#include "flow/bend_arcs.h"

#include "flow/chains.h"
#include "num/minmax.h"

namespace wireskin::flow {

namespace {

constexpr uint32_t k_most_pieces = 16;  // of a segment between two samples

// One segment of a chain as a Hermite cubic: the ends and what leaves and reaches them.
struct Cubic {
  Vec3 p, q, leave, reach;

  Vec3 at(double t) const {
    const double u = 1.0 - t;
    return p + (t * t * (3.0 - 2.0 * t)) * (q - p) + (t * u) * (u * leave - t * reach);
  }
};

// The neighbours of a place along its chain; k_none beyond an end.
struct ChainWalk {
  const Arcs& arcs;
  const Chains& chains;
  uint32_t first, count;
  bool closed;

  ChainWalk(const Arcs& all, const Chains& list, uint32_t chain)
      : arcs(all),
        chains(list),
        first(list.start[chain]),
        count(list.start[chain + 1] - list.start[chain]),
        closed(list.closed[chain] != 0) {}
  uint32_t after(uint32_t i) const { return i + 1 < count ? i + 1 : closed ? 0 : k_none; }
  uint32_t before(uint32_t i) const { return i > 0 ? i - 1 : closed ? count - 1 : k_none; }
  const Vec3& point(uint32_t i) const { return arcs.vertex[chains.vertex[first + i]]; }
};

}  // namespace

// The unit tangent at a place; zero at ends and corners, where none is known.
static Vec3 tangent_at(const ChainWalk& walk, uint32_t i) {
  const uint32_t before = walk.before(i), after = walk.after(i);
  if (before == k_none || after == k_none) return {};
  const Vec3 to = walk.point(i) - walk.point(before), from = walk.point(after) - walk.point(i);
  const double g = length(to), h = length(from);
  if (dot(to, from) < k_cos_corner * (g * h)) return {};
  return unit((h / g) * to + (g / h) * from);
}

// A tangent turned over in the middle of the chord: what a circle does.
static Vec3 mirrored(const Vec3& tangent, const Vec3& along) {
  return 2.0 * dot(tangent, along) * along - tangent;
}

// How fast a circle with that tangent leaves the chord, in parameters of a cubic; no farther than
// twice the segment beyond the end.
static Vec3 speed(const Vec3& tangent, const Vec3& along, double chord, double beyond) {
  return (smaller(chord, 2.0 * beyond) * 2.0 / (1.0 + dot(tangent, along))) * tangent;
}

// Whether the segment from place i to the next bends at all.
static bool cubic_of(const ChainWalk& walk, uint32_t i, Cubic* cubic) {
  constexpr double k_no_bend = 1e-7;
  const uint32_t k = walk.after(i), before = walk.before(i), after = walk.after(k);
  cubic->p = walk.point(i);
  cubic->q = walk.point(k);
  const double chord = length(cubic->q - cubic->p);
  const Vec3 along = unit(cubic->q - cubic->p);
  Vec3 leave = tangent_at(walk, i), reach = tangent_at(walk, k);
  const bool free_begin = leave == Vec3{}, free_end = reach == Vec3{};
  if (free_begin && free_end) return false;
  if (free_begin) leave = mirrored(reach, along);
  if (free_end) reach = mirrored(leave, along);
  if (length(cross(leave, along)) + length(cross(reach, along)) < k_no_bend) return false;
  const double begin = free_begin ? chord : length(cubic->p - walk.point(before));
  const double end = free_end ? chord : length(walk.point(after) - cubic->q);
  const double shorter = smaller(begin, end);
  cubic->leave = speed(leave, along, chord, free_begin ? shorter : begin);
  cubic->reach = speed(reach, along, chord, free_end ? shorter : end);
  return true;
}

static uint32_t pieces_of(const Cubic& cubic, double step) {
  const double wished = 4.0 * length(cubic.q - cubic.p) / step;
  return wished < k_most_pieces ? static_cast<uint32_t>(wished) + 1 : k_most_pieces;
}

// New vertices of every place's segment, the next place's on: first[i] .. first[i + 1).
static Status bend_chains(Context& context, const Chains& chains, double step, Arcs* arcs,
                          Array<uint32_t>* first) {
  Cubic cubic;
  TRY(first->reserve(chains.vertex.size() + 1));
  Array<Vec3> added(context);
  const uint32_t given = static_cast<uint32_t>(arcs->vertex.size());
  for (uint32_t c = 0; c < chains.size(); ++c) {
    const ChainWalk walk(*arcs, chains, c);
    for (uint32_t i = 0; i < walk.count; ++i) {
      first->push_reserved(given + static_cast<uint32_t>(added.size()));
      if (walk.after(i) == k_none || !cubic_of(walk, i, &cubic)) continue;
      const uint32_t pieces = pieces_of(cubic, step);
      for (uint32_t k = 1; k < pieces; ++k) TRY(added.push(cubic.at(double(k) / pieces)));
    }
    if (added.size() >= k_none / 4) {
      return fail(Code::too_large, "too many samples for 32-bit indices");
    }
    if (c % 1024 == 0) TRY(context.checkpoint());
  }
  first->push_reserved(given + static_cast<uint32_t>(added.size()));
  TRY(arcs->vertex.reserve(given + added.size()));
  TRY(arcs->is_node.reserve(given + added.size()));
  for (const Vec3& p : added) {
    arcs->vertex.push_reserved(p);
    arcs->is_node.push_reserved(0);
  }
  return {};
}

// The arcs with the new vertices in their paths.
static Status lengthen_paths(const Chains& chains, Span<const uint32_t> first, Arcs* arcs) {
  Context& context = arcs->path.context();
  Array<uint32_t> start(context), path(context), curve(context);
  Array<double> along(context);
  const size_t room = arcs->path.size() + (first[first.size() - 1] - first[0]);
  TRY(start.reserve(arcs->start.size()));
  TRY(path.reserve(room));
  TRY(curve.reserve(room));
  TRY(along.reserve(room));
  start.push_reserved(0);
  for (uint32_t a = 0; a < arcs->size(); ++a) {
    const uint32_t begin = arcs->start[a], end = arcs->start[a + 1] - 1;
    const bool backward = chains.arc_backward[a] != 0;
    double length_so_far = 0.0;
    const auto add = [&](uint32_t vertex, uint32_t of_curve) {
      if (path.size() > start.back()) {
        length_so_far += length(arcs->vertex[vertex] - arcs->vertex[path.back()]);
      }
      path.push_reserved(vertex);
      curve.push_reserved(of_curve);
      along.push_reserved(length_so_far);
    };
    for (uint32_t i = begin; i < end; ++i) {
      add(arcs->path[i], arcs->curve[i]);
      const uint32_t place = chains.arc_place[a] + (backward ? end - 1 - i : i - begin);
      const uint32_t low = first[place], count = first[place + 1] - low;
      for (uint32_t k = 0; k < count; ++k) {
        add(backward ? low + count - 1 - k : low + k, arcs->curve[i]);
      }
    }
    add(arcs->path[end], arcs->curve[end]);
    start.push_reserved(static_cast<uint32_t>(path.size()));
  }
  arcs->start = static_cast<Array<uint32_t>&&>(start);
  arcs->path = static_cast<Array<uint32_t>&&>(path);
  arcs->curve = static_cast<Array<uint32_t>&&>(curve);
  arcs->along = static_cast<Array<double>&&>(along);
  return {};
}

Status bend_arcs(Context& context, double step, Arcs* arcs) {
  Chains chains(context);
  Array<uint32_t> first(context);
  TRY(find_chains(context, *arcs, 0.0, &chains));
  TRY(bend_chains(context, chains, step, arcs, &first));
  return first.back() == first[0] ? Status{} : lengthen_paths(chains, first.span(), arcs);
}

}  // namespace wireskin::flow
