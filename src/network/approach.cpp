#include "network/approach.h"

#include "base/sort.h"

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

// ---- The grid -----------------------------------------------------------------------------------

struct CellEntry {
  uint64_t cell;
  uint32_t edge;
};

struct EdgePair {
  uint32_t a, b;
};

struct Grid {
  Vec3 low;
  double cell;

  uint64_t index(double x, double origin) const {
    const double steps = (x - origin) / cell;
    constexpr double k_last = 2097151.0;  // three times 21 bits
    return static_cast<uint64_t>(steps > 0.0 ? (steps < k_last ? steps : k_last) : 0.0);
  }
  static uint64_t key(uint64_t x, uint64_t y, uint64_t z) { return x << 42 | y << 21 | z; }
};

// Puts an edge into every cell within `radius` of its pieces, none of which is longer than a cell.
static Status enter_edge(const Grid& grid, const Vec3& p, const Vec3& q, double radius,
                         uint32_t edge, Array<CellEntry>* entries) {
  const double pieces_needed = length(q - p) / grid.cell;
  const uint32_t pieces = 1 + static_cast<uint32_t>(pieces_needed < 4e9 ? pieces_needed : 4e9);
  for (uint32_t k = 0; k < pieces; ++k) {
    const Vec3 a = p + (static_cast<double>(k) / pieces) * (q - p);
    const Vec3 b = p + (static_cast<double>(k + 1) / pieces) * (q - p);
    const auto low = [&](double u, double v, double o) {
      return grid.index((u < v ? u : v) - radius, o);
    };
    const auto high = [&](double u, double v, double o) {
      return grid.index((u > v ? u : v) + radius, o);
    };
    for (uint64_t x = low(a.x, b.x, grid.low.x); x <= high(a.x, b.x, grid.low.x); ++x) {
      for (uint64_t y = low(a.y, b.y, grid.low.y); y <= high(a.y, b.y, grid.low.y); ++y) {
        for (uint64_t z = low(a.z, b.z, grid.low.z); z <= high(a.z, b.z, grid.low.z); ++z) {
          TRY(entries->push({Grid::key(x, y, z), edge}));
        }
      }
    }
  }
  return {};
}

// How far the cubic of an edge leaves its chord, about.
static double bulge_of_edge(const Wires& wires, uint32_t curve, uint32_t i) {
  const EdgeCubic cubic = cubic_of_edge(wires, curve, i);
  return 1.5 * length(cubic.at(0.5) - 0.5 * (cubic.from + cubic.to));
}

static Grid grid_of(const Wires& wires, const EdgeSet& edges, double reach, double bulge) {
  Grid grid = {wires.position[0], 0.0};
  double sum = 0.0;
  uint32_t count = 0;
  for (uint32_t i = 0; i < wires.samples(); ++i) {
    const Vec3& p = wires.position[i];
    Vec3& low = grid.low;
    low = {p.x < low.x ? p.x : low.x, p.y < low.y ? p.y : low.y, p.z < low.z ? p.z : low.z};
    const uint32_t j = edges.next(i);
    if (j == k_none) continue;
    sum += length(wires.position[j] - p);
    ++count;
  }
  const double mean = count > 0 ? sum / count : 0.0;
  const double widest = reach + 2.0 * bulge;
  grid.cell = mean > widest ? mean : widest;
  constexpr double k_least = 1.0 / 1048576.0;  // the extent is about one, an index has 21 bits
  if (!(grid.cell > k_least)) grid.cell = k_least;
  return grid;
}

// Pairs of edges that share a cell, each once.
static Status pairs_of_cells(Array<CellEntry>* entries, Array<EdgePair>* pairs) {
  Context& context = entries->context();
  sort(entries->span(), [](const CellEntry& x, const CellEntry& y) {
    return x.cell != y.cell ? x.cell < y.cell : x.edge < y.edge;
  });
  size_t kept = 0;  // pieces of one edge may share a cell
  for (const CellEntry& entry : *entries) {
    const CellEntry* last = kept > 0 ? &(*entries)[kept - 1] : nullptr;
    if (last != nullptr && last->cell == entry.cell && last->edge == entry.edge) continue;
    (*entries)[kept++] = entry;
  }
  entries->shrink(kept);
  for (size_t first = 0, end = 0; first < entries->size(); first = end) {
    while (end < entries->size() && (*entries)[end].cell == (*entries)[first].cell) ++end;
    for (size_t i = first; i < end; ++i) {
      for (size_t k = i + 1; k < end; ++k) {
        TRY(pairs->push({(*entries)[i].edge, (*entries)[k].edge}));
      }
      if (i % 256 == 255) TRY(context.checkpoint());
    }
  }
  const auto less = [](const EdgePair& x, const EdgePair& y) {
    return x.a != y.a ? x.a < y.a : x.b < y.b;
  };
  sort(pairs->span(), less);
  kept = 0;  // and edges several cells
  for (const EdgePair& pair : *pairs) {
    if (kept > 0 && !less((*pairs)[kept - 1], pair)) continue;
    (*pairs)[kept++] = pair;
  }
  pairs->shrink(kept);
  return {};
}

static Status compare_pair(const EdgeSet& edges, Span<const double> bulge, double reach,
                           const EdgePair& pair, Array<Approach>* approaches) {
  const Wires& wires = edges.wires;
  const uint32_t a = pair.a, b = pair.b;
  if (edges.share_a_sample(a, b)) return {};
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

Status find_approaches(const Wires& wires, Span<const uint32_t> curve, double reach,
                       Array<Approach>* approaches) {
  Context& context = wires.position.context();
  const EdgeSet edges = {wires, curve};
  Array<double> bulge(context);
  Array<CellEntry> entries(context);
  Array<EdgePair> pairs(context);
  TRY(bulge.assign(wires.samples(), 0.0));
  double greatest = 0.0;
  for (uint32_t i = 0; i < wires.samples(); ++i) {
    if (edges.next(i) == k_none) continue;
    bulge[i] = bulge_of_edge(wires, curve[i], i);
    greatest = bulge[i] > greatest ? bulge[i] : greatest;
  }
  const Grid grid = grid_of(wires, edges, reach, greatest);
  for (uint32_t i = 0; i < wires.samples(); ++i) {
    if (edges.next(i) == k_none) continue;
    TRY(enter_edge(grid, wires.position[i], wires.position[edges.next(i)], 0.5 * reach + bulge[i],
                   i, &entries));
    if (i % 4096 == 4095) TRY(context.checkpoint());
  }
  TRY(pairs_of_cells(&entries, &pairs));
  entries.free();
  for (size_t k = 0; k < pairs.size(); ++k) {
    TRY(compare_pair(edges, bulge.span(), reach, pairs[k], approaches));
    if (k % 4096 == 4095) TRY(context.checkpoint());
  }
  return {};
}

}  // namespace wireskin::network
