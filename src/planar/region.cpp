#include "planar/region.h"

#include "num/minmax.h"
#include "num/predicates.h"
#include "planar/insertion_order.h"

namespace wireskin::planar {

static Status fail_at_point(Code code, const char* sentence, uint32_t point, Conflict* conflict) {
  Place place;
  place.vertex = point;
  conflict->point[0] = point;
  return fail(code, sentence, place);
}

static Status check_region(const Region& region, Conflict* conflict) {
  if (region.border.size() % 2 != 0 || region.lines.size() % 2 != 0) {
    return fail(Code::bad_argument, "an edge has one end only");
  }
  if (region.points.size() > k_most_vertices / 2 || region.edges() > k_most_vertices) {
    return fail(Code::too_large, "the patch has too many points on its curves");
  }
  for (size_t e = 0; e < region.edges(); ++e) {
    if (region.end(e, 0) < region.points.size() && region.end(e, 1) < region.points.size()) {
      continue;
    }
    conflict->edge[0] = static_cast<uint32_t>(e);
    return fail(Code::index_out_of_range, "an edge names a point that does not exist");
  }
  return {};
}

static Status check_coordinates(Span<const Vec2> points, Conflict* conflict, double* greatest) {
  *greatest = 0.0;
  for (uint32_t i = 0; i < points.size(); ++i) {
    const Vec2 p = points[i];
    const double size = larger(std::fabs(p.x), std::fabs(p.y));
    if (p.x != p.x || p.y != p.y) {
      return fail_at_point(Code::not_a_number, "a coordinate is not a number", i, conflict);
    }
    if (size > DBL_MAX)
      return fail_at_point(Code::infinite, "a coordinate is infinite", i, conflict);
    if (size > 0.25 * k_greatest_coordinate) {
      return fail_at_point(Code::bad_argument, "a coordinate is too great for exact arithmetic", i,
                           conflict);
    }
    *greatest = larger(*greatest, size);
  }
  return {};
}

// Numbers too small for exact products, next to the others, become zero: a change by 1e-30 of the
// region's extent, and only in the working copy.
static double flush(double value, double least) {
  return std::fabs(value) < least ? 0.0 : value;
}

static Status copy_points(Span<const Vec2> points, double greatest, Array<Vec2>* copy) {
  const double least = larger(0x1p-100 * greatest, k_least_coordinate);
  TRY(copy->reserve(points.size()));
  for (const Vec2& p : points) copy->push_reserved({flush(p.x, least), flush(p.y, least)});
  return {};
}

static bool all_on_one_line(Span<const Vec2> points) {
  size_t other = 1;
  while (other < points.size() && points[other].x == points[0].x &&
         points[other].y == points[0].y) {
    ++other;
  }
  for (size_t i = other + 1; i < points.size(); ++i) {
    if (orient2d(points[0], points[other], points[i]) != 0.0) return false;
  }
  return true;
}

// Inserts p, unless a vertex stands there already. Returns which one it is.
static Status insert_or_find(Triangulation* t, const Vec2& p, uint32_t* vertex) {
  const Location location = locate(t, p, t->hint, false);
  if (location.where == Where::on_vertex) {
    *vertex = t->start(location.edge);
    return {};
  }
  WIRESKIN_ASSERT(location.where != Where::hidden);
  *vertex = static_cast<uint32_t>(t->points.size());
  TRY(collect_cavity(t, p, location.edge >> 2));
  return fill_cavity(t, p);
}

// Gives the vertices, numbered as they were inserted, the numbers of their points.
static Status relabel(Span<const Vec2> points, Span<const uint32_t> point_of, Triangulation* t) {
  const uint32_t inserted = static_cast<uint32_t>(t->points.size());
  Array<uint32_t> leaving(t->points.context());
  TRY(leaving.assign(k_box_corners + points.size(), k_none));
  for (uint32_t v = 0; v < inserted; ++v) {
    leaving[v < k_box_corners ? v : k_box_corners + point_of[v - k_box_corners]] = t->leaving[v];
  }
  for (Triangle& triangle : t->triangles) {
    for (uint32_t& v : triangle.vertex) {
      if (v >= k_box_corners) v = k_box_corners + point_of[v - k_box_corners];
    }
  }
  TRY(t->points.resize(k_box_corners + points.size()));
  for (size_t i = 0; i < points.size(); ++i) t->points[k_box_corners + i] = points[i];
  return t->leaving.copy(leaving.span());
}

static Status insert_points(const Region& region, Span<const Vec2> points, Triangulation* t,
                            Array<uint32_t>* joined, Conflict* conflict) {
  const uint32_t count = static_cast<uint32_t>(points.size());
  Array<uint32_t> order(t->points.context()), point_of(t->points.context());
  TRY(insertion_order(points, &order));
  TRY(joined->assign(count, k_none));
  TRY(point_of.assign(count, k_none));  // of each vertex, the least of its points
  TRY(begin_box(points, t));
  for (uint32_t i = 0; i < count; ++i) {
    if (i % 4096 == 0) TRY(t->points.context().checkpoint());
    uint32_t vertex = k_none;
    TRY(insert_or_find(t, points[order[i]], &vertex));
    uint32_t* least = &point_of[vertex - k_box_corners];
    if (*least != k_none && !region.join) {
      conflict->point[1] = *least;
      return fail_at_point(Code::patch_folded, "two points of the border coincide", order[i],
                           conflict);
    }
    if (order[i] < *least) *least = order[i];
    (*joined)[order[i]] = vertex;
  }
  for (uint32_t& point : *joined) point = point_of[point - k_box_corners];
  return relabel(points, point_of.span(), t);
}

// Every vertex must have an even number of border edges: then the parity of crossings is the same
// along every ray.
static Status check_closed(const Region& region, const Array<uint32_t>& joined,
                           Conflict* conflict) {
  Array<uint8_t> odd(joined.context());
  TRY(odd.assign(joined.size(), 0));
  for (const uint32_t end : region.border) odd[joined[end]] ^= 1;
  for (uint32_t i = 0; i < odd.size(); ++i) {
    if (odd[i] == 0) continue;
    return fail_at_point(Code::open_network, "the border of the patch is not closed", i, conflict);
  }
  return {};
}

// The first edge but `except` that runs along the mesh edge between vertices p and q.
static uint32_t edge_along(const Region& region, const Triangulation& t,
                           Span<const uint32_t> joined, uint32_t p, uint32_t q, size_t except) {
  const auto between = [&](const Vec2& a, const Vec2& b, const Vec2& x) {
    return orient2d(a, b, x) == 0.0 && dot(x - a, x - b) <= 0.0;
  };
  for (size_t e = 0; e < region.edges(); ++e) {
    const uint32_t a = k_box_corners + joined[region.end(e, 0)];
    const uint32_t b = k_box_corners + joined[region.end(e, 1)];
    if (a == b || e == except) continue;
    if ((a == p && b == q) || (a == q && b == p)) return static_cast<uint32_t>(e);
    const Vec2& pa = t.points[a];
    const Vec2& pb = t.points[b];
    if (between(pa, pb, t.points[p]) && between(pa, pb, t.points[q])) {
      return static_cast<uint32_t>(e);
    }
  }
  return k_none;
}

// Says which edge or point stands in the way of `edge`, in the words of recover_edge where both
// belong to the border.
static Status name_conflict(const Region& region, const Triangulation& t,
                            Span<const uint32_t> joined, size_t edge, Status status,
                            Conflict* conflict) {
  conflict->edge[0] = static_cast<uint32_t>(edge);
  if (t.touched != k_none) {
    conflict->point[0] = status.place.vertex = t.touched - k_box_corners;
    if (!region.on_border(edge)) status.sentence = "a point lies on an edge that it is no end of";
    return status;
  }
  if (t.crossed == k_none) return status;
  conflict->edge[1] = edge_along(region, t, joined, t.start(t.crossed), t.end(t.crossed), edge);
  status.place.vertex = region.end(edge, 0);
  const bool both = conflict->edge[1] != k_none && region.on_border(conflict->edge[1]);
  if (!both || !region.on_border(edge)) status.sentence = "two edges inside the patch cross";
  return status;
}

// Makes an edge of the region one edge of the mesh, or with `join` several through the points on
// it.
static Status recover_with_points(const Region& region, Triangulation* t,
                                  Span<const uint32_t> joined, size_t edge, Conflict* conflict) {
  uint32_t a = k_box_corners + joined[region.end(edge, 0)];
  const uint32_t b = k_box_corners + joined[region.end(edge, 1)];
  const bool border = region.on_border(edge);
  if (a == b && !region.join) {
    conflict->edge[0] = static_cast<uint32_t>(edge);
    return fail_at_point(Code::patch_folded, "an edge has no length", region.end(edge, 0),
                         conflict);
  }
  while (a != b) {
    uint32_t end = b;
    Status status = recover_edge(t, a, b, border);
    while (!status.ok() && region.join && t->touched != k_none) {
      // The point in the way is the first one seen from either end.
      end = t->touched;
      status = recover_edge(t, a, end, border);
    }
    if (status.code == Code::patch_folded) {
      return name_conflict(region, *t, joined, edge, status, conflict);
    }
    TRY(status);
    a = end;
  }
  return {};
}

// The numbers below `count` by lot (R. A. Fisher, F. Yates, 1938, drawn with S. Vigna's splitmix64,
// 2015): no order of edges then makes many of them cross many triangles.
static Status shuffled(size_t count, Array<uint32_t>* order) {
  TRY(order->resize(count));
  uint64_t state = 0;
  for (uint32_t i = 0; i < count; ++i) {
    uint64_t z = (state += 0x9e3779b97f4a7c15ull);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    const size_t place = (z ^ (z >> 31)) % (i + 1ull);
    (*order)[i] = (*order)[place];
    (*order)[place] = i;
  }
  return {};
}

// Points and lines must have the inside at their side.
static Status check_inside(const Region& region, const Triangulation& t,
                           const Array<uint32_t>& joined, Conflict* conflict) {
  Array<uint8_t> used(joined.context());
  size_t inside = 0;
  TRY(used.assign(t.points.size(), 0));
  for (const Triangle& triangle : t.triangles) {
    if ((triangle.flags & k_outside) != 0) continue;
    ++inside;
    for (const uint32_t v : triangle.vertex) used[v] = 1;
  }
  if (inside == 0) {
    return fail(Code::patch_without_plane, "the border of the patch has no area");
  }
  for (uint32_t i = 0; i < joined.size(); ++i) {
    if (joined[i] != i || used[k_box_corners + i] != 0) continue;
    return fail_at_point(Code::bad_argument, "a point lies outside of the patch", i, conflict);
  }
  for (uint32_t h = 0; h < 4 * t.triangles.size(); ++h) {
    if ((h & 3) == 3 || !t.constrained(h)) continue;
    const uint32_t g = t.twin(h);
    if ((t.triangles[h >> 2].flags & t.triangles[g >> 2].flags & k_outside) == 0) continue;
    conflict->edge[0] = edge_along(region, t, joined.span(), t.start(h), t.end(h), SIZE_MAX);
    return fail_at_point(Code::bad_argument, "an edge runs outside of the patch",
                         t.start(h) - k_box_corners, conflict);
  }
  return {};
}

Status triangulate_region(const Region& region, Triangulation* t, Array<uint32_t>* joined,
                          Conflict* conflict) {
  Context& context = t->points.context();
  Array<Vec2> points(context);
  Array<uint32_t> order(context);
  double greatest = 0.0;
  TRY(check_region(region, conflict));
  TRY(check_coordinates(region.points, conflict, &greatest));
  TRY(copy_points(region.points, greatest, &points));
  if (points.size() < 3) {
    return fail(Code::patch_without_plane, "the patch has fewer than three points");
  }
  TRY(insert_points(region, points.span(), t, joined, conflict));
  if (all_on_one_line(points.span())) {
    return fail(Code::patch_without_plane, "the border of the patch has no area");
  }
  TRY(check_closed(region, *joined, conflict));
  TRY(shuffled(region.edges(), &order));
  for (size_t i = 0; i < order.size(); ++i) {
    if (i % 4096 == 0) TRY(context.checkpoint());
    TRY(recover_with_points(region, t, joined->span(), order[i], conflict));
  }
  TRY(mark_outside(t));
  return check_inside(region, *t, *joined, conflict);
}

}  // namespace wireskin::planar
