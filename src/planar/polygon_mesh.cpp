#include "planar/polygon_mesh.h"

#include "base/in_parts.h"
#include "num/minmax.h"
#include "num/predicates.h"
#include "planar/insertion_order.h"
#include "planar/lattice.h"
#include "planar/refine.h"
#include "planar/relax.h"

namespace wireskin::planar {

static constexpr int k_relaxing_sweeps = 6;

// Interior points that a lattice of the spacing would have.
static double expected_points(const Triangulation& t, double spacing) {
  double area2 = 0.0;
  for (const Triangle& triangle : t.triangles) {
    if ((triangle.flags & k_outside) != 0) continue;
    const Vec2& a = t.points[triangle.vertex[0]];
    area2 += cross(t.points[triangle.vertex[1]] - a, t.points[triangle.vertex[2]] - a);
  }
  return area2 / (1.7320508075688772 * spacing * spacing);
}

// A fine border adds a few layers of its own.
static Status limit_vertices(double given, double lattice, size_t* most) {
  const double vertices = 4.0 * lattice + 24.0 * given + 1024.0;
  if (!(lattice + given < 0.5 * k_most_vertices)) {
    return fail(Code::too_large, "the spacing is too small for the size of the patch");
  }
  *most = vertices < k_most_vertices ? static_cast<size_t>(vertices) : k_most_vertices;
  return {};
}

// An edge is an obstacle in the direction that has the inside on its left, else in that from the
// lower vertex to the higher.
static bool is_main_direction(const Triangulation& t, uint32_t h) {
  const uint32_t own = t.triangles[h >> 2].flags & k_outside;
  const uint32_t other = t.triangles[t.twin(h) >> 2].flags & k_outside;
  return own != other ? own == 0 : t.start(h) < t.end(h);
}

// Appends what the lattice keeps clear of at vertex v: the edges of the region that it starts, or
// itself if it has none. Its size is the mean length of its edges, or else the spacing, or the
// distance of its nearest neighbour if that is less.
static Status survey_star(const Triangulation& t, uint32_t v, double spacing, double* size,
                          Array<LatticeObstacle>* obstacles) {
  double sum = 0.0, nearest = spacing, shortest = DBL_MAX;
  uint32_t edges = 0, spoke = t.leaving[v];
  do {
    const Vec2& end = t.points[t.end(spoke)];
    const double reach = length(end - t.points[v]);
    nearest = smaller(nearest, reach);
    if (t.constrained(spoke)) {
      const bool border = (t.edge_bits(spoke) & k_border) != 0;
      sum += reach;
      shortest = smaller(shortest, reach);
      ++edges;
      if (is_main_direction(t, spoke)) {
        TRY(obstacles->push({t.points[v], end, reach, border}));
      }
    }
    spoke = t.turn(spoke);
  } while (spoke != t.leaving[v]);
  *size = edges != 0 ? smaller(sum / edges, 2.0 * shortest) : nearest;
  if (edges == 0) TRY(obstacles->push({t.points[v], t.points[v], nearest, false}));
  return {};
}

static Status survey(const Triangulation& t, double spacing, Array<double>* sizes,
                     Array<LatticeObstacle>* obstacles) {
  const uint32_t count = static_cast<uint32_t>(t.points.size());
  TRY(assign_in_parts(count, spacing, sizes));
  TRY(obstacles->reserve(count));
  for (uint32_t v = k_box_corners; v < count; ++v) {
    if (v % 4096 == 0) TRY(sizes->context().checkpoint());
    if (t.leaving[v] != k_none) TRY(survey_star(t, v, spacing, &(*sizes)[v], obstacles));
  }
  return {};
}

// A lattice point that rounding put outside or onto something is left out: refine() fills the gap.
static Status insert_lattice(Span<const Vec2> lattice, double spacing, Triangulation* t,
                             Array<double>* sizes) {
  Array<uint32_t> order(t->points.context());
  TRY(insertion_order(lattice, &order));
  TRY(sizes->reserve(sizes->size() + lattice.size()));
  TRY(t->points.reserve(t->points.size() + lattice.size()));
  TRY(t->leaving.reserve(t->points.size() + lattice.size()));
  TRY(t->triangles.reserve(t->triangles.size() + 2 * lattice.size()));
  for (size_t i = 0; i < lattice.size(); ++i) {
    if (i % 4096 == 0) TRY(t->points.context().checkpoint());
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

static Status fill_inside(const Region& region, double spacing, Triangulation* t) {
  Context& context = t->points.context();
  Array<double> sizes(context);
  Array<LatticeObstacle> obstacles(context);
  Array<Vec2> lattice(context);
  const uint32_t given = static_cast<uint32_t>(region.points.size());
  const double expected = expected_points(*t, spacing);
  size_t most_vertices = 0;
  TRY(limit_vertices(given, expected, &most_vertices));
  TRY(survey(*t, spacing, &sizes, &obstacles));
  TRY(lattice_points(obstacles.span(), spacing, expected, &lattice));
  TRY(insert_lattice(lattice.span(), spacing, t, &sizes));
  const uint32_t first_loose = static_cast<uint32_t>(t->points.size());
  TRY(refine(t, &sizes, spacing, most_vertices));
  return relax(t, sizes.span(), k_box_corners + given, first_loose, k_relaxing_sweeps);
}

static Status copy_result(const Triangulation& t, Span<const Vec2> given, PolygonMesh* mesh) {
  Context& context = mesh->points.context();
  size_t count = 0;
  TRY(in_parts(context, t.triangles.size(),
               [&](size_t i) { count += (t.triangles[i].flags & k_outside) == 0 ? 1u : 0u; }));
  TRY(mesh->points.resize(t.points.size() - k_box_corners));
  TRY(mesh->triangles.reserve(3 * count));
  TRY(in_parts(context, mesh->points.size(), [&](size_t i) {
    mesh->points[i] = i < given.size() ? given[i] : t.points[i + k_box_corners];
  }));
  return in_parts(context, t.triangles.size(), [&](size_t i) {
    const Triangle& triangle = t.triangles[i];
    if ((triangle.flags & k_outside) != 0) return;
    for (const uint32_t v : triangle.vertex) mesh->triangles.push_reserved(v - k_box_corners);
  });
}

static void hand_over(PolygonMesh* result, PolygonMesh* mesh) {
  mesh->points = static_cast<Array<Vec2>&&>(result->points);
  mesh->triangles = static_cast<Array<uint32_t>&&>(result->triangles);
  mesh->joined = static_cast<Array<uint32_t>&&>(result->joined);
}

static Status check_spacing(double spacing) {
  if (spacing > 0.0 && spacing <= DBL_MAX) return {};
  return fail(Code::bad_argument, "the spacing is not a positive number");
}

Status mesh_region(Context& context, const Region& region, double spacing, PolygonMesh* mesh) {
  Triangulation t(context);
  PolygonMesh result(context);
  mesh->conflict = {};
  TRY(check_spacing(spacing));
  TRY(triangulate_region(region, &t, &result.joined, &mesh->conflict));
  TRY(fill_inside(region, spacing, &t));
  TRY(copy_result(t, region.points, &result));
  hand_over(&result, mesh);
  return {};
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

Status mesh_polygon(Context& context, Span<const Vec2> border, double spacing, PolygonMesh* mesh) {
  const uint32_t count = static_cast<uint32_t>(border.size());
  Array<uint32_t> edges(context);
  Triangulation t(context);
  PolygonMesh result(context);
  mesh->conflict = {};
  TRY(check_spacing(spacing));
  if (count < 3) return fail(Code::patch_folded, "the border has fewer than three points");
  TRY(edges.resize(2 * size_t{count}));
  for (uint32_t i = 0; i < count; ++i) {
    edges[2 * i] = i;
    edges[2 * i + 1] = i + 1 < count ? i + 1 : 0;
  }
  const Region region = {border, edges.span(), {}, false};
  TRY(triangulate_region(region, &t, &result.joined, &mesh->conflict));
  if (!turns_left({t.points.data() + k_box_corners, count})) {
    return fail(Code::patch_without_plane, "the border of the patch runs clockwise");
  }
  TRY(fill_inside(region, spacing, &t));
  TRY(copy_result(t, border, &result));
  hand_over(&result, mesh);
  return {};
}

}  // namespace wireskin::planar
