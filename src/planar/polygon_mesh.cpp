#include "planar/polygon_mesh.h"

#include "num/minmax.h"
#include "num/predicates.h"
#include "planar/constrained_delaunay.h"
#include "planar/insertion_order.h"
#include "planar/lattice.h"
#include "planar/refine.h"
#include "planar/relax.h"

namespace wireskin::planar {

static constexpr int k_relaxing_sweeps = 6;

static Status check_coordinates(Span<const Vec2> border, double* greatest) {
  *greatest = 0.0;
  for (const Vec2& p : border) {
    if (p.x != p.x || p.y != p.y) return fail(Code::not_a_number, "a coordinate is not a number");
    *greatest = larger(*greatest, larger(std::fabs(p.x), std::fabs(p.y)));
  }
  if (*greatest > DBL_MAX) return fail(Code::infinite, "a coordinate is infinite");
  if (*greatest > 0.25 * k_greatest_coordinate) {
    return fail(Code::bad_argument, "a coordinate is too great for exact arithmetic");
  }
  return {};
}

// Numbers too small for exact products, next to the others, become zero: a change by 1e-30 of the
// polygon's extent, and only in the working copy.
static double flush(double value, double least) {
  return std::fabs(value) < least ? 0.0 : value;
}

static Status copy_border(Span<const Vec2> border, double greatest, Array<Vec2>* points) {
  const double least = larger(0x1p-100 * greatest, k_least_coordinate);
  TRY(points->reserve(border.size()));
  for (const Vec2& p : border) points->push_reserved({flush(p.x, least), flush(p.y, least)});
  return {};
}

// Twice the area, by triangles round the first point.
static double shoelace(Span<const Vec2> border) {
  double sum = 0.0;
  for (size_t i = 2; i < border.size(); ++i) {
    sum += cross(border[i - 1] - border[0], border[i] - border[0]);
  }
  return sum;
}

// A lattice of `spacing` would have `expected` points; a fine border adds a few layers of its own.
static Status limit_vertices(Span<const Vec2> border, double lattice, size_t* most) {
  const double vertices = 4.0 * lattice + 24.0 * static_cast<double>(border.size()) + 1024.0;
  if (!(lattice + static_cast<double>(border.size()) < k_most_vertices / 2)) {
    return fail(Code::too_large, "the spacing is too small for the size of the patch");
  }
  *most = vertices < k_most_vertices ? static_cast<size_t>(vertices) : k_most_vertices;
  return {};
}

static bool all_on_one_line(Span<const Vec2> points) {
  for (size_t i = 2; i < points.size(); ++i) {
    if (orient2d(points[0], points[1], points[i]) != 0.0) return false;
  }
  return true;
}

// In border order the vertices follow the box corners, whatever order they are inserted in; so the
// triangulation is relabelled afterwards.
static Status insert_border(Span<const Vec2> border, Triangulation* t) {
  const uint32_t count = static_cast<uint32_t>(border.size());
  Array<uint32_t> order(t->points.context());
  Array<uint32_t> leaving(t->points.context());
  TRY(insertion_order(border, &order));
  TRY(leaving.resize(k_box_corners + count));
  TRY(begin_box(border, t));
  for (uint32_t i = 0; i < count; ++i) {
    if (i % 16384 == 0) TRY(t->points.context().checkpoint());
    TRY(insert_point(t, border[order[i]]));
  }
  for (Triangle& triangle : t->triangles) {
    for (uint32_t& v : triangle.vertex) {
      if (v >= k_box_corners) v = k_box_corners + order[v - k_box_corners];
    }
  }
  for (uint32_t v = 0; v < k_box_corners; ++v) leaving[v] = t->leaving[v];
  for (uint32_t i = 0; i < count; ++i) {
    leaving[k_box_corners + order[i]] = t->leaving[k_box_corners + i];
    t->points[k_box_corners + i] = border[i];
  }
  return t->leaving.copy(leaving.span());
}

// Is a simple polygon counter-clockwise? At its leftmost point (the lowest of those), it turns
// left.
static bool turns_left(Span<const Vec2> border) {
  size_t corner = 0;
  for (size_t i = 1; i < border.size(); ++i) {
    const Vec2 p = border[i];
    const Vec2 q = border[corner];
    if (p.x < q.x || (p.x == q.x && p.y < q.y)) corner = i;
  }
  const size_t last = border.size() - 1;
  return orient2d(border[corner == 0 ? last : corner - 1], border[corner],
                  border[corner == last ? 0 : corner + 1]) > 0.0;
}

// The mean length of its two edges, for each border point; the box corners are never asked.
static Status border_sizes(Span<const Vec2> border, Array<double>* sizes) {
  TRY(sizes->assign(k_box_corners + border.size(), 0.0));
  size_t before = border.size() - 1;
  for (size_t i = 0; i < border.size(); ++i) {
    const double half = 0.5 * length(border[i] - border[before]);
    (*sizes)[k_box_corners + before] += half;
    (*sizes)[k_box_corners + i] += half;
    before = i;
  }
  return {};
}

static Status triangulate_border(Span<const Vec2> border, Triangulation* t) {
  const uint32_t count = static_cast<uint32_t>(border.size());
  TRY(insert_border(border, t));
  if (all_on_one_line(border)) {
    return fail(Code::patch_without_plane, "the border of the patch has no area");
  }
  for (uint32_t i = 0; i < count; ++i) {
    if (i % 4096 == 0) TRY(t->points.context().checkpoint());
    TRY(recover_edge(t, k_box_corners + i, k_box_corners + (i + 1 < count ? i + 1 : 0)));
  }
  if (!turns_left(border)) {
    return fail(Code::patch_without_plane, "the border of the patch runs clockwise");
  }
  return mark_outside(t);
}

// A lattice point that rounding put outside or onto something is left out: refine() fills the gap.
static Status insert_lattice(Span<const Vec2> lattice, double spacing, Triangulation* t,
                             Array<double>* sizes) {
  Array<uint32_t> order(t->points.context());
  TRY(insertion_order(lattice, &order));
  TRY(sizes->reserve(sizes->size() + lattice.size()));
  for (size_t i = 0; i < lattice.size(); ++i) {
    if (i % 16384 == 0) TRY(t->points.context().checkpoint());
    const Vec2 p = lattice[order[i]];
    const Location location = locate(t, p, t->hint, false);
    if (location.where != Where::inside && location.where != Where::on_edge) continue;
    if (location.where == Where::on_edge && t->constrained(location.edge)) continue;
    if ((t->triangles[location.edge >> 2].flags & k_outside) != 0) continue;
    TRY(collect_cavity(t, p, location.edge >> 2));
    TRY(fill_cavity(t, p));
    sizes->push_reserved(spacing);
  }
  return {};
}

static Status copy_result(const Triangulation& t, Span<const Vec2> border, PolygonMesh* mesh) {
  size_t count = 0;
  for (const Triangle& triangle : t.triangles) count += (triangle.flags & k_outside) == 0 ? 1u : 0u;
  TRY(mesh->points.resize(t.points.size() - k_box_corners));
  TRY(mesh->triangles.reserve(3 * count));
  for (size_t i = 0; i < mesh->points.size(); ++i) {
    mesh->points[i] = i < border.size() ? border[i] : t.points[i + k_box_corners];
  }
  for (const Triangle& triangle : t.triangles) {
    if ((triangle.flags & k_outside) != 0) continue;
    for (const uint32_t v : triangle.vertex) mesh->triangles.push_reserved(v - k_box_corners);
  }
  return {};
}

Status mesh_polygon(Context& context, Span<const Vec2> border, double spacing, PolygonMesh* mesh) {
  if (!(spacing > 0.0) || spacing > DBL_MAX) {
    return fail(Code::bad_argument, "the spacing is not a positive number");
  }
  if (border.size() < 3) return fail(Code::patch_folded, "the border has fewer than three points");
  double greatest = 0.0;
  size_t most_vertices = 0;
  TRY(check_coordinates(border, &greatest));
  const double expected = std::fabs(shoelace(border)) / (1.7320508075688772 * spacing * spacing);
  TRY(limit_vertices(border, expected, &most_vertices));
  Array<Vec2> points(context);
  Array<Vec2> lattice(context);
  Array<double> sizes(context);
  Triangulation t(context);
  TRY(copy_border(border, greatest, &points));
  TRY(triangulate_border(points.span(), &t));
  TRY(border_sizes(points.span(), &sizes));
  TRY(lattice_points(points.span(), spacing, expected, &lattice));
  TRY(insert_lattice(lattice.span(), spacing, &t, &sizes));
  TRY(refine(&t, &sizes, spacing, most_vertices));
  TRY(relax(&t, sizes.span(), k_box_corners + static_cast<uint32_t>(border.size()),
            k_relaxing_sweeps));
  PolygonMesh result(context);
  TRY(copy_result(t, border, &result));
  mesh->points = static_cast<Array<Vec2>&&>(result.points);
  mesh->triangles = static_cast<Array<uint32_t>&&>(result.triangles);
  return {};
}

}  // namespace wireskin::planar
