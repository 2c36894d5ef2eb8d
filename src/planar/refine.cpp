#include "planar/refine.h"

#include "base/in_parts.h"
#include "num/minmax.h"

namespace wireskin::planar {

// A triangle is too large when its circumradius exceeds that of an equilateral one of the wished
// size this many times. Chosen so that about as many points result as a hexagonal lattice would
// have.
static constexpr double k_coarseness = 1.25;
// The least distance between a new point and any vertex that it will be joined with, over its size.
static constexpr double k_least_distance = 0.7;
// Triangles that may be looked at for each vertex allowed. A tenth is usual; beside a fan of
// needles on one long edge, each point that is proposed and refused could cost the whole fan.
static constexpr uint64_t k_most_work = 64;
// Cosine of the angle under which a point may see a border edge: 105 degrees.
static constexpr double k_lens_cosine = -0.2588190451025208;

struct Refiner {
  Triangulation* t;
  Array<double>* sizes;
  double spacing;
  Array<uint32_t> queue;
  size_t head = 0;
};

// Where a point is proposed, and which edge length is wished there.
struct Proposal {
  Vec2 point;
  double size;
};

static bool is_coarse(const Refiner& r, uint32_t triangle) {
  const uint32_t* v = r.t->triangles[triangle].vertex;
  const Vec2 a = r.t->points[v[0]], b = r.t->points[v[1]], c = r.t->points[v[2]];
  const Vec2 ab = b - a, bc = c - b, ca = a - c;
  const double size = ((*r.sizes)[v[0]] + (*r.sizes)[v[1]] + (*r.sizes)[v[2]]) / 3.0;
  // Circumradius = product of the sides / (4 area), against k_coarseness size / sqrt(3).
  const double area2 = cross(ab, bc);
  const double limit = 4.0 / 3.0 * k_coarseness * k_coarseness * size * size;
  return dot(ab, ab) * dot(bc, bc) * dot(ca, ca) > limit * area2 * area2;
}

static bool is_front(const Triangulation& t, uint32_t h) {
  return t.constrained(h) || (t.triangles[t.twin(h) >> 2].flags & k_coarse) == 0;
}

static Status queue_triangle(Refiner* r, uint32_t triangle) {
  Triangle& slot = r->t->triangles[triangle];
  if ((slot.flags & (k_coarse | k_queued | k_outside)) != k_coarse) return {};
  slot.flags |= k_queued;
  return r->queue.push(triangle);
}

static uint32_t pop_triangle(Refiner* r) {
  const uint32_t triangle = r->queue[r->head++];
  if (r->head >= 4096 && 2 * r->head >= r->queue.size()) {
    const size_t rest = r->queue.size() - r->head;
    std::memmove(r->queue.data(), r->queue.data() + r->head, rest * sizeof(uint32_t));
    r->queue.shrink(rest);
    r->head = 0;
  }
  r->t->triangles[triangle].flags &= ~k_queued;
  return triangle;
}

static double drift(double size, double spacing, double distance) {
  if (size < spacing) {
    const double growth = size < k_fine_size * spacing ? k_size_growth_fine : k_size_growth;
    return smaller(size + growth * distance, spacing);
  }
  return larger(size - k_size_descent * distance, spacing);
}

// The point above edge h that makes a triangle of the wished size, or the circumcentre if that is
// nearer. False if the circumcentre lies on the other side of the edge.
static bool propose(const Refiner& r, uint32_t h, Proposal* proposal) {
  const Triangulation& t = *r.t;
  const Vec2 a = t.points[t.start(h)], b = t.points[t.end(h)], c = t.points[t.apex(h)];
  const Vec2 ab = b - a;
  const double squared = dot(ab, ab);
  const double area2 = cross(a - c, b - c);
  // Heights over the middle of the edge, in units of its length.
  const double centre = 0.5 * dot(a - c, b - c) / area2;
  if (!(centre > 0.0)) return false;
  const double size = 0.5 * ((*r.sizes)[t.start(h)] + (*r.sizes)[t.end(h)]);
  const double apex_size = (*r.sizes)[t.apex(h)];
  const double most =
      apex_size < r.spacing ? drift(apex_size, r.spacing, length(c - 0.5 * (a + b))) : DBL_MAX;
  // 0.875 is about the height of an equilateral triangle.
  const double wished = smaller(drift(size, r.spacing, 0.875 * size), most);
  const double ideal2 = wished * wished / squared - 0.25;
  const double ideal = ideal2 > 0.25 ? std::sqrt(ideal2) : 0.5;
  const double height = smaller(ideal, centre);
  proposal->point = 0.5 * (a + b) + height * Vec2{-ab.y, ab.x};
  proposal->size = smaller(drift(size, r.spacing, height * std::sqrt(squared)), most);
  return true;
}

// Whether the collected cavity keeps its distance from the proposed point.
static bool is_clear(const Triangulation& t, const Proposal& proposal) {
  const double least = k_least_distance * proposal.size;
  const size_t count = t.outline.size();
  for (size_t i = 0; i < count; ++i) {
    const Vec2 a = t.points[t.outline[i].vertex] - proposal.point;
    const double aa = dot(a, a);
    if (!(aa >= least * least)) return false;
    if ((t.outline[i].bits & 1) == 0) continue;
    const Vec2 b = t.points[t.outline[i + 1 < count ? i + 1 : 0].vertex] - proposal.point;
    if (dot(a, b) < k_lens_cosine * std::sqrt(aa * dot(b, b))) return false;
  }
  return true;
}

// Classifies the triangles round a new point and queues those that a front has reached.
static Status advance_front(Refiner* r) {
  Triangulation& t = *r->t;
  for (const uint32_t triangle : t.cavity) {
    if (is_coarse(*r, triangle)) t.triangles[triangle].flags |= k_coarse;
  }
  for (const uint32_t triangle : t.cavity) {
    if ((t.triangles[triangle].flags & k_coarse) == 0) {
      // Edge 1 of a new triangle is the one opposite the new point.
      const uint32_t g = t.twin(4 * triangle + 1);
      if (!t.constrained(4 * triangle + 1)) TRY(queue_triangle(r, g >> 2));
      continue;
    }
    const uint32_t h = 4 * triangle;
    if (is_front(t, h) || is_front(t, h + 1) || is_front(t, h + 2))
      TRY(queue_triangle(r, triangle));
  }
  return {};
}

static Status try_edge(Refiner* r, uint32_t h, bool* done) {
  Triangulation& t = *r->t;
  Proposal proposal;
  *done = false;
  if (!is_front(t, h) || !propose(*r, h, &proposal)) return {};
  const Location location = locate(&t, proposal.point, h >> 2, true);
  if (location.where == Where::hidden || location.where == Where::on_vertex) return {};
  if (location.where == Where::on_edge && t.constrained(location.edge)) return {};
  TRY(collect_cavity(&t, proposal.point, location.edge >> 2));
  if (!is_clear(t, proposal)) return {};
  TRY(fill_cavity(&t, proposal.point));
  TRY(r->sizes->push(proposal.size));
  *done = true;
  return advance_front(r);
}

// The triangle's edges, shortest first.
static void sort_edges(const Triangulation& t, uint32_t triangle, uint32_t edges[3]) {
  double squared[3] = {};
  for (uint32_t i = 0; i < 3; ++i) {
    const uint32_t h = 4 * triangle + i;
    const Vec2 along = t.points[t.end(h)] - t.points[t.start(h)];
    const double s = dot(along, along);
    uint32_t j = i;
    for (; j > 0 && squared[j - 1] > s; --j) {
      squared[j] = squared[j - 1];
      edges[j] = edges[j - 1];
    }
    squared[j] = s;
    edges[j] = h;
  }
}

// Puts a point into the triangle, or else declares it finished, so that the front can pass it.
static Status refine_triangle(Refiner* r, uint32_t triangle) {
  Triangulation& t = *r->t;
  if ((t.triangles[triangle].flags & k_coarse) == 0) return {};
  uint32_t edges[3];
  sort_edges(t, triangle, edges);
  for (const uint32_t h : edges) {
    bool done = false;
    TRY(try_edge(r, h, &done));
    if (done) return {};
  }
  t.triangles[triangle].flags &= ~k_coarse;
  for (uint32_t h = 4 * triangle; h < 4 * triangle + 3; ++h) {
    if (!t.constrained(h)) TRY(queue_triangle(r, t.twin(h) >> 2));
  }
  return {};
}

Status refine(Triangulation* t, Array<double>* sizes, double spacing, size_t most_vertices) {
  Refiner r = {t, sizes, spacing, Array<uint32_t>(t->triangles.context())};
  TRY(in_parts(t->points.context(), t->triangles.size(), [&](size_t i) {
    if ((t->triangles[i].flags & k_outside) == 0 && is_coarse(r, static_cast<uint32_t>(i)))
      t->triangles[i].flags |= k_coarse;
  }));
  Pace pace(t->points.context());
  for (uint32_t i = 0; i < t->triangles.size(); ++i) {
    TRY(pace.after());
    if ((t->triangles[i].flags & k_coarse) == 0) continue;
    const uint32_t h = 4 * i;
    if (is_front(*t, h) || is_front(*t, h + 1) || is_front(*t, h + 2)) TRY(queue_triangle(&r, i));
  }
  const uint64_t most_work = t->work + k_most_work * most_vertices;
  while (r.head < r.queue.size() && t->points.size() < most_vertices) {
    if (t->work > most_work) break;
    TRY(pace.after(3));  // its edges
    TRY(refine_triangle(&r, pop_triangle(&r)));
  }
  return {};
}

}  // namespace wireskin::planar
