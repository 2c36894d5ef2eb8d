#include "network/linking.h"

#include "base/sort.h"
#include "num/minmax.h"
#include "num/predicates.h"
#include "num/trig.h"

namespace wireskin::network {

namespace {

// An edge of the border with the normal that it has, across it; `next`: the edge behind it.
struct LinkedEdge {
  Vec3 from, to, tangent, normal;
  uint32_t next;
};

// The same seen from afar.
struct SeenEdge {
  Vec2 from, to;
  double low, high;  // its extent along the first axis of the view
  uint32_t edge;
};

// What is seen along `toward`; `right` and it have a right angle.
struct LinkingView {
  Vec3 toward, right;
};

}  // namespace

// How far the normals turn about the curve from an edge to the next one, in radians, against the
// normal carried over by the least rotation.
static double twist_angle(const LinkedEdge& e, const LinkedEdge& f, const Vec3& normal_e,
                          const Vec3& normal_f) {
  const Vec3 axis = cross(e.tangent, f.tangent);
  const double cosine = dot(e.tangent, f.tangent);
  const Vec3 carried =
      cosine * normal_e + cross(axis, normal_e) + (dot(axis, normal_e) / (1.0 + cosine)) * axis;
  return arc_tangent(dot(cross(carried, normal_f), f.tangent), dot(carried, normal_f));
}

static Status take_edges(const Border& border, Array<LinkedEdge>* edges, bool* known) {
  constexpr double k_least_sine = 0.05, k_turns_back = -0.98;
  *known = true;
  for (uint32_t l = 0; l < border.loops(); ++l) {
    for (uint32_t i = border.start[l]; i < border.start[l + 1]; ++i) {
      const uint32_t j = next_on_border(border, l, i);
      const Vec3 tangent = unit(border.position[j] - border.position[i]);
      const Vec3 mean = reject(border.normal[i] + border.normal[j], tangent);
      *known = *known && border.normal[i] != Vec3{} && length(mean) > k_least_sine;
      TRY(edges->push({border.position[i], border.position[j], tangent, unit(mean), j}));
    }
  }
  for (const LinkedEdge& e : *edges) {
    *known = *known && dot(e.tangent, (*edges)[e.next].tangent) > k_turns_back;
  }
  return {};
}

// A view along no edge: of a few that follow no axis the one in which edges look least shortened.
static LinkingView choose_view(Span<const LinkedEdge> edges) {
  const Vec3 views[] = {{0.4142, 0.7321, 1.0}, {-0.8661, 0.3178, 0.5772}, {0.6931, -1.0, 0.2718}};
  LinkingView best = {{}, {}};
  double greatest = -1.0;
  for (const Vec3& view : views) {
    const Vec3 toward = unit(view);
    double least = 1.0;
    for (const LinkedEdge& e : edges) least = smaller(least, length(cross(e.tangent, toward)));
    if (!(least > greatest)) continue;
    greatest = least;
    best = {toward, unit(cross(toward, Vec3{1.0, 0.0, 0.0}))};
  }
  return best;
}

static Status see_edges(Span<const LinkedEdge> edges, const LinkingView& view,
                        Array<SeenEdge>* seen) {
  const Vec3 up = cross(view.toward, view.right);
  TRY(seen->reserve(edges.size()));
  for (uint32_t i = 0; i < edges.size(); ++i) {
    const LinkedEdge& e = edges[i];
    const Vec2 from = {dot(e.from, view.right), dot(e.from, up)};
    const Vec2 to = {dot(e.to, view.right), dot(e.to, up)};
    seen->push_reserved({from, to, smaller(from.x, to.x), larger(from.x, to.x), i});
  }
  sort(seen->span(), [](const SeenEdge& a, const SeenEdge& b) {
    return a.low != b.low ? a.low < b.low : a.edge < b.edge;
  });
  return {};
}

// Exact, so that no rounding makes or loses one of two crossings that cancel.
static bool are_seen_to_cross(const SeenEdge& a, const SeenEdge& b) {
  if (larger(a.from.y, a.to.y) < smaller(b.from.y, b.to.y)) return false;
  if (larger(b.from.y, b.to.y) < smaller(a.from.y, a.to.y)) return false;
  const bool from = orient2d(a.from, a.to, b.from) >= 0.0;
  const bool to = orient2d(a.from, a.to, b.to) >= 0.0;
  if (from == to) return false;
  return (orient2d(b.from, b.to, a.from) >= 0.0) != (orient2d(b.from, b.to, a.to) >= 0.0);
}

static Status count_crossings(Span<const LinkedEdge> edges, Span<const SeenEdge> seen,
                              Context* context, int32_t* sum) {
  constexpr size_t k_pairs_between = size_t{1} << 18;  // some milliseconds
  size_t pairs = 0;
  *sum = 0;
  for (size_t i = 0; i < seen.size(); ++i) {
    ++pairs;
    for (size_t k = i + 1; k < seen.size() && seen[k].low <= seen[i].high; ++k) {
      ++pairs;
      const LinkedEdge &e = edges[seen[i].edge], &f = edges[seen[k].edge];
      if (e.next == seen[k].edge || f.next == seen[i].edge) continue;
      if (!are_seen_to_cross(seen[i], seen[k])) continue;
      const double side = dot(cross(f.to - f.from, e.to - e.from), f.from - e.from);
      *sum += side > 0.0 ? 1 : side < 0.0 ? -1 : 0;
    }
    if (pairs < k_pairs_between) continue;
    TRY(context->checkpoint());
    pairs = 0;
  }
  return {};
}

// How often the normals turn about the curves against what looks towards the viewer.
static double turns_of_normals(Span<const LinkedEdge> edges, const Vec3& toward) {
  double sum = 0.0;
  for (const LinkedEdge& e : edges) {
    const LinkedEdge& f = edges[e.next];
    const Vec3 before = unit(reject(toward, e.tangent)), behind = unit(reject(toward, f.tangent));
    sum += twist_angle(e, f, e.normal, f.normal) - twist_angle(e, f, before, behind);
  }
  return sum / (2.0 * k_pi);
}

Status linking_number(const Border& border, int32_t* number) {
  constexpr double k_near = 0.2;
  Context& context = border.vertex.context();
  Array<LinkedEdge> edges(context);
  Array<SeenEdge> seen(context);
  bool known = false;
  int32_t crossings = 0;
  *number = 0;
  TRY(take_edges(border, &edges, &known));
  if (!known) return {};
  const LinkingView view = choose_view(edges.span());
  TRY(see_edges(edges.span(), view, &seen));
  TRY(count_crossings(edges.span(), seen.span(), &context, &crossings));
  const double sum = crossings + turns_of_normals(edges.span(), view.toward);
  const int32_t nearest = static_cast<int32_t>(sum < 0.0 ? sum - 0.5 : sum + 0.5);
  if (std::fabs(sum - nearest) < k_near) *number = nearest;
  return {};
}

}  // namespace wireskin::network
