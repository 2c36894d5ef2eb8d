#include "flow/flat_cells.h"

#include "base/sort.h"
#include "num/minmax.h"

namespace wireskin::flow {

static constexpr double k_cost_of_flat = 1.5;  // of a curve, where one face too many costs 1

namespace {

enum class FaceState : uint8_t { inner, parting, dangling };

// Union-find over tetrahedra and the outside; a root is the least of its members.
struct CellForest {
  Array<uint32_t> parent;
  Array<uint8_t> solid;  // of each root: some tetrahedron of it is not flat

  explicit CellForest(Context& context) : parent(context), solid(context) {}
  uint32_t root_of(uint32_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  }
  void join(uint32_t a, uint32_t b) {
    a = root_of(a);
    b = root_of(b);
    const uint32_t low = a < b ? a : b;
    solid[low] = static_cast<uint8_t>(solid[a] | solid[b]);
    parent[a < b ? b : a] = low;
  }
};

// The faces between two cells; what it would gain to merge these.
struct CellPair {
  uint32_t low, high;  // roots
  uint32_t first, last;
  double gain;
};

struct FacePlace {
  uint32_t low, high, face;
};

struct Merging {
  const StraightLines* lines;
  CellForest forest;
  Array<uint32_t> side;                // of each face two cells
  Array<FaceState> state;              // of each face
  Array<uint32_t> arc_start, arc_rim;  // for each arc its places in FlatFaces::rim
  Array<uint32_t> face_of_rim;
  Array<double> arc_length;
  Array<FacePlace> place;
  Array<CellPair> pair;
  Array<uint32_t> arc_stamp;
  Array<uint8_t> touched;  // of each cell, in this pass

  Merging(Context& context, const StraightLines& straight)
      : lines(&straight),
        forest(context),
        side(context),
        state(context),
        arc_start(context),
        arc_rim(context),
        face_of_rim(context),
        arc_length(context),
        place(context),
        pair(context),
        arc_stamp(context),
        touched(context) {}
};

struct CurveFault {
  uint32_t faces;
  bool flat;  // the two faces there are
};

}  // namespace

static Vec3 cross_of_triangle(const Complex& complex, uint32_t t) {
  const uint32_t* const v = &complex.triangle[3 * size_t{t}];
  const Vec3& a = complex.point[v[0]];
  return cross(complex.point[v[1]] - a, complex.point[v[2]] - a);
}

// Lower over its largest face than two layers of a flat face can be.
static bool is_flat_tet(const Complex& complex, uint32_t t) {
  double largest = 0.0;
  for (uint32_t k = 0; k < 4; ++k) {
    const Vec3 n = cross_of_triangle(complex, complex.tet_triangle[4 * size_t{t} + k]);
    largest = larger(largest, dot(n, n));
  }
  const uint32_t* const v = &complex.tet[4 * size_t{t}];
  const Vec3& a = complex.point[v[0]];
  const double six =
      dot(complex.point[v[1]] - a, cross(complex.point[v[2]] - a, complex.point[v[3]] - a));
  return six <= 2.0 * k_flat * complex.diagonal * std::sqrt(largest);
}

// Cells between faces; what is flat all through, between the layers of a face, joins the cell
// beside it.
static Status find_cells_of_faces(const Complex& complex, const FlatFaces& faces,
                                  CellForest* forest) {
  const uint32_t outside = complex.tet_count();
  TRY(forest->parent.resize(size_t{outside} + 1));
  TRY(forest->solid.assign(size_t{outside} + 1, 0));
  for (uint32_t i = 0; i <= outside; ++i) {
    forest->parent[i] = i;
    forest->solid[i] = i == outside || !is_flat_tet(complex, i);
  }
  Array<uint32_t> separating(forest->parent.context());
  for (uint32_t t = 0; t < complex.triangle_count(); ++t) {
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
static Status find_face_sides(const Complex& complex, const FlatFaces& faces, Merging* merging) {
  CellForest& forest = merging->forest;
  TRY(merging->side.resize(2 * size_t{faces.size()}));
  TRY(merging->state.resize(faces.size()));
  for (uint32_t f = 0; f < faces.size(); ++f) {
    double largest = 0.0;
    uint32_t* const side = &merging->side[2 * size_t{f}];
    side[0] = side[1] = k_none;
    merging->state[f] = FaceState::inner;
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
    merging->state[f] = side[0] == k_none ? FaceState::dangling : FaceState::parting;
  }
  return {};
}

static Status link_arcs(const Samples& samples, const FlatFaces& faces, Merging* merging) {
  const size_t arcs = samples.start.size() - 1;
  TRY(merging->arc_start.assign(arcs + 1, 0));
  TRY(merging->arc_rim.resize(faces.rim.size()));
  TRY(merging->face_of_rim.resize(faces.rim.size()));
  TRY(merging->arc_length.resize(arcs));
  TRY(merging->arc_stamp.assign(arcs, k_none));
  for (uint32_t a = 0; a < arcs; ++a) {
    merging->arc_length[a] = samples.along[samples.start[a + 1] - 1];
  }
  for (uint32_t f = 0; f < faces.size(); ++f) {
    for (uint32_t i = faces.rim_start[f]; i < faces.rim_start[f + 1]; ++i) {
      merging->face_of_rim[i] = f;
      ++merging->arc_start[faces.rim[i].arc];
    }
  }
  starts_from_counts(merging->arc_start.span());
  for (uint32_t i = 0; i < faces.rim.size(); ++i) {
    merging->arc_rim[merging->arc_start[faces.rim[i].arc]++] = i;
  }
  for (size_t a = arcs; a > 0; --a) merging->arc_start[a] = merging->arc_start[a - 1];
  merging->arc_start[0] = 0;
  return {};
}

// Two faces at a curve that lie in one plane, on both sides of it.
static bool continue_flat(const FlatFaces& faces, const Merging& merging, uint32_t i, uint32_t k) {
  const Vec3& a = faces.normal[merging.face_of_rim[i]];
  const Vec3& b = faces.normal[merging.face_of_rim[k]];
  if (std::fabs(dot(a, b)) < k_same_line) return false;
  return !merging.lines->is_straight(faces.rim[i].arc) ||
         dot(faces.rim[i].into, faces.rim[k].into) < 0.0;
}

// How many of the faces at a curve count, and whether they are two that are flat.
template <typename Counts>
static CurveFault fault_of(const FlatFaces& faces, const Merging& merging, uint32_t arc,
                           const Counts& counts) {
  CurveFault fault = {0, false};
  uint32_t at[2] = {};
  for (uint32_t i = merging.arc_start[arc]; i < merging.arc_start[arc + 1]; ++i) {
    const uint32_t rim = merging.arc_rim[i];
    if (!counts(merging.face_of_rim[rim])) continue;
    if (fault.faces < 2) at[fault.faces] = rim;
    ++fault.faces;
  }
  fault.flat = fault.faces == 2 && continue_flat(faces, merging, at[0], at[1]);
  return fault;
}

static double cost_of(const CurveFault& fault) {
  return fault.faces > 2 ? 1.0 : fault.flat ? k_cost_of_flat : 0.0;
}

// What the curves gain if the cells on both sides of these faces become one; below zero if one
// would have no faces left.
static double gain_of(const FlatFaces& faces, const CellPair& pair, Merging* merging) {
  double gain = 0.0;
  const auto parts = [&](uint32_t f) { return merging->state[f] == FaceState::parting; };
  const auto remains = [&](uint32_t f) {
    if (!parts(f)) return false;
    const uint32_t a = merging->forest.root_of(merging->side[2 * size_t{f}]);
    const uint32_t b = merging->forest.root_of(merging->side[2 * size_t{f} + 1]);
    return (a < b ? a : b) != pair.low || (a < b ? b : a) != pair.high;
  };
  for (uint32_t p = pair.first; p < pair.last; ++p) {
    const uint32_t f = merging->place[p].face;
    for (uint32_t i = faces.rim_start[f]; i < faces.rim_start[f + 1]; ++i) {
      const uint32_t arc = faces.rim[i].arc;
      if (merging->arc_stamp[arc] == pair.first) continue;
      merging->arc_stamp[arc] = pair.first;
      const CurveFault now = fault_of(faces, *merging, arc, parts);
      const CurveFault then = fault_of(faces, *merging, arc, remains);
      if (then.faces < 2 && then.faces < now.faces) return -1.0;
      gain += merging->arc_length[arc] * (cost_of(now) - cost_of(then));
    }
  }
  return gain;
}

// The pairs of cells that faces part, each with the faces between them.
static Status list_pairs(const FlatFaces& faces, Merging* merging) {
  merging->place.clear();
  merging->pair.clear();
  for (uint32_t f = 0; f < faces.size(); ++f) {
    if (merging->state[f] != FaceState::parting) continue;
    const uint32_t a = merging->forest.root_of(merging->side[2 * size_t{f}]);
    const uint32_t b = merging->forest.root_of(merging->side[2 * size_t{f} + 1]);
    if (a == b) {
      merging->state[f] = FaceState::inner;
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

// In passes; a cell takes part in one merger a pass, for that changes what others would gain.
static Status merge_cells(Context& context, const FlatFaces& faces, Merging* merging) {
  for (bool any = true; any;) {
    any = false;
    TRY(context.checkpoint());
    TRY(list_pairs(faces, merging));
    for (uint32_t& stamp : merging->arc_stamp) stamp = k_none;
    for (CellPair& pair : merging->pair) {
      pair.gain = gain_of(faces, pair, merging);
      merging->touched[pair.low] = merging->touched[pair.high] = 0;
    }
    sort(merging->pair.span(), [](const CellPair& a, const CellPair& b) {
      return a.gain != b.gain ? a.gain > b.gain : a.first < b.first;
    });
    for (const CellPair& pair : merging->pair) {
      if (!(pair.gain > 0.0)) break;
      if (merging->touched[pair.low] != 0 || merging->touched[pair.high] != 0) continue;
      merging->touched[pair.low] = merging->touched[pair.high] = 1;
      merging->forest.join(pair.low, pair.high);
      any = true;
    }
  }
  return {};
}

// Those that part no cells, as a curved face is missing, but have no rival at any of their curves.
static Status keep_dangling(const FlatFaces& faces, Merging* merging) {
  Array<uint8_t> crowded(merging->arc_stamp.context());
  const auto counts = [&](uint32_t f) { return merging->state[f] != FaceState::inner; };
  TRY(crowded.resize(merging->arc_length.size()));
  for (uint32_t a = 0; a < crowded.size(); ++a) {
    crowded[a] = fault_of(faces, *merging, a, counts).faces > 2;
  }
  for (uint32_t i = 0; i < faces.rim.size(); ++i) {
    const uint32_t f = merging->face_of_rim[i];
    if (merging->state[f] == FaceState::dangling && crowded[faces.rim[i].arc] != 0) {
      merging->state[f] = FaceState::inner;
    }
  }
  return {};
}

static Status set_turns(const Complex& complex, const FlatFaces& faces, Merging* merging,
                        Array<Pass>* turn) {
  TRY(turn->assign(complex.triangle_count(), Pass::by_radius));
  for (uint32_t f = 0; f < faces.size(); ++f) {
    const FaceState state = merging->state[f];
    const uint32_t* const side = &merging->side[2 * size_t{f}];
    const bool merged = state == FaceState::inner && side[0] != k_none;
    const Pass pass = merged ? Pass::first : state == FaceState::dangling ? Pass::late : Pass::flat;
    for (uint32_t i = faces.start[f]; i < faces.start[f + 1]; ++i) {
      (*turn)[faces.triangle[i]] = pass;
    }
  }
  // Whatever parts two cells now, lines along curves among it.
  for (uint32_t t = 0; t < complex.triangle_count(); ++t) {
    if (faces.part[t] == FlatPart::none || faces.part[t] == FlatPart::disc) continue;
    const uint32_t a = merging->forest.root_of(complex.side_of(t, 0));
    const uint32_t b = merging->forest.root_of(complex.side_of(t, 1));
    if (a != b) (*turn)[t] = Pass::last;
  }
  return {};
}

// Marks the edges of curves where two faces that stay make a crease, or one waits for another, and
// the chords over them.
static void mark_needs(const Complex& complex, const Samples& samples, const CurveEdges& curves,
                       const FlatFaces& faces, const Merging& merging, Span<Need> need,
                       bool* any_settled) {
  const auto stays = [&](uint32_t f) { return merging.state[f] != FaceState::inner; };
  for (uint32_t a = 0; a < merging.arc_length.size(); ++a) {
    const CurveFault fault = fault_of(faces, merging, a, stays);
    if (fault.faces == 0 || fault.flat) continue;
    *any_settled = *any_settled || fault.faces > 1;
    for (uint32_t i = samples.start[a]; i + 1 < samples.start[a + 1]; ++i) {
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

Status find_flat_cells(Context& context, const Complex& complex, const Samples& samples,
                       const CurveEdges& curves, const StraightLines& lines, const FlatFaces& faces,
                       FlatCells* cells) {
  cells->turn.clear();
  TRY(cells->need.assign(complex.edge_count(), Need::open));
  if (faces.size() == 0) return {};
  Merging merging(context, lines);
  TRY(find_cells_of_faces(complex, faces, &merging.forest));
  TRY(find_face_sides(complex, faces, &merging));
  TRY(link_arcs(samples, faces, &merging));
  TRY(merging.touched.assign(merging.forest.parent.size(), 0));
  TRY(merge_cells(context, faces, &merging));
  TRY(keep_dangling(faces, &merging));
  TRY(set_turns(complex, faces, &merging, &cells->turn));
  mark_needs(complex, samples, curves, faces, merging, cells->need.span(), &cells->any_settled);
  return {};
}

}  // namespace wireskin::flow
