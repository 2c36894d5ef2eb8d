#include "network/approach.h"

#include "base/in_parts.h"
#include "network/box_tree.h"
#include "num/minmax.h"

namespace wireskin::network {

// A cubic over [0, 1] in Hermite form.
struct EdgeCubic {
  Vec3 from, to, slope_from, slope_to;

  Vec3 at(double t) const {
    const double u = 1.0 - t;
    return (u * u * (1.0 + 2.0 * t)) * from + (t * t * (3.0 - 2.0 * t)) * to +
           (u * u * t) * slope_from - (u * t * t) * slope_to;
  }
  Vec3 derivative(double t) const {
    const double u = 1.0 - t;
    return (6.0 * t * u) * (to - from) + (u * (u - 2.0 * t)) * slope_from +
           (t * (t - 2.0 * u)) * slope_to;
  }
};

// The derivative by chord length at b of the parabola through a, b, c; zero at a corner.
static Vec3 parabola_slope(const Vec3& a, const Vec3& b, const Vec3& c) {
  constexpr double k_least_cosine = 0.7;
  const double before = length(b - a), after = length(c - b);
  if (!(before > 0.0 && after > 0.0)) return {};
  if (dot(b - a, c - b) < k_least_cosine * before * after) return {};
  const double sum = before + after;
  return (after / (sum * before)) * (b - a) + (before / (sum * after)) * (c - b);
}

static EdgeCubic cubic_of_edge(const Wires& wires, uint32_t curve, uint32_t i) {
  const uint32_t j = wires.next(curve, i), before = wires.previous(curve, i);
  const uint32_t after = wires.next(curve, j);
  const Vec3 &p = wires.position[i], &q = wires.position[j];
  const Vec3 chord = q - p;
  const double size = length(chord);
  Vec3 first, last;
  if (before != k_none && before != j) first = parabola_slope(wires.position[before], p, q);
  if (after != k_none && after != i) last = parabola_slope(p, q, wires.position[after]);
  first = size * first;
  last = size * last;
  // Where one side is free or a corner, the parabola of the other side goes on.
  const bool no_first = first == Vec3{}, no_last = last == Vec3{};
  if (no_first) first = no_last ? chord : 2.0 * chord - last;
  if (no_last) last = no_first ? chord : 2.0 * chord - first;
  return {p, q, first, last};
}

Vec3 point_of_place(const Wires& wires, uint32_t curve, const WirePlace& place) {
  if (place.part == 0.0) return wires.position[place.edge];
  return cubic_of_edge(wires, curve, place.edge).at(place.part);
}

// ---- Pairs of edges -----------------------------------------------------------------------------

static double clamp_part(double t) {
  return t > 0.0 ? (t < 1.0 ? t : 1.0) : 0.0;
}

struct ChordApproach {
  double s = 0.0, t = 0.0, distance = 0.0;
};

// The nearest points of two straight edges (C. Ericson, "Real-Time Collision Detection",
// 2005, 5.1.9).
static ChordApproach nearest_of_chords(const Vec3& p, const Vec3& p_end, const Vec3& q,
                                       const Vec3& q_end) {
  const Vec3 d = p_end - p, e = q_end - q, r = p - q;
  const double a = dot(d, d), b = dot(d, e), c = dot(d, r), f = dot(e, r), g = dot(e, e);
  const double determinant = a * g - b * b;
  ChordApproach result;
  if (a > 0.0 && determinant > 1e-14 * a * g) result.s = clamp_part((b * f - c * g) / determinant);
  if (g > 0.0) result.t = (b * result.s + f) / g;
  if (!(result.t > 0.0)) {
    result.t = 0.0;
    result.s = a > 0.0 ? clamp_part(-c / a) : 0.0;
  } else if (result.t > 1.0) {
    result.t = 1.0;
    result.s = a > 0.0 ? clamp_part((b - c) / a) : 0.0;
  }
  result.distance = length(r + result.s * d - result.t * e);
  return result;
}

struct EdgeSet {
  const Wires& wires;
  Span<const uint32_t> curve;

  uint32_t next(uint32_t i) const { return wires.next(curve[i], i); }
  uint32_t previous(uint32_t i) const { return wires.previous(curve[i], i); }
  ChordApproach chords(uint32_t a, uint32_t b) const {
    return nearest_of_chords(wires.position[a], wires.position[next(a)], wires.position[b],
                             wires.position[next(b)]);
  }
  // Whether all of edge b lies beyond the end of edge a, where another edge begins, to which that
  // end belongs. So lie most edges of a curve to each other, and of curves side by side.
  bool lies_beyond(uint32_t a, uint32_t b) const {
    const Vec3 end = wires.position[next(a)], along = end - wires.position[a];
    return dot(wires.position[b] - end, along) > 0.0 &&
           dot(wires.position[next(b)] - end, along) > 0.0 && next(next(a)) != k_none;
  }
  bool share_a_sample(uint32_t a, uint32_t b) const {
    return a == b || next(a) == b || next(b) == a || next(a) == next(b);
  }
};

// The edges at a place: two where it is a sample inside a curve.
struct EdgesAtPlace {
  uint32_t edge[2];
  uint32_t count;
};

static EdgesAtPlace edges_at(const EdgeSet& edges, uint32_t edge, double part) {
  EdgesAtPlace result = {{edge, k_none}, 1};
  uint32_t other = k_none;
  if (part == 0.0) other = edges.previous(edge);
  if (part == 1.0 && edges.next(edges.next(edge)) != k_none) other = edges.next(edge);
  if (other != k_none) result.edge[result.count++] = other;
  return result;
}

// Whether none of the other edges at the two places come nearer. What differs by rounding only is
// no nearer: at a sample that lies on the other curve either of its edges could win, and the one
// that does not own the sample would be dropped.
static bool is_least(const EdgeSet& edges, uint32_t a, uint32_t b, const ChordApproach& chords) {
  constexpr double k_rounding = 1e-13;  // the extent is about one
  const EdgesAtPlace at_a = edges_at(edges, a, chords.s), at_b = edges_at(edges, b, chords.t);
  for (uint32_t i = 0; i < at_a.count; ++i) {
    for (uint32_t k = 0; k < at_b.count; ++k) {
      if (i + k == 0) continue;
      const uint32_t e = at_a.edge[i], f = at_b.edge[k];
      if (edges.share_a_sample(e, f)) return false;
      if (edges.chords(e, f).distance < chords.distance * (1.0 - 1e-9) - k_rounding) return false;
    }
  }
  return true;
}

// Steps to the nearest points of the linearised cubics, as long as that helps.
static void refine(const EdgeCubic& p, const EdgeCubic& q, ChordApproach* approach) {
  constexpr int k_steps = 12;
  approach->distance = length(p.at(approach->s) - q.at(approach->t));
  for (int step = 0; step < k_steps; ++step) {
    const Vec3 r = p.at(approach->s) - q.at(approach->t);
    const Vec3 d = p.derivative(approach->s), e = q.derivative(approach->t);
    const double a = dot(d, d), b = dot(d, e), c = dot(d, r), f = dot(e, r), g = dot(e, e);
    const double determinant = a * g - b * b;
    if (!(a > 0.0 && g > 0.0)) return;
    ChordApproach next = *approach;
    if (determinant > 1e-6 * a * g) next.s += (b * f - c * g) / determinant;
    next.s = clamp_part(next.s);
    next.t = clamp_part(next.t + (f + b * (next.s - approach->s)) / g);
    next.s = clamp_part(approach->s + (b * (next.t - approach->t) - c) / a);
    next.distance = length(p.at(next.s) - q.at(next.t));
    if (!(next.distance < approach->distance)) return;
    *approach = next;
  }
}

WirePlace nearest_on_edge(const Wires& wires, uint32_t curve, uint32_t i, const Vec3& target) {
  const EdgeCubic cubic = cubic_of_edge(wires, curve, i);
  ChordApproach approach = nearest_of_chords(cubic.from, cubic.to, target, target);
  approach.distance = length(cubic.at(approach.s) - target);
  for (int step = 0; step < 12; ++step) {
    const Vec3 d = cubic.derivative(approach.s);
    if (!(dot(d, d) > 0.0)) break;
    const double s = clamp_part(approach.s + dot(target - cubic.at(approach.s), d) / dot(d, d));
    const double distance = length(cubic.at(s) - target);
    if (!(distance < approach.distance)) break;
    approach = {s, 0.0, distance};
  }
  if (approach.s < 1.0) return {i, approach.s};
  return {wires.next(curve, i), 0.0};
}

// How far the cubic of an edge leaves its chord, about.
static double bulge_of_edge(const Wires& wires, uint32_t curve, uint32_t i) {
  const EdgeCubic cubic = cubic_of_edge(wires, curve, i);
  return 1.5 * length(cubic.at(0.5) - 0.5 * (cubic.from + cubic.to));
}

static Status compare_pair(const EdgeSet& edges, Span<const double> bulge, double reach, uint32_t a,
                           uint32_t b, Array<Approach>* approaches) {
  const Wires& wires = edges.wires;
  if (edges.share_a_sample(a, b)) return {};
  if (edges.lies_beyond(a, b) || edges.lies_beyond(b, a)) return {};
  ChordApproach chords = edges.chords(a, b);
  if (!(chords.distance <= reach + bulge[a] + bulge[b])) return {};
  // The sample between two edges belongs to the later one.
  if (chords.s == 1.0 && edges.next(edges.next(a)) != k_none) return {};
  if (chords.t == 1.0 && edges.next(edges.next(b)) != k_none) return {};
  if (!is_least(edges, a, b, chords)) return {};
  refine(cubic_of_edge(wires, edges.curve[a], a), cubic_of_edge(wires, edges.curve[b], b), &chords);
  if (!(chords.distance <= reach)) return {};
  Approach found;
  found.a = chords.s < 1.0 ? WirePlace{a, chords.s} : WirePlace{edges.next(a), 0.0};
  found.b = chords.t < 1.0 ? WirePlace{b, chords.t} : WirePlace{edges.next(b), 0.0};
  found.at_a = point_of_place(wires, edges.curve[a], found.a);
  found.at_b = point_of_place(wires, edges.curve[b], found.b);
  found.distance = length(found.at_a - found.at_b);
  return approaches->push(found);
}

// Sixty within reach of each edge of a curve of a million samples.
static constexpr uint64_t k_most_pairs = 1u << 26;

// Drawings have less than one for a sample, with every line drawn many times a few. All lines of a
// lattice cross, however few their samples; but thousands of curves that all come near each other
// are a tangle.
static size_t most_approaches(const Wires& wires) {
  constexpr uint64_t k_most_for_a_sample = 16, k_most_of_a_lattice = 1u << 18;
  const uint64_t pairs = uint64_t{wires.curves()} * wires.curves() / 2;
  return static_cast<size_t>(k_most_for_a_sample * wires.samples() +
                             (pairs < k_most_of_a_lattice ? pairs : k_most_of_a_lattice));
}

// Rounding must not part boxes of edges that just reach each other.
static Vec3 slack_at(const Vec3& p, double margin) {
  constexpr double k_rounding = 1e-15;
  const double own = (1.0 + 1e-9) * margin;
  return {own + k_rounding * std::fabs(p.x), own + k_rounding * std::fabs(p.y),
          own + k_rounding * std::fabs(p.z)};
}

static Box box_of_edge(const Vec3& p, const Vec3& q, double margin) {
  const Vec3 low = {smaller(p.x, q.x), smaller(p.y, q.y), smaller(p.z, q.z)};
  const Vec3 high = {larger(p.x, q.x), larger(p.y, q.y), larger(p.z, q.z)};
  return {low - slack_at(low, margin), high + slack_at(high, margin)};
}

Status find_approaches(const Wires& wires, Span<const uint32_t> curve, double reach,
                       Array<Approach>* approaches) {
  constexpr size_t k_steps_of_search = 8;
  Context& context = wires.position.context();
  const EdgeSet edges = {wires, curve};
  Array<double> bulge(context);
  Array<Box> box(context);
  Array<uint32_t> sample(context), near(context);
  BoxTree tree(context);
  TRY(assign_in_parts(wires.samples(), 0.0, &bulge));
  TRY(box.reserve(wires.samples()));
  TRY(sample.reserve(wires.samples()));
  TRY(in_parts(context, wires.samples(), [&](size_t s) {
    const uint32_t i = static_cast<uint32_t>(s), next = edges.next(i);
    if (next == k_none) return;
    bulge[i] = bulge_of_edge(wires, curve[i], i);
    const double margin = 0.5 * reach + bulge[i];
    box.push_reserved(box_of_edge(wires.position[i], wires.position[next], margin));
    sample.push_reserved(i);
  }));
  TRY(tree.build(box.span()));
  const size_t most = most_approaches(wires);
  uint64_t pairs = 0;
  Pace pace(context);
  for (uint32_t e = 0; e < box.size(); ++e) {
    TRY(tree.find(box[e], e, &near));
    TRY(pace.after(k_steps_of_search));
    pairs += near.size();
    if (pairs > k_most_pairs) {
      return fail(Code::bad_argument,
                  "the snapping tolerance covers too many samples: give a smaller one");
    }
    TRY(make_room_in_parts(near.size(), approaches));
    for (const uint32_t other : near) {
      TRY(compare_pair(edges, bulge.span(), reach, sample[e], sample[other], approaches));
      TRY(pace.after());
    }
    if (approaches->size() > most) {
      return fail(Code::bad_argument,
                  "the curves come within the snapping tolerance of each other in too many places: "
                  "give a smaller one");
    }
  }
  return {};
}

}  // namespace wireskin::network
