#include "planar/relax.h"

#include "num/minmax.h"
#include "num/predicates.h"

namespace wireskin::planar {

// Squared sine of the angle that a move may not fall below even if others gain: 40 degrees.
static constexpr double k_good_sine2 = 0.41317591116653485;
// Steps shorter than this part of the size are not worth their flips.
static constexpr double k_least_step = 0.01;

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

// Those that may want to move: loose ones and the neighbours of loose or held ones.
static void wake(const Triangulation& t, uint32_t first_free, uint32_t first_loose,
                 Span<uint8_t> awake) {
  const auto at_rest = [&](uint32_t v) { return v >= first_free && v < first_loose; };
  for (const Triangle& triangle : t.triangles) {
    const uint32_t* v = triangle.vertex;
    if (at_rest(v[0]) && at_rest(v[1]) && at_rest(v[2])) continue;
    awake[v[0]] = awake[v[1]] = awake[v[2]] = 1;
  }
}

Status relax(Triangulation* t, Span<const double> sizes, uint32_t first_free, uint32_t first_loose,
             int sweeps) {
  Context& context = t->points.context();
  const uint32_t count = static_cast<uint32_t>(t->points.size());
  Array<uint8_t> awake(context);
  TRY(awake.assign(count, 0));
  wake(*t, first_free, first_loose, awake.span());
  t->stack.clear();
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    for (uint32_t v = first_free; v < count; ++v) {
      if (v % 16384 == 0) TRY(context.checkpoint());
      if (awake[v] != 0) TRY(relax_vertex(t, sizes, awake.span(), v));
    }
  }
  return {};
}

}  // namespace wireskin::planar
