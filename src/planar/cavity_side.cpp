#include "planar/cavity_side.h"

#include "num/predicates.h"

namespace wireskin::planar {

// Chains up to this many points are searched in full for each triangle.
static constexpr uint32_t k_short_chain = 24;

// A part of the chain still to be triangulated, and the half-edge that closes it from outside.
struct ChainRange {
  uint32_t first, last, parent;
};

// An edge as a new point sees it, and the half-edge on its far side; k_none at the region's rim.
struct SeenEdge {
  uint32_t from, to, beyond;
};

// A list of the chain's points that are present, and the triangles among them.
struct SideBuilder {
  explicit SideBuilder(Context& context)
      : next(context),
        previous(context),
        order(context),
        distance(context),
        stack(context),
        fan(context),
        spare(context),
        seen(context) {}

  Array<uint32_t> next, previous;
  Array<uint32_t> order;   // the points between the ends, the last to be reinserted last
  Array<double> distance;  // from the segment, times its length
  Array<uint32_t> stack;   // half-edges
  Array<uint32_t> fan;     // slots of the triangles round the new point
  Array<uint32_t> spare;
  Array<SeenEdge> seen;
  uint64_t dice = 0;
};

static void link_side(SideTriangles* side, uint32_t h, uint32_t g) {
  side->triangles[h >> 2].twin[h & 3] = g;
  side->triangles[g >> 2].twin[g & 3] = h;
}

static uint32_t side_start(const SideTriangles& side, uint32_t h) {
  return side.triangles[h >> 2].vertex[h & 3];
}

static uint32_t side_next(uint32_t h) {
  return (h & 3) == 2 ? h - 2 : h + 1;
}

static uint32_t side_previous(uint32_t h) {
  return (h & 3) == 0 ? h + 2 : h - 1;
}

// Notes that h runs along an edge of the region: towards the chain's start, or along the segment.
static void note_inner(SideTriangles* side, uint32_t h) {
  const uint32_t last = static_cast<uint32_t>(side->points.size()) - 1;
  const bool segment = side_start(*side, h) == 0 && side_start(*side, side_next(h)) == last;
  side->inner[segment ? last : side_start(*side, side_next(h))] = h;
}

// The point between places first and last of the chain whose circle with both holds no other.
static uint32_t delaunay_apex(Span<const Vec2> points, uint32_t first, uint32_t last) {
  const Vec2 a = points[first];
  const Vec2 b = points[last];
  uint32_t best = first + 1;
  for (uint32_t i = first + 2; i < last; ++i) {
    if (incircle(a, b, points[best], points[i]) > 0.0) best = i;
  }
  WIRESKIN_ASSERT(orient2d(a, b, points[best]) > 0.0);
  return best;
}

// Every point sees the segment, so the triangle on it that is empty of chain points is Delaunay,
// and the same holds for the two regions that it leaves.
static Status wrap_chain(SideTriangles* side) {
  const uint32_t last_point = static_cast<uint32_t>(side->points.size()) - 1;
  Array<ChainRange> ranges(side->points.context());
  side->triangles.clear();
  TRY(ranges.reserve(size_t{last_point} + 2));
  TRY(side->triangles.reserve(last_point));
  ranges.push_reserved({0, last_point, k_none});
  while (!ranges.empty()) {
    const ChainRange range = ranges.back();
    ranges.pop();
    if (range.last == range.first + 1) {
      side->inner[range.first] = range.parent;
      continue;
    }
    const uint32_t apex = delaunay_apex(side->points.span(), range.first, range.last);
    const uint32_t h = 4 * static_cast<uint32_t>(side->triangles.size());
    side->triangles.push_reserved({{range.first, range.last, apex}, {k_none, k_none, k_none}});
    if (range.parent == k_none) {
      side->inner[last_point] = h;
    } else {
      link_side(side, h, range.parent);
    }
    ranges.push_reserved({range.first, apex, h + 2});
    ranges.push_reserved({apex, range.last, h + 1});
  }
  return {};
}

// By lot, with the mixing of S. Vigna's splitmix64 (2015).
static uint32_t draw_below(SideBuilder* builder, uint32_t count) {
  uint64_t z = (builder->dice += 0x9e3779b97f4a7c15ull);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
  return static_cast<uint32_t>((z ^ (z >> 31)) % count);
}

static bool is_dent(const SideBuilder& builder, uint32_t point) {
  const double own = builder.distance[point];
  return own < builder.distance[builder.previous[point]] &&
         own < builder.distance[builder.next[point]];
}

// Takes all points but one off the list, by lot, never one that is nearer to the segment than both
// its neighbours, so that what remains still sees the segment.
static Status take_off(const SideTriangles& side, SideBuilder* builder) {
  const uint32_t last = static_cast<uint32_t>(side.points.size()) - 1;
  TRY(builder->next.resize(size_t{last} + 1));
  TRY(builder->previous.resize(size_t{last} + 1));
  TRY(builder->distance.resize(size_t{last} + 1));
  TRY(builder->order.resize(last - 1));
  for (uint32_t i = 0; i <= last; ++i) {
    builder->next[i] = i + 1;
    builder->previous[i] = i - 1;
    builder->distance[i] = orient2d(side.points[0], side.points[last], side.points[i]);
    if (i > 0 && i < last) builder->order[i - 1] = i;
  }
  for (uint32_t rest = last - 1; rest > 1; --rest) {
    uint32_t lot = draw_below(builder, rest);
    while (is_dent(*builder, builder->order[lot])) lot = lot + 1 < rest ? lot + 1 : 0;
    const uint32_t point = builder->order[lot];
    builder->order[lot] = builder->order[rest - 1];
    builder->order[rest - 1] = point;
    builder->next[builder->previous[point]] = builder->next[point];
    builder->previous[builder->next[point]] = builder->previous[point];
  }
  return {};
}

static bool is_left(const SideTriangles& side, uint32_t a, uint32_t b, uint32_t c) {
  return orient2d(side.points[a], side.points[b], side.points[c]) > 0.0;
}

// Does u lie inside the circle of the triangle of h?
static bool is_encircled(const SideTriangles& side, uint32_t h, uint32_t u) {
  const uint32_t* v = side.triangles[h >> 2].vertex;
  return incircle(side.points[v[0]], side.points[v[1]], side.points[v[2]], side.points[u]) > 0.0;
}

static void add_to_fan(SideTriangles* side, SideBuilder* builder, uint32_t u,
                       const SeenEdge& edge) {
  const uint32_t slot = builder->spare.back();
  builder->spare.pop();
  side->triangles[slot] = {{u, edge.from, edge.to}, {k_none, k_none, k_none}};
  if (edge.beyond != k_none) {
    link_side(side, 4 * slot + 1, edge.beyond);
  } else {
    note_inner(side, 4 * slot + 1);
  }
  builder->fan.push_reserved(slot);
}

// Puts u back between its neighbours: joins it with the outline of the triangles that give way.
// True if all of them did so because u lies inside their circles.
static bool reinsert(SideTriangles* side, SideBuilder* builder, uint32_t u) {
  const uint32_t before = builder->previous[u], after = builder->next[u];
  bool round = true;
  builder->next[before] = builder->previous[after] = u;
  builder->fan.clear();
  builder->seen.clear();
  builder->seen.push_reserved({before, after, side->inner[before]});
  while (!builder->seen.empty()) {
    const SeenEdge edge = builder->seen.back();
    builder->seen.pop();
    const uint32_t h = edge.beyond;
    const bool encircled = h != k_none && is_encircled(*side, h, u);
    if (h == k_none || (!encircled && is_left(*side, u, edge.from, edge.to))) {
      add_to_fan(side, builder, u, edge);
      continue;
    }
    round = round && encircled;
    const SideTriangle& gone = side->triangles[h >> 2];
    const uint32_t apex = side_start(*side, side_previous(h));
    builder->seen.push_reserved({apex, edge.to, gone.twin[side_previous(h) & 3]});
    builder->seen.push_reserved({edge.from, apex, gone.twin[side_next(h) & 3]});
    builder->spare.push_reserved(h >> 2);
  }
  const size_t count = builder->fan.size();
  for (size_t i = 1; i < count; ++i) {
    link_side(side, 4 * builder->fan[i - 1] + 2, 4 * builder->fan[i]);
  }
  side->inner[before] = 4 * builder->fan[0];
  side->inner[u] = 4 * builder->fan[count - 1] + 2;
  return round;
}

static bool side_should_flip(const SideTriangles& side, uint32_t h) {
  const uint32_t g = side.triangles[h >> 2].twin[h & 3];
  if (g == k_none) return false;
  const uint32_t a = side_start(side, h), b = side_start(side, g);
  const uint32_t c = side_start(side, side_previous(h)), d = side_start(side, side_previous(g));
  return is_left(side, a, b, c) && is_left(side, b, a, d) && is_left(side, a, d, c) &&
         is_left(side, b, c, d) &&
         incircle(side.points[a], side.points[b], side.points[c], side.points[d]) > 0.0;
}

static void flip_side(SideTriangles* side, uint32_t h) {
  const uint32_t g = side->triangles[h >> 2].twin[h & 3];
  const uint32_t h1 = side_next(h), h2 = side_previous(h);
  const uint32_t g1 = side_next(g), g2 = side_previous(g);
  const uint32_t a = side_start(*side, h), b = side_start(*side, g);
  const uint32_t c = side_start(*side, h2), d = side_start(*side, g2);
  const uint32_t beyond[4] = {
      side->triangles[g >> 2].twin[g1 & 3], side->triangles[h >> 2].twin[h2 & 3],
      side->triangles[h >> 2].twin[h1 & 3], side->triangles[g >> 2].twin[g2 & 3]};
  const uint32_t t0 = h >> 2, t1 = g >> 2;
  side->triangles[t0] = {{d, c, a}, {k_none, k_none, k_none}};
  side->triangles[t1] = {{c, d, b}, {k_none, k_none, k_none}};
  link_side(side, 4 * t0, 4 * t1);
  const uint32_t outer[4] = {4 * t0 + 2, 4 * t0 + 1, 4 * t1 + 2, 4 * t1 + 1};
  for (int i = 0; i < 4; ++i) {
    if (beyond[i] != k_none) {
      link_side(side, outer[i], beyond[i]);
    } else {
      note_inner(side, outer[i]);
    }
  }
}

// Flips the edges on the stack and those that flips unsettle. Both triangles of a flip turn left
// before and after, so each one lowers the triangulation lifted to the paraboloid: it ends.
static Status settle(SideTriangles* side, SideBuilder* builder) {
  while (!builder->stack.empty()) {
    const uint32_t h = builder->stack.back();
    builder->stack.pop();
    if (!side_should_flip(*side, h)) continue;
    const uint32_t g = side->triangles[h >> 2].twin[h & 3];
    flip_side(side, h);
    const uint32_t changed[2] = {h >> 2, g >> 2};
    for (const uint32_t t : changed) {
      TRY(builder->stack.push(4 * t + 1));
      TRY(builder->stack.push(4 * t + 2));
    }
  }
  return {};
}

// All triangles turn left and fill the region's outline, so they cover it once; the settled edges
// make them Delaunay.
static bool all_turn_left(const SideTriangles& side) {
  for (const SideTriangle& t : side.triangles) {
    if (!is_left(side, t.vertex[0], t.vertex[1], t.vertex[2])) return false;
  }
  return true;
}

static Status reinsert_all(SideTriangles* side, bool* proved) {
  SideBuilder builder(side->points.context());
  const uint32_t last = static_cast<uint32_t>(side->points.size()) - 1;
  TRY(take_off(*side, &builder));
  TRY(builder.spare.reserve(last));
  TRY(builder.fan.reserve(last));
  TRY(builder.seen.reserve(2 * size_t{last}));
  TRY(side->triangles.resize(last - 1));
  for (uint32_t i = last - 1; i-- > 0;) builder.spare.push_reserved(i);
  const uint32_t first = builder.order[0];
  builder.fan.clear();
  add_to_fan(side, &builder, first, {0, last, k_none});
  side->inner[0] = 4 * builder.fan[0];
  side->inner[first] = 4 * builder.fan[0] + 2;
  for (uint32_t i = 1; i < last - 1; ++i) {
    if (i % 4096 == 0) TRY(side->points.context().checkpoint());
    if (reinsert(side, &builder, builder.order[i])) continue;
    for (const uint32_t slot : builder.fan) TRY(builder.stack.push(4 * slot));
    TRY(settle(side, &builder));
  }
  for (uint32_t h = 0; h < 4 * (last - 1); ++h) {
    if ((h & 3) != 3) TRY(builder.stack.push(h));
  }
  TRY(settle(side, &builder));
  *proved = all_turn_left(*side);
  return {};
}

Status triangulate_side(SideTriangles* side) {
  bool proved = false;
  TRY(side->inner.assign(side->points.size(), k_none));
  side->triangles.clear();
  if (side->points.size() < 3) return {};
  if (side->points.size() > k_short_chain) TRY(reinsert_all(side, &proved));
  return proved ? Status{} : wrap_chain(side);
}

}  // namespace wireskin::planar
