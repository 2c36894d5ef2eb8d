#include "flow/flat_faces.h"

#include "base/sort.h"
#include "num/minmax.h"

namespace wireskin::flow {

static constexpr double k_flat = 1e-3;          // of the diagonal, off the plane
static constexpr double k_straight = 0.01;      // of an arc's length, off its chord
static constexpr double k_least_corner = 0.94;  // cosine of what a polygon turns at a corner
static constexpr double k_same_line = 0.9985;   // of what it turns elsewhere
static constexpr uint8_t k_most_visits = 4;

namespace {

struct Plane {
  Vec3 at, normal;
};

struct FaceFlood {
  Array<uint32_t> mark;               // of each triangle: the seed whose face it was last in
  Array<uint8_t> visits;              // of each triangle
  Array<uint32_t> member;             // the face
  Array<uint8_t> straight;            // of each edge: on a straight arc
  Array<uint32_t> line;               // of each vertex inside a straight arc: the arc
  Array<uint32_t> line_end;           // of each arc, two
  Array<uint32_t> seen, border_edge;  // of each vertex: its edges on the border, and one of them

  explicit FaceFlood(Context& context)
      : mark(context),
        visits(context),
        member(context),
        straight(context),
        line(context),
        line_end(context),
        seen(context),
        border_edge(context) {}
};

}  // namespace

static double twice_area(const Complex& complex, uint32_t t) {
  const uint32_t* const v = &complex.triangle[3 * size_t{t}];
  const Vec3& a = complex.point[v[0]];
  return length(cross(complex.point[v[1]] - a, complex.point[v[2]] - a));
}

static Plane plane_of(const Complex& complex, uint32_t t) {
  const uint32_t* const v = &complex.triangle[3 * size_t{t}];
  const Vec3& a = complex.point[v[0]];
  return {a, unit(cross(complex.point[v[1]] - a, complex.point[v[2]] - a))};
}

static bool in_plane(const Complex& complex, const Plane& plane, uint32_t t) {
  for (uint32_t k = 0; k < 3; ++k) {
    const Vec3& p = complex.point[complex.triangle[3 * size_t{t} + k]];
    if (std::fabs(dot(p - plane.at, plane.normal)) > k_flat * complex.diagonal) return false;
  }
  return true;
}

static bool stays_on_line(const Samples& samples, uint32_t first, uint32_t last) {
  const Vec3& p = samples.position[samples.at[first]];
  const Vec3 chord = samples.position[samples.at[last]] - p;
  const Vec3 along = unit(chord);
  for (uint32_t i = first + 1; i < last; ++i) {
    const Vec3 to = samples.position[samples.at[i]] - p;
    if (length(to - dot(to, along) * along) > k_straight * length(chord)) return false;
  }
  return samples.at[first] != samples.at[last];
}

// Marks the edges and the vertices of straight arcs.
static Status mark_straight(const Complex& complex, const Samples& samples,
                            const CurveEdges& curves, FaceFlood* flood) {
  TRY(flood->straight.assign(complex.edge_count(), 0));
  TRY(flood->line.assign(complex.point.size(), k_none));
  TRY(flood->line_end.assign(2 * samples.start.size(), k_none));
  for (uint32_t a = 0; a + 1 < samples.start.size(); ++a) {
    const uint32_t first = samples.start[a], last = samples.start[a + 1] - 1;
    if (!stays_on_line(samples, first, last)) continue;
    flood->line_end[2 * size_t{a}] = complex.same_as[samples.at[first]];
    flood->line_end[2 * size_t{a} + 1] = complex.same_as[samples.at[last]];
    for (uint32_t i = first; i < last; ++i) {
      if (curves.edge_of[i] != k_none) flood->straight[curves.edge_of[i]] = 1;
      if (i > first) flood->line[complex.same_as[samples.at[i]]] = a;
    }
  }
  return {};
}

static Vec3 edge_vector(const Complex& complex, uint32_t e, uint32_t from) {
  const uint32_t a = complex.edge[2 * size_t{e}], b = complex.edge[2 * size_t{e} + 1];
  return unit(a == from ? complex.point[b] - complex.point[a]
                        : complex.point[a] - complex.point[b]);
}

// Whether u, too, is on the straight arc that v is inside of.
static bool on_line_of(const FaceFlood& flood, uint32_t v, uint32_t u) {
  const uint32_t line = flood.line[v];
  return line != k_none && (flood.line[u] == line || flood.line_end[2 * size_t{line}] == u ||
                            flood.line_end[2 * size_t{line} + 1] == u);
}

// Edges of the complex that belong to the curves, or pass over samples of a straight one.
static bool on_rim(const Complex& complex, const CurveEdges& curves, const FaceFlood& flood,
                   uint32_t e) {
  const uint32_t a = complex.edge[2 * size_t{e}], b = complex.edge[2 * size_t{e} + 1];
  return curves.on_curve(e) || on_line_of(flood, a, b) || on_line_of(flood, b, a);
}

// All corners on one straight line: such a triangle lies in every plane through it.
static bool is_line(const Complex& complex, const CurveEdges& curves, const FaceFlood& flood,
                    uint32_t t) {
  const uint32_t* const v = &complex.triangle[3 * size_t{t}];
  const uint32_t* const edge = &complex.triangle_edge[3 * size_t{t}];
  for (uint32_t k = 0; k < 3; ++k) {
    const uint32_t e = edge[(k + 1) % 3], f = edge[(k + 2) % 3];
    if (curves.on_curve(e) && curves.on_curve(f)) {
      if (dot(edge_vector(complex, e, v[k]), edge_vector(complex, f, v[k])) < -k_same_line) {
        return true;
      }
    }
    if (on_line_of(flood, v[k], v[(k + 1) % 3]) && on_line_of(flood, v[k], v[(k + 2) % 3])) {
      return true;
    }
  }
  return false;
}

// Which side of an edge, within the plane, a triangle lies on.
static bool on_left(const Complex& complex, const Plane& plane, uint32_t e, uint32_t t) {
  const Vec3& a = complex.point[complex.edge[2 * size_t{e}]];
  const Vec3& b = complex.point[complex.edge[2 * size_t{e} + 1]];
  const uint32_t* const v = &complex.triangle[3 * size_t{t}];
  const Vec3 middle =
      (1.0 / 3.0) * (complex.point[v[0]] + complex.point[v[1]] + complex.point[v[2]]);
  return dot(cross(b - a, middle - a), plane.normal) > 0.0;
}

// The sides of an edge that the face takes up, a bit each.
static uint32_t sides_of(const Complex& complex, const FaceFlood& flood, const Plane& plane,
                         uint32_t seed, uint32_t e) {
  uint32_t sides = 0;
  for (const uint32_t t : complex.triangles_of(e)) {
    if (flood.mark[t] == seed) sides |= on_left(complex, plane, e, t) ? 1u : 2u;
  }
  return sides;
}

static Status flood_face(const Complex& complex, const CurveEdges& curves, const Sheet& sheet,
                         const Plane& plane, uint32_t seed, FaceFlood* flood) {
  flood->member.clear();
  const auto add = [&](uint32_t t) {
    flood->mark[t] = seed;
    ++flood->visits[t];
    return flood->member.push(t);
  };
  TRY(add(seed));
  for (size_t i = 0; i < flood->member.size(); ++i) {
    for (uint32_t k = 0; k < 3; ++k) {
      const uint32_t e = complex.triangle_edge[3 * size_t{flood->member[i]} + k];
      if (on_rim(complex, curves, *flood, e)) continue;
      for (const uint32_t t : complex.triangles_of(e)) {
        const bool done = flood->mark[t] == seed || flood->visits[t] >= k_most_visits;
        if (done || sheet.in[t] == 0 || !in_plane(complex, plane, t)) continue;
        if (!is_line(complex, curves, *flood, t)) TRY(add(t));
      }
    }
  }
  return {};
}

static bool is_closed(const Complex& complex, const CurveEdges& curves, const FaceFlood& flood,
                      const Plane& plane, uint32_t seed) {
  for (const uint32_t t : flood.member) {
    for (uint32_t k = 0; k < 3; ++k) {
      const uint32_t e = complex.triangle_edge[3 * size_t{t} + k];
      if (on_rim(complex, curves, flood, e)) continue;
      if (sides_of(complex, flood, plane, seed, e) != 3) return false;
    }
  }
  return true;
}

// Notes an edge of the border at both its ends; false if it makes a bend with the one before.
static bool turns_well(const Complex& complex, uint32_t e, FaceFlood* flood) {
  bool well = true;
  for (uint32_t end = 0; end < 2; ++end) {
    const uint32_t v = complex.edge[2 * size_t{e} + end];
    if (flood->seen[v]++ == 0) {
      flood->border_edge[v] = e;
      continue;
    }
    const double cosine =
        -dot(edge_vector(complex, e, v), edge_vector(complex, flood->border_edge[v], v));
    well = well && (cosine > k_same_line || cosine < k_least_corner);
  }
  return well;
}

static bool is_polygon(const Complex& complex, const CurveEdges& curves, const Plane& plane,
                       uint32_t seed, FaceFlood* flood) {
  double whole = 0.0, straight = 0.0;
  bool corners = true;
  for (const uint32_t t : flood->member) {
    for (uint32_t k = 0; k < 3; ++k) {
      const uint32_t e = complex.triangle_edge[3 * size_t{t} + k];
      if (!on_rim(complex, curves, *flood, e)) continue;
      if (sides_of(complex, *flood, plane, seed, e) == 3) continue;
      const double size = length(complex.point[complex.edge[2 * size_t{e}]] -
                                 complex.point[complex.edge[2 * size_t{e} + 1]]);
      whole += size;
      if (curves.on_curve(e) && flood->straight[e] == 0) continue;
      straight += size;
      corners = turns_well(complex, e, flood) && corners;
    }
  }
  for (const uint32_t t : flood->member) {
    for (uint32_t k = 0; k < 3; ++k) flood->seen[complex.triangle[3 * size_t{t} + k]] = 0;
  }
  return corners && straight >= 0.5 * whole;
}

// Triangles at curves, which every face has, largest first.
static Status list_seeds(const Complex& complex, const CurveEdges& curves, const Sheet& sheet,
                         const FaceFlood& flood, Array<double>* area, Array<uint32_t>* seeds) {
  TRY(area->resize(complex.triangle_count()));
  for (uint32_t t = 0; t < complex.triangle_count(); ++t) {
    if (sheet.in[t] == 0) continue;
    (*area)[t] = twice_area(complex, t);
    bool at_curve = false;
    for (uint32_t k = 0; k < 3; ++k) {
      at_curve = at_curve || curves.on_curve(complex.triangle_edge[3 * size_t{t} + k]);
    }
    if (at_curve && !is_line(complex, curves, flood, t)) TRY(seeds->push(t));
  }
  sort(seeds->span(), [&](uint32_t a, uint32_t b) {
    return (*area)[a] != (*area)[b] ? (*area)[a] > (*area)[b] : a < b;
  });
  return {};
}

Status find_flat_faces(Context& context, const Complex& complex, const Samples& samples,
                       const CurveEdges& curves, const Sheet& sheet, Array<Flatness>* flatness) {
  constexpr size_t k_members_per_checkpoint = 1u << 15;
  FaceFlood flood(context);
  Array<double> area(context);
  Array<uint32_t> seeds(context);
  TRY(flatness->assign(complex.triangle_count(), Flatness::none));
  TRY(flood.mark.assign(complex.triangle_count(), k_none));
  TRY(flood.visits.assign(complex.triangle_count(), 0));
  TRY(flood.seen.assign(complex.point.size(), 0));
  TRY(flood.border_edge.resize(complex.point.size()));
  TRY(mark_straight(complex, samples, curves, &flood));
  TRY(list_seeds(complex, curves, sheet, flood, &area, &seeds));
  size_t looked_at = 0;
  for (const uint32_t seed : seeds) {
    if (flood.visits[seed] != 0) continue;
    const Plane plane = plane_of(complex, seed);
    TRY(flood_face(complex, curves, sheet, plane, seed, &flood));
    looked_at += flood.member.size();
    if (looked_at > k_members_per_checkpoint) {
      TRY(context.checkpoint());
      looked_at = 0;
    }
    if (!is_closed(complex, curves, flood, plane, seed)) continue;
    const bool polygon = is_polygon(complex, curves, plane, seed, &flood);
    for (const uint32_t t : flood.member) {
      (*flatness)[t] = polygon ? Flatness::polygon : Flatness::plane;
    }
  }
  return {};
}

}  // namespace wireskin::flow
