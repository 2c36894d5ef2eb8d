#include "flow/flat_cells.h"

#include "flow/merge_cells.h"

namespace wireskin::flow {

// Those that part no cells, as a curved face is missing, but have no rival at any of their curves.
static Status keep_dangling(const FlatFaces& faces, const StraightLines& lines, FaceRims* rims) {
  Array<uint8_t> crowded(rims->start.context());
  const auto counts = [&](uint32_t f) { return rims->stays(f); };
  TRY(crowded.resize(rims->arc_count()));
  for (uint32_t a = 0; a < crowded.size(); ++a) {
    crowded[a] = fault_of(faces, lines, *rims, a, counts).faces > 2;
  }
  for (uint32_t i = 0; i < faces.rim.size(); ++i) {
    const uint32_t f = rims->face[i];
    if (rims->state[f] == FaceState::dangling && crowded[faces.rim[i].arc] != 0) {
      rims->state[f] = FaceState::inner;
    }
  }
  return {};
}

static bool covers(const Complex& complex, uint32_t t, const Vec3& normal, const Vec3& p) {
  const uint32_t* const v = &complex.triangle[3 * size_t{t}];
  const Vec3 &a = complex.point[v[0]], &b = complex.point[v[1]], &c = complex.point[v[2]];
  const double ab = dot(cross(b - a, p - a), normal), bc = dot(cross(c - b, p - b), normal),
               ca = dot(cross(a - c, p - c), normal);
  return (ab >= 0.0 && bc >= 0.0 && ca >= 0.0) || (ab <= 0.0 && bc <= 0.0 && ca <= 0.0);
}

// The triangles of a disc where its largest one is, in all layers.
template <typename Visit>
static void each_in_middle(const Complex& complex, const FlatFaces& faces, uint32_t f,
                           const Visit& visit) {
  const Span<const uint32_t> disc =
      faces.triangle.span().part(faces.start[f], faces.start[f + 1] - faces.start[f]);
  double largest = 0.0;
  Vec3 middle;
  for (const uint32_t t : disc) {
    const uint32_t* const v = &complex.triangle[3 * size_t{t}];
    const Vec3 &a = complex.point[v[0]], &b = complex.point[v[1]], &c = complex.point[v[2]];
    const Vec3 n = cross(b - a, c - a);
    if (!(dot(n, n) > largest)) continue;
    largest = dot(n, n);
    middle = (1.0 / 3.0) * (a + b + c);
  }
  for (const uint32_t t : disc) {
    if (covers(complex, t, faces.normal[f], middle)) visit(t);
  }
}

static Status list_lids(const Complex& complex, const FlatFaces& faces, Span<const uint32_t> lids,
                        FlatCells* cells) {
  Status status;
  TRY(cells->lid_start.push(0));
  for (const uint32_t f : lids) {
    each_in_middle(complex, faces, f, [&](uint32_t t) {
      if (status.ok()) status = cells->lid_middle.push(t);
    });
    TRY(status);
    TRY(cells->lid_start.push(static_cast<uint32_t>(cells->lid_middle.size())));
  }
  return {};
}

static Status set_turns(const Complex& complex, const FlatFaces& faces, const FaceRims& rims,
                        FaceCells* cells, Array<Pass>* turn) {
  TRY(turn->assign(complex.triangle_count(), Pass::by_radius));
  for (uint32_t f = 0; f < faces.size(); ++f) {
    const FaceState state = rims.state[f];
    const uint32_t* const side = &cells->side[2 * size_t{f}];
    const bool merged = state == FaceState::inner && side[0] != k_none;
    const Pass pass = merged ? Pass::first : state == FaceState::dangling ? Pass::late : Pass::flat;
    for (uint32_t i = faces.start[f]; i < faces.start[f + 1]; ++i) {
      (*turn)[faces.triangle[i]] = pass;
    }
    // Walls that do not bulge with a hole's rim end on triangles in its plane: these stay.
    if (state != FaceState::hole) continue;
    each_in_middle(complex, faces, f, [&](uint32_t t) { (*turn)[t] = Pass::hole; });
  }
  // Whatever parts two cells now, lines along curves among it.
  for (uint32_t t = 0; t < complex.triangle_count(); ++t) {
    if (faces.part[t] == FlatPart::none || faces.part[t] == FlatPart::disc) continue;
    const uint32_t a = cells->forest.root_of(complex.side_of(t, 0));
    const uint32_t b = cells->forest.root_of(complex.side_of(t, 1));
    if (a != b) (*turn)[t] = Pass::last;
  }
  return {};
}

// Marks the edges of curves where two faces that stay make a crease, or one waits for another, and
// the chords over them.
static void mark_needs(const Drawing& drawing, const FlatFaces& faces, const FaceRims& rims,
                       Span<Need> need, bool* any_settled) {
  const Complex& complex = drawing.complex;
  const CurveEdges& curves = drawing.curves;
  const auto stays = [&](uint32_t f) { return rims.stays(f); };
  for (uint32_t a = 0; a < rims.arc_count(); ++a) {
    const CurveFault fault = fault_of(faces, drawing.lines, rims, a, stays);
    if (fault.faces == 0 || fault.flat) continue;
    *any_settled = *any_settled || fault.faces > 1;
    for (uint32_t i = drawing.samples.start[a]; i + 1 < drawing.samples.start[a + 1]; ++i) {
      if (curves.edge_of[i] == k_none) continue;
      need[curves.edge_of[i]] = fault.faces == 1 ? Need::waiting : Need::settled;
    }
  }
  for (uint32_t e = 0; e < complex.edge_count(); ++e) {
    const uint32_t middle = curves.chord_middle[e];
    if (curves.on_curve(e) || middle == k_none) continue;
    const Need a = need[find_edge(complex, complex.edge[2 * size_t{e}], middle)];
    if (a == need[find_edge(complex, middle, complex.edge[2 * size_t{e} + 1])]) need[e] = a;
  }
}

Status find_flat_cells(Context& context, const Drawing& drawing, const FlatFaces& faces, Lids lids,
                       FlatCells* cells) {
  const Complex& complex = drawing.complex;
  cells->turn.clear();
  cells->any_settled = false;
  cells->lid_start.clear();
  cells->lid_middle.clear();
  cells->given_up = faces.given_up;
  TRY(cells->need.assign(complex.edge_count(), Need::open));
  if (faces.size() == 0) return {};
  FaceRims rims(context);
  FaceCells between(context);
  Array<uint32_t> lid_faces(context);
  TRY(link_rims(faces, static_cast<uint32_t>(drawing.samples.start.size() - 1), &rims));
  TRY(find_face_cells(complex, faces, &rims, &between));
  TRY(merge_cells(context, drawing, faces, &rims, &between));
  TRY(keep_dangling(faces, drawing.lines, &rims));
  TRY(find_lids(context, drawing, faces, lids, &rims, &lid_faces));
  TRY(list_lids(complex, faces, lid_faces.span(), cells));
  TRY(set_turns(complex, faces, rims, &between, &cells->turn));
  mark_needs(drawing, faces, rims, cells->need.span(), &cells->any_settled);
  return {};
}

}  // namespace wireskin::flow
