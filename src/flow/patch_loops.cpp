#include "flow/patch_loops.h"

#include "base/search.h"

namespace wireskin::flow {

Status start_loops(const Complex& complex, PatchLoops* loops) {
  TRY(loops->count.assign(complex.edge_count(), 0));
  TRY(loops->first.resize(complex.edge_count()));
  TRY(loops->second.resize(complex.edge_count()));
  TRY(loops->passed.assign(complex.edge_count(), 0));
  TRY(loops->border_first.resize(complex.point.size()));
  TRY(loops->border_second.resize(complex.point.size()));
  return loops->seen.assign(complex.point.size(), 0);
}

static void count_cells(const Complex& complex, Span<const uint32_t> patch, PatchLoops* loops) {
  int32_t vertices = 0, edges = 0;
  for (const uint32_t t : patch) {
    for (uint32_t k = 0; k < 3; ++k) {
      const uint32_t e = complex.triangle_edge[3 * size_t{t} + k];
      const uint32_t v = complex.triangle[3 * size_t{t} + k];
      if (loops->count[e] == 0) {
        loops->first[e] = t;
        ++edges;
      } else if (loops->count[e] == 1) {
        loops->second[e] = t;
      }
      ++loops->count[e];
      if (loops->seen[v] == 0) ++vertices;
      loops->seen[v] = 1;
    }
  }
  loops->euler_characteristic = vertices - edges + static_cast<int32_t>(patch.size());
}

// The edges of the border at each vertex: those of an odd number of triangles, each noted once.
static void link_border(const Complex& complex, Span<const uint32_t> patch, PatchLoops* loops) {
  for (const uint32_t t : patch) {
    for (uint32_t k = 0; k < 3; ++k) {
      const uint32_t e = complex.triangle_edge[3 * size_t{t} + k];
      if (loops->count[e] % 2 == 0 || loops->first[e] != t) continue;
      for (uint32_t end = 0; end < 2; ++end) {
        const uint32_t v = complex.edge[2 * size_t{e} + end];
        const uint32_t at = loops->seen[v]++;
        if (at == 1) loops->border_first[v] = e;
        if (at == 2) loops->border_second[v] = e;
      }
    }
  }
}

static void clear_cells(const Complex& complex, Span<const uint32_t> patch, PatchLoops* loops) {
  for (const uint32_t t : patch) {
    for (uint32_t k = 0; k < 3; ++k) {
      loops->count[complex.triangle_edge[3 * size_t{t} + k]] = 0;
      loops->passed[complex.triangle_edge[3 * size_t{t} + k]] = 0;
      loops->seen[complex.triangle[3 * size_t{t} + k]] = 0;
    }
  }
}

// The segment between two neighbouring samples, in the direction from u to v.
static LoopRun segment_step(const Complex& complex, const CurveEdges& curves,
                            const Samples& samples, uint32_t u, uint32_t v, uint32_t arc_hint) {
  const uint32_t e = find_edge(complex, u, v);
  const uint32_t i = e == k_none ? k_none : curves.segment[e];
  if (i == k_none) return {k_none, u, v};
  // The arc is the one whose range holds the place; segments of one arc come in a row.
  uint32_t arc = arc_hint;
  if (arc == k_none || i < samples.start[arc] || i >= samples.start[arc + 1]) {
    const uint32_t arcs = static_cast<uint32_t>(samples.start.size() - 1);
    arc = last_holding(uint32_t{0}, arcs, [&](uint32_t a) { return samples.start[a] <= i; });
  }
  const bool forward = complex.same_as[samples.at[i]] == u;
  return forward ? LoopRun{arc, i, i + 1} : LoopRun{arc, i + 1, i};
}

// The steps along the curve that a border edge from u to v stands for.
static Status push_steps(const Complex& complex, const CurveEdges& curves, const Samples& samples,
                         uint32_t e, uint32_t u, uint32_t v, PatchLoops* loops) {
  const uint32_t hint = loops->step.empty() ? k_none : loops->step.back().arc;
  if (curves.on_curve(e) || curves.chord_middle[e] == k_none) {
    const LoopRun step = segment_step(complex, curves, samples, u, v, hint);
    if (step.arc == k_none) loops->open = true;
    return loops->step.push(step);
  }
  const uint32_t m = curves.chord_middle[e];
  const LoopRun first = segment_step(complex, curves, samples, u, m, hint);
  TRY(loops->step.push(first));
  return loops->step.push(segment_step(complex, curves, samples, m, v, first.arc));
}

static bool continues(const LoopRun& a, const LoopRun& b) {
  return a.arc != k_none && a.arc == b.arc && a.to == b.from && (a.from < a.to) == (b.from < b.to);
}

// Joins the steps of a loop to runs.
static Status push_runs(PatchLoops* loops) {
  const Array<LoopRun>& step = loops->step;
  const size_t n = step.size();
  size_t first = 0;
  for (size_t i = 0; i < n; ++i) {
    if (continues(step[(i + n - 1) % n], step[i])) continue;
    first = i;
    break;
  }
  const size_t begin = loops->run.size();
  for (size_t i = 0; i < n; ++i) {
    const LoopRun& s = step[(first + i) % n];
    if (loops->run.size() > begin && continues(loops->run.back(), s)) {
      loops->run.back().to = s.to;
    } else {
      TRY(loops->run.push(s));
    }
  }
  return loops->run_start.push(static_cast<uint32_t>(loops->run.size()));
}

struct BorderStep {
  uint32_t triangle, edge;
  uint32_t from, to;
};

// Round the end of an edge of the border, through the patch, to the next one.
static void turn_round(const Complex& complex, const PatchLoops& loops, uint32_t pivot,
                       BorderStep* next) {
  for (size_t turns = 0; turns < complex.triangle_count(); ++turns) {
    const uint32_t* const edge = &complex.triangle_edge[3 * size_t{next->triangle}];
    const uint32_t* const vertex = &complex.triangle[3 * size_t{next->triangle}];
    // Of the triangle's edges the two at the pivot are those not opposite to it.
    for (uint32_t k = 0; k < 3; ++k) {
      if (vertex[k] == pivot || edge[k] == next->edge) continue;
      next->edge = edge[k];
      break;
    }
    if (loops.count[next->edge] != 2) return;
    next->triangle = loops.first[next->edge] == next->triangle ? loops.second[next->edge]
                                                               : loops.first[next->edge];
  }
}

static BorderStep next_on_border(const Complex& complex, const PatchLoops& loops,
                                 const BorderStep& at) {
  BorderStep next = at;
  if (loops.seen[at.to] == 3) {
    const bool at_first = loops.border_first[at.to] == at.edge;
    next.edge = at_first ? loops.border_second[at.to] : loops.border_first[at.to];
    next.triangle = loops.first[next.edge];
  } else {
    turn_round(complex, loops, at.to, &next);
  }
  next.from = at.to;
  const uint32_t* const ends = &complex.edge[2 * size_t{next.edge}];
  next.to = ends[0] == at.to ? ends[1] : ends[0];
  return next;
}

static Status walk_border(const Complex& complex, const CurveEdges& curves, const Samples& samples,
                          const BorderStep& begin, PatchLoops* loops) {
  loops->step.clear();
  BorderStep at = begin;
  while (loops->passed[at.edge] == 0) {
    loops->passed[at.edge] = 1;
    TRY(push_steps(complex, curves, samples, at.edge, at.from, at.to, loops));
    at = next_on_border(complex, *loops, at);
  }
  return push_runs(loops);
}

Status find_loops(const Complex& complex, const CurveEdges& curves, const Samples& samples,
                  Span<const uint32_t> patch, Span<const uint8_t> turned, PatchLoops* loops) {
  loops->run.clear();
  loops->run_start.clear();
  loops->open = false;
  TRY(loops->run_start.push(0));
  count_cells(complex, patch, loops);
  link_border(complex, patch, loops);
  for (const uint32_t t : patch) {
    for (uint32_t k = 0; k < 3; ++k) {
      const uint32_t e = complex.triangle_edge[3 * size_t{t} + k];
      if (loops->count[e] % 2 == 0 || loops->passed[e] != 0) continue;
      const uint32_t a = complex.triangle[3 * size_t{t} + (k + 1) % 3];
      const uint32_t b = complex.triangle[3 * size_t{t} + (k + 2) % 3];
      const BorderStep begin = turned[t] != 0 ? BorderStep{t, e, b, a} : BorderStep{t, e, a, b};
      TRY(walk_border(complex, curves, samples, begin, loops));
    }
  }
  clear_cells(complex, patch, loops);
  return {};
}

}  // namespace wireskin::flow
