#include "planar/relax.h"

#include "base/in_parts.h"
#include "num/minmax.h"
#include "num/predicates.h"

namespace wireskin::planar {

// Squared sine of the angle that a move may not fall below even if others gain: 40 degrees.
static constexpr double k_good_sine2 = 0.41317591116653485;
// Triangles with a smaller angle than 28 degrees are worth a search.
static constexpr double k_poor_sine2 = 0.22040354826462722;
static constexpr int k_searches = 3;
// Steps shorter than this part of the size are not worth their flips.
static constexpr double k_least_step = 0.01;

struct Mobility {
  uint32_t first_free, first_loose;

  bool rests(const Triangle& triangle) const {
    for (const uint32_t v : triangle.vertex) {
      if (v < first_free || v >= first_loose) return false;
    }
    return true;
  }
};

// Squared sine of the least angle. It lies opposite the shortest side, and its sine is twice the
// area over the product of the other two.
static double least_sine2(const Vec2& a, const Vec2& b, const Vec2& c) {
  const double ab = dot(b - a, b - a);
  const double bc = dot(c - b, c - b);
  const double ca = dot(a - c, a - c);
  const double shortest = smaller(ab, smaller(bc, ca));
  const double area2 = cross(b - a, c - a);
  return area2 * area2 * shortest / (ab * bc * ca);
}

// The least of that in the triangles round a vertex if it were at p; 0 if one of them did not turn
// left. `h` leaves the vertex.
static double star_quality(const Triangulation& t, uint32_t h, const Vec2& p) {
  double least = 1.0;
  uint32_t spoke = h;
  do {
    const Vec2 b = t.points[t.end(spoke)];
    const Vec2 c = t.points[t.apex(spoke)];
    if (!(orient2d(p, b, c) > 0.0)) return 0.0;
    const double sine2 = least_sine2(p, b, c);
    if (!(sine2 >= least)) least = sine2;
    spoke = t.turn(spoke);
  } while (spoke != h);
  return least;
}

// The mean of the places at which single neighbours would like to have the vertex.
static Vec2 wished_place(const Triangulation& t, Span<const double> sizes, uint32_t h) {
  const uint32_t vertex = t.start(h);
  const Vec2 p = t.points[vertex];
  Vec2 sum;
  double count = 0.0;
  uint32_t spoke = h;
  do {
    const uint32_t neighbour = t.end(spoke);
    const Vec2 q = t.points[neighbour];
    const double wished = 0.5 * (sizes[vertex] + sizes[neighbour]);
    sum = sum + q + (wished / length(p - q)) * (p - q);
    count += 1.0;
    spoke = t.turn(spoke);
  } while (spoke != h);
  return (1.0 / count) * sum;
}

static bool should_flip(const Triangulation& t, uint32_t h) {
  const uint32_t g = t.twin(h);
  if (g == k_none || t.constrained(h)) return false;
  return incircle(t.points[t.start(h)], t.points[t.end(h)], t.points[t.apex(h)],
                  t.points[t.apex(g)]) > 0.0;
}

static Status push_star(Triangulation* t, uint32_t h) {
  uint32_t spoke = h;
  do {
    TRY(t->stack.push(spoke));
    TRY(t->stack.push(Triangulation::next(spoke)));
    spoke = t->turn(spoke);
  } while (spoke != h);
  return {};
}

// Checks the edges on the stack, and after a flip the four round it. A half-edge on the stack may
// have become another edge meanwhile; looking at it does no harm, and the edge that it was is there
// as well.
static Status restore_delaunay(Triangulation* t) {
  while (!t->stack.empty()) {
    const uint32_t h = t->stack.back();
    t->stack.pop();
    if (!should_flip(*t, h)) continue;
    const uint32_t g = t->twin(h);
    flip(t, h);
    TRY(t->stack.push(h));
    TRY(t->stack.push(Triangulation::previous(h)));
    TRY(t->stack.push(g));
    TRY(t->stack.push(Triangulation::previous(g)));
  }
  return {};
}

static void wake_star(const Triangulation& t, uint32_t h, Span<uint8_t> awake) {
  awake[t.start(h)] = 1;
  uint32_t spoke = h;
  do {
    awake[t.end(spoke)] = 1;
    spoke = t.turn(spoke);
  } while (spoke != h);
}

// Moves one vertex all the way or half of it, and goes to sleep if it hardly wants to move.
static Status relax_vertex(Triangulation* t, Span<const double> sizes, Span<uint8_t> awake,
                           uint32_t vertex) {
  const uint32_t h = t->leaving[vertex];
  const Vec2 p = t->points[vertex];
  const Vec2 step = wished_place(*t, sizes, h) - p;
  const double least = k_least_step * sizes[vertex];
  awake[vertex] = 0;
  if (!(dot(step, step) > least * least)) return {};
  const double before = star_quality(*t, h, p);
  const double needed = before < k_good_sine2 ? before : k_good_sine2;
  for (double part = 1.0; part > 0.25; part *= 0.5) {
    const Vec2 moved = p + part * step;
    if (!(star_quality(*t, h, moved) > needed)) continue;
    t->points[vertex] = moved;
    wake_star(*t, h, awake);
    TRY(push_star(t, h));
    return restore_delaunay(t);
  }
  return {};
}

// Looks round a vertex, near and nearer, for the place where the worst triangle is best.
static Status search_place(Triangulation* t, uint32_t vertex, bool* found) {
  static constexpr Vec2 k_directions[] = {{1, 0},  {0.7071, 0.7071},   {0, 1},  {-0.7071, 0.7071},
                                          {-1, 0}, {-0.7071, -0.7071}, {0, -1}, {0.7071, -0.7071}};
  const uint32_t h = t->leaving[vertex];
  double reach = DBL_MAX;
  uint32_t spoke = h;
  do {
    reach = smaller(reach, length(t->points[t->end(spoke)] - t->points[vertex]));
    spoke = t->turn(spoke);
  } while (spoke != h);
  const double before = star_quality(*t, h, t->points[vertex]);
  double best = before;
  for (double step = 0.4 * reach; step > 0.03 * reach; step *= 0.5) {
    const Vec2 centre = t->points[vertex];
    for (const Vec2& direction : k_directions) {
      const Vec2 moved = centre + step * direction;
      const double quality = star_quality(*t, h, moved);
      if (!(quality > best)) continue;
      best = quality;
      t->points[vertex] = moved;
    }
  }
  if (!(best > before)) return {};
  *found = true;
  TRY(push_star(t, h));
  return restore_delaunay(t);
}

// Searches better places for the free corners of poor triangles.
static Status mend_triangles(Triangulation* t, const Mobility& mobility, bool* found) {
  for (uint32_t i = 0; i < t->triangles.size(); ++i) {
    if (i % 4096 == 0) TRY(t->points.context().checkpoint());
    const Triangle triangle = t->triangles[i];
    const uint32_t* v = triangle.vertex;
    if ((triangle.flags & k_outside) != 0 || mobility.rests(triangle)) continue;
    if (least_sine2(t->points[v[0]], t->points[v[1]], t->points[v[2]]) > k_poor_sine2) continue;
    for (uint32_t k = 0; k < 3; ++k) {
      if (v[k] >= mobility.first_free) TRY(search_place(t, v[k], found));
    }
  }
  return {};
}

// Those that may want to move: loose vertices and the neighbours of loose or held ones.
static Status wake(const Triangulation& t, const Mobility& mobility, Span<uint8_t> awake) {
  return in_parts(t.points.context(), t.triangles.size(), [&](size_t i) {
    if (mobility.rests(t.triangles[i])) return;
    for (const uint32_t v : t.triangles[i].vertex) awake[v] = 1;
  });
}

Status relax(Triangulation* t, Span<const double> sizes, uint32_t first_free, uint32_t first_loose,
             int sweeps) {
  Context& context = t->points.context();
  const uint32_t count = static_cast<uint32_t>(t->points.size());
  const Mobility mobility = {first_free, first_loose};
  Array<uint8_t> awake(context);
  TRY(assign_in_parts(count, 0, &awake));
  TRY(wake(*t, mobility, awake.span()));
  t->stack.clear();
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    for (uint32_t v = first_free; v < count; ++v) {
      if (v % 4096 == 0) TRY(context.checkpoint());
      if (awake[v] != 0) TRY(relax_vertex(t, sizes, awake.span(), v));
    }
  }
  bool found = true;
  for (int search = 0; search < k_searches && found; ++search) {
    found = false;
    TRY(mend_triangles(t, mobility, &found));
  }
  return {};
}

}  // namespace wireskin::planar
