#include "network/crossing.h"

#include "base/sort.h"

namespace wireskin::network {

// Sine of the least angle between two branches that go different ways.
static constexpr double k_sine_of_branch = 0.17;

bool run_along(const Vec3& a, const Vec3& b) {
  return length(cross(a, b)) < k_sine_of_branch;
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

// Of one of the two places.
struct Tip {
  uint32_t branches = 0;  // one: the curve ends there
  uint32_t seen = 0;      // of these, not along the gap
  Vec3 sum;               // of their unit directions, short where a curve goes straight on
  bool points = true;     // all branches lead away from the other curve
};

static Status add_branch(const View& view, const Vec3& way, bool of_a, Array<Branch>* branches,
                         Tip* tip) {
  constexpr double k_least_share = 0.5;
  ++tip->branches;
  tip->sum += unit(way);
  const bool away = dot(unit(way), of_a ? view.gap : -view.gap) < -k_sine_of_branch;
  const Vec3 seen = reject(way, view.gap);
  if (!(length(seen) > k_least_share * length(way))) {
    tip->points = tip->points && away;
    return {};
  }
  ++tip->seen;
  const Vec3 direction = unit(seen);
  const double x = dot(direction, view.u), y = dot(direction, view.v);
  const double turn = y / (std::fabs(x) + std::fabs(y));
  return branches->push({direction, x < 0.0 ? 2.0 - turn : turn, of_a, away});
}

// The branches of all curves at a place.
static Status list_branches(const Beads& beads, const View& view, const WirePlace& place, bool of_a,
                            Array<Branch>* branches, Tip* tip) {
  const Wires& wires = beads.wires;
  const uint32_t first = place.edge;
  uint32_t b = first;
  do {
    const WirePlace here = place.part == 0.0 ? beads.place_of(b) : place;
    const uint32_t c = beads.curve[here.edge];
    const Vec3 from = beads.point_at(here);
    tip->points = tip->points && !wires.boundary[c];
    for (int side = 0; side < 2; ++side) {
      const bool forward = side == 1;
      const uint32_t beyond = forward ? wires.next(c, here.edge) : wires.previous(c, here.edge);
      if (here.part == 0.0 && beyond == k_none) continue;
      const Vec3 way = walk(beads, here, view.reach, forward) - from;
      TRY(add_branch(view, way, of_a, branches, tip));
    }
    b = beads.bead[b].ring;
  } while (place.part == 0.0 && b != first);
  return {};
}

static void mark_along(Span<Branch> branches) {
  for (size_t i = 0; i < branches.size(); ++i) {
    Branch &p = branches[i], &q = branches[(i + 1) % branches.size()];
    if (p.of_a == q.of_a || dot(p.direction, q.direction) < 0.0) continue;
    if (run_along(p.direction, q.direction)) p.along = q.along = true;
  }
}

// How often the branches change from one curve to the other, going round once.
static uint32_t count_changes(Span<const Branch> branches) {
  uint32_t changes = 0;
  const Branch *first = nullptr, *last = nullptr;
  for (const Branch& branch : branches) {
    if (branch.along) continue;
    if (first == nullptr) first = &branch;
    if (last != nullptr && last->of_a != branch.of_a) ++changes;
    last = &branch;
  }
  return first != nullptr && first->of_a != last->of_a ? changes + 1 : changes;
}

Status judge_contact(const Beads& beads, const Approach& approach, Array<Branch>* scratch,
                     Contact* contact) {
  const View view(approach);
  const WirePlace a = settle(beads, approach.a, view.reach);
  const WirePlace b = settle(beads, approach.b, view.reach);
  Tip at_a, at_b;
  scratch->clear();
  TRY(list_branches(beads, view, a, true, scratch, &at_a));
  TRY(list_branches(beads, view, b, false, scratch, &at_b));
  *contact = Contact::meets;
  if (at_a.branches < 2 || at_b.branches < 2) return {};
  sort(scratch->span(), [](const Branch& p, const Branch& q) {
    if (p.turn != q.turn) return p.turn < q.turn;
    return p.of_a && !q.of_a;
  });
  mark_along(scratch->span());
  if (count_changes(scratch->span()) >= 4) return {};
  for (const Branch& branch : *scratch) {
    Tip& tip = branch.of_a ? at_a : at_b;
    const Tip& other = branch.of_a ? at_b : at_a;
    const bool leaves_line = !branch.along && other.seen == other.branches;
    tip.points = tip.points && (branch.away || leaves_line);
  }
  const auto is_corner = [](const Tip& tip) {
    return tip.points && length(tip.sum) > k_sine_of_branch * tip.branches;
  };
  *contact = is_corner(at_a) || is_corner(at_b) ? Contact::points : Contact::beside;
  return {};
}

}  // namespace wireskin::network
