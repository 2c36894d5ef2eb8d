#include "flow/patches.h"

#include "base/in_parts.h"
#include "flow/orient.h"
#include "flow/patch_loops.h"
#include "num/minmax.h"

namespace wireskin::flow {

namespace {

enum class Kind : uint8_t { patch, ear, tail };

// Classes of triangles that the cuts leave together; what each takes over from ears and tails.
struct Classes {
  Array<uint32_t> of;  // class of each triangle
  Array<uint32_t> start, triangle;
  Array<Kind> kind;
  Array<uint32_t> taken_by, taken;  // pairs: class `taken` belongs to class `taken_by` too

  explicit Classes(Context& context)
      : of(context),
        start(context),
        triangle(context),
        kind(context),
        taken_by(context),
        taken(context) {}
  Span<const uint32_t> part(uint32_t c) const {
    return triangle.span().part(start[c], start[c + 1] - start[c]);
  }
};

// The border modulo two of a set of triangles that grows.
struct Border {
  Array<uint8_t> odd, touched;
  Array<uint32_t> edge;  // touched at some time

  explicit Border(Context& context) : odd(context), touched(context), edge(context) {}
};

}  // namespace

static Status toggle_edge(uint32_t e, Border* border) {
  border->odd[e] ^= 1;
  if (border->touched[e] == 0) {
    border->touched[e] = 1;
    TRY(border->edge.push(e));
  }
  return {};
}

static Status toggle_triangles(const Complex& complex, Span<const uint32_t> triangles,
                               Border* border) {
  for (const uint32_t t : triangles) {
    for (uint32_t k = 0; k < 3; ++k) {
      TRY(toggle_edge(complex.triangle_edge[3 * size_t{t} + k], border));
    }
  }
  return {};
}

static void clear_border(Border* border) {
  for (const uint32_t e : border->edge) border->odd[e] = border->touched[e] = 0;
  border->edge.clear();
}

// The ear of a chord: the triangle that it makes with the two segments it passes over.
static uint32_t ear_of(const Complex& complex, const CurveEdges& curves, uint32_t chord) {
  for (const uint32_t t : complex.triangles_of(chord)) {
    for (uint32_t k = 0; k < 3; ++k) {
      if (complex.triangle_edge[3 * size_t{t} + k] == chord &&
          complex.triangle[3 * size_t{t} + k] == curves.chord_middle[chord]) {
        return t;
      }
    }
  }
  return k_none;
}

static bool is_chord(const CurveEdges& curves, uint32_t e) {
  return !curves.on_curve(e) && curves.chord_middle[e] != k_none;
}

// Replaces every chord in the border by the path along the curve.
static Status straighten_border(const Complex& complex, const CurveEdges& curves, Border* border) {
  const size_t count = border->edge.size();
  for (size_t i = 0; i < count; ++i) {
    const uint32_t e = border->edge[i];
    if (border->odd[e] == 0 || !is_chord(curves, e)) continue;
    const uint32_t ear = ear_of(complex, curves, e);
    TRY(toggle_triangles(complex, {&ear, 1}, border));
  }
  return {};
}

static Status find_classes(const Complex& complex, const CurveEdges& curves, const Sheet& walls,
                           Classes* classes) {
  Array<uint32_t> patch(classes->of.context());
  Pace pace(classes->of.context());
  TRY(classes->of.assign(complex.triangle_count(), k_none));
  TRY(classes->start.push(0));
  for (uint32_t t = 0; t < complex.triangle_count(); ++t) {
    TRY(pace.after());
    if (walls.in[t] == 0 || classes->of[t] != k_none) continue;
    const uint32_t c = static_cast<uint32_t>(classes->kind.size());
    TRY(flood_patch(complex, curves, walls, t, c, classes->of.span(), &patch));
    for (const uint32_t member : patch) TRY(classes->triangle.push(member));
    TRY(classes->start.push(static_cast<uint32_t>(classes->triangle.size())));
    TRY(classes->kind.push(Kind::patch));
  }
  return {};
}

static Status find_ears(const Complex& complex, const CurveEdges& curves, Classes* classes,
                        Border* border) {
  Pace pace(classes->of.context());
  for (uint32_t c = 0; c < classes->kind.size(); ++c) {
    TRY(toggle_triangles(complex, classes->part(c), border));
    TRY(pace.after(border->edge.size()));
    bool any = false, left = false;
    for (const uint32_t e : border->edge) any = any || border->odd[e] != 0;
    TRY(straighten_border(complex, curves, border));
    for (const uint32_t e : border->edge) left = left || border->odd[e] != 0;
    if (any && !left) classes->kind[c] = Kind::ear;
    clear_border(border);
  }
  return {};
}

static bool takes(const Classes& classes, uint32_t c, size_t first, uint32_t other) {
  for (size_t i = first; i < classes.taken.size(); ++i) {
    if (classes.taken_by[i] == c && classes.taken[i] == other) return true;
  }
  return false;
}

// Where the classes are looked up: walls, rooms and what is known of flat faces.
struct TailSearch {
  const FlatCells& cells;
  const Persistence& persistence;
  const Topology3& topology;
};

// A strip of a flat face, with one void on both sides, from where another wall merged into the face
// to the curve that they should meet at.
static bool is_flat_tail(const Complex& complex, const TailSearch& search, uint32_t t) {
  if (search.cells.turn.empty() || search.cells.turn[t] != Pass::late) return false;
  const Array<uint32_t>& label = search.topology.label;
  return label[complex.side_of(t, 0)] == label[complex.side_of(t, 1)];
}

// The ear in the walls at a chord of the border, or the tail at an edge where sheets merge.
static uint32_t continuation(const Complex& complex, const CurveEdges& curves,
                             const TailSearch& search, const Classes& classes, uint32_t e) {
  const Sheet& walls = search.topology.walls;
  if (curves.on_curve(e)) return k_none;
  if (is_chord(curves, e)) {
    const uint32_t ear = ear_of(complex, curves, e);
    const bool here = walls.in[ear] != 0 && classes.kind[classes.of[ear]] == Kind::ear;
    return here ? classes.of[ear] : k_none;
  }
  if (walls.degree[e] < 3) return k_none;
  for (const uint32_t t : complex.triangles_of(e)) {
    if (walls.in[t] == 0) continue;
    if (is_flat_tail(complex, search, t)) return classes.of[t];
    if (complex.edge_gabriel[e] == 0 && search.persistence.creator[t] == 0 &&
        complex.triangle_value[t] == complex.edge_value[e]) {
      return classes.of[t];
    }
  }
  return k_none;
}

// Lets class c take over ears and tails until its border is on curves, or nothing more is found.
static Status take_continuations(const Complex& complex, const CurveEdges& curves,
                                 const TailSearch& search, uint32_t c, Classes* classes,
                                 Border* border) {
  const size_t first = classes->taken.size();
  TRY(toggle_triangles(complex, classes->part(c), border));
  for (size_t i = 0; i < border->edge.size(); ++i) {
    const uint32_t e = border->edge[i];
    if (border->odd[e] == 0) continue;
    const uint32_t other = continuation(complex, curves, search, *classes, e);
    if (other == k_none || other == c || takes(*classes, c, first, other)) continue;
    TRY(classes->taken_by.push(c));
    TRY(classes->taken.push(other));
    TRY(toggle_triangles(complex, classes->part(other), border));
  }
  clear_border(border);
  return {};
}

static Status find_tails(Context& context, const Complex& complex, const CurveEdges& curves,
                         const TailSearch& search, Classes* classes, Border* border) {
  for (uint32_t c = 0; c < classes->kind.size(); ++c) {
    if (c % 256 == 0) TRY(context.checkpoint());
    if (classes->kind[c] == Kind::ear) continue;
    TRY(take_continuations(complex, curves, search, c, classes, border));
  }
  for (const uint32_t other : classes->taken) {
    if (classes->kind[other] == Kind::patch) classes->kind[other] = Kind::tail;
  }
  return {};
}

// All triangles of a patch. One that is taken over twice cancels out.
static Status gather_patch(const Classes& classes, uint32_t c, size_t* taken,
                           Array<uint32_t>* triangles) {
  for (const uint32_t t : classes.part(c)) TRY(triangles->push(t));
  for (; *taken < classes.taken.size() && classes.taken_by[*taken] <= c; ++*taken) {
    if (classes.taken_by[*taken] != c) continue;
    for (const uint32_t t : classes.part(classes.taken[*taken])) TRY(triangles->push(t));
  }
  return {};
}

static double area_of(const Complex& complex, const Samples& samples, uint32_t t) {
  const uint32_t* const v = &complex.triangle[3 * size_t{t}];
  const Vec3& a = samples.position[v[0]];
  return 0.5 * length(cross(samples.position[v[1]] - a, samples.position[v[2]] - a));
}

static Status add_patch(const Complex& complex, const CurveEdges& curves, const Samples& samples,
                        Span<const uint32_t> side, Span<const uint32_t> part, PatchLoops* loops,
                        Patches* patches) {
  PatchFacts facts;
  for (const uint32_t t : part) {
    facts.area += area_of(complex, samples, t);
    facts.greatest = larger(facts.greatest, complex.triangle_value[t]);
    if (patches->owner[t] == k_none) patches->owner[t] = patches->size();
  }
  facts.greatest = std::sqrt(facts.greatest);
  const uint32_t turned = patches->turned[part[0]];
  facts.front = side[2 * size_t{part[0]} + (1 - turned)];
  facts.back = side[2 * size_t{part[0]} + turned];
  TRY(find_loops(complex, curves, samples, part, patches->turned.span(), loops));
  facts.loops = static_cast<uint32_t>(loops->run_start.size() - 1);
  facts.euler_characteristic = loops->euler_characteristic;
  facts.open = loops->open;
  const uint32_t first = static_cast<uint32_t>(patches->run.size());
  for (size_t l = 1; l < loops->run_start.size(); ++l) {
    TRY(patches->run_start.push(first + loops->run_start[l]));
  }
  for (const LoopRun& r : loops->run) TRY(patches->run.push(r));
  TRY(patches->loop_start.push(static_cast<uint32_t>(patches->run_start.size() - 1)));
  return patches->facts.push(facts);
}

// Ears that no patch took (walls that cut off the tip of a junction have chords all round) go to
// the patch beside them, so that no triangle of the walls is lost.
static Status own_rest(const Complex& complex, const CurveEdges& curves, const Sheet& walls,
                       Array<uint32_t>* owner) {
  Array<uint32_t> queue(owner->context());
  Pace pace(owner->context());
  TRY(queue.reserve(owner->size()));
  for (uint32_t t = 0; t < owner->size(); ++t) {
    if ((*owner)[t] != k_none) queue.push_reserved(t);
  }
  for (size_t i = 0; i < queue.size(); ++i) {
    TRY(pace.after());
    for (uint32_t k = 0; k < 3; ++k) {
      const uint32_t e = complex.triangle_edge[3 * size_t{queue[i]} + k];
      if (curves.on_curve(e)) continue;
      for (const uint32_t t : complex.triangles_of(e)) {
        if (walls.in[t] == 0 || (*owner)[t] != k_none) continue;
        (*owner)[t] = (*owner)[queue[i]];
        queue.push_reserved(t);
      }
    }
  }
  return {};
}

Status cut_patches(Context& context, const Complex& complex, const CurveEdges& curves,
                   const Samples& samples, const FlatCells& cells, const Persistence& persistence,
                   const Topology3& topology, Patches* patches) {
  constexpr size_t k_steps_of_patch = 16;
  Classes classes(context);
  Border border(context);
  PatchLoops loops(context);
  Array<uint32_t> side(context);
  TRY(border.odd.assign(complex.edge_count(), 0));
  TRY(border.touched.assign(complex.edge_count(), 0));
  TRY(find_classes(complex, curves, topology.walls, &classes));
  TRY(find_ears(complex, curves, &classes, &border));
  TRY(find_tails(context, complex, curves, {cells, persistence, topology}, &classes, &border));
  TRY(find_sides(complex, persistence, topology, &side));
  TRY(orient_walls(context, complex, topology.walls, side.span(), &patches->turned));
  TRY(patches->owner.assign(complex.triangle_count(), k_none));
  TRY(patches->start.push(0));
  TRY(patches->loop_start.push(0));
  TRY(patches->run_start.push(0));
  TRY(start_loops(complex, &loops));
  TRY(context.checkpoint());
  size_t taken = 0;
  Pace pace(context);
  for (uint32_t c = 0; c < classes.kind.size(); ++c) {
    if (classes.kind[c] != Kind::patch) continue;
    const size_t first = patches->triangle.size();
    TRY(gather_patch(classes, c, &taken, &patches->triangle));
    const Span<const uint32_t> part =
        patches->triangle.span().part(first, patches->triangle.size() - first);
    TRY(add_patch(complex, curves, samples, side.span(), part, &loops, patches));
    TRY(patches->start.push(static_cast<uint32_t>(patches->triangle.size())));
    TRY(pace.after(k_steps_of_patch + part.size()));
  }
  return own_rest(complex, curves, topology.walls, &patches->owner);
}

}  // namespace wireskin::flow
