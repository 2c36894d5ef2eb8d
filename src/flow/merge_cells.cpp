#include "flow/merge_cells.h"

#include "base/sort.h"
#include "num/minmax.h"

namespace wireskin::flow {

static constexpr double k_cost_of_flat = 1.5;  // of a curve, where one face too many costs 1
static constexpr uint32_t k_tets_per_pause = 1u << 16;
static constexpr size_t k_rims_per_pause = size_t{1} << 17;

namespace {

// The faces between two cells; what it would gain to merge these.
struct CellPair {
  uint32_t low, high;  // roots
  uint32_t first, last;
  double gain;
};

struct FacePlace {
  uint32_t low, high, face;
};

enum class CellTurn : uint8_t { free, grown, over };

struct Merging {
  Array<uint32_t> live;    // of each arc: its parting faces, the first of its places
  Array<uint32_t> count;   // of each arc: those of the pair looked at, else zero
  Array<uint8_t> changed;  // of each arc, in this pass
  size_t work = 0;         // arcs looked at since the last checkpoint
  Array<FacePlace> place;
  Array<CellPair> pair;
  Array<uint32_t> order;
  Array<CellTurn> turn;                   // of each cell, in this pass
  Array<uint32_t> degree;                 // of each cell: its pairs
  Array<uint32_t> first_pair, next_pair;  // lists of pairs: of each cell, of both sides of a pair

  explicit Merging(Context& context)
      : live(context),
        count(context),
        changed(context),
        place(context),
        pair(context),
        order(context),
        turn(context),
        degree(context),
        first_pair(context),
        next_pair(context) {}
};

}  // namespace

// Lower over its largest face than two layers of a flat face can be.
static bool is_flat_tet(const Complex& complex, uint32_t t, double flat) {
  double largest = 0.0;
  for (uint32_t k = 0; k < 4; ++k) {
    const Vec3 n = cross_of_triangle(complex, complex.tet_triangle[4 * size_t{t} + k]);
    largest = larger(largest, dot(n, n));
  }
  const uint32_t* const v = &complex.tet[4 * size_t{t}];
  const Vec3& a = complex.point[v[0]];
  const double six =
      dot(complex.point[v[1]] - a, cross(complex.point[v[2]] - a, complex.point[v[3]] - a));
  return six <= 2.0 * flat * std::sqrt(largest);
}

// Cells between faces; what is flat all through, between the layers of a face, joins the cell
// beside it.
static Status find_cells_of_faces(const Complex& complex, const FlatFaces& faces,
                                  CellForest* forest) {
  const uint32_t outside = complex.tet_count();
  TRY(forest->parent.resize(size_t{outside} + 1));
  TRY(forest->solid.assign(size_t{outside} + 1, 0));
  for (uint32_t i = 0; i <= outside; ++i) {
    if (i % k_tets_per_pause == 0) TRY(forest->parent.context().checkpoint());
    forest->parent[i] = i;
    forest->solid[i] = i == outside || !is_flat_tet(complex, i, faces.flat);
  }
  Array<uint32_t> separating(forest->parent.context());
  for (uint32_t t = 0; t < complex.triangle_count(); ++t) {
    if (t % k_tets_per_pause == 0) TRY(forest->parent.context().checkpoint());
    if (faces.part[t] == FlatPart::polygon || faces.part[t] == FlatPart::line) {
      TRY(separating.push(t));
    } else {
      forest->join(complex.side_of(t, 0), complex.side_of(t, 1));
    }
  }
  sort(separating.span(), [&](uint32_t a, uint32_t b) {
    const double fa = complex.triangle_value[a], fb = complex.triangle_value[b];
    return fa != fb ? fa > fb : a > b;
  });
  for (const uint32_t t : separating) {
    const uint32_t a = forest->root_of(complex.side_of(t, 0));
    const uint32_t b = forest->root_of(complex.side_of(t, 1));
    if (forest->solid[a] == 0 || forest->solid[b] == 0) forest->join(a, b);
  }
  return {};
}

// The cells before and behind each face, as its largest triangle between two cells says.
static void find_face_sides(const Complex& complex, const FlatFaces& faces, FaceRims* rims,
                            FaceCells* cells) {
  CellForest& forest = cells->forest;
  for (uint32_t f = 0; f < faces.size(); ++f) {
    double largest = 0.0;
    uint32_t* const side = &cells->side[2 * size_t{f}];
    side[0] = side[1] = k_none;
    rims->state[f] = FaceState::inner;
    if (faces.polygon[f] == 0) continue;
    for (uint32_t i = faces.start[f]; i < faces.start[f + 1]; ++i) {
      const uint32_t t = faces.triangle[i];
      const uint32_t a = forest.root_of(complex.side_of(t, 0));
      const uint32_t b = forest.root_of(complex.side_of(t, 1));
      const Vec3 n = cross_of_triangle(complex, t);
      if (a == b || !(dot(n, n) > largest)) continue;
      largest = dot(n, n);
      const bool up = dot(n, faces.normal[f]) > 0.0;
      side[0] = up ? b : a;
      side[1] = up ? a : b;
    }
    rims->state[f] = side[0] == k_none ? FaceState::dangling : FaceState::parting;
  }
}

Status find_face_cells(const Complex& complex, const FlatFaces& faces, FaceRims* rims,
                       FaceCells* cells) {
  TRY(cells->side.resize(2 * size_t{faces.size()}));
  TRY(find_cells_of_faces(complex, faces, &cells->forest));
  find_face_sides(complex, faces, rims, cells);
  return {};
}

static double cost_of(const CurveFault& fault) {
  return fault.faces > 2 ? 1.0 : fault.flat ? k_cost_of_flat : 0.0;
}

// What the curves gain if the cells on both sides of these faces become one; below zero if one
// would have fewer than two faces left.
static double gain_of(const Drawing& drawing, const FlatFaces& faces, const FaceRims& rims,
                      FaceCells* cells, const CellPair& pair, Merging* merging) {
  double gain = 0.0;
  bool bares = false;
  const auto each_arc = [&](const auto& visit) {
    for (uint32_t p = pair.first; p < pair.last; ++p) {
      const uint32_t f = merging->place[p].face;
      for (uint32_t i = faces.rim_start[f]; i < faces.rim_start[f + 1]; ++i) {
        ++merging->work;
        visit(faces.rim[i].arc);
      }
    }
  };
  const auto remains = [&](uint32_t f) {
    const uint32_t a = cells->forest.root_of(cells->side[2 * size_t{f}]);
    const uint32_t b = cells->forest.root_of(cells->side[2 * size_t{f} + 1]);
    return (a < b ? a : b) != pair.low || (a < b ? b : a) != pair.high;
  };
  each_arc([&](uint32_t arc) { ++merging->count[arc]; });
  each_arc([&](uint32_t arc) {
    const uint32_t now = merging->live[arc], gone = merging->count[arc];
    merging->count[arc] = 0;
    if (gone == 0) return;
    bares = bares || now - gone < 2;
    // Which faces there are matters only where two are left: then few are looked at.
    if (now - gone > 2) return;
    const auto any = [](uint32_t) { return true; };
    const CurveFault before =
        now > 2 ? CurveFault{now, false} : fault_of(faces, drawing.lines, rims, arc, now, any);
    const CurveFault after = fault_of(faces, drawing.lines, rims, arc, now, remains);
    gain += drawing.samples.along[drawing.samples.start[arc + 1] - 1] *
            (cost_of(before) - cost_of(after));
  });
  return bares ? -1.0 : gain;
}

// The pairs of cells that faces part, each with the faces between them.
static Status list_pairs(const FlatFaces& faces, FaceRims* rims, FaceCells* cells,
                         Merging* merging) {
  merging->place.clear();
  merging->pair.clear();
  for (uint32_t f = 0; f < faces.size(); ++f) {
    if (rims->state[f] != FaceState::parting) continue;
    const uint32_t a = cells->forest.root_of(cells->side[2 * size_t{f}]);
    const uint32_t b = cells->forest.root_of(cells->side[2 * size_t{f} + 1]);
    if (a == b) {
      rims->state[f] = FaceState::inner;
      continue;
    }
    TRY(merging->place.push({a < b ? a : b, a < b ? b : a, f}));
  }
  sort(merging->place.span(), [](const FacePlace& a, const FacePlace& b) {
    if (a.low != b.low) return a.low < b.low;
    return a.high != b.high ? a.high < b.high : a.face < b.face;
  });
  for (uint32_t i = 0; i < merging->place.size(); ++i) {
    const FacePlace& p = merging->place[i];
    if (!merging->pair.empty() && merging->pair.back().low == p.low &&
        merging->pair.back().high == p.high) {
      merging->pair.back().last = i + 1;
    } else {
      TRY(merging->pair.push({p.low, p.high, i, i + 1, 0.0}));
    }
  }
  return {};
}

// Moves the places of faces that part cells to the front of each arc's.
static void gather_live(FaceRims* rims, Merging* merging) {
  for (uint32_t a = 0; a < rims->arc_count(); ++a) {
    uint32_t& live = merging->live[a];
    live = 0;
    for (uint32_t i = rims->start[a]; i < rims->start[a + 1]; ++i) {
      if (rims->state[rims->face[rims->rim[i]]] != FaceState::parting) continue;
      swap_values(rims->rim[i], rims->rim[rims->start[a] + live++]);
    }
  }
}

static Status start_pass(Merging* merging) {
  const size_t pairs = merging->pair.size();
  TRY(merging->next_pair.resize(2 * pairs));
  TRY(merging->order.resize(pairs));
  for (uint8_t& c : merging->changed) c = 0;
  for (const CellPair& p : merging->pair) {
    const uint32_t sides[2] = {p.low, p.high};
    for (const uint32_t cell : sides) {
      merging->turn[cell] = CellTurn::free;
      merging->degree[cell] = 0;
      merging->first_pair[cell] = k_none;
    }
  }
  for (uint32_t i = 0; i < pairs; ++i) {
    merging->order[i] = i;
    for (uint32_t k = 0; k < 2; ++k) {
      const uint32_t cell = k == 0 ? merging->pair[i].low : merging->pair[i].high;
      merging->next_pair[2 * size_t{i} + k] = merging->first_pair[cell];
      merging->first_pair[cell] = 2 * i + k;
      ++merging->degree[cell];
    }
  }
  sort(merging->order.span(), [&](uint32_t i, uint32_t k) {
    const CellPair &a = merging->pair[i], &b = merging->pair[k];
    return a.gain != b.gain ? a.gain > b.gain : a.first < b.first;
  });
  return {};
}

// Whether nothing done in this pass bears on what the merger gains: one cell has not changed, and
// the other has only grown by cells that the one does not touch, at other curves.
static bool is_independent(const FlatFaces& faces, const CellPair& pair, const Merging& merging) {
  const CellTurn low = merging.turn[pair.low], high = merging.turn[pair.high];
  if (low == CellTurn::over || high == CellTurn::over) return false;
  if (low == CellTurn::grown && high == CellTurn::grown) return false;
  for (uint32_t p = pair.first; p < pair.last; ++p) {
    const uint32_t f = merging.place[p].face;
    for (uint32_t i = faces.rim_start[f]; i < faces.rim_start[f + 1]; ++i) {
      if (merging.changed[faces.rim[i].arc] != 0) return false;
    }
  }
  return true;
}

// The cell with fewer neighbours goes into the other; what it touches waits for the next pass.
static void merge_pair(const FlatFaces& faces, const CellPair& pair, CellForest* forest,
                       Merging* merging) {
  const bool low_grown = merging->turn[pair.low] == CellTurn::grown;
  const bool high_grown = merging->turn[pair.high] == CellTurn::grown;
  const bool low_larger = merging->degree[pair.low] > merging->degree[pair.high];
  const uint32_t into = low_grown || (!high_grown && low_larger) ? pair.low : pair.high;
  const uint32_t small = into == pair.low ? pair.high : pair.low;
  for (uint32_t at = merging->first_pair[small]; at != k_none; at = merging->next_pair[at]) {
    const CellPair& p = merging->pair[at / 2];
    merging->turn[(at & 1) == 0 ? p.high : p.low] = CellTurn::over;
  }
  merging->turn[small] = CellTurn::over;
  merging->turn[into] = CellTurn::grown;
  for (uint32_t p = pair.first; p < pair.last; ++p) {
    const uint32_t f = merging->place[p].face;
    for (uint32_t i = faces.rim_start[f]; i < faces.rim_start[f + 1]; ++i) {
      merging->changed[faces.rim[i].arc] = 1;
    }
  }
  forest->join(pair.low, pair.high);
}

Status merge_cells(Context& context, const Drawing& drawing, const FlatFaces& faces, FaceRims* rims,
                   FaceCells* cells) {
  Merging merging(context);
  const size_t cell_count = cells->forest.parent.size();
  TRY(merging.live.assign(rims->arc_count(), 0));
  TRY(merging.count.assign(rims->arc_count(), 0));
  TRY(merging.changed.assign(rims->arc_count(), 0));
  TRY(merging.turn.assign(cell_count, CellTurn::free));
  TRY(merging.degree.assign(cell_count, 0));
  TRY(merging.first_pair.assign(cell_count, k_none));
  for (bool any = true; any;) {
    any = false;
    TRY(context.checkpoint());
    TRY(list_pairs(faces, rims, cells, &merging));
    gather_live(rims, &merging);
    for (CellPair& pair : merging.pair) {
      pair.gain = gain_of(drawing, faces, *rims, cells, pair, &merging);
      if (merging.work < k_rims_per_pause) continue;
      merging.work = 0;
      TRY(context.checkpoint());
    }
    TRY(start_pass(&merging));
    for (const uint32_t i : merging.order) {
      const CellPair& pair = merging.pair[i];
      if (!(pair.gain > 0.0)) break;
      if (!is_independent(faces, pair, merging)) continue;
      merge_pair(faces, pair, &cells->forest, &merging);
      any = true;
    }
  }
  return {};
}

}  // namespace wireskin::flow
