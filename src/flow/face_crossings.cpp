#include "flow/face_crossings.h"

#include "num/minmax.h"

namespace wireskin::flow {

static constexpr double k_beside = 1e-5;  // of the diagonal, from an edge
static constexpr uint32_t k_edges_per_pause = 1u << 18, k_arcs_per_pause = 1u << 10;

// What segments of curves join each vertex to.
static Status link_segments(const Complex& complex, const CurveEdges& curves,
                            CurvesAcross* across) {
  size_t count = 0;
  TRY(across->next_start.assign(complex.point.size() + 1, 0));
  for (uint32_t e = 0; e < complex.edge_count(); ++e) {
    if (e % k_edges_per_pause == 0) TRY(across->next.context().checkpoint());
    if (!curves.on_curve(e)) continue;
    ++across->next_start[complex.edge[2 * size_t{e}]];
    ++across->next_start[complex.edge[2 * size_t{e} + 1]];
    count += 2;
  }
  TRY(across->next.resize(count));
  starts_from_counts(across->next_start.span());
  for (uint32_t e = 0; e < complex.edge_count(); ++e) {
    if (e % k_edges_per_pause == 0) TRY(across->next.context().checkpoint());
    if (!curves.on_curve(e)) continue;
    const uint32_t a = complex.edge[2 * size_t{e}], b = complex.edge[2 * size_t{e} + 1];
    across->next[across->next_start[a]++] = b;
    across->next[across->next_start[b]++] = a;
  }
  shift_starts_back(across->next_start.span());
  return {};
}

namespace {

struct PlaneTriangle {
  Vec3 corner[3], inward[3];  // of the edge from each corner
  double longest = 0.0;
  // The longest edge, where the corners are in a row, but on no curve that they have in common: it
  // has no inside to pass through, yet may reach across curves. Else 3.
  uint32_t sliver = 3;
};

}  // namespace

// Whether a piece of curve from p to q crosses one from a to b in their plane, away from its ends.
static bool crosses_edge(const FacePlane& plane, const Vec3& a, const Vec3& b, double margin,
                         const Vec3& p, const Vec3& q) {
  const Vec3 along = unit(b - a);
  const Vec3 across = cross(plane.normal, along);
  const double at_p = dot(p - a, across), at_q = dot(q - a, across);
  if (larger(at_p, at_q) < margin || smaller(at_p, at_q) > -margin) return false;
  const double t = at_p / (at_p - at_q);
  const double at = dot(p + t * (q - p) - a, along);
  return at > margin && at < length(b - a) - margin;
}

// Whether a piece of curve from p to q passes through a triangle of its plane, not just beside or
// along its edges.
static bool passes_through(const PlaneTriangle& triangle, double margin, const Vec3& p,
                           const Vec3& q) {
  double from = 0.0, to = 1.0;
  for (uint32_t k = 0; k < 3; ++k) {
    const Vec3 &b = triangle.corner[k], &inward = triangle.inward[k];
    const double at_p = dot(p - b, inward) - margin, at_q = dot(q - b, inward) - margin;
    if (at_p <= 0.0 && at_q <= 0.0) return false;
    if (at_p < 0.0) from = larger(from, at_p / (at_p - at_q));
    if (at_q < 0.0) to = smaller(to, at_p / (at_p - at_q));
  }
  return (to - from) * length(q - p) > margin;
}

static PlaneTriangle place_triangle(const Complex& complex, const FacePlane& plane, uint32_t t) {
  PlaneTriangle triangle;
  for (uint32_t k = 0; k < 3; ++k) {
    triangle.corner[k] = complex.point[complex.triangle[3 * size_t{t} + k]];
  }
  const Vec3 n = cross_of_triangle(complex, t);
  const Vec3 up = dot(n, plane.normal) > 0.0 ? plane.normal : -plane.normal;
  uint32_t longest = 0;
  for (uint32_t k = 0; k < 3; ++k) {
    const Vec3 side = triangle.corner[(k + 1) % 3] - triangle.corner[k];
    const double size = length(side);
    if (size > triangle.longest) longest = k;
    triangle.longest = larger(triangle.longest, size);
    triangle.inward[k] = cross(up, unit(side));
  }
  const double flat = 4.0 * k_beside * complex.diagonal * triangle.longest;
  if (length(n) <= flat) triangle.sliver = longest;
  return triangle;
}

static bool reaches_across(const FacePlane& plane, const PlaneTriangle& triangle, double margin,
                           const Vec3& p, const Vec3& q) {
  const uint32_t k = triangle.sliver;
  if (k == 3) return passes_through(triangle, margin, p, q);
  return crosses_edge(plane, triangle.corner[k], triangle.corner[(k + 1) % 3], margin, p, q);
}

static bool any_line_crosses(const Complex& complex, const FacePlane& plane, uint32_t seed,
                             const PlaneTriangle& triangle, CurvesAcross* across) {
  const Array<Vec3>& end = across->line_end;
  if (across->plane_line_of != seed) {
    across->plane_line_of = seed;
    across->plane_line.clear();
    across->work += end.size() / 2;
    for (uint32_t i = 0; i < end.size(); i += 2) {
      const bool within = near_plane(plane, end[i]) && near_plane(plane, end[i + 1]);
      if (within) across->plane_line.push_reserved(i);
    }
  }
  across->work += across->plane_line.size();
  for (const uint32_t i : across->plane_line) {
    const double margin = k_beside * complex.diagonal + across->line_bend[i / 2];
    if (reaches_across(plane, triangle, margin, end[i], end[i + 1])) return true;
  }
  return false;
}

// An end of a segment that runs across lies in a ball round the triangle, as no sample lies in that
// of which the segment is a diameter.
static bool any_bend_crosses(const Complex& complex, const StraightLines& lines,
                             const FacePlane& plane, const PlaneTriangle& triangle,
                             CurvesAcross* across) {
  if (across->curved.empty()) return false;
  const Vec3 middle = (1.0 / 3.0) * (triangle.corner[0] + triangle.corner[1] + triangle.corner[2]);
  const double margin = k_beside * complex.diagonal;
  return across->grid.any_near(middle, triangle.longest, [&](uint32_t at) {
    const uint32_t i = across->curved[at];
    ++across->work;
    if (!near_plane(plane, complex.point[i])) return false;
    for (uint32_t k = across->next_start[i]; k < across->next_start[i + 1]; ++k) {
      const Vec3& q = complex.point[across->next[k]];
      if (!near_plane(plane, q) || !reaches_across(plane, triangle, margin, complex.point[i], q)) {
        continue;
      }
      if (lines.common(i, across->next[k]) == k_none) return true;
    }
    return false;
  });
}

static Status list_lines(const Drawing& drawing, CurvesAcross* across) {
  const Complex& complex = drawing.complex;
  const Samples& samples = drawing.samples;
  const StraightLines& lines = drawing.lines;
  for (uint32_t line = 0; line + 1 < lines.arc_start.size(); ++line) {
    if (line % k_arcs_per_pause == 0) TRY(across->line_end.context().checkpoint());
    const uint32_t first = lines.arc_start[line], last = lines.arc_start[line + 1];
    if (first == last) continue;
    const uint32_t arc = lines.arc[first];
    const Vec3 from = complex.point[complex.same_as[samples.at[samples.start[arc]]]];
    const Vec3 along =
        complex.point[complex.same_as[samples.at[samples.start[arc + 1] - 1]]] - from;
    Vec3 low = from, high = from;
    for (uint32_t i = first; i < last; ++i) {
      const uint32_t a = lines.arc[i];
      for (uint32_t end = 0; end < 2; ++end) {
        const uint32_t at = end == 0 ? samples.start[a] : samples.start[a + 1] - 1;
        const Vec3& p = complex.point[complex.same_as[samples.at[at]]];
        if (dot(p - low, along) < 0.0) low = p;
        if (dot(p - high, along) > 0.0) high = p;
      }
    }
    double bend = 0.0;
    for (uint32_t i = first; i < last; ++i) {
      for (uint32_t k = samples.start[lines.arc[i]]; k < samples.start[lines.arc[i] + 1]; ++k) {
        const Vec3& p = complex.point[complex.same_as[samples.at[k]]];
        bend = larger(bend, length(reject(p - low, unit(high - low))));
      }
    }
    TRY(across->line_bend.push(bend));
    TRY(across->line_end.push(low));
    TRY(across->line_end.push(high));
  }
  return across->plane_line.reserve(across->line_end.size());
}

static Status list_curved(const Drawing& drawing, CurvesAcross* across) {
  const Complex& complex = drawing.complex;
  const Samples& samples = drawing.samples;
  Array<Vec3> point(across->curved.context());
  for (uint32_t a = 0; a + 1 < samples.start.size(); ++a) {
    if (drawing.lines.is_straight(a)) continue;
    for (uint32_t i = samples.start[a]; i < samples.start[a + 1]; ++i) {
      TRY(across->curved.push(complex.same_as[samples.at[i]]));
      TRY(point.push(complex.point[across->curved.back()]));
    }
  }
  return across->grid.build(point.span());
}

Status find_curves_across(const Drawing& drawing, CurvesAcross* across) {
  const Complex& complex = drawing.complex;
  TRY(list_lines(drawing, across));
  TRY(list_curved(drawing, across));
  TRY(across->crossed.assign(complex.triangle_count(), Crossed::unknown));
  TRY(across->judged.reserve(complex.triangle_count()));
  return link_segments(complex, drawing.curves, across);
}

// The complex is embedded: where no flat tetrahedron lies at a triangle no edge runs over it.
static bool has_flat_neighbour(const Complex& complex, const FacePlane& plane, uint32_t t) {
  for (uint32_t side = 0; side < 2; ++side) {
    const uint32_t tet = complex.triangle_side[2 * size_t{t} + side];
    if (tet == k_none) continue;
    bool flat = true;
    for (uint32_t k = 0; k < 4; ++k) {
      flat = flat && near_plane(plane, complex.point[complex.tet[4 * size_t{tet} + k]]);
    }
    if (flat) return true;
  }
  return false;
}

bool is_crossed(const Drawing& drawing, const FacePlane& plane, uint32_t seed, uint32_t t,
                CurvesAcross* across) {
  const Complex& complex = drawing.complex;
  if (!has_flat_neighbour(complex, plane, t)) return false;
  if (across->crossed[t] == Crossed::unknown) {
    const PlaneTriangle triangle = place_triangle(complex, plane, t);
    const bool crossed = any_line_crosses(complex, plane, seed, triangle, across) ||
                         any_bend_crosses(complex, drawing.lines, plane, triangle, across);
    across->crossed[t] = crossed ? Crossed::yes : Crossed::no;
    across->judged.push_reserved(t);
  }
  return across->crossed[t] == Crossed::yes;
}

}  // namespace wireskin::flow
