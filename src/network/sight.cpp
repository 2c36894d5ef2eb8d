#include "network/sight.h"

#include "base/sort.h"
#include "num/minmax.h"
#include "num/trig.h"

namespace wireskin::network {

// So many vertices of a loop at most look.
static constexpr uint32_t k_most_places = 32;
static constexpr uint32_t k_places_in_leaf = 8;
// So many times its own length a loop looks ahead: 25 radii of a tube.
static constexpr double k_reach = 4.0;
// A place sees its own loop where both look at each other with more than this cosine: what is
// beside it on a smooth loop is seen with a cosine near zero.
static constexpr double k_least_own_cosine = 0.2;

// How far the loop turns to the left within its surface, all the way round.
static double total_turning(const Border& border, uint32_t loop) {
  double sum = 0.0;
  for (uint32_t i = border.start[loop]; i < border.start[loop + 1]; ++i) {
    const uint32_t j = next_on_border(border, loop, i), k = next_on_border(border, loop, j);
    const Vec3& n = border.normal[j];
    const Vec3 before = reject(border.position[j] - border.position[i], n);
    const Vec3 behind = reject(border.position[k] - border.position[j], n);
    sum += arc_tangent(dot(cross(before, behind), n), dot(before, behind));
  }
  return sum;
}

static double length_of_loop(const Border& border, uint32_t loop) {
  double sum = 0.0;
  for (uint32_t i = border.start[loop]; i < border.start[loop + 1]; ++i) {
    sum += length(border.position[next_on_border(border, loop, i)] - border.position[i]);
  }
  return sum;
}

double curvature_inside(const Border& border, uint32_t loop) {
  return 2.0 * k_pi - total_turning(border, loop);
}

bool knows_normals(const Border& border, uint32_t loop) {
  bool known = true;
  for (uint32_t i = border.start[loop]; i < border.start[loop + 1]; ++i) {
    known = known && border.normal[i] != Vec3{};
  }
  return known;
}

Status add_sight_loop(const Border& border, uint32_t loop, uint32_t patch, bool reversed,
                      SightMap* map) {
  const uint32_t start = border.start[loop], n = border.start[loop + 1] - start;
  const uint32_t count = n < k_most_places ? n : k_most_places;
  const uint32_t own = static_cast<uint32_t>(map->loop.size());
  const double inside = curvature_inside(border, loop);
  const SightLoop added = {patch,
                           reversed,
                           static_cast<uint32_t>(map->place.size()),
                           count,
                           reversed ? 4.0 * k_pi - inside : inside,
                           k_reach * length_of_loop(border, loop)};
  for (uint32_t k = 0; k < count; ++k) {
    const uint32_t i = static_cast<uint32_t>(uint64_t{k} * n / count);
    const Vec3& next = border.position[start + (i + 1 < n ? i + 1 : 0)];
    const Vec3& before = border.position[start + (i > 0 ? i - 1 : n - 1)];
    const Vec3& normal = border.normal[start + i];
    const Vec3 conormal = unit(cross(normal, next - before));
    TRY(map->place.push(
        {border.position[start + i], reversed ? -conormal : conormal, normal, own}));
  }
  return map->loop.push(added);
}

// ---- The tree -----------------------------------------------------------------------------------

static SightBox box_of(const SightMap& map, uint32_t first, uint32_t count) {
  SightBox box = {map.place[map.order[first]].position, {}, first, count, k_none};
  box.high = box.low;
  for (uint32_t v : map.order.span().part(first, count)) {
    const Vec3& p = map.place[v].position;
    box.low = {smaller(box.low.x, p.x), smaller(box.low.y, p.y), smaller(box.low.z, p.z)};
    box.high = {larger(box.high.x, p.x), larger(box.high.y, p.y), larger(box.high.z, p.z)};
  }
  return box;
}

// Sorts the places of a box along its longest side.
static void sort_box(const SightBox& box, SightMap* map) {
  const Vec3 side = box.high - box.low;
  const uint32_t axis = side.x >= side.y && side.x >= side.z ? 0u : side.y >= side.z ? 1u : 2u;
  sort(map->order.span().part(box.first, box.count), [map, axis](uint32_t a, uint32_t b) {
    const double x = coordinate(map->place[a].position, axis);
    const double y = coordinate(map->place[b].position, axis);
    return x != y ? x < y : a < b;
  });
}

namespace {

struct SightSplit {
  uint32_t first, count;
  uint32_t parent;  // whose second child this is, or k_none
};

}  // namespace

Status build_sight_tree(SightMap* map) {
  Context& context = map->place.context();
  const uint32_t n = static_cast<uint32_t>(map->place.size());
  Array<SightSplit> split(context);
  TRY(map->nearest.assign(n, -1.0));
  TRY(map->order.resize(n));
  for (uint32_t i = 0; i < n; ++i) map->order[i] = i;
  if (n > 0) TRY(split.push({0, n, k_none}));
  while (!split.empty()) {
    const SightSplit todo = split[split.size() - 1];
    split.pop();
    const uint32_t own = static_cast<uint32_t>(map->box.size());
    const SightBox box = box_of(*map, todo.first, todo.count);
    if (todo.parent != k_none) map->box[todo.parent].second = own;
    TRY(map->box.push(box));
    if (todo.count <= k_places_in_leaf) continue;
    sort_box(box, map);
    const uint32_t half = todo.count / 2;
    TRY(split.push({todo.first + half, todo.count - half, own}));
    TRY(split.push({todo.first, half, k_none}));
    if (todo.count > 4096) TRY(context.checkpoint());
  }
  return {};
}

// ---- Looking ------------------------------------------------------------------------------------

SightTurn turn_between(const SightPlace& p, const SightPlace& q) {
  const Vec3 way = q.position - p.position;
  const double chord = length(way);
  if (chord == 0.0) return {0.0, -1.0, -1.0, -1.0};
  const double out = dot(p.conormal, way) / chord, back = -dot(q.conormal, way) / chord;
  // Along the way the conormal turns into the chord and on; the normal is carried along. Who turns
  // back on the spot has no axis to turn about.
  constexpr double k_turns_back = -0.999;
  if (!(out > k_turns_back && back > k_turns_back)) return {chord, out, back, -1.0};
  const auto carry = [](const Vec3& n, const Vec3& from, const Vec3& to) {
    const Vec3 axis = cross(from, to);
    return dot(from, to) * n + cross(axis, n) + (dot(axis, n) / (1.0 + dot(from, to))) * axis;
  };
  const Vec3 along = (1.0 / chord) * way;
  const Vec3 carried = carry(carry(p.normal, p.conormal, along), along, -q.conormal);
  return {chord, out, back, dot(carried, q.normal)};
}

double way_between(const SightPlace& p, const SightPlace& q) {
  const SightTurn t = turn_between(p, q);
  const double least = p.loop == q.loop ? k_least_own_cosine : 0.0;
  if (!(t.out > least && t.back > least && t.twist > 0.0)) return -1.0;
  return t.chord * 8.0 / ((1.0 + t.out) * (1.0 + t.back) * (1.0 + t.twist));
}

static bool have_common(Span<const uint32_t> a, Span<const uint32_t> b) {
  size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    if (a[i] == b[j]) return true;
    if (a[i] < b[j]) {
      ++i;
    } else {
      ++j;
    }
  }
  return false;
}

// Whether loop b may be what is seen from loop a: its own, or one that passes no vertex of it.
static bool may_see(const SightMap& map, uint32_t a, uint32_t b) {
  const uint32_t p = map.loop[a].patch, q = map.loop[b].patch;
  return a == b || (p != q && !have_common(map.corner[p], map.corner[q]));
}

static double distance_to_box(const SightBox& box, const Vec3& p) {
  const auto beyond = [](double low, double x, double high) {
    return larger(larger(low - x, x - high), 0.0);
  };
  return length(Vec3{beyond(box.low.x, p.x, box.high.x), beyond(box.low.y, p.y, box.high.y),
                     beyond(box.low.z, p.z, box.high.z)});
}

// Whether all of a box lies behind a place.
static bool is_behind(const SightBox& box, const SightPlace& p) {
  const Vec3& c = p.conormal;
  const Vec3 farthest = {c.x > 0.0 ? box.high.x : box.low.x, c.y > 0.0 ? box.high.y : box.low.y,
                         c.z > 0.0 ? box.high.z : box.low.z};
  return !(dot(c, farthest - p.position) > 0.0);
}

namespace {

struct Seen {
  uint32_t place = k_none;
  double way = DBL_MAX;
};

}  // namespace

// The place with the least way within the reach of a place's loop, as `measure(q, limit)` gives it:
// no less than the distance, and DBL_MAX where q is not seen or the way is no shorter than the
// limit.
template <typename Measure>
static Seen search_sight(const SightMap& map, const SightPlace& from, const Measure& measure) {
  uint32_t waiting[64];  // halves of halves: 32 levels at most
  uint32_t count = 0;
  Seen seen = {k_none, map.loop[from.loop].reach};
  waiting[count++] = 0;
  while (count > 0) {
    const uint32_t b = waiting[--count];
    const SightBox& box = map.box[b];
    if (is_behind(box, from) || !(distance_to_box(box, from.position) < seen.way)) continue;
    if (box.second == k_none) {
      for (uint32_t q : map.order.span().part(box.first, box.count)) {
        const double way = measure(q, seen.way);
        if (way < seen.way) seen = {q, way};
      }
      continue;
    }
    const bool left_first = distance_to_box(map.box[b + 1], from.position) <=
                            distance_to_box(map.box[box.second], from.position);
    waiting[count++] = left_first ? box.second : b + 1;
    waiting[count++] = left_first ? b + 1 : box.second;
  }
  return seen;
}

// The way from place q to what it sees nearest, its reach where that is nothing.
static double nearest_way(SightMap* map, uint32_t q) {
  if (map->nearest[q] >= 0.0) return map->nearest[q];
  const SightPlace& from = map->place[q];
  const Seen seen = search_sight(*map, from, [&](uint32_t r, double limit) {
    const double way = way_between(from, map->place[r]);
    const bool nearer = way > 0.0 && way < limit;
    return nearer && may_see(*map, from.loop, map->place[r].loop) ? way : DBL_MAX;
  });
  return map->nearest[q] = seen.way;
}

Sight look(SightMap* map, uint32_t i, Span<const uint8_t> hidden) {
  const SightPlace& from = map->place[i];
  const Seen seen = search_sight(*map, from, [&](uint32_t q, double limit) {
    const uint32_t loop = map->place[q].loop;
    if (loop != from.loop && hidden[loop]) return DBL_MAX;
    const double way = way_between(from, map->place[q]);
    if (!(way > 0.0 && way < limit) || !may_see(*map, from.loop, loop)) return DBL_MAX;
    return way * larger(way / nearest_way(map, q), 1.0);
  });
  if (seen.place == k_none) return {};
  const SightPlace& to = map->place[seen.place];
  return {to.loop, seen.way, dot(from.conormal, unit(to.position - from.position))};
}

}  // namespace wireskin::network
