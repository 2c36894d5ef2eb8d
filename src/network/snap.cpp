#include "network/snap.h"

#include "base/in_parts.h"
#include "base/sort_in_parts.h"
#include "network/snap_order.h"
#include "network/snap_walk.h"
#include "network/write_beads.h"

namespace wireskin::network {

// Insides are connected if the network joins them within this many tolerances.
static constexpr double k_connected = 4.0;
// What k_crossing is in a complete network, which rarely has any crossing left.
static constexpr double k_crossing_in_complete = 0.01;
// The gap at a crossing tells how exact the curves are: a node that is farther away than this many
// gaps, and than k_exact of the tolerance, is another place.
static constexpr double k_gaps_to_node = 3.0;
// New nodes that are nearer along a curve than this part of the tolerance are one.
static constexpr double k_one_node = 0.01;

struct Meeting {
  WirePlace a, b;
  Vec3 at_a, at_b;
  uint32_t free_ends;
};

class Snapper {
 public:
  Snapper(double tolerance, Beads* beads)
      : tolerance_(tolerance),
        beads_(*beads),
        component_(beads->context()),
        walk_(beads->context()),
        best_(beads->context()),
        stamp_(beads->context()),
        queue_(beads->context()) {}

  Status run(SnapResult* result);

 private:
  Context& context() const { return beads_.context(); }
  const Wires& wires() const { return beads_.wires; }
  double node_reach(double gap) const;
  double crossing() const { return (complete_ ? k_crossing_in_complete : k_crossing) * tolerance_; }
  bool would_touch(uint32_t bead, const WirePlace& place) const;
  uint32_t promote(const WirePlace& place, const WirePlace& other, const Vec3& at,
                   double reach) const;
  Meeting meet(const Approach& approach, double reach) const;
  Status relax(uint32_t bead, double distance, double radius);
  Status connected(const BeadPlace& a, const BeadPlace& b, double radius, bool own, bool* result);
  double detour(uint32_t free_ends, double distance, double reach) const;
  Status unite(const Meeting& meeting, SnapResult* result);
  Status join(const Approach& approach, bool beside, SnapResult* result);
  Status join_all(Span<const Approach> approaches, const SnapPlan& plan, SnapResult* result);
  Status count_open(Span<const Approach> approaches, Span<const uint8_t> beside, uint32_t* open);

  double tolerance_;
  Beads& beads_;
  bool exact_ = false;  // most gaps are next to nothing
  bool complete_ = false;
  Array<uint32_t> component_;  // of each curve, before snapping
  Array<uint32_t> walk_;       // of each sample (network/snap_walk.h)
  // The search for connections: distances that hold where the stamp is the current one.
  Array<double> best_;
  Array<uint32_t> stamp_;
  Array<uint32_t> queue_;
  uint32_t now_ = 0;
  uint32_t steps_ = 0;
};

double Snapper::node_reach(double gap) const {
  const double reach = k_exact * tolerance_ + k_gaps_to_node * gap;
  return exact_ && reach < tolerance_ ? reach : tolerance_;
}

// Whether the curve of `place`, coming to the node of bead b, would meet a curve there that runs
// along it.
bool Snapper::would_touch(uint32_t b, const WirePlace& place) const {
  const Vec3 own = unit(beads_.direction_at(place));
  for (uint32_t other = beads_.bead[b].ring; other != b; other = beads_.bead[other].ring) {
    if (beads_.curve_of(other) == beads_.curve[place.edge]) continue;
    const Vec3 there = unit(beads_.direction_at(beads_.place_of(other)));
    if (there != Vec3{} && run_along(own, there)) return true;  // a point leads nowhere
  }
  return false;
}

// The end or node near `place` that takes part instead of it; k_none if there is none. `other`: the
// place that comes to it, at the point `at`.
uint32_t Snapper::promote(const WirePlace& place, const WirePlace& other, const Vec3& at,
                          double reach) const {
  const uint32_t b = beads_.special_near(beads_.locate(place), tolerance_, reach);
  if (b == k_none) return k_none;
  const double gap = length(beads_.bead[b].position - at);
  if (beads_.is_free_end(b)) return gap <= tolerance_ ? b : k_none;
  if (!(gap <= reach)) return k_none;
  return exact_ && gap > k_one_node * tolerance_ && would_touch(b, other) ? k_none : b;
}

// The places that are to be joined: those of the approach, or the ends and nodes near them.
Meeting Snapper::meet(const Approach& approach, double reach) const {
  Meeting m = {approach.a, approach.b, approach.at_a, approach.at_b, 0};
  const auto take = [&](uint32_t bead, WirePlace* place, Vec3* at) {
    *place = beads_.place_of(bead);
    *at = beads_.bead[bead].position;
    m.free_ends += beads_.is_free_end(bead);
  };
  const auto follow = [this](const Vec3& target, WirePlace* place, Vec3* at) {
    *place = beads_.nearest_place(*place, target, 2.0 * tolerance_);
    *at = beads_.point_at(*place);
  };
  const uint32_t x = promote(m.a, m.b, m.at_b, reach);
  if (x != k_none) {
    take(x, &m.a, &m.at_a);
    follow(m.at_a, &m.b, &m.at_b);
  }
  const uint32_t y = promote(m.b, m.a, m.at_a, reach);
  if (y == k_none) return m;
  take(y, &m.b, &m.at_b);
  if (x != k_none) return m;
  follow(m.at_b, &m.a, &m.at_a);
  const uint32_t again = promote(m.a, m.b, m.at_b, reach);
  if (again != k_none) take(again, &m.a, &m.at_a);
  return m;
}

Status Snapper::relax(uint32_t bead, double distance, double radius) {
  if (bead == k_none || !(distance <= radius)) return {};
  if (stamp_[bead] == now_ && best_[bead] <= distance) return {};
  stamp_[bead] = now_;
  best_[bead] = distance;
  if (++steps_ % 16384 == 0) TRY(context().checkpoint());
  return queue_.push(bead);
}

// Whether the network leads from a to b within `radius`; with `own` on their own curves alone.
Status Snapper::connected(const BeadPlace& a, const BeadPlace& b, double radius, bool own,
                          bool* result) {
  const uint32_t curve_a = beads_.curve_of(a.bead), curve_b = beads_.curve_of(b.bead);
  const Span<const Bead> bead = beads_.bead.span();
  ++now_;
  queue_.clear();
  TRY(relax(a.bead, a.behind, radius));
  if (a.behind > 0.0) TRY(relax(bead[a.bead].next, bead[a.bead].to_next - a.behind, radius));
  const auto reached = [&](uint32_t at, double behind) {
    return at != k_none && stamp_[at] == now_ && best_[at] + behind <= radius;
  };
  const auto found = [&] {
    return reached(b.bead, b.behind) ||
           (b.behind > 0.0 && reached(bead[b.bead].next, bead[b.bead].to_next - b.behind));
  };
  *result = found() || (a.bead == b.bead && std::fabs(a.behind - b.behind) <= radius);
  for (size_t k = 0; k < queue_.size() && !*result; ++k) {
    const uint32_t u = queue_[k], before = bead[u].previous;
    const double distance = best_[u];
    TRY(relax(bead[u].ring, distance, radius));
    if (own && beads_.curve_of(u) != curve_a && beads_.curve_of(u) != curve_b) continue;
    TRY(relax(bead[u].next, distance + bead[u].to_next, radius));
    if (before != k_none) TRY(relax(before, distance + bead[before].to_next, radius));
    *result = found();
  }
  return {};
}

// How long a way through the network counts as a connection. A loose end is there to be joined:
// only the tip of a curve that has crossed the other one (at 30 degrees or more) already is not.
double Snapper::detour(uint32_t free_ends, double distance, double reach) const {
  if (free_ends == 0) return k_connected * reach;
  const double factor = free_ends == 1 ? 4.0 : 2.0, least = free_ends == 1 ? 1.0 : 0.5;
  return factor * distance > least * tolerance_ ? factor * distance : least * tolerance_;
}

Status Snapper::unite(const Meeting& m, SnapResult* result) {
  const uint32_t x = beads_.make_bead(m.a), z = beads_.make_bead(m.b);
  if (beads_.sets.find(x) == beads_.sets.find(z)) return {};
  Snap snap = {beads_.origin_of(m.a),  beads_.origin_of(m.b), m.at_a, m.at_b, 0.0,
               SnapKind::inside_inside};
  snap.distance = length(m.at_a - m.at_b);
  if (beads_.is_end(x) || beads_.is_end(z)) snap.kind = SnapKind::end_inside;
  if (beads_.is_end(x) && beads_.is_end(z)) snap.kind = SnapKind::end_end;
  TRY(make_room_in_parts(1, &result->snaps));
  result->snaps.push_reserved(snap);
  beads_.unite(x, z);
  return {};
}

// Curves that pass side by side are joined only at an end. Where curves cross they share a point,
// however near the ways round by other curves are; so do an end and the curve on which it lies.
Status Snapper::join(const Approach& approach, bool beside, SnapResult* result) {
  const double reach = node_reach(approach.distance);
  const Meeting m = meet(approach, reach);
  const double distance = length(m.at_a - m.at_b);
  if (!(distance <= tolerance_)) return {};
  const uint32_t a = component_[beads_.curve[m.a.edge]], b = component_[beads_.curve[m.b.edge]];
  if (m.free_ends == 0) {
    if (beside || (a == b && distance > crossing())) return {};
  }
  bool together = false;
  const bool on_it = exact_ && m.free_ends == 1 && distance <= k_exact * tolerance_;
  TRY(connected(beads_.locate(m.a), beads_.locate(m.b), detour(m.free_ends, distance, reach), on_it,
                &together));
  if (!together) return unite(m, result);
  if (!exact_ || m.free_ends > 0 || beside || approach.distance > crossing()) return {};
  TRY(connected(beads_.locate(approach.a), beads_.locate(approach.b), detour(0, distance, reach),
                true, &together));
  if (together) return {};
  return unite({approach.a, approach.b, approach.at_a, approach.at_b, 0}, result);
}

Status Snapper::join_all(Span<const Approach> approaches, const SnapPlan& plan,
                         SnapResult* result) {
  constexpr SnapPass k_order[] = {SnapPass::settled, SnapPass::crosses, SnapPass::beside};
  constexpr size_t k_steps_of_join = 512;  // it may search all within four tolerances
  Pace pace(context());
  for (const SnapPass now : k_order) {
    for (size_t k = 0; k < approaches.size(); ++k) {
      TRY(pace.after());
      if (plan.pass[k] != now) continue;
      TRY(join(approaches[k], plan.beside[k] != 0, result));
      const Approach& joined = approaches[k];
      TRY(pace.after(k_steps_of_join + walk_[joined.a.edge] + walk_[joined.b.edge]));
    }
  }
  return {};
}

// Pairs of components that come nearer to each other than the tolerance, and not side by side.
Status Snapper::count_open(Span<const Approach> approaches, Span<const uint8_t> beside,
                           uint32_t* open) {
  struct Pair {
    uint32_t a, b;
  };
  DisjointSets joined(context());
  Array<Pair> pairs(context());
  TRY(joined.reset(wires().curves()));
  TRY(in_parts(context(), beads_.bead.size(), [&](size_t i) {
    const uint32_t b = static_cast<uint32_t>(i);
    joined.unite(beads_.curve_of(b), beads_.curve_of(beads_.bead[b].ring));
  }));
  TRY(pairs.reserve(approaches.size()));
  TRY(in_parts(context(), approaches.size(), [&](size_t k) {
    const Approach& approach = approaches[k];
    if (beside[k]) return;
    const uint32_t a = joined.find(beads_.curve[approach.a.edge]);
    const uint32_t b = joined.find(beads_.curve[approach.b.edge]);
    if (a != b) pairs.push_reserved(a < b ? Pair{a, b} : Pair{b, a});
  }));
  const auto less = [](const Pair& p, const Pair& q) { return p.a != q.a ? p.a < q.a : p.b < q.b; };
  TRY(sort_in_parts(context(), pairs.span(), less));
  *open = 0;
  return in_parts(context(), pairs.size(),
                  [&](size_t k) { *open += k == 0 || less(pairs[k - 1], pairs[k]); });
}

Status Snapper::run(SnapResult* result) {
  WireCounts counts;
  Array<Approach> approaches(context());
  TRY(curve_of_samples(wires(), &beads_.curve));
  TRY(count_wires(wires(), &component_, &counts));
  complete_ = counts.dangling == 0 && counts.components == 1;
  const double reach = (complete_ ? k_crossing_in_complete : 1.0) * tolerance_;
  TRY(find_approaches(wires(), beads_.curve.span(), reach, &approaches));
  const auto nearer = [](const Approach& p, const Approach& q) {
    if (p.distance != q.distance) return p.distance < q.distance;
    if (p.a.edge != q.a.edge) return p.a.edge < q.a.edge;
    if (p.b.edge != q.b.edge) return p.b.edge < q.b.edge;
    return p.a.part != q.a.part ? p.a.part < q.a.part : p.b.part < q.b.part;
  };
  TRY(sort_in_parts(context(), approaches.span(), nearer));
  TRY(count_walks(wires(), tolerance_, &walk_));
  TRY(check_walks(approaches.span(), walk_.span(), context()));
  TRY(beads_.string_samples(approaches.size()));
  TRY(assign_in_parts(beads_.room(), 0.0, &best_));
  TRY(assign_in_parts(beads_.room(), 0, &stamp_));
  SnapPlan plan(context());
  TRY(plan_snaps(beads_, tolerance_, complete_, approaches.span(), walk_.span(), &plan));
  TRY(count_open(approaches.span(), plan.beside.span(), &result->open_before));
  exact_ = plan.exact;
  TRY(join_all(approaches.span(), plan, result));
  TRY(beads_.unite_close(k_one_node * tolerance_));
  return count_open(approaches.span(), plan.beside.span(), &result->open_after);
}

Status snap_wires(double tolerance, Wires* wires, SnapResult* result) {
  Context& context = wires->position.context();
  Wires joined(context);
  {
    Beads beads(*wires);
    TRY(Snapper(tolerance, &beads).run(result));
    TRY(write_beads(2.0 * tolerance, &beads, &joined));
  }
  *wires = static_cast<Wires&&>(joined);
  return {};
}

}  // namespace wireskin::network
