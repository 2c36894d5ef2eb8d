#include "planar/lattice.h"

#include "base/sort.h"
#include "num/minmax.h"
#include "planar/refine.h"

namespace wireskin::planar {

// Distance between the border and the lattice in spacings. Below the height of a row, 0.866, so
// that a lattice that fits the border continues it.
static constexpr double k_clearance = 0.8;
static constexpr double k_row_height = 0.8660254037844386;

// Farther from the origin than this many spacings, x + 1 would soon be x.
static constexpr double k_greatest_reach = 0x1p+40;

// A border edge in the lattice's frame (unit: one spacing), with the distance that points keep.
struct ClearedEdge {
  Vec2 a, b;
  double radius;
  double low, high;  // the rows concerned
  uint32_t index;
  bool border;
};

// What an edge forbids on one row; `crosses`: the inside begins or ends in between.
struct ClearedPart {
  double from, to;
  uint32_t index;
  bool crosses;
};

// Lattice coordinates: origin on the border, first axis along its longest edge.
struct LatticeFrame {
  Vec2 origin, axis;
  double spacing;

  Vec2 enter(const Vec2& p) const {
    const Vec2 d = p - origin;
    return (1.0 / spacing) * Vec2{dot(axis, d), cross(axis, d)};
  }
  Vec2 leave(const Vec2& p) const {
    return origin + spacing * (p.x * axis + p.y * Vec2{-axis.y, axis.x});
  }
};

// The greatest integer not above x, for |x| < 2^62.
static double round_down(double x) {
  const double whole = static_cast<double>(static_cast<int64_t>(x));
  return whole > x ? whole - 1.0 : whole;
}

static LatticeFrame frame_of(Span<const LatticeObstacle> obstacles, double spacing) {
  LatticeFrame frame = {obstacles[0].a, {1.0, 0.0}, spacing};
  double longest = 0.0;
  for (const LatticeObstacle& edge : obstacles) {
    const Vec2 along = edge.b - edge.a;
    const double norm = length(along);
    if (norm > longest * (1.0 + 1e-9)) {  // rounding must not choose between equal edges
      longest = norm;
      frame = {edge.a, (1.0 / norm) * along, spacing};
    }
  }
  return frame;
}

// How far inside of a border of this size the sizes reach the spacing, all in spacings.
static double grading_distance(double size) {
  if (size >= 1.0) return (size - 1.0) / k_size_descent;
  const double fine = larger(k_fine_size - size, 0.0);
  return fine / k_size_growth_fine + (1.0 - size - fine) / k_size_growth;
}

static ClearedEdge clear_edge(const LatticeFrame& frame, const LatticeObstacle& obstacle,
                              uint32_t index) {
  ClearedEdge edge = {frame.enter(obstacle.a), frame.enter(obstacle.b), 0.0, 0.0, 0.0, index,
                      obstacle.border};
  const double size = obstacle.size / frame.spacing;
  edge.radius = k_clearance + grading_distance(size);
  edge.low = smaller(edge.a.y, edge.b.y) - edge.radius;
  edge.high = larger(edge.a.y, edge.b.y) + edge.radius;
  return edge;
}

static void widen_by_disc(const Vec2& centre, double radius, double y, ClearedPart* part) {
  const double half2 = radius * radius - (y - centre.y) * (y - centre.y);
  if (half2 < 0.0) return;
  const double half = std::sqrt(half2);
  part->from = smaller(part->from, centre.x - half);
  part->to = larger(part->to, centre.x + half);
}

static void widen_by_segment(const Vec2& a, const Vec2& b, double y, ClearedPart* part) {
  if ((a.y <= y) == (b.y <= y)) return;
  const double x = a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x);
  part->from = smaller(part->from, x);
  part->to = larger(part->to, x);
}

// The points within the radius of the edge are two discs and a strip; all of it is convex.
static ClearedPart cleared_part(const ClearedEdge& edge, double y) {
  const Vec2 along = edge.b - edge.a;
  const double norm = length(along);
  const double scaled = norm > 0.0 ? edge.radius / norm : 0.0;
  const Vec2 across = {-scaled * along.y, scaled * along.x};
  ClearedPart part = {DBL_MAX, -DBL_MAX, edge.index,
                      edge.border && (edge.a.y <= y) != (edge.b.y <= y)};
  widen_by_disc(edge.a, edge.radius, y, &part);
  widen_by_disc(edge.b, edge.radius, y, &part);
  widen_by_segment(edge.a + across, edge.b + across, y, &part);
  widen_by_segment(edge.a - across, edge.b - across, y, &part);
  widen_by_segment(edge.a, edge.b, y, &part);
  return part;
}

// Adds the lattice points of row `row` that lie inside the polygon and in no cleared part.
static Status fill_row(const LatticeFrame& frame, double row, Span<ClearedPart> parts,
                       Array<Vec2>* points) {
  sort(parts, [](const ClearedPart& p, const ClearedPart& q) {
    return p.from != q.from ? p.from < q.from : p.index < q.index;
  });
  const double shift = 0.5 * (row - 2.0 * round_down(0.5 * row));
  double reach = -DBL_MAX;
  bool inside = false;
  for (const ClearedPart& part : parts) {
    if (inside && part.from > reach) {
      for (double x = round_down(reach - shift) + 1.0 + shift; x < part.from; x += 1.0) {
        TRY(points->push(frame.leave({x, k_row_height * row})));
      }
    }
    reach = larger(reach, part.to);
    inside = inside != part.crosses;
  }
  return {};
}

Status lattice_points(Span<const LatticeObstacle> obstacles, double spacing, double expected,
                      Array<Vec2>* points) {
  const uint32_t count = static_cast<uint32_t>(obstacles.size());
  const LatticeFrame frame = frame_of(obstacles, spacing);
  Array<ClearedEdge> edges(points->context());
  Array<uint32_t> active(points->context());
  Array<ClearedPart> parts(points->context());
  TRY(edges.reserve(count));
  TRY(active.reserve(count));
  TRY(parts.reserve(count));
  points->clear();
  double low = DBL_MAX;
  double high = -DBL_MAX;
  double reach = 0.0;
  for (uint32_t i = 0; i < count; ++i) {
    edges.push_reserved(clear_edge(frame, obstacles[i], i));
    low = smaller(low, smaller(edges[i].a.y, edges[i].b.y));
    high = larger(high, larger(edges[i].a.y, edges[i].b.y));
    reach = larger(reach, larger(std::fabs(edges[i].a.x), std::fabs(edges[i].a.y)));
    reach = larger(reach, larger(std::fabs(edges[i].b.x), std::fabs(edges[i].b.y)));
  }
  if (!(reach < k_greatest_reach)) return {};
  double work = (high - low) / k_row_height;
  for (ClearedEdge& edge : edges) {
    edge.low = larger(edge.low, low);
    edge.high = smaller(edge.high, high);
    work += (edge.high - edge.low) / k_row_height;
  }
  if (!(work < 16.0 * expected + 64.0 * count)) return {};
  sort(edges.span(), [](const ClearedEdge& p, const ClearedEdge& q) {
    return p.low != q.low ? p.low < q.low : p.index < q.index;
  });
  size_t coming = 0;
  for (double row = round_down(low / k_row_height); row * k_row_height < high; row += 1.0) {
    const double y = row * k_row_height;
    for (; coming < count && edges[coming].low <= y; ++coming) {
      active.push_reserved(static_cast<uint32_t>(coming));
    }
    parts.clear();
    size_t kept = 0;
    for (const uint32_t i : active) {
      if (edges[i].high < y) continue;
      active[kept++] = i;
      parts.push_reserved(cleared_part(edges[i], y));
    }
    active.shrink(kept);
    TRY(fill_row(frame, row, parts.span(), points));
    if (points->size() > k_most_vertices) break;
    TRY(points->context().checkpoint());
  }
  return {};
}

}  // namespace wireskin::planar
