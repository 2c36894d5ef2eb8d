#include "flow/straight_lines.h"

namespace wireskin::flow {

static constexpr double k_straight = 0.01;       // of an arc's length, off its chord
static constexpr double k_unseen_bend = 0.9985;  // cosine
static constexpr double k_unseen_step = 1e-5;    // of the diagonal, of a node off a line

static bool has_line(const StraightLines& lines, uint32_t v, uint32_t line) {
  for (uint32_t i = lines.start[v]; i < lines.start[v + 1]; ++i) {
    if (lines.line[i] == line) return true;
  }
  return false;
}

uint32_t StraightLines::common(uint32_t u, uint32_t v) const {
  for (uint32_t i = start[u]; i < start[u + 1]; ++i) {
    if (has_line(*this, v, line[i])) return line[i];
  }
  return k_none;
}

uint32_t StraightLines::common(uint32_t u, uint32_t v, uint32_t w) const {
  for (uint32_t i = start[u]; i < start[u + 1]; ++i) {
    if (has_line(*this, v, line[i]) && has_line(*this, w, line[i])) return line[i];
  }
  return k_none;
}

static bool stays_on_line(const Samples& samples, uint32_t first, uint32_t last) {
  const Vec3& p = samples.position[samples.at[first]];
  const Vec3 chord = samples.position[samples.at[last]] - p;
  const Vec3 along = unit(chord);
  for (uint32_t i = first + 1; i < last; ++i) {
    const Vec3 to = samples.position[samples.at[i]] - p;
    if (length(reject(to, along)) > k_straight * length(chord)) return false;
  }
  return samples.at[first] != samples.at[last];
}

static uint32_t root_of_line(Span<uint32_t> parent, uint32_t a) {
  while (parent[a] != a) a = parent[a] = parent[parent[a]];
  return a;
}

// Two straight arcs from a node, by their other ends.
static bool goes_on(const Complex& complex, uint32_t node, uint32_t u, uint32_t v) {
  const Vec3 a = complex.point[u] - complex.point[node];
  const Vec3 b = complex.point[v] - complex.point[node];
  if (dot(unit(a), unit(b)) > -k_unseen_bend) return false;
  return length(reject(a, unit(b - a))) <= k_unseen_step * complex.diagonal;
}

// Joins the arcs that go on at nodes. Until then each straight arc is a line of its own.
static Status join_lines(const Complex& complex, const Samples& samples, Span<uint32_t> parent) {
  Array<uint32_t> start(complex.point.context()), arc(complex.point.context());
  const auto end_of = [&](uint32_t a, uint32_t end) {
    const uint32_t at = end == 0 ? samples.start[a] : samples.start[a + 1] - 1;
    return complex.same_as[samples.at[at]];
  };
  TRY(start.assign(complex.point.size() + 1, 0));
  TRY(arc.resize(2 * parent.size()));
  for (uint32_t a = 0; a < parent.size(); ++a) {
    for (uint32_t end = 0; end < 2 && parent[a] != k_none; ++end) ++start[end_of(a, end)];
  }
  starts_from_counts(start.span());
  for (uint32_t a = 0; a < parent.size(); ++a) {
    for (uint32_t end = 0; end < 2 && parent[a] != k_none; ++end) arc[start[end_of(a, end)]++] = a;
  }
  // The starts have moved on to the ends.
  constexpr size_t k_pairs_per_checkpoint = 1u << 16;
  size_t pairs = 0;
  for (uint32_t v = 0; v < complex.point.size(); ++v) {
    for (uint32_t i = v == 0 ? 0 : start[v - 1]; i < start[v]; ++i) {
      pairs += start[v] - i;
      if (pairs > k_pairs_per_checkpoint) {
        pairs = 0;
        TRY(start.context().checkpoint());
      }
      for (uint32_t k = i + 1; k < start[v]; ++k) {
        const uint32_t u = end_of(arc[i], 0) == v ? end_of(arc[i], 1) : end_of(arc[i], 0);
        const uint32_t w = end_of(arc[k], 0) == v ? end_of(arc[k], 1) : end_of(arc[k], 0);
        if (u == w || !goes_on(complex, v, u, w)) continue;
        parent[root_of_line(parent, arc[i])] = root_of_line(parent, arc[k]);
      }
    }
  }
  return {};
}

Status find_straight_lines(const Complex& complex, const Samples& samples, StraightLines* lines) {
  const uint32_t arcs = static_cast<uint32_t>(samples.start.size() - 1);
  Array<uint32_t> parent(lines->line.context()), number(lines->line.context());
  TRY(parent.assign(arcs, k_none));
  for (uint32_t a = 0; a < arcs; ++a) {
    if (stays_on_line(samples, samples.start[a], samples.start[a + 1] - 1)) parent[a] = a;
  }
  TRY(join_lines(complex, samples, parent.span()));
  TRY(number.assign(arcs, k_none));
  TRY(lines->line_of.assign(arcs, k_none));
  TRY(lines->start.assign(complex.point.size() + 1, 0));
  TRY(lines->arc_start.assign(size_t{arcs} + 1, 0));
  uint32_t count = 0;
  size_t vertices = 0;
  for (uint32_t a = 0; a < arcs; ++a) {
    if (parent[a] == k_none) continue;
    uint32_t& line = number[root_of_line(parent.span(), a)];
    if (line == k_none) line = count++;
    lines->line_of[a] = line;
    ++lines->arc_start[line];
    for (uint32_t i = samples.start[a]; i < samples.start[a + 1]; ++i, ++vertices) {
      ++lines->start[complex.same_as[samples.at[i]]];
    }
  }
  TRY(lines->arc.resize(arcs));
  TRY(lines->line.resize(vertices));
  starts_from_counts(lines->start.span());
  starts_from_counts(lines->arc_start.span());
  for (uint32_t a = arcs; a-- > 0;) {
    if (parent[a] == k_none) continue;
    lines->arc[lines->arc_start[lines->line_of[a]]++] = a;
    for (uint32_t i = samples.start[a]; i < samples.start[a + 1]; ++i) {
      lines->line[lines->start[complex.same_as[samples.at[i]]]++] = lines->line_of[a];
    }
  }
  shift_starts_back(lines->start.span());
  shift_starts_back(lines->arc_start.span());
  return {};
}

}  // namespace wireskin::flow
