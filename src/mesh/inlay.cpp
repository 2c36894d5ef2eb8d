#include "mesh/inlay.h"

#include "mesh/chart.h"
#include "mesh/dome.h"
#include "mesh/loop_refine.h"
#include "mesh/nearest.h"
#include "num/minmax.h"
#include "planar/insertion_order.h"
#include "planar/region.h"

namespace wireskin::mesh {

// Vertices of the mesh nearer to an edge of the curves than this part of the spacing make way.
static constexpr double k_room = 0.5;

namespace {

struct InlayWork {
  Span<const uint32_t> start;
  const Inlay& inlay;
  double spacing;
  uint32_t rim;                     // loop vertices
  Array<Vec2> flat;                 // of the mesh
  Array<Vec3> foot;                 // of each point, on the mesh
  Array<Vec2> drawn;                // loop vertices and feet in the chart
  Array<uint32_t> border;           // the loops' edges
  Array<uint32_t> vertex_of_point;  // of each triangulated point behind those drawn, the vertex

  InlayWork(Context& context, Span<const uint32_t> loops, const Inlay& of, double wished)
      : start(loops),
        inlay(of),
        spacing(wished),
        rim(loops[loops.size() - 1]),
        flat(context),
        foot(context),
        drawn(context),
        border(context),
        vertex_of_point(context) {}
  uint32_t held() const { return rim + static_cast<uint32_t>(inlay.point.size()); }
};

}  // namespace

// The nearest place in the triangles round the nearest vertex.
static Status find_feet(Span<const Vec3> position, Span<const uint32_t> triangle, InlayWork* work) {
  Context& context = work->flat.context();
  Array<uint32_t> start(context), corner(context);
  TRY(find_corners(static_cast<uint32_t>(position.size()), triangle, &start, &corner));
  TRY(work->foot.resize(work->inlay.point.size()));
  TRY(work->drawn.copy(work->flat.span().part(0, work->rim)));
  for (size_t i = 0; i < work->foot.size(); ++i) {
    const Vec3& p = work->inlay.point[i];
    uint32_t nearest = 0;
    double least = DBL_MAX;
    for (uint32_t v = 0; v < position.size(); ++v) {
      const Vec3 gap = position[v] - p;
      if (dot(gap, gap) < least) least = dot(gap, gap), nearest = v;
    }
    Vec2 flat;
    bool beside = false;
    least = DBL_MAX;
    for (uint32_t k = start[nearest]; k < start[nearest + 1]; ++k) {
      const uint32_t* t = &triangle[corner[k] / 3 * 3];
      const Vec3 w = nearest_weights(p, position[t[0]], position[t[1]], position[t[2]]);
      const Vec3 q = w.x * position[t[0]] + w.y * position[t[1]] + w.z * position[t[2]];
      const Vec3 gap = q - p;
      if (!(dot(gap, gap) < least)) continue;
      least = dot(gap, gap);
      work->foot[i] = q;
      beside = is_on_border(w, t, work->rim);
      flat = w.x * work->flat[t[0]] + w.y * work->flat[t[1]] + w.z * work->flat[t[2]];
    }
    if (beside) {
      Place place;
      place.vertex = work->rim + static_cast<uint32_t>(i);
      return fail(Code::patch_folded, "the curve leaves the patch that it lies in", place);
    }
    TRY(work->drawn.push(flat));
    TRY(context.checkpoint());
  }
  return {};
}

static const Vec3& drawn_at(const InlayWork& work, Span<const Vec3> position, uint32_t number) {
  return number < work.rim ? position[number] : work.foot[number - work.rim];
}

// Whether an inner vertex stands too near to the curves to stay.
static bool in_the_way(const InlayWork& work, Span<const Vec3> position, const Vec3& p) {
  const double room = k_room * work.spacing;
  for (const Vec3& foot : work.foot) {
    const Vec3 gap = foot - p;
    if (dot(gap, gap) < room * room) return true;
  }
  for (size_t e = 0; e < work.inlay.edge.size(); e += 2) {
    const Vec3& a = drawn_at(work, position, work.inlay.edge[e]);
    const Vec3& b = drawn_at(work, position, work.inlay.edge[e + 1]);
    const Vec2 w = nearest_weights(p, a, b);
    const Vec3 gap = w.x * a + w.y * b - p;
    if (dot(gap, gap) < room * room) return true;
  }
  return false;
}

// What stood in the way, in numbers of the inlay: rather a point of a curve than one of a loop.
static Status refuse_drawing(const InlayWork& work, const planar::Region& region,
                             const planar::Conflict& conflict) {
  Status status = fail(Code::patch_folded,
                       "the curve crosses another one or the border of the patch that it lies in");
  const auto take = [&](uint32_t number) {
    if (number != k_none && number >= work.rim && status.place.vertex == k_none) {
      status.place.vertex = number;
    }
  };
  for (const uint32_t point : conflict.point) take(point);
  for (const uint32_t edge : conflict.edge) {
    if (edge == k_none) continue;
    take(region.end(edge, 0));
    take(region.end(edge, 1));
  }
  return status;
}

static Status draw_curves(InlayWork* work, planar::Triangulation* t) {
  planar::Conflict conflict;
  Array<uint32_t> joined(t->points.context());
  for (size_t l = 0; l + 1 < work->start.size(); ++l) {
    for (uint32_t v = work->start[l]; v < work->start[l + 1]; ++v) {
      TRY(work->border.push(v));
      TRY(work->border.push(v + 1 == work->start[l + 1] ? work->start[l] : v + 1));
    }
  }
  const planar::Region region = {work->drawn.span(), work->border.span(), work->inlay.edge, false};
  const Status status = planar::triangulate_region(region, t, &joined, &conflict);
  const bool refused = status.code == Code::patch_folded || status.code == Code::bad_argument ||
                       status.code == Code::patch_without_plane;
  return refused ? refuse_drawing(*work, region, conflict) : status;
}

// Inner vertices that rounding puts outside or onto something are left out.
static Status add_inner(InlayWork* work, Span<const Vec3> position, planar::Triangulation* t) {
  Context& context = t->points.context();
  Array<uint32_t> order(context);
  const size_t inner = position.size() - work->rim;
  if (inner == 0) return {};
  TRY(planar::insertion_order(work->flat.span().part(work->rim, inner), &order));
  for (size_t i = 0; i < inner; ++i) {
    if (i % 256 == 0) TRY(context.checkpoint());
    const uint32_t v = work->rim + order[i];
    if (in_the_way(*work, position, position[v])) continue;
    const Vec2 p = work->flat[v];
    const planar::Location location = planar::locate(t, p, t->hint, false);
    const bool on_edge = location.where == planar::Where::on_edge;
    if (!on_edge && location.where != planar::Where::inside) continue;
    if (on_edge && t->constrained(location.edge)) continue;
    if ((t->triangles[location.edge >> 2].flags & planar::k_outside) != 0) continue;
    TRY(planar::collect_cavity(t, p, location.edge >> 2));
    TRY(planar::fill_cavity(t, p));
    TRY(work->vertex_of_point.push(v));
  }
  return {};
}

// From the chart back to the mesh, the curves at their feet.
static Status lift(const InlayWork& work, const planar::Triangulation& t, Array<Vec3>* position,
                   Array<uint32_t>* triangle) {
  Array<Vec3> place(position->context());
  TRY(place.copy(position->span().part(0, work.rim)));
  for (const Vec3& foot : work.foot) TRY(place.push(foot));
  for (uint32_t v : work.vertex_of_point) TRY(place.push((*position)[v]));
  triangle->clear();
  for (const planar::Triangle& one : t.triangles) {
    if ((one.flags & planar::k_outside) != 0) continue;
    for (uint32_t v : one.vertex) TRY(triangle->push(v - planar::k_box_corners));
  }
  *position = static_cast<Array<Vec3>&&>(place);
  return {};
}

// Carries the feet to the points, and the mesh with them.
static Status shift_to_points(const InlayWork& work, Span<const uint32_t> triangle,
                              Span<Vec3> position) {
  Array<Vec3> shift(work.flat.context());
  double greatest = 0.0;
  TRY(shift.assign(position.size(), Vec3{}));
  for (uint32_t i = 0; i < work.foot.size(); ++i) {
    shift[work.rim + i] = work.inlay.point[i] - work.foot[i];
    greatest = larger(greatest, length(shift[work.rim + i]));
  }
  // What is rounding needs no system.
  constexpr double k_nothing = 1e-9;
  if (greatest > k_nothing * work.spacing) {
    TRY(spread_shift(work.flat.context(), work.held(), position, triangle, shift.span()));
  }
  for (size_t v = 0; v < position.size(); ++v) position[v] += shift[v];
  for (uint32_t i = 0; i < work.foot.size(); ++i) position[work.rim + i] = work.inlay.point[i];
  return {};
}

Status inlay_curves(Context& context, Span<const uint32_t> start, const Inlay& inlay,
                    double spacing, Array<Vec3>* position, Array<uint32_t>* triangle) {
  InlayWork work(context, start, inlay, spacing);
  planar::Triangulation t(context);
  TRY(lay_flat(context, start, position->span(), triangle->span(), &work.flat));
  TRY(find_feet(position->span(), triangle->span(), &work));
  TRY(draw_curves(&work, &t));
  TRY(add_inner(&work, position->span(), &t));
  TRY(lift(work, t, position, triangle));
  const HeldCurves held = {work.held(), inlay.edge};
  TRY(refine_loops(context, spacing, start, held, position, triangle));
  TRY(shift_to_points(work, triangle->span(), position->span()));
  return refine_loops(context, spacing, start, held, position, triangle);
}

}  // namespace wireskin::mesh
