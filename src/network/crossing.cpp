#include "network/crossing.h"

#include "base/sort.h"

namespace wireskin::network {

// Sine of the least angle between two branches that go different ways.
static constexpr double k_crossing_sine = 0.17;

bool run_along(const Vec3& a, const Vec3& b) {
  return length(cross(a, b)) < k_crossing_sine;
}

// The point that far along the curve from a place, or the end before it.
static Vec3 walk(const Beads& beads, const WirePlace& from, double distance, bool forward) {
  constexpr int k_most_steps = 64;
  const Wires& wires = beads.wires;
  const uint32_t c = beads.curve[from.edge];
  WirePlace place = from;
  for (int step = 0; step < k_most_steps; ++step) {
    uint32_t edge = place.edge;
    double at = place.part;
    if (!forward && at == 0.0) {
      edge = wires.previous(c, edge);
      at = 1.0;
    }
    const uint32_t next = edge == k_none ? k_none : wires.next(c, edge);
    if (next == k_none) break;
    const double size = beads.edge_length(edge), rest = forward ? (1.0 - at) * size : at * size;
    if (distance < rest)
      return beads.point_at({edge, at + (forward ? distance : -distance) / size});
    distance -= rest;
    place = {forward ? next : edge, 0.0};
  }
  return beads.point_at(place);
}

namespace {

// The plane across the gap.
struct View {
  Vec3 gap, u, v;
  double reach;

  explicit View(const Approach& approach) : gap(unit(approach.at_b - approach.at_a)) {
    const Vec3 axis = std::fabs(gap.x) > 0.8 ? Vec3{0, 1, 0} : Vec3{1, 0, 0};
    u = unit(reject(axis, gap));
    v = cross(gap, u);
    reach = 2.0 * approach.distance;
  }
};

}  // namespace

static Status add_branch(const View& view, const Vec3& from, const Vec3& to, bool of_a,
                         Array<Branch>* branches) {
  constexpr double k_least_share = 0.5;
  const Vec3 way = to - from, seen = reject(way, view.gap);
  if (!(length(seen) > k_least_share * length(way))) return {};
  const Vec3 direction = unit(seen);
  const double x = dot(direction, view.u), y = dot(direction, view.v);
  const double turn = y / (std::fabs(x) + std::fabs(y));
  return branches->push({direction, x < 0.0 ? 2.0 - turn : turn, of_a});
}

// The end or node that is so near that what lies between is no branch; else the place itself.
static WirePlace settle(const Beads& beads, const WirePlace& place, double reach) {
  constexpr double k_near = 0.25;
  if (place.part == 0.0) return place;
  const uint32_t next = beads.wires.next(beads.curve[place.edge], place.edge);
  const double size = beads.edge_length(place.edge);
  const auto special = [&](uint32_t b, double away) {
    return away <= k_near * reach && (beads.bead[b].ring != b || beads.is_end(b));
  };
  if (special(place.edge, place.part * size)) return {place.edge, 0.0};
  return special(next, (1.0 - place.part) * size) ? WirePlace{next, 0.0} : place;
}

// The branches of all curves at a place. `ends`: there is only one, the curve ends there.
static Status list_branches(const Beads& beads, const View& view, const WirePlace& place, bool of_a,
                            Array<Branch>* branches, bool* ends) {
  const Wires& wires = beads.wires;
  uint32_t count = 0;
  const uint32_t first = place.edge;
  uint32_t b = first;
  do {
    const WirePlace here = place.part == 0.0 ? beads.place_of(b) : place;
    const uint32_t c = beads.curve[here.edge];
    const Vec3 from = beads.point_at(here);
    for (int side = 0; side < 2; ++side) {
      const bool forward = side == 1;
      const uint32_t beyond = forward ? wires.next(c, here.edge) : wires.previous(c, here.edge);
      if (here.part == 0.0 && beyond == k_none) continue;
      ++count;
      TRY(add_branch(view, from, walk(beads, here, view.reach, forward), of_a, branches));
    }
    b = beads.bead[b].ring;
  } while (place.part == 0.0 && b != first);
  *ends = count < 2;
  return {};
}

// How often the branches change from one curve to the other, going round once.
static uint32_t count_changes(Span<const Branch> branches, Span<uint8_t> along) {
  const size_t n = branches.size();
  for (size_t i = 0; i < n; ++i) {
    const Branch &p = branches[i], &q = branches[(i + 1) % n];
    if (p.of_a == q.of_a || dot(p.direction, q.direction) < 0.0) continue;
    if (run_along(p.direction, q.direction)) along[i] = along[(i + 1) % n] = 1;
  }
  uint32_t changes = 0;
  const Branch *first = nullptr, *last = nullptr;
  for (size_t i = 0; i < n; ++i) {
    if (along[i]) continue;
    if (first == nullptr) first = &branches[i];
    if (last != nullptr && last->of_a != branches[i].of_a) ++changes;
    last = &branches[i];
  }
  return first != nullptr && first->of_a != last->of_a ? changes + 1 : changes;
}

Status cross_or_end(const Beads& beads, const Approach& approach, Array<Branch>* scratch,
                    bool* result) {
  const View view(approach);
  bool ends_a = false, ends_b = false;
  scratch->clear();
  const WirePlace a = settle(beads, approach.a, view.reach);
  const WirePlace b = settle(beads, approach.b, view.reach);
  TRY(list_branches(beads, view, a, true, scratch, &ends_a));
  TRY(list_branches(beads, view, b, false, scratch, &ends_b));
  *result = true;
  if (ends_a || ends_b) return {};
  sort(scratch->span(), [](const Branch& p, const Branch& q) {
    if (p.turn != q.turn) return p.turn < q.turn;
    return p.of_a && !q.of_a;
  });
  Array<uint8_t> along(scratch->context());
  TRY(along.assign(scratch->size(), 0));
  *result = count_changes(scratch->span(), along.span()) >= 4;
  return {};
}

}  // namespace wireskin::network
