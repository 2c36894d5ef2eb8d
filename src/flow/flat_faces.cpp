#include "flow/flat_faces.h"

#include "base/in_parts.h"
#include "base/sort_in_parts.h"
#include "flow/face_crossings.h"
#include "num/minmax.h"

namespace wireskin::flow {

static constexpr double k_least_corner = 0.94;  // cosine of what a polygon turns at a corner
// Corners keep their noise, and a plane may go through some that are off it.
static constexpr double k_noise_off_plane = 3.0;  // times its standard deviation
static constexpr double k_most_noise = 10.0;      // times what is flat without noise
static constexpr double k_exact = 0.02;  // of what counts as flat: planes are no matter of choice
static constexpr uint8_t k_most_visits = 4;
static constexpr size_t k_flood_per_checkpoint = size_t{1} << 15;

namespace {

struct FaceFlood {
  CurvesAcross across;
  size_t most_work;
  size_t work = 0, next_checkpoint = k_flood_per_checkpoint;
  Array<uint32_t> mark;               // of each triangle: the seed whose face it was last in
  Array<uint8_t> visits;              // of each triangle
  Array<uint32_t> member;             // the face
  Array<uint32_t> left;               // to be looked at again
  Array<uint8_t> straight;            // of each edge: on a straight arc
  Array<uint32_t> arc_of;             // of each edge on a curve
  Array<uint32_t> rim_of;             // of each arc: the seed of the face that has it last
  Array<uint32_t> seen, border_edge;  // of each vertex: its edges on the border, and one of them

  FaceFlood(Context& context, size_t most)
      : across(context),
        most_work(most),
        mark(context),
        visits(context),
        member(context),
        left(context),
        straight(context),
        arc_of(context),
        rim_of(context),
        seen(context),
        border_edge(context) {}
  size_t all_work() const { return work + across.work; }
  bool too_much() const { return all_work() > most_work; }
  Status pause() {
    if (all_work() <= next_checkpoint) return {};
    next_checkpoint = all_work() + k_flood_per_checkpoint;
    return mark.context().checkpoint();
  }
};

}  // namespace

static FacePlane plane_of(const Complex& complex, uint32_t t, double flat) {
  return {complex.point[complex.triangle[3 * size_t{t}]], unit(cross_of_triangle(complex, t)),
          flat};
}

static bool in_plane(const Complex& complex, const FacePlane& plane, uint32_t t) {
  for (uint32_t k = 0; k < 3; ++k) {
    if (!near_plane(plane, complex.point[complex.triangle[3 * size_t{t} + k]])) return false;
  }
  return true;
}

// Marks the edges of arcs.
static Status mark_arcs(const Drawing& drawing, FaceFlood* flood) {
  const Complex& complex = drawing.complex;
  const Samples& samples = drawing.samples;
  TRY(flood->straight.assign(complex.edge_count(), 0));
  TRY(flood->arc_of.assign(complex.edge_count(), k_none));
  TRY(flood->rim_of.assign(samples.start.size(), k_none));
  for (uint32_t a = 0; a + 1 < samples.start.size(); ++a) {
    for (uint32_t i = samples.start[a]; i + 1 < samples.start[a + 1]; ++i) {
      if (drawing.curves.edge_of[i] == k_none) continue;
      flood->arc_of[drawing.curves.edge_of[i]] = a;
      if (drawing.lines.is_straight(a)) flood->straight[drawing.curves.edge_of[i]] = 1;
    }
  }
  return {};
}

static Vec3 edge_vector(const Complex& complex, uint32_t e, uint32_t from) {
  const uint32_t a = complex.edge[2 * size_t{e}], b = complex.edge[2 * size_t{e} + 1];
  return unit(a == from ? complex.point[b] - complex.point[a]
                        : complex.point[a] - complex.point[b]);
}

// Edges of the complex that belong to the curves, or run along a straight line of them.
static bool on_rim(const Drawing& drawing, uint32_t e) {
  const Complex& complex = drawing.complex;
  if (drawing.curves.on_curve(e)) return true;
  return drawing.lines.common(complex.edge[2 * size_t{e}], complex.edge[2 * size_t{e} + 1]) !=
         k_none;
}

// All corners on one straight line: such a triangle lies in every plane through it.
static bool is_line(const Drawing& drawing, uint32_t t) {
  const Complex& complex = drawing.complex;
  const uint32_t* const v = &complex.triangle[3 * size_t{t}];
  const uint32_t* const edge = &complex.triangle_edge[3 * size_t{t}];
  for (uint32_t k = 0; k < 3; ++k) {
    const uint32_t e = edge[(k + 1) % 3], f = edge[(k + 2) % 3];
    if (!drawing.curves.on_curve(e) || !drawing.curves.on_curve(f)) continue;
    if (dot(edge_vector(complex, e, v[k]), edge_vector(complex, f, v[k])) < -k_same_line) {
      return true;
    }
  }
  return drawing.lines.common(v[0], v[1], v[2]) != k_none;
}

// Which side of an edge, within the plane, a triangle lies on.
static bool on_left(const Complex& complex, const FacePlane& plane, uint32_t e, uint32_t t) {
  const Vec3& a = complex.point[complex.edge[2 * size_t{e}]];
  const Vec3& b = complex.point[complex.edge[2 * size_t{e} + 1]];
  const uint32_t* const v = &complex.triangle[3 * size_t{t}];
  const Vec3 middle =
      (1.0 / 3.0) * (complex.point[v[0]] + complex.point[v[1]] + complex.point[v[2]]);
  return dot(cross(b - a, middle - a), plane.normal) > 0.0;
}

// The sides of an edge that the face takes up, a bit each.
static uint32_t sides_of(const Complex& complex, const FaceFlood& flood, const FacePlane& plane,
                         uint32_t seed, uint32_t e) {
  uint32_t sides = 0;
  for (const uint32_t t : complex.triangles_of(e)) {
    if (flood.mark[t] == seed) sides |= on_left(complex, plane, e, t) ? 1u : 2u;
  }
  return sides;
}

static Status flood_face(const Drawing& drawing, const FlatFaces& faces, const FacePlane& plane,
                         uint32_t seed, FaceFlood* flood) {
  const Complex& complex = drawing.complex;
  flood->member.clear();
  const auto add = [&](uint32_t t) {
    flood->mark[t] = seed;
    ++flood->visits[t];
    return flood->member.push(t);
  };
  TRY(add(seed));
  for (size_t i = 0; i < flood->member.size() && !flood->too_much(); ++i) {
    for (uint32_t k = 0; k < 3; ++k) {
      const uint32_t e = complex.triangle_edge[3 * size_t{flood->member[i]} + k];
      ++flood->work;
      if (on_rim(drawing, e)) continue;
      for (const uint32_t t : complex.triangles_of(e)) {
        const bool done = flood->mark[t] == seed || flood->visits[t] >= k_most_visits;
        if (done || faces.part[t] != FlatPart::none || !in_plane(complex, plane, t)) continue;
        if (is_line(drawing, t)) continue;
        if (!is_crossed(drawing, plane, seed, t, &flood->across)) TRY(add(t));
        TRY(flood->pause());
      }
    }
  }
  return {};
}

// The plane of the triangles found, and how far off the one before they were at most.
static FacePlane plane_of_members(const Complex& complex, const FaceFlood& flood,
                                  const FacePlane& plane, double* off) {
  Vec3 normal, middle;
  *off = 0.0;
  for (const uint32_t t : flood.member) {
    const uint32_t* const v = &complex.triangle[3 * size_t{t}];
    const Vec3 &a = complex.point[v[0]], &b = complex.point[v[1]], &c = complex.point[v[2]];
    const Vec3 n = cross(b - a, c - a);
    if (dot(n, plane.normal) > 0.0) normal += n;
    if (dot(n, plane.normal) < 0.0) normal -= n;
    middle += (1.0 / 3.0) * (a - plane.at + (b - plane.at) + (c - plane.at));
    for (uint32_t k = 0; k < 3; ++k) {
      *off = larger(*off, std::fabs(dot(complex.point[v[k]] - plane.at, plane.normal)));
    }
  }
  const double share = 1.0 / static_cast<double>(flood.member.size());
  return {plane.at + share * middle, unit(normal), plane.flat};
}

// With noise the plane of one triangle is askew: the planes of all that it has in reach follow.
static Status flood_plane(const Drawing& drawing, const FlatFaces& faces, uint32_t seed,
                          FacePlane* plane, FaceFlood* flood) {
  const Complex& complex = drawing.complex;
  constexpr uint32_t k_most_planes = 4;
  for (uint32_t i = 0; i < k_most_planes; ++i) {
    TRY(flood_face(drawing, faces, *plane, seed, flood));
    double off = 0.0;
    const FacePlane next = plane_of_members(complex, *flood, *plane, &off);
    if (off <= k_exact * plane->flat || i + 1 == k_most_planes) break;
    if (flood->too_much() || !in_plane(complex, next, seed)) break;
    for (const uint32_t t : flood->member) {
      flood->mark[t] = k_none;
      --flood->visits[t];
    }
    flood->across.forget_judged();
    flood->across.plane_line_of = k_none;
    *plane = next;
  }
  return {};
}

// Whether the triangle goes on, at each of its edges off the curves, on the other side.
static bool goes_on_all_round(const Drawing& drawing, const FaceFlood& flood,
                              const FacePlane& plane, uint32_t seed, uint32_t t) {
  const Complex& complex = drawing.complex;
  for (uint32_t k = 0; k < 3; ++k) {
    const uint32_t e = complex.triangle_edge[3 * size_t{t} + k];
    if (on_rim(drawing, e)) continue;
    if (sides_of(complex, flood, plane, seed, e) != 3) return false;
  }
  return true;
}

// Leaves only triangles that go on all round: all of a face where curves close it, nothing where
// not.
static Status close_face(const Drawing& drawing, const FacePlane& plane, uint32_t seed,
                         FaceFlood* flood) {
  const Complex& complex = drawing.complex;
  Array<uint32_t>& left = flood->left;
  TRY(left.copy(flood->member.span()));
  while (!left.empty()) {
    const uint32_t t = left.back();
    left.pop();
    ++flood->work;
    TRY(flood->pause());
    if (flood->mark[t] != seed) continue;
    if (goes_on_all_round(drawing, *flood, plane, seed, t)) continue;
    flood->mark[t] = k_none;
    for (uint32_t k = 0; k < 3; ++k) {
      const uint32_t e = complex.triangle_edge[3 * size_t{t} + k];
      if (on_rim(drawing, e)) continue;
      for (const uint32_t next : complex.triangles_of(e)) {
        if (flood->mark[next] == seed) TRY(left.push(next));
      }
    }
  }
  size_t kept = 0;
  for (const uint32_t t : flood->member) {
    if (flood->mark[t] == seed) flood->member[kept++] = t;
  }
  flood->member.shrink(kept);
  return {};
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

static bool is_polygon(const Drawing& drawing, const FacePlane& plane, uint32_t seed,
                       FaceFlood* flood) {
  const Complex& complex = drawing.complex;
  double whole = 0.0, straight = 0.0;
  bool corners = true;
  for (const uint32_t t : flood->member) {
    for (uint32_t k = 0; k < 3; ++k) {
      const uint32_t e = complex.triangle_edge[3 * size_t{t} + k];
      if (!on_rim(drawing, e)) continue;
      if (sides_of(complex, *flood, plane, seed, e) == 3) continue;
      const double size = length(complex.point[complex.edge[2 * size_t{e}]] -
                                 complex.point[complex.edge[2 * size_t{e} + 1]]);
      whole += size;
      if (drawing.curves.on_curve(e) && flood->straight[e] == 0) continue;
      straight += size;
      corners = turns_well(complex, e, flood) && corners;
    }
  }
  for (const uint32_t t : flood->member) {
    for (uint32_t k = 0; k < 3; ++k) flood->seen[complex.triangle[3 * size_t{t} + k]] = 0;
  }
  return corners && straight >= 0.5 * whole;
}

// Whether a curve goes through the face, from one side to the other.
static bool is_pierced(const Complex& complex, const FacePlane& plane, const FaceFlood& flood) {
  for (const uint32_t t : flood.member) {
    for (uint32_t k = 0; k < 3; ++k) {
      const uint32_t v = complex.triangle[3 * size_t{t} + k];
      bool above = false, below = false, within = false;
      for (uint32_t i = flood.across.next_start[v]; i < flood.across.next_start[v + 1]; ++i) {
        const double off = dot(complex.point[flood.across.next[i]] - plane.at, plane.normal);
        above = above || off > plane.flat;
        below = below || off < -plane.flat;
        within = within || std::fabs(off) <= plane.flat;
      }
      if (above && below && !within) return true;
    }
  }
  return false;
}

// Notes an arc that has the face on one side.
static Status add_rim(const Complex& complex, const FacePlane& plane, uint32_t arc, uint32_t e,
                      uint32_t sides, uint32_t seed, FaceFlood* flood, FlatFaces* faces) {
  if (flood->rim_of[arc] == seed) return {};
  flood->rim_of[arc] = seed;
  const Vec3 left = cross(plane.normal, edge_vector(complex, e, complex.edge[2 * size_t{e}]));
  return faces->rim.push({arc, sides == 1 ? left : -left});
}

// Whether an arc of a line runs along an edge on it, for more than half of either.
static bool runs_along(const Complex& complex, const Samples& samples, uint32_t a, uint32_t e) {
  const Vec3& from = complex.point[complex.edge[2 * size_t{e}]];
  const Vec3& to = complex.point[complex.edge[2 * size_t{e} + 1]];
  const Vec3 along = unit(to - from);
  const double whole = length(to - from);
  double s = dot(samples.position[samples.at[samples.start[a]]] - from, along);
  double t = dot(samples.position[samples.at[samples.start[a + 1] - 1]] - from, along);
  if (s > t) swap_values(s, t);
  const double common = smaller(t, whole) - larger(s, 0.0);
  return common > 0.5 * smaller(whole, t - s);
}

static Status add_face(const Drawing& drawing, const FacePlane& plane, uint32_t seed,
                       FaceFlood* flood, FlatFaces* faces) {
  const Complex& complex = drawing.complex;
  const StraightLines& lines = drawing.lines;
  for (const uint32_t t : flood->member) {
    faces->part[t] = faces->polygon.back() != 0 ? FlatPart::polygon : FlatPart::disc;
    TRY(faces->triangle.push(t));
    for (uint32_t k = 0; k < 3; ++k) {
      const uint32_t e = complex.triangle_edge[3 * size_t{t} + k];
      if (!on_rim(drawing, e)) continue;
      const uint32_t sides = sides_of(complex, *flood, plane, seed, e);
      if (sides == 3) continue;
      if (drawing.curves.on_curve(e)) {
        TRY(add_rim(complex, plane, flood->arc_of[e], e, sides, seed, flood, faces));
        continue;
      }
      const uint32_t* const v = &complex.edge[2 * size_t{e}];
      const uint32_t line = lines.common(v[0], v[1]);
      for (uint32_t i = lines.arc_start[line]; i < lines.arc_start[line + 1]; ++i) {
        if (!runs_along(complex, drawing.samples, lines.arc[i], e)) continue;
        TRY(add_rim(complex, plane, lines.arc[i], e, sides, seed, flood, faces));
      }
    }
  }
  TRY(faces->normal.push(plane.normal));
  TRY(faces->start.push(static_cast<uint32_t>(faces->triangle.size())));
  return faces->rim_start.push(static_cast<uint32_t>(faces->rim.size()));
}

// The plane of an arc that is not straight; none if it has no plane or is not to be looked at.
static bool plane_of_arc(const Samples& samples, uint32_t a, double flat, FacePlane* plane) {
  const uint32_t first = samples.start[a], last = samples.start[a + 1] - 1;
  const auto at = [&](uint32_t i) { return samples.position[samples.at[i]]; };
  Vec3 normal;
  for (uint32_t i = first + 1; i + 1 <= last; ++i) {
    normal += cross(at(i) - at(first), at(i + 1) - at(first));
  }
  *plane = {at(first), unit(normal), flat};
  for (uint32_t i = first; i <= last; ++i) {
    const double off = dot(at(i) - plane->at, plane->normal);
    if (std::fabs(off) > 0.1 * flat) return false;
  }
  return dot(normal, normal) > 0.0;
}

// Triangles at straight arcs, and those in the planes of others, which every face has, largest
// first.
static Status list_seeds(const Drawing& drawing, double flat, Array<double>* area,
                         Array<uint32_t>* seeds) {
  const Complex& complex = drawing.complex;
  const Samples& samples = drawing.samples;
  Pace pace(area->context());
  TRY(area->assign(complex.triangle_count(), 0.0));
  for (uint32_t a = 0; a + 1 < samples.start.size(); ++a) {
    FacePlane plane;
    const bool straight = drawing.lines.is_straight(a);
    if (!straight && !plane_of_arc(samples, a, flat, &plane)) continue;
    for (uint32_t i = samples.start[a]; i + 1 < samples.start[a + 1]; ++i) {
      if (drawing.curves.edge_of[i] == k_none) continue;
      for (const uint32_t t : complex.triangles_of(drawing.curves.edge_of[i])) {
        TRY(pace.after());
        if ((*area)[t] > 0.0 || is_line(drawing, t)) continue;
        if (!straight && !in_plane(complex, plane, t)) continue;
        (*area)[t] = length(cross_of_triangle(complex, t));
        TRY(seeds->push(t));
      }
    }
  }
  return sort_in_parts(area->context(), seeds->span(), [&](uint32_t a, uint32_t b) {
    return (*area)[a] != (*area)[b] ? (*area)[a] > (*area)[b] : a < b;
  });
}

static Status start_faces(const Drawing& drawing, FaceFlood* flood, FlatFaces* faces) {
  const Complex& complex = drawing.complex;
  TRY(faces->part.assign(complex.triangle_count(), FlatPart::none));
  TRY(faces->start.push(0));
  TRY(faces->rim_start.push(0));
  TRY(find_curves_across(drawing, &flood->across));
  TRY(flood->mark.assign(complex.triangle_count(), k_none));
  TRY(flood->visits.assign(complex.triangle_count(), 0));
  TRY(flood->seen.assign(complex.point.size(), 0));
  TRY(flood->border_edge.resize(complex.point.size()));
  return mark_arcs(drawing, flood);
}

static Status forget_faces(FlatFaces* faces) {
  faces->start.clear();
  faces->triangle.clear();
  faces->normal.clear();
  faces->polygon.clear();
  faces->rim_start.clear();
  faces->rim.clear();
  for (FlatPart& part : faces->part) part = FlatPart::none;
  faces->given_up = true;
  return {};
}

Status find_flat_faces(Context& context, const Drawing& drawing, double noise, FlatFaces* faces,
                       size_t most_work) {
  const Complex& complex = drawing.complex;
  const double flat = k_flat * complex.diagonal;
  faces->flat = larger(flat, smaller(k_noise_off_plane * noise, k_most_noise * flat));
  FaceFlood flood(context, most_work);
  Array<double> area(context);
  Array<uint32_t> seeds(context);
  TRY(start_faces(drawing, &flood, faces));
  TRY(context.checkpoint());
  TRY(list_seeds(drawing, faces->flat, &area, &seeds));
  for (const uint32_t seed : seeds) {
    TRY(flood.pause());
    if (flood.too_much()) return forget_faces(faces);
    if (flood.visits[seed] != 0) continue;
    flood.across.judged.clear();
    FacePlane plane = plane_of(complex, seed, faces->flat);
    if (is_crossed(drawing, plane, seed, seed, &flood.across)) continue;
    TRY(flood_plane(drawing, *faces, seed, &plane, &flood));
    if (flood.too_much()) return forget_faces(faces);
    TRY(close_face(drawing, plane, seed, &flood));
    if (flood.member.empty() || is_pierced(complex, plane, flood)) continue;
    TRY(faces->polygon.push(is_polygon(drawing, plane, seed, &flood)));
    TRY(add_face(drawing, plane, seed, &flood, faces));
  }
  if (faces->size() == 0) return {};
  return in_parts(context, complex.triangle_count(), [&](size_t i) {
    const uint32_t t = static_cast<uint32_t>(i);
    if (is_line(drawing, t)) faces->part[t] = FlatPart::line;
  });
}

}  // namespace wireskin::flow
