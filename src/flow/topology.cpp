#include "flow/topology.h"

#include "base/sort.h"

namespace wireskin::flow {

static constexpr uint32_t k_most_tries = 200;
// Of a wall's border that may lie off the curves.
static constexpr double k_loose_share = 0.1;
// Above the noise of rounding, for a void behind a polygon; and its volume, of the power 3/2 of the
// polygon's area: two sheets in one plane are none.
static constexpr double k_least_polygon_ratio = 1.0005;
static constexpr double k_least_polygon_volume = 1e-3;

static uint32_t side_of(const Complex& complex, uint32_t triangle, uint32_t side) {
  const uint32_t t = complex.triangle_side[2 * size_t{triangle} + side];
  return t == k_none ? complex.tet_count() : t;
}

static uint32_t find_label(Span<uint32_t> label, uint32_t i) {
  while (label[i] != i) i = label[i] = label[label[i]];
  return i;
}

Status label_rooms(const Complex& complex, const Sheet& sheet, Array<uint32_t>* label) {
  const uint32_t outside = complex.tet_count();
  TRY(label->resize(size_t{outside} + 1));
  for (uint32_t i = 0; i <= outside; ++i) (*label)[i] = i;
  for (uint32_t t = 0; t < complex.triangle_count(); ++t) {
    if (sheet.in[t] != 0) continue;
    const uint32_t a = find_label(label->span(), side_of(complex, t, 0));
    const uint32_t b = find_label(label->span(), side_of(complex, t, 1));
    if (a < b) (*label)[b] = a;
    if (b < a) (*label)[a] = b;
  }
  for (uint32_t i = 0; i <= outside; ++i) (*label)[i] = find_label(label->span(), i);
  return {};
}

// By the radii at which triangles are swallowed, greatest first.
static void order_by_value(const Complex& complex, Array<uint32_t>* triangles) {
  sort(triangles->span(), [&](uint32_t a, uint32_t b) {
    const double fa = complex.triangle_value[a], fb = complex.triangle_value[b];
    return fa != fb ? fa > fb : a > b;
  });
}

// ---- Voids --------------------------------------------------------------------------------------

static double edge_length(const Complex& complex, uint32_t e) {
  return length(complex.point[complex.edge[2 * size_t{e}]] -
                complex.point[complex.edge[2 * size_t{e} + 1]]);
}

// Toggles the wall's border in `odd`, chords replaced by the path along the curve, and counts.
static size_t toggle_wall_border(const Complex& complex, const CurveEdges& curves,
                                 const Sheet& sheet, Span<const uint32_t> wall, Span<uint8_t> odd) {
  size_t count = 0;
  const auto toggle = [&](uint32_t e) {
    odd[e] ^= 1;
    count += odd[e] != 0 ? size_t{1} : SIZE_MAX;
  };
  for (const uint32_t t : wall) {
    for (uint32_t k = 0; k < 3; ++k) {
      const uint32_t e = complex.triangle_edge[3 * size_t{t} + k];
      const uint32_t middle = curves.chord_middle[e];
      if (!curves.by_curve(e) && sheet.degree[e] == 2) continue;
      if (curves.on_curve(e) || middle == k_none) {
        toggle(e);
        continue;
      }
      toggle(find_edge(complex, complex.edge[2 * size_t{e}], middle));
      toggle(find_edge(complex, middle, complex.edge[2 * size_t{e} + 1]));
    }
  }
  return count;
}

// Walls whose border cancels out are ears at curves, or cut off the tip of a junction.
static bool is_tip(const Complex& complex, const CurveEdges& curves, const Sheet& sheet,
                   Span<const uint32_t> wall, Span<uint8_t> odd) {
  const bool tip = toggle_wall_border(complex, curves, sheet, wall, odd) == 0;
  toggle_wall_border(complex, curves, sheet, wall, odd);
  return tip;
}

// Whether the wall that a creator lies in ends on curves, or at least on chords.
static bool bounded_by_curves(const Complex& complex, const CurveEdges& curves, const Sheet& sheet,
                              Span<const uint32_t> wall) {
  double whole = 0.0, loose = 0.0;
  for (const uint32_t t : wall) {
    for (uint32_t k = 0; k < 3; ++k) {
      const uint32_t e = complex.triangle_edge[3 * size_t{t} + k];
      const bool by_curve = curves.by_curve(e);
      if (!by_curve && sheet.degree[e] == 2) continue;
      whole += edge_length(complex, e);
      if (!by_curve) loose += edge_length(complex, e);
    }
  }
  return loose <= k_loose_share * whole;
}

// Cuts the list where the ratios fall most.
static void cut_at_gap(const Persistence& persistence, Array<uint32_t>* chosen) {
  double greatest = 0.0;
  size_t kept = 0;
  for (size_t i = 0; i < chosen->size(); ++i) {
    const double next = i + 1 < chosen->size() ? persistence.voids[(*chosen)[i + 1]].ratio : 1.0;
    const double gap = persistence.voids[(*chosen)[i]].ratio / next;
    if (gap > greatest) {
      greatest = gap;
      kept = i + 1;
    }
  }
  chosen->shrink(kept);
}

namespace {

// Everything that trying a void needs.
struct VoidTrial {
  Sheet all, peeled;
  Array<uint32_t> mark, wall;
  Array<uint8_t> odd;  // of each edge, zero between uses

  explicit VoidTrial(Context& context)
      : all(context), peeled(context), mark(context), wall(context), odd(context) {}
};

}  // namespace

// The destroyers and the walls of the voids chosen.
static Status start_trial(const Complex& complex, const Persistence& persistence,
                          Span<const uint32_t> chosen, VoidTrial* trial) {
  TRY(start_sheet(complex, &trial->all));
  TRY(trial->mark.assign(complex.triangle_count(), k_none));
  TRY(trial->odd.assign(complex.edge_count(), 0));
  for (uint32_t t = 0; t < complex.triangle_count(); ++t) {
    if (persistence.creator[t] == 0) add_to_sheet(complex, t, &trial->all);
  }
  for (const uint32_t v : chosen) add_to_sheet(complex, persistence.voids[v].creator, &trial->all);
  return {};
}

enum class Verdict : uint8_t { accepted, unbounded, gone };

// Whether the creator's wall holds, together with those chosen before.
static Status try_void(const Complex& complex, const CurveEdges& curves, uint32_t creator,
                       uint32_t stamp, VoidTrial* trial, Verdict* verdict) {
  TRY(copy_sheet(trial->all, &trial->peeled));
  add_to_sheet(complex, creator, &trial->peeled);
  peel(complex, curves, Protect::curves, &trial->peeled);
  *verdict = Verdict::gone;
  if (trial->peeled.in[creator] == 0) return {};
  TRY(flood_patch(complex, curves, trial->peeled, creator, stamp, trial->mark.span(),
                  &trial->wall));
  if (is_tip(complex, curves, trial->peeled, trial->wall.span(), trial->odd.span())) return {};
  const bool bounded = bounded_by_curves(complex, curves, trial->peeled, trial->wall.span());
  *verdict = bounded ? Verdict::accepted : Verdict::unbounded;
  return {};
}

// The volume of a room, and the area of a wall.
static double room_volume(const Complex& complex, Span<const uint32_t> label, uint32_t room) {
  double six = 0.0;
  for (uint32_t i = 0; i < complex.tet_count(); ++i) {
    if (label[i] != room) continue;
    const uint32_t* const v = &complex.tet[4 * size_t{i}];
    const Vec3& a = complex.point[v[0]];
    six += dot(complex.point[v[1]] - a, cross(complex.point[v[2]] - a, complex.point[v[3]] - a));
  }
  return six / 6.0;
}

static double wall_area(const Complex& complex, Span<const uint32_t> wall) {
  double twice = 0.0;
  for (const uint32_t t : wall) {
    const uint32_t* const v = &complex.triangle[3 * size_t{t}];
    const Vec3& a = complex.point[v[0]];
    twice += length(cross(complex.point[v[1]] - a, complex.point[v[2]] - a));
  }
  return 0.5 * twice;
}

// Whether the wall tried last keeps the outside from a room worth the name.
static Status closes_room(const Complex& complex, const VoidTrial& trial, uint32_t creator,
                          bool* closes) {
  Array<uint32_t> label(trial.mark.context());
  TRY(label_rooms(complex, trial.peeled, &label));
  const uint32_t outside = label[complex.tet_count()];
  const uint32_t a = label[side_of(complex, creator, 0)], b = label[side_of(complex, creator, 1)];
  *closes = false;
  if (a == b || (a != outside && b != outside)) return {};
  const double area = wall_area(complex, trial.wall.span());
  const double volume = room_volume(complex, label.span(), a == outside ? b : a);
  *closes = volume > k_least_polygon_volume * area * std::sqrt(area);
  return {};
}

static bool among(Span<const uint32_t> list, uint32_t i) {
  for (const uint32_t other : list) {
    if (other == i) return true;
  }
  return false;
}

// A polygon is a face, however wide open a room would be without it: pyramids and plates are hardly
// narrower at the base than within. Only towards the outside: within, such a face is no wall.
static Status close_polygons(Context& context, const Complex& complex, const CurveEdges& curves,
                             Span<const Flatness> flatness, const Persistence& persistence,
                             Array<uint32_t>* chosen) {
  VoidTrial trial(context);
  uint32_t tries = 0;
  for (uint32_t i = 0; i < persistence.voids.size() && tries < k_most_tries; ++i) {
    const Void& v = persistence.voids[i];
    if (v.ratio < k_least_polygon_ratio) break;
    if (v.loose || flatness[v.creator] != Flatness::polygon || among(chosen->span(), i)) continue;
    if (tries++ == 0) TRY(start_trial(complex, persistence, chosen->span(), &trial));
    TRY(context.checkpoint());
    Verdict verdict = Verdict::gone;
    bool closes = false;
    TRY(try_void(complex, curves, v.creator, i, &trial, &verdict));
    if (verdict == Verdict::accepted) TRY(closes_room(complex, trial, v.creator, &closes));
    if (!closes) continue;
    add_to_sheet(complex, v.creator, &trial.all);
    TRY(chosen->push(i));
  }
  return {};
}

Status choose_voids(Context& context, const Complex& complex, const CurveEdges& curves,
                    Span<const Flatness> flatness, const Persistence& persistence,
                    const TopologyOptions& options, Array<uint32_t>* chosen) {
  const bool automatic = options.voids < 0;
  const size_t wished = automatic ? SIZE_MAX : static_cast<size_t>(options.voids);
  VoidTrial trial(context);
  Array<uint32_t> unbounded(context);
  chosen->clear();
  TRY(start_trial(complex, persistence, {}, &trial));
  for (uint32_t i = 0; i < persistence.voids.size() && i < k_most_tries; ++i) {
    if (automatic && persistence.voids[i].ratio < options.least_ratio) break;
    if (chosen->size() == wished) break;
    if (persistence.voids[i].loose) {
      TRY(unbounded.push(i));
      continue;
    }
    TRY(context.checkpoint());
    const uint32_t creator = persistence.voids[i].creator;
    Verdict verdict = Verdict::gone;
    TRY(try_void(complex, curves, creator, i, &trial, &verdict));
    if (verdict == Verdict::unbounded) TRY(unbounded.push(i));
    if (verdict != Verdict::accepted) continue;
    add_to_sheet(complex, creator, &trial.all);
    TRY(chosen->push(i));
  }
  if (automatic) {
    cut_at_gap(persistence, chosen);
    if (!flatness.empty()) {
      TRY(close_polygons(context, complex, curves, flatness, persistence, chosen));
    }
  }
  // Who asks for a number gets it as far as anything is caged at all.
  for (size_t k = 0; !automatic && k < unbounded.size() && chosen->size() < wished; ++k) {
    TRY(chosen->push(unbounded[k]));
  }
  return {};
}

// ---- Handles and walls --------------------------------------------------------------------------

static bool same_void(const Complex& complex, Span<const uint32_t> label, uint32_t triangle) {
  return label[side_of(complex, triangle, 0)] == label[side_of(complex, triangle, 1)];
}

// Opens handles: triangles with one void on both sides that are part of no fin.
static Status open_handles(Context& context, const Complex& complex, const CurveEdges& curves,
                           Topology3* topology) {
  Sheet& walls = topology->walls;
  Sheet finless(context);
  Array<uint32_t> order(context);
  TRY(copy_sheet(walls, &finless));
  peel(complex, curves, Protect::nothing, &finless);
  for (uint32_t t = 0; t < complex.triangle_count(); ++t) {
    if (finless.in[t] != 0 && same_void(complex, topology->label.span(), t)) TRY(order.push(t));
  }
  order_by_value(complex, &order);
  for (const uint32_t t : order) {
    if (finless.in[t] == 0) continue;
    begin_removal(&walls);
    remove_triangle(complex, curves, t, &walls);
    if (!peel_unless_bared(complex, curves, &walls)) continue;
    if (walls.removed.size() > 1000) TRY(context.checkpoint());
    begin_removal(&finless);
    for (const uint32_t gone : walls.removed) remove_triangle(complex, curves, gone, &finless);
    peel_after(complex, curves, Protect::nothing, &finless);
  }
  return {};
}

static bool has_open_border(const Complex& complex, const CurveEdges& curves, const Sheet& sheet,
                            Span<const uint32_t> wall) {
  for (const uint32_t t : wall) {
    for (uint32_t k = 0; k < 3; ++k) {
      const uint32_t e = complex.triangle_edge[3 * size_t{t} + k];
      if (sheet.degree[e] != 2 && !curves.by_curve(e)) return true;
    }
  }
  return false;
}

enum class Settled : uint8_t { no, now, yes };

// The triangles of a wall from one of them on, as far as they are not settled; `whole` unless it
// goes on in ones that are.
static Status flood_unsettled(const Complex& complex, const CurveEdges& curves, const Sheet& walls,
                              uint32_t triangle, Span<Settled> settled, Array<uint32_t>* wall,
                              bool* whole) {
  wall->clear();
  *whole = true;
  settled[triangle] = Settled::now;
  TRY(wall->push(triangle));
  for (size_t i = 0; i < wall->size(); ++i) {
    for (uint32_t k = 0; k < 3; ++k) {
      const uint32_t e = complex.triangle_edge[3 * size_t{(*wall)[i]} + k];
      if (walls.degree[e] != 2 || curves.by_curve(e)) continue;
      for (const uint32_t t : complex.triangles_of(e)) {
        if (walls.in[t] == 0 || settled[t] == Settled::now) continue;
        *whole = *whole && settled[t] == Settled::no;
        if (settled[t] == Settled::yes) continue;
        settled[t] = Settled::now;
        TRY(wall->push(t));
      }
    }
  }
  return {};
}

// Greatest radius first. A wall that must stay, as a curve would go bare without it, must so for
// good, and with it all that joins it later, for there are only ever fewer triangles; and one whose
// border is closed has no neighbour that it could join. So each is looked at once.
static Status remove_open_walls(Context& context, const Complex& complex, const CurveEdges& curves,
                                Topology3* topology) {
  constexpr size_t k_work_per_checkpoint = 1u << 14;
  Sheet& walls = topology->walls;
  Array<uint32_t> order(context), wall(context);
  Array<Settled> settled(context);
  TRY(settled.assign(complex.triangle_count(), Settled::no));
  for (uint32_t t = 0; t < complex.triangle_count(); ++t) {
    if (walls.in[t] != 0 && same_void(complex, topology->label.span(), t)) TRY(order.push(t));
  }
  order_by_value(complex, &order);
  size_t work = 0;
  for (const uint32_t seed : order) {
    if (walls.in[seed] == 0 || settled[seed] != Settled::no) continue;
    bool whole = false;
    TRY(flood_unsettled(complex, curves, walls, seed, settled.span(), &wall, &whole));
    work += wall.size();
    if (whole && has_open_border(complex, curves, walls, wall.span())) {
      begin_removal(&walls);
      for (const uint32_t t : wall) remove_triangle(complex, curves, t, &walls);
      peel_unless_bared(complex, curves, &walls);
      work += walls.removed.size();
    }
    for (const uint32_t t : wall) settled[t] = Settled::yes;
    if (work < k_work_per_checkpoint) continue;
    TRY(context.checkpoint());
    work = 0;
  }
  return {};
}

Status reconstruct_topology(Context& context, const Complex& complex, const CurveEdges& curves,
                            Span<const Flatness> flatness, const Persistence& persistence,
                            const TopologyOptions& options, Topology3* topology) {
  TRY(choose_voids(context, complex, curves, flatness, persistence, options, &topology->chosen));
  Sheet& walls = topology->walls;
  TRY(start_sheet(complex, &walls));
  for (uint32_t t = 0; t < complex.triangle_count(); ++t) {
    if (persistence.creator[t] == 0) add_to_sheet(complex, t, &walls);
  }
  for (const uint32_t v : topology->chosen) {
    add_to_sheet(complex, persistence.voids[v].creator, &walls);
  }
  peel(complex, curves, Protect::curves, &walls);
  TRY(copy_sheet(walls, &topology->closed));
  TRY(label_rooms(complex, walls, &topology->label));
  TRY(open_handles(context, complex, curves, topology));
  if (!options.open_walls) TRY(remove_open_walls(context, complex, curves, topology));
  return {};
}

}  // namespace wireskin::flow
