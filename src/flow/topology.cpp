#include "flow/topology.h"

#include "base/in_parts.h"
#include "base/sort_in_parts.h"

namespace wireskin::flow {

static constexpr uint32_t k_most_tries = 200;
// Of a wall's border that may lie off the curves.
static constexpr double k_loose_share = 0.1;
// Of a void that curves wait for: above the noise of rounding.
static constexpr double k_least_wanted = 1.0005;

static uint32_t find_label(Span<uint32_t> label, uint32_t i) {
  while (label[i] != i) i = label[i] = label[label[i]];
  return i;
}

Status label_rooms(const Complex& complex, const Sheet& sheet, Array<uint32_t>* label) {
  const uint32_t outside = complex.tet_count();
  TRY(label->resize(size_t{outside} + 1));
  for (uint32_t i = 0; i <= outside; ++i) (*label)[i] = i;
  TRY(in_parts(label->context(), complex.triangle_count(), [&](size_t i) {
    const uint32_t t = static_cast<uint32_t>(i);
    if (sheet.in[t] != 0) return;
    const uint32_t a = find_label(label->span(), complex.side_of(t, 0));
    const uint32_t b = find_label(label->span(), complex.side_of(t, 1));
    if (a < b) (*label)[b] = a;
    if (b < a) (*label)[a] = b;
  }));
  return in_parts(label->context(), label->size(), [&](size_t i) {
    (*label)[i] = find_label(label->span(), static_cast<uint32_t>(i));
  });
}

// By the radii at which triangles are swallowed, greatest first.
static Status order_by_value(const Complex& complex, Array<uint32_t>* triangles) {
  return sort_in_parts(triangles->context(), triangles->span(), [&](uint32_t a, uint32_t b) {
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

// Where a wall ends off the curves at a flat face that waits for others.
static bool meets_late_face(const Complex& complex, const FlatCells& cells, uint32_t e) {
  if (cells.turn.empty()) return false;
  for (const uint32_t t : complex.triangles_of(e)) {
    if (cells.turn[t] == Pass::late) return true;
  }
  return false;
}

WallBorder measure_border(const Complex& complex, const CurveEdges& curves, const FlatCells& cells,
                          const Sheet& sheet, Span<const uint32_t> wall) {
  WallBorder border;
  for (const uint32_t t : wall) {
    for (uint32_t k = 0; k < 3; ++k) {
      const uint32_t e = complex.triangle_edge[3 * size_t{t} + k];
      const bool by_curve = curves.by_curve(e);
      if (!by_curve && sheet.degree[e] == 2) continue;
      const double size = edge_length(complex, e);
      border.whole += size;
      if (!by_curve) border.loose += size;
      if (!by_curve && meets_late_face(complex, cells, e)) border.in_face += size;
      if (by_curve && cells.need[e] == Need::settled) border.settled += size;
      if (by_curve && cells.need[e] == Need::waiting) border.waiting += size;
    }
  }
  return border;
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

static Status add_destroyers(const Complex& complex, const Persistence& persistence, Sheet* sheet) {
  return in_parts(sheet->in.context(), complex.triangle_count(), [&](size_t t) {
    if (persistence.creator[t] == 0) add_to_sheet(complex, static_cast<uint32_t>(t), sheet);
  });
}

static Status start_trial(const Complex& complex, const Persistence& persistence,
                          VoidTrial* trial) {
  TRY(start_sheet(complex, &trial->all));
  TRY(trial->mark.assign(complex.triangle_count(), k_none));
  TRY(trial->odd.assign(complex.edge_count(), 0));
  return add_destroyers(complex, persistence, &trial->all);
}

struct Choice {
  uint32_t place;  // in Persistence::voids
  double ratio;
  bool wanted;
};

enum class Verdict : uint8_t { wanted, accepted, unbounded, gone };

// Whether the creator's wall holds, together with those chosen before.
static Status try_void(const Complex& complex, const CurveEdges& curves, const FlatCells& cells,
                       uint32_t creator, uint32_t stamp, VoidTrial* trial, Verdict* verdict) {
  Context& context = trial->mark.context();
  TRY(copy_sheet(trial->all, &trial->peeled));
  TRY(context.checkpoint());
  add_to_sheet(complex, creator, &trial->peeled);
  TRY(peel(complex, curves, Protect::curves, &trial->peeled));
  TRY(context.checkpoint());
  *verdict = Verdict::gone;
  if (trial->peeled.in[creator] == 0) return {};
  TRY(flood_patch(complex, curves, trial->peeled, creator, stamp, trial->mark.span(),
                  &trial->wall));
  if (is_tip(complex, curves, trial->peeled, trial->wall.span(), trial->odd.span())) return {};
  const WallBorder border =
      measure_border(complex, curves, cells, trial->peeled, trial->wall.span());
  const bool bounded = border.loose <= k_loose_share * border.whole && !border.is_idle();
  *verdict = border.is_wanted() ? Verdict::wanted
             : bounded          ? Verdict::accepted
                                : Verdict::unbounded;
  return {};
}

// All that hold; down to a lesser ratio those that curves wait for, if any do.
static Status try_voids(Context& context, const Complex& complex, const CurveEdges& curves,
                        const FlatCells& cells, const Persistence& persistence, double least_ratio,
                        size_t wished, Array<Choice>* choices, Array<uint32_t>* unbounded,
                        uint32_t* untried) {
  VoidTrial trial(context);
  uint32_t tries = 0;
  bool waiting = false;
  *untried = 0;
  for (const Need n : cells.need) waiting = waiting || n == Need::waiting;
  TRY(start_trial(complex, persistence, &trial));
  for (uint32_t i = 0; i < persistence.voids.size() && choices->size() < wished; ++i) {
    const Void& v = persistence.voids[i];
    const bool high = v.ratio >= least_ratio;
    Verdict verdict = v.held ? Verdict::wanted : Verdict::gone;
    const bool worth_it = !v.held && (high || (waiting && v.ratio >= k_least_wanted));
    if (worth_it && tries == k_most_tries) ++*untried;
    if (worth_it && tries < k_most_tries) {
      ++tries;
      TRY(context.checkpoint());
      TRY(try_void(complex, curves, cells, v.creator, i, &trial, &verdict));
    }
    if (verdict == Verdict::unbounded) TRY(unbounded->push(i));
    if (verdict != Verdict::wanted && (verdict != Verdict::accepted || !high)) continue;
    add_to_sheet(complex, v.creator, &trial.all);
    TRY(choices->push({i, v.ratio, verdict == Verdict::wanted}));
  }
  return {};
}

// Cuts the list where the ratios fall most, but for voids that are wanted.
static void cut_at_gap(Array<Choice>* choices) {
  double greatest = 0.0;
  size_t first_cut = 0, kept = 0;
  sort(choices->span(), [](const Choice& a, const Choice& b) {
    return a.ratio != b.ratio ? a.ratio > b.ratio : a.place < b.place;
  });
  for (size_t i = 0; i < choices->size(); ++i) {
    const double next = i + 1 < choices->size() ? (*choices)[i + 1].ratio : 1.0;
    const double gap = (*choices)[i].ratio / next;
    if (gap > greatest) {
      greatest = gap;
      first_cut = i + 1;
    }
  }
  for (size_t i = 0; i < choices->size(); ++i) {
    if (i < first_cut || (*choices)[i].wanted) (*choices)[kept++] = (*choices)[i];
  }
  choices->shrink(kept);
}

Status choose_voids(Context& context, const Complex& complex, const CurveEdges& curves,
                    const FlatCells& cells, const Persistence& persistence,
                    const TopologyOptions& options, Array<uint32_t>* chosen, uint32_t* untried) {
  const bool automatic = options.voids < 0;
  const size_t wished = automatic ? SIZE_MAX : static_cast<size_t>(options.voids);
  Array<Choice> choices(context);
  Array<uint32_t> unbounded(context);
  TRY(try_voids(context, complex, curves, cells, persistence, automatic ? options.least_ratio : 1.0,
                wished, &choices, &unbounded, untried));
  if (automatic) cut_at_gap(&choices);
  chosen->clear();
  for (const Choice& c : choices) TRY(chosen->push(c.place));
  // Who asks for a number gets it as far as anything is caged at all.
  for (size_t k = 0; !automatic && k < unbounded.size() && chosen->size() < wished; ++k) {
    TRY(chosen->push(unbounded[k]));
  }
  return {};
}

// ---- Handles and walls --------------------------------------------------------------------------

// Whether the triangle may go: one void is on both sides, and it is not part of a sure face.
static bool may_go(const Complex& complex, const FlatCells& cells, const Topology3& topology,
                   uint32_t triangle) {
  if (!cells.turn.empty() && cells.turn[triangle] == Pass::late) return false;
  return topology.label[complex.side_of(triangle, 0)] ==
         topology.label[complex.side_of(triangle, 1)];
}

// Those of a set that may go.
static Status list_removable(const Complex& complex, const FlatCells& cells,
                             const Topology3& topology, Span<const uint8_t> in,
                             Array<uint32_t>* triangles) {
  Pace pace(triangles->context());
  for (uint32_t t = 0; t < complex.triangle_count(); ++t) {
    TRY(pace.after());
    if (in[t] != 0 && may_go(complex, cells, topology, t)) TRY(triangles->push(t));
  }
  return order_by_value(complex, triangles);
}

// Opens handles: triangles with one void on both sides that are part of no fin.
static Status open_handles(Context& context, const Complex& complex, const CurveEdges& curves,
                           const FlatCells& cells, Topology3* topology) {
  Sheet& walls = topology->walls;
  Sheet finless(context);
  Array<uint32_t> order(context);
  TRY(copy_sheet(walls, &finless));
  TRY(context.checkpoint());
  TRY(peel(complex, curves, Protect::nothing, &finless));
  TRY(context.checkpoint());
  TRY(list_removable(complex, cells, *topology, finless.in.span(), &order));
  TRY(context.checkpoint());
  for (const uint32_t t : order) {
    if (finless.in[t] == 0) continue;
    begin_removal(&walls);
    remove_triangle(complex, curves, t, &walls);
    TRY(peel_unless_bared(complex, curves, &walls));
    begin_removal(&finless);
    for (const uint32_t gone : walls.removed) remove_triangle(complex, curves, gone, &finless);
    TRY(peel_after(complex, curves, Protect::nothing, &finless));
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
  Pace pace(wall->context());
  TRY(wall->push(triangle));
  for (size_t i = 0; i < wall->size(); ++i) {
    TRY(pace.after());
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
                                const FlatCells& cells, Topology3* topology) {
  Sheet& walls = topology->walls;
  Pace pace(context);
  Array<uint32_t> order(context), wall(context);
  Array<Settled> settled(context);
  TRY(settled.assign(complex.triangle_count(), Settled::no));
  TRY(list_removable(complex, cells, *topology, walls.in.span(), &order));
  for (const uint32_t seed : order) {
    if (walls.in[seed] == 0 || settled[seed] != Settled::no) continue;
    bool whole = false;
    TRY(flood_unsettled(complex, curves, walls, seed, settled.span(), &wall, &whole));
    if (whole && has_open_border(complex, curves, walls, wall.span())) {
      begin_removal(&walls);
      for (const uint32_t t : wall) remove_triangle(complex, curves, t, &walls);
      TRY(peel_unless_bared(complex, curves, &walls));
    }
    for (const uint32_t t : wall) settled[t] = Settled::yes;
    TRY(pace.after(wall.size()));
  }
  return {};
}

Status reconstruct_topology(Context& context, const Complex& complex, const CurveEdges& curves,
                            const FlatCells& cells, const Persistence& persistence,
                            const TopologyOptions& options, Topology3* topology) {
  TRY(choose_voids(context, complex, curves, cells, persistence, options, &topology->chosen,
                   &topology->untried));
  Sheet& walls = topology->walls;
  TRY(start_sheet(complex, &walls));
  TRY(add_destroyers(complex, persistence, &walls));
  for (const uint32_t v : topology->chosen) {
    add_to_sheet(complex, persistence.voids[v].creator, &walls);
  }
  TRY(context.checkpoint());
  TRY(peel(complex, curves, Protect::curves, &walls));
  TRY(context.checkpoint());
  TRY(copy_sheet(walls, &topology->closed));
  TRY(label_rooms(complex, walls, &topology->label));
  TRY(context.checkpoint());
  TRY(open_handles(context, complex, curves, cells, topology));
  if (!options.open_walls) TRY(remove_open_walls(context, complex, curves, cells, topology));
  return {};
}

}  // namespace wireskin::flow
