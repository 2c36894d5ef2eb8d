#include "planar/constrained_delaunay.h"

#include "base/sort.h"
#include "num/minmax.h"
#include "num/predicates.h"
#include "planar/cavity_side.h"

namespace wireskin::planar {

static constexpr uint32_t k_paired =
    0x80000000u;  // CavityEdge::beyond: the partner's place follows

static Status touching() {
  return fail(Code::patch_folded, "a vertex of the border lies on another of its edges");
}

static void constrain(Triangulation* t, uint32_t h, bool border) {
  const uint32_t g = t->twin(h);
  const uint32_t sides[2] = {h, g};
  for (const uint32_t side : sides) {
    if (side == k_none) continue;
    uint32_t& flags = t->triangles[side >> 2].flags;
    flags |= 1u << (side & 3);
    if (border) flags ^= k_border << (side & 3);
  }
}

// A triangle without neighbours in a slot whose place in the queue of refine stays valid.
static void set_triangle(Triangulation* t, uint32_t slot, uint32_t a, uint32_t b, uint32_t c) {
  Triangle& triangle = t->triangles[slot];
  triangle = {{a, b, c}, {k_none, k_none, k_none}, triangle.flags & k_queued, 0};
  t->leaving[a] = 4 * slot;
  t->leaving[b] = 4 * slot + 1;
  t->leaving[c] = 4 * slot + 2;
}

Status begin_box(Span<const Vec2> points, Triangulation* t) {
  Vec2 low = points[0];
  Vec2 high = points[0];
  double reach = 0.0;
  for (const Vec2& p : points) {
    low = {p.x < low.x ? p.x : low.x, p.y < low.y ? p.y : low.y};
    high = {p.x > high.x ? p.x : high.x, p.y > high.y ? p.y : high.y};
    reach = larger(reach, larger(std::fabs(p.x), std::fabs(p.y)));
  }
  // Wide enough that subtracting it changes every coordinate, even those of a single point.
  double margin = larger(high.x - low.x, high.y - low.y);
  margin = larger(margin, larger(0x1p-40 * reach, k_least_coordinate));
  TRY(t->points.reserve(points.size() + k_box_corners));
  TRY(t->leaving.resize(k_box_corners));
  TRY(t->triangles.resize(2));
  t->points.clear();
  t->points.push_reserved({low.x - margin, low.y - margin});
  t->points.push_reserved({high.x + margin, low.y - margin});
  t->points.push_reserved({high.x + margin, high.y + margin});
  t->points.push_reserved({low.x - margin, high.y + margin});
  t->triangles[0].flags = t->triangles[1].flags = 0;
  set_triangle(t, 0, 0, 1, 2);
  set_triangle(t, 1, 0, 2, 3);
  link(t, 2, 4);
  t->hint = 0;
  t->dice = 1;
  return {};
}

static uint32_t throw_dice(Triangulation* t) {
  t->dice = t->dice * 1664525u + 1013904223u;  // W. H. Press et al., "Numerical Recipes", 1992
  return t->dice >> 31;
}

// Where p lies in or on the triangle; `hidden` with the edge beyond which it lies otherwise. Edge
// `entry` has p on the inner side.
static Location place_in_triangle(Triangulation* t, const Vec2& p, uint32_t triangle,
                                  uint32_t entry) {
  uint32_t zero[3];
  int zeros = 0;
  const uint32_t turn = throw_dice(t);
  for (uint32_t i = 0; i < 3; ++i) {
    // Either direction round the triangle, so that a walk cannot run in a circle for ever.
    const uint32_t h = 4 * triangle + (turn != 0 ? i : 2 - i);
    if (h == entry) continue;
    const double side = orient2d(t->points[t->start(h)], t->points[t->end(h)], p);
    if (side < 0.0) return {Where::hidden, h};
    if (side == 0.0) zero[zeros++] = h;
  }
  if (zeros == 0) return {Where::inside, 4 * triangle};
  if (zeros == 1) return {Where::on_edge, zero[0]};
  // The vertex is where the second of the two edges, in counter-clockwise order, begins.
  return {Where::on_vertex, Triangulation::next(zero[0]) == zero[1] ? zero[1] : zero[0]};
}

Location locate(Triangulation* t, const Vec2& p, uint32_t triangle, bool stop_at_constraints) {
  uint32_t entry = k_none;
  const size_t most_steps = 4 * t->triangles.size() + 64;
  for (size_t step = 0; step < most_steps; ++step) {
    const Location location = place_in_triangle(t, p, triangle, entry);
    if (location.where != Where::hidden) return location;
    const uint32_t beyond = t->twin(location.edge);
    if (beyond == k_none) return location;
    if (stop_at_constraints && t->constrained(location.edge)) return location;
    triangle = beyond >> 2;
    entry = beyond;
  }
  if (stop_at_constraints) return {Where::hidden, entry};
  // A walk this long is a streak of bad luck; looking at every triangle always ends.
  for (uint32_t i = 0; i < t->triangles.size(); ++i) {
    const Location location = place_in_triangle(t, p, i, k_none);
    if (location.where != Where::hidden) return location;
  }
  return {Where::hidden, entry};
}

static bool in_circumcircle(const Triangulation& t, uint32_t triangle, const Vec2& p) {
  const uint32_t* v = t.triangles[triangle].vertex;
  return incircle(t.points[v[0]], t.points[v[1]], t.points[v[2]], p) > 0.0;
}

// The triangles whose circumcircle holds p form a tree across their common edges, because p sees
// all of them and none of their edges twice. Walking it depth first, counter-clockwise, gives the
// outline in order.
Status collect_cavity(Triangulation* t, const Vec2& p, uint32_t triangle) {
  t->outline.clear();
  t->cavity.clear();
  t->stack.clear();
  TRY(t->cavity.push(triangle));
  for (uint32_t i = 3; i-- > 0;) TRY(t->stack.push(4 * triangle + i));
  while (!t->stack.empty()) {
    const uint32_t h = t->stack.back();
    const uint32_t g = t->twin(h);
    t->stack.pop();
    if (g == k_none || t->constrained(h) || !in_circumcircle(*t, g >> 2, p)) {
      TRY(t->outline.push({t->start(h), g, t->edge_bits(h)}));
      continue;
    }
    TRY(t->cavity.push(g >> 2));
    TRY(t->stack.push(Triangulation::previous(g)));
    TRY(t->stack.push(Triangulation::next(g)));
  }
  return {};
}

Status fill_cavity(Triangulation* t, const Vec2& p) {
  const size_t count = t->outline.size();
  WIRESKIN_ASSERT(count == t->cavity.size() + 2);
  if (t->points.size() >= k_most_vertices) {
    return fail(Code::too_large, "the triangulation has too many vertices for its indices");
  }
  const uint32_t vertex = static_cast<uint32_t>(t->points.size());
  TRY(t->points.push(p));
  TRY(t->leaving.push(k_none));
  for (int i = 0; i < 2; ++i) {
    TRY(t->cavity.push(static_cast<uint32_t>(t->triangles.size())));
    TRY(t->triangles.push({}));
  }
  for (size_t i = 0; i < count; ++i) {
    const CavityEdge& edge = t->outline[i];
    const uint32_t slot = t->cavity[i];
    set_triangle(t, slot, vertex, edge.vertex, t->outline[i + 1 < count ? i + 1 : 0].vertex);
    link(t, 4 * slot + 1, edge.beyond);
    t->triangles[slot].flags |= edge.bits << 1;
  }
  for (size_t i = 0; i < count; ++i) {
    link(t, 4 * t->cavity[i] + 2, 4 * t->cavity[i + 1 < count ? i + 1 : 0]);
  }
  t->hint = t->cavity[0];
  return {};
}

Status insert_point(Triangulation* t, const Vec2& p) {
  const Location location = locate(t, p, t->hint, false);
  if (location.where == Where::on_vertex) {
    return fail(Code::patch_folded, "two points of the border coincide");
  }
  if (location.where == Where::on_edge && t->constrained(location.edge)) return touching();
  if (location.where == Where::hidden) {
    return fail(Code::bad_argument, "a point lies outside of the box that is triangulated");
  }
  TRY(collect_cavity(t, p, location.edge >> 2));
  return fill_cavity(t, p);
}

// Is u, a point on the line through a and b, on b's side of a?
static bool is_ahead(const Vec2& a, const Vec2& b, const Vec2& u) {
  if (b.x != a.x) return (b.x > a.x) == (u.x > a.x);
  return (b.y > a.y) == (u.y > a.y);
}

// The search round one end of a segment for its other end, or for the edge that it crosses first.
struct FanSearch {
  uint32_t from, to;
  uint32_t spoke;
  double side;  // of the spoke's end
};

static FanSearch begin_search(const Triangulation& t, uint32_t from, uint32_t to) {
  const uint32_t spoke = t.leaving[from];
  return {from, to, spoke, orient2d(t.points[from], t.points[to], t.points[t.end(spoke)])};
}

// Looks at one triangle. Sets *edge to the spoke where it ends in `to`, to the triangle's edge
// opposite to `from` where that is crossed; t->touched where the spoke lies on the segment.
static void search_step(Triangulation* t, FanSearch* search, uint32_t* edge) {
  const Vec2& from = t->points[search->from];
  const Vec2& to = t->points[search->to];
  const uint32_t h = search->spoke;
  if (t->end(h) == search->to) {
    *edge = h;
    return;
  }
  if (search->side == 0.0 && is_ahead(from, to, t->points[t->end(h)])) {
    t->touched = t->end(h);
    return;
  }
  const double next_side = orient2d(from, to, t->points[t->apex(h)]);
  // The triangle's angle at `from` is below 180 degrees, so right-then-left means ahead of it.
  if (search->side < 0.0 && next_side > 0.0) *edge = Triangulation::next(h);
  search->side = next_side;
  search->spoke = t->turn(h);
}

// The edge a-b where it exists already, else the edge that the segment crosses first, seen from one
// of its ends. Both ends are searched in turns, so that a vertex of many edges costs nothing.
static Status first_crossing(Triangulation* t, uint32_t a, uint32_t b, uint32_t* edge) {
  FanSearch searches[2] = {begin_search(*t, a, b), begin_search(*t, b, a)};
  t->touched = t->crossed = k_none;
  for (size_t step = 0; step < 6 * t->triangles.size(); ++step) {
    search_step(t, &searches[step & 1], edge);
    if (t->touched != k_none) return touching();
    if (*edge != k_none) return {};
  }
  return fail(Code::patch_folded, "the border crosses itself");
}

// Walks along a-b from its first crossing edge. Collects the crossed triangles in t->cavity and in
// t->chain the edges of both sides: first those on the left from a to b, then those on the right
// from b to a; `beyond` is for now the edge itself.
static Status collect_corridor(Triangulation* t, uint32_t a, uint32_t b, uint32_t crossing,
                               size_t* left_count) {
  const Vec2 pa = t->points[a];
  const Vec2 pb = t->points[b];
  t->cavity.clear();
  t->chain.clear();
  t->outline.clear();
  TRY(t->cavity.push(crossing >> 2));
  TRY(t->chain.push({a, Triangulation::next(crossing), 0}));
  TRY(t->outline.push({t->start(crossing), Triangulation::previous(crossing), 0}));
  for (uint32_t apex = k_none; apex != b;) {
    if (t->constrained(crossing)) {
      t->crossed = crossing;
      return fail(Code::patch_folded, "the border crosses itself");
    }
    const uint32_t g = t->twin(crossing);
    WIRESKIN_ASSERT(g != k_none && t->cavity.size() <= t->triangles.size());
    TRY(t->cavity.push(g >> 2));
    apex = t->apex(g);
    const double side = apex == b ? 0.0 : orient2d(pa, pb, t->points[apex]);
    if (side == 0.0 && apex != b) {
      t->touched = apex;
      return touching();
    }
    // g runs from the left to the right side; its triangle adds an edge on the side of its apex.
    if (side >= 0.0) TRY(t->chain.push({t->start(g), Triangulation::previous(g), 0}));
    if (side <= 0.0) TRY(t->outline.push({apex, Triangulation::next(g), 0}));
    crossing = side > 0.0 ? Triangulation::next(g) : Triangulation::previous(g);
  }
  *left_count = t->chain.size();
  for (size_t i = t->outline.size(); i-- > 0;) TRY(t->chain.push(t->outline[i]));
  return {};
}

// Replaces each chain edge by what lies beyond it. An edge that hangs into the corridor has the
// chain on both sides; there, the two places in the chain refer to each other.
static void look_beyond(Triangulation* t, Span<CavityEdge> chain) {
  for (uint32_t i = 0; i < chain.size(); ++i) t->triangles[chain[i].beyond >> 2].mark = i;
  for (CavityEdge& edge : chain) edge.bits = t->edge_bits(edge.beyond);
  for (uint32_t i = 0; i < chain.size(); ++i) {
    const uint32_t h = chain[i].beyond;
    if ((h & k_paired) != 0) continue;
    const uint32_t g = t->twin(h);
    const uint32_t partner = g == k_none ? k_none : t->triangles[g >> 2].mark;
    if (partner < chain.size() && chain[partner].beyond == g) {
      chain[i].beyond = k_paired | partner;
      chain[partner].beyond = k_paired | i;
    }
  }
  for (CavityEdge& edge : chain) {
    if ((edge.beyond & k_paired) == 0) edge.beyond = t->twin(edge.beyond);
  }
}

static void attach(Triangulation* t, Span<CavityEdge> chain, uint32_t place, uint32_t h) {
  const CavityEdge edge = chain[place];
  if (edge.beyond != k_none && (edge.beyond & k_paired) != 0) {
    chain[edge.beyond & ~k_paired].beyond =
        h;  // the partner, when its turn comes, will link the two
  } else {
    link(t, h, edge.beyond);
  }
  t->triangles[h >> 2].flags |= edge.bits << (h & 3);
}

// Triangulates the region between a chain and the segment that closes it, which ends at vertex
// `closing`, in the slots that `*slot` runs through. Returns the half-edge along the segment.
static Status fill_side(Triangulation* t, Span<CavityEdge> chain, uint32_t closing,
                        SideTriangles* side, size_t* slot, uint32_t* base) {
  const uint32_t count = static_cast<uint32_t>(chain.size());
  TRY(side->points.resize(size_t{count} + 1));
  for (uint32_t i = 0; i <= count; ++i) {
    side->points[i] = t->points[i < count ? chain[i].vertex : closing];
  }
  TRY(triangulate_side(side));
  const size_t first = *slot;
  const auto global = [&](uint32_t h) {
    return h == k_none ? k_none : 4 * t->cavity[first + (h >> 2)] + (h & 3);
  };
  for (const SideTriangle& triangle : side->triangles) {
    uint32_t v[3];
    for (int i = 0; i < 3; ++i) {
      v[i] = triangle.vertex[i] < count ? chain[triangle.vertex[i]].vertex : closing;
    }
    set_triangle(t, t->cavity[(*slot)++], v[0], v[1], v[2]);
  }
  for (size_t i = 0; i < side->triangles.size(); ++i) {
    for (uint32_t k = 0; k < 3; ++k) {
      const uint32_t g = global(side->triangles[i].twin[k]);
      if (g != k_none) t->triangles[t->cavity[first + i]].twin[k] = g;
    }
  }
  for (uint32_t i = 0; i < count; ++i) attach(t, chain, i, global(side->inner[i]));
  *base = global(side->inner[count]);
  return {};
}

Status recover_edge(Triangulation* t, uint32_t a, uint32_t b, bool border) {
  uint32_t edge = k_none;
  TRY(first_crossing(t, a, b, &edge));
  const uint32_t start = t->start(edge), end = t->end(edge);
  if ((start == a && end == b) || (start == b && end == a)) {
    constrain(t, edge, border);
    return {};
  }
  if (t->apex(edge) == b) swap_values(a, b);
  size_t left_count = 0;
  TRY(collect_corridor(t, a, b, edge, &left_count));
  const Span<CavityEdge> left = t->chain.span().part(0, left_count);
  const Span<CavityEdge> right = t->chain.span().part(left_count, t->chain.size() - left_count);
  SideTriangles side(t->points.context());
  look_beyond(t, left);
  look_beyond(t, right);
  size_t slot = 0;
  uint32_t left_base = k_none, right_base = k_none;
  TRY(fill_side(t, left, b, &side, &slot, &left_base));
  TRY(fill_side(t, right, a, &side, &slot, &right_base));
  WIRESKIN_ASSERT(slot == t->cavity.size());
  link(t, left_base, right_base);
  constrain(t, left_base, border);
  t->hint = left_base >> 2;
  return {};
}

void flip(Triangulation* t, uint32_t h) {
  const uint32_t g = t->twin(h);
  const uint32_t h1 = Triangulation::next(h);
  const uint32_t g1 = Triangulation::next(g);
  Triangle& th = t->triangles[h >> 2];
  Triangle& tg = t->triangles[g >> 2];
  const uint32_t beyond_h1 = t->twin(h1);
  const uint32_t beyond_g1 = t->twin(g1);
  const uint32_t h1_bits = t->edge_bits(h1);
  const uint32_t g1_bits = t->edge_bits(g1);
  const uint32_t a = t->start(h), b = t->start(g), c = t->apex(h), d = t->apex(g);
  th.vertex[h1 & 3] = d;
  tg.vertex[g1 & 3] = c;
  link(t, h, beyond_g1);
  link(t, g, beyond_h1);
  link(t, h1, g1);
  const uint32_t h_mask = k_edge_bits << (h & 3) | k_edge_bits << (h1 & 3);
  const uint32_t g_mask = k_edge_bits << (g & 3) | k_edge_bits << (g1 & 3);
  th.flags = (th.flags & ~h_mask) | g1_bits << (h & 3);
  tg.flags = (tg.flags & ~g_mask) | h1_bits << (g & 3);
  t->leaving[a] = h;
  t->leaving[b] = g;
  t->leaving[c] = g1;
  t->leaving[d] = h1;
}

Status mark_outside(Triangulation* t) {
  // A triangle enters the stack once, when it is reached.
  TRY(t->stack.reserve(t->triangles.size()));
  t->stack.clear();
  for (Triangle& triangle : t->triangles) triangle.mark = 0;
  const uint32_t seed = t->leaving[0] >> 2;
  t->triangles[seed].flags |= k_outside;
  t->triangles[seed].mark = 1;
  t->stack.push_reserved(seed);
  while (!t->stack.empty()) {
    const uint32_t triangle = t->stack.back();
    const uint32_t flags = t->triangles[triangle].flags;
    t->stack.pop();
    for (uint32_t i = 0; i < 3; ++i) {
      const uint32_t g = t->twin(4 * triangle + i);
      if (g == k_none || t->triangles[g >> 2].mark != 0) continue;
      const bool divides = (flags & k_border << i) != 0;
      const bool outside = ((flags & k_outside) != 0) != divides;
      t->triangles[g >> 2].mark = 1;
      if (outside) t->triangles[g >> 2].flags |= k_outside;
      t->stack.push_reserved(g >> 2);
    }
  }
  return {};
}

}  // namespace wireskin::planar
