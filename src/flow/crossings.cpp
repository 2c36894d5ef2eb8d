#include "flow/crossings.h"

#include "base/in_parts.h"
#include "base/sort.h"
#include "num/minmax.h"
#include "num/predicates.h"
#include "num/predicates3.h"

namespace wireskin::flow {

namespace {

// A place, and the side of a triangle's plane that it is on.
struct SidedPoint {
  const Vec3& at;
  int side;
};

}  // namespace

// ---- Two triangles ------------------------------------------------------------------------------

static Vec2 drop_axis(const Vec3& p, int axis) {
  if (axis == 0) return {p.y, p.z};
  return axis == 1 ? Vec2{p.z, p.x} : Vec2{p.x, p.y};
}

static int sign_of(double x) {
  return (x > 0.0) - (x < 0.0);
}

// An axis along which the triangle shows an area; 3 if there is none.
static int visible_axis(const Vec3& a, const Vec3& b, const Vec3& c) {
  for (int axis = 0; axis < 3; ++axis) {
    if (orient2d(drop_axis(a, axis), drop_axis(b, axis), drop_axis(c, axis)) != 0.0) return axis;
  }
  return 3;
}

static bool on_segment(const Vec2& p, const Vec2& a, const Vec2& b) {
  return smaller(a.x, b.x) <= p.x && p.x <= larger(a.x, b.x) && smaller(a.y, b.y) <= p.y &&
         p.y <= larger(a.y, b.y);
}

static bool segments_meet(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  const int c_side = sign_of(orient2d(a, b, c)), d_side = sign_of(orient2d(a, b, d));
  const int a_side = sign_of(orient2d(c, d, a)), b_side = sign_of(orient2d(c, d, b));
  if (c_side * d_side < 0 && a_side * b_side < 0) return true;
  return (c_side == 0 && on_segment(c, a, b)) || (d_side == 0 && on_segment(d, a, b)) ||
         (a_side == 0 && on_segment(a, c, d)) || (b_side == 0 && on_segment(b, c, d));
}

// All in one plane.
static bool segment_meets_flat(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b,
                               const Vec3& c) {
  const int axis = visible_axis(a, b, c);
  if (axis == 3) return false;
  const Vec2 u = drop_axis(p, axis), v = drop_axis(q, axis);
  const Vec2 corner[3] = {drop_axis(a, axis), drop_axis(b, axis), drop_axis(c, axis)};
  bool inside = true;
  const int turn = sign_of(orient2d(corner[0], corner[1], corner[2]));
  for (int k = 0; k < 3; ++k) {
    const Vec2 &from = corner[k], &to = corner[(k + 1) % 3];
    if (sign_of(orient2d(from, to, u)) * turn < 0) inside = false;
    if (segments_meet(u, v, from, to)) return true;
  }
  return inside;
}

// Whether the closed segment has a point in the closed triangle.
static bool segment_meets(const SidedPoint& p, const SidedPoint& q, const Vec3& a, const Vec3& b,
                          const Vec3& c) {
  if (p.side * q.side > 0) return false;
  if (p.side == 0 && q.side == 0) return segment_meets_flat(p.at, q.at, a, b, c);
  const int ab = sign_of(orient3d(p.at, q.at, a, b)), bc = sign_of(orient3d(p.at, q.at, b, c));
  const int ca = sign_of(orient3d(p.at, q.at, c, a));
  return (ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0);
}

// Triangles u v p and v u q: they overlap if they lie in one plane on one side of u v.
static bool fold_over(const Vec3& u, const Vec3& v, const Vec3& p, const Vec3& q) {
  if (orient3d(u, v, p, q) != 0.0) return false;
  const int axis = visible_axis(u, v, p);
  if (axis == 3) return false;
  const Vec2 a = drop_axis(u, axis), b = drop_axis(v, axis);
  return sign_of(orient2d(a, b, drop_axis(p, axis))) == sign_of(orient2d(a, b, drop_axis(q, axis)));
}

static bool repeats_corner(const uint32_t* t) {
  return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

// The sides of a triangle's plane that the corners of another are on; false where all are off it on
// one side, and the two have no point in common (T. Moeller, "A Fast Triangle-Triangle Intersection
// Test", 1997).
static bool reaches_plane(const Vec3* position, const uint32_t* triangle, const uint32_t* plane,
                          int* side) {
  const Vec3 &a = position[plane[0]], &b = position[plane[1]], &c = position[plane[2]];
  for (int k = 0; k < 3; ++k) side[k] = sign_of(orient3d(a, b, c, position[triangle[k]]));
  return side[0] == 0 || side[0] != side[1] || side[0] != side[2];
}

// Whether one of a triangle's edges meets another triangle.
static bool edges_meet(const Vec3* position, const uint32_t* edges, const int* side,
                       const uint32_t* triangle) {
  const Vec3 &a = position[triangle[0]], &b = position[triangle[1]], &c = position[triangle[2]];
  for (uint32_t k = 0; k < 3; ++k) {
    const uint32_t next = (k + 1) % 3;
    const SidedPoint p = {position[edges[k]], side[k]}, q = {position[edges[next]], side[next]};
    if (segment_meets(p, q, a, b, c)) return true;
  }
  return false;
}

// Of two triangles that share a corner, number at[i] of t[i]: whether the edge opposite to it in
// one of them meets the other.
static bool cross_beyond_corner(const Vec3* position, const uint32_t* const* t,
                                const uint32_t* at) {
  for (int k = 0; k < 2; ++k) {
    const uint32_t *edge = t[k], *plane = t[1 - k];
    const Vec3 &a = position[plane[0]], &b = position[plane[1]], &c = position[plane[2]];
    const Vec3 &u = position[edge[(at[k] + 1) % 3]], &v = position[edge[(at[k] + 2) % 3]];
    const SidedPoint p = {u, sign_of(orient3d(a, b, c, u))}, q = {v, sign_of(orient3d(a, b, c, v))};
    // Then the whole triangle is on one side of the other's plane, but for the corner.
    if (p.side * q.side > 0) return false;
    if (segment_meets(p, q, a, b, c)) return true;
  }
  return false;
}

bool triangles_cross(Span<const Vec3> position, const uint32_t* a, const uint32_t* b) {
  uint32_t shared = 0, at_a = 0, at_b = 0, sum_a = 0, sum_b = 0;
  for (uint32_t i = 0; i < 3; ++i) {
    for (uint32_t j = 0; j < 3; ++j) {
      if (a[i] != b[j]) continue;
      ++shared;
      at_a = i, at_b = j;
      sum_a += i, sum_b += j;
    }
  }
  const Vec3* const p = position.data();
  if (shared >= 3 || repeats_corner(a) || repeats_corner(b)) return true;
  if (shared == 2) {
    // The corners that are not shared are what is left of 0 + 1 + 2.
    const uint32_t i = 3 - sum_a, j = 3 - sum_b;
    return fold_over(p[a[(i + 1) % 3]], p[a[(i + 2) % 3]], p[a[i]], p[b[j]]);
  }
  if (shared == 1) {
    const uint32_t* const t[2] = {a, b};
    const uint32_t at[2] = {at_a, at_b};
    return cross_beyond_corner(p, t, at);
  }
  int side_of_a[3], side_of_b[3];
  if (!reaches_plane(p, a, b, side_of_a) || !reaches_plane(p, b, a, side_of_b)) return false;
  return edges_meet(p, a, side_of_a, b) || edges_meet(p, b, side_of_b, a);
}

// ---- All triangles ------------------------------------------------------------------------------

namespace {

struct Box {
  Vec3 low, high;
};

// Cells of a uniform grid along each axis.
struct CrossingGrid {
  Vec3 low;
  double per_cell = 0.0;
  uint32_t size[3] = {1, 1, 1};
};

struct CellRange {
  uint32_t low[3], high[3];
};

}  // namespace

static Box box_of(Span<const Vec3> position, const uint32_t* t) {
  Box box = {position[t[0]], position[t[0]]};
  for (int k = 1; k < 3; ++k) {
    const Vec3& p = position[t[k]];
    box.low = {smaller(box.low.x, p.x), smaller(box.low.y, p.y), smaller(box.low.z, p.z)};
    box.high = {larger(box.high.x, p.x), larger(box.high.y, p.y), larger(box.high.z, p.z)};
  }
  return box;
}

static bool apart(const Box& a, const Box& b) {
  return a.high.x < b.low.x || b.high.x < a.low.x || a.high.y < b.low.y || b.high.y < a.low.y ||
         a.high.z < b.low.z || b.high.z < a.low.z;
}

static uint32_t cell_along(double x, double low, double per_cell, uint32_t size) {
  const double at = (x - low) * per_cell;
  if (!(at > 0.0)) return 0;
  return at < size ? static_cast<uint32_t>(at) : size - 1;
}

static CellRange cells_of(const CrossingGrid& grid, const Box& box) {
  const double low[3] = {box.low.x, box.low.y, box.low.z};
  const double high[3] = {box.high.x, box.high.y, box.high.z};
  const double base[3] = {grid.low.x, grid.low.y, grid.low.z};
  CellRange range;
  for (int k = 0; k < 3; ++k) {
    range.low[k] = cell_along(low[k], base[k], grid.per_cell, grid.size[k]);
    range.high[k] = cell_along(high[k], base[k], grid.per_cell, grid.size[k]);
  }
  return range;
}

template <typename Visit>
static Status each_cell(const CrossingGrid& grid, const CellRange& range, Pace* pace,
                        const Visit& visit) {
  const size_t layer =
      size_t{range.high[0] - range.low[0] + 1} * (range.high[1] - range.low[1] + 1);
  for (uint32_t z = range.low[2]; z <= range.high[2]; ++z) {
    TRY(pace->after(layer));
    for (uint32_t y = range.low[1]; y <= range.high[1]; ++y) {
      for (uint32_t x = range.low[0]; x <= range.high[0]; ++x) {
        visit((z * grid.size[1] + y) * grid.size[0] + x);
      }
    }
  }
  return {};
}

// Cells about as large as the mean triangle.
static Status choose_grid(Context& context, Span<const Vec3> position,
                          Span<const uint32_t> triangle, CrossingGrid* grid) {
  Box all = box_of(position, triangle.data());
  double sum = 0.0;
  TRY(in_parts(context, triangle.size() / 3, [&](size_t t) {
    const Box box = box_of(position, &triangle[3 * t]);
    const Vec3 extent = box.high - box.low;
    sum += larger(extent.x, larger(extent.y, extent.z));
    all.low = {smaller(all.low.x, box.low.x), smaller(all.low.y, box.low.y),
               smaller(all.low.z, box.low.z)};
    all.high = {larger(all.high.x, box.high.x), larger(all.high.y, box.high.y),
                larger(all.high.z, box.high.z)};
  }));
  grid->low = all.low;
  const Vec3 extent = all.high - all.low;
  const double greatest = larger(extent.x, larger(extent.y, extent.z));
  if (!(sum > 0.0)) return {};
  const double cell = larger(sum / (static_cast<double>(triangle.size()) / 3.0), greatest / 200.0);
  const double along[3] = {extent.x, extent.y, extent.z};
  grid->per_cell = 1.0 / cell;
  for (int k = 0; k < 3; ++k) grid->size[k] = static_cast<uint32_t>(along[k] / cell) + 1;
  return {};
}

namespace {

// The triangles at each cell, by number.
struct TriangleCells {
  Span<const Vec3> position;
  Span<const uint32_t> triangle;
  CrossingGrid grid;
  Array<uint32_t> start, item;  // of cell c: item[start[c] .. start[c + 1])
  Array<uint32_t> met;          // of each triangle: for which other it was met last
  Pace pace;

  TriangleCells(Context& context, Span<const Vec3> at, Span<const uint32_t> triangles)
      : position(at),
        triangle(triangles),
        start(context),
        item(context),
        met(context),
        pace(context) {}

  uint32_t count() const { return static_cast<uint32_t>(triangle.size() / 3); }
  const uint32_t* corners(uint32_t t) const { return &triangle[3 * size_t{t}]; }
  Box box(uint32_t t) const { return box_of(position, corners(t)); }
  CellRange range(uint32_t t) const { return cells_of(grid, box(t)); }
};

}  // namespace

// Counts the triangles at each cell, then lists them. Most cells are empty, and a pass over them
// takes next to no time for each.
static Status fill_cells(Context& context, TriangleCells* cells) {
  Array<uint32_t>&start = cells->start, &item = cells->item;
  const CrossingGrid& grid = cells->grid;
  TRY(assign_in_parts(size_t{grid.size[0]} * grid.size[1] * grid.size[2] + 1, 0, &start));
  for (uint32_t t = 0; t < cells->count(); ++t) {
    TRY(each_cell(grid, cells->range(t), &cells->pace, [&](uint32_t cell) { ++start[cell]; }));
  }
  uint32_t sum = 0;
  TRY(in_parts<k_light_steps_per_checkpoint>(context, start.size(), [&](size_t i) {
    const uint32_t count = start[i];
    start[i] = sum;
    sum += count;
  }));
  TRY(item.resize(sum));
  TRY(context.checkpoint());
  for (uint32_t t = 0; t < cells->count(); ++t) {
    const auto add = [&](uint32_t cell) { item[start[cell]++] = t; };
    TRY(each_cell(grid, cells->range(t), &cells->pace, add));
  }
  shift_starts_back(start.span());
  return context.checkpoint();
}

// The triangles before t whose boxes meet its own, each once.
static Status gather_near(uint32_t t, TriangleCells* cells, Array<uint32_t>* near) {
  constexpr size_t k_items_of_step = 4;
  const Box box = cells->box(t);
  near->clear();
  return each_cell(cells->grid, cells_of(cells->grid, box), &cells->pace, [&](uint32_t cell) {
    const uint32_t first = cells->start[cell], end = cells->start[cell + 1];
    cells->pace.add((end - first) / k_items_of_step);  // triangles that lie close: many in some
    for (uint32_t i = first; i < end; ++i) {
      const uint32_t other = cells->item[i];
      if (other >= t || cells->met[other] == t) continue;
      cells->met[other] = t;
      if (!apart(box, cells->box(other))) near->push_reserved(other);
    }
  });
}

Status find_crossings(Context& context, Span<const Vec3> position, Span<const uint32_t> triangle,
                      size_t most, Array<uint32_t>* pairs) {
  constexpr size_t k_steps_of_pair = 4;
  pairs->clear();
  if (triangle.empty()) return {};
  TriangleCells cells(context, position, triangle);
  const uint32_t count = cells.count();
  Array<uint32_t> near(context);
  TRY(choose_grid(context, position, triangle, &cells.grid));
  TRY(fill_cells(context, &cells));
  TRY(assign_in_parts(count, k_none, &cells.met));
  TRY(near.reserve(count));
  TRY(pairs->reserve(most < count ? 2 * most : 2 * size_t{count}));
  for (uint32_t t = 0; t < count && pairs->size() < 2 * most; ++t) {
    TRY(gather_near(t, &cells, &near));
    for (const uint32_t other : near) {
      TRY(cells.pace.after(k_steps_of_pair));
      if (!triangles_cross(position, cells.corners(other), cells.corners(t))) continue;
      TRY(pairs->push(other));
      TRY(pairs->push(t));
    }
  }
  return {};
}

}  // namespace wireskin::flow
