#include "network/snap.h"

#include "base/sort.h"
#include "network/beads.h"

namespace wireskin::network {

// Insides are connected if the network joins them within this many tolerances.
static constexpr double k_connected = 4.0;
// Within one component insides are joined only this much nearer than the tolerance: where curves
// cross, and not where they pass each other. A complete network rarely has any crossing left.
static constexpr double k_crossing = 0.25, k_crossing_in_complete = 0.01;

// A place that may take part in a joint: as it was found, and the end or node that serves instead.
struct Candidate {
  WirePlace place;
  Vec3 at;
  uint32_t special = k_none;
};

class Snapper {
 public:
  Snapper(double tolerance, Beads* beads)
      : tolerance_(tolerance),
        beads_(*beads),
        component_(beads->context()),
        best_(beads->context()),
        stamp_(beads->context()),
        queue_(beads->context()) {}

  Status run(SnapResult* result);

 private:
  Context& context() const { return beads_.context(); }
  const Wires& wires() const { return beads_.wires; }
  void promote(const Vec3& other, Candidate* candidate) const;
  void approach(const Candidate& other, Candidate* candidate) const;
  Status relax(uint32_t bead, double distance, double radius);
  Status connected(const BeadPlace& a, const BeadPlace& b, double radius, bool* result);
  double detour(uint32_t free_ends, double distance) const;
  Status join(const Approach& approach, SnapResult* result);
  Status unite(const Candidate& a, const Candidate& b, SnapResult* result);
  Status count_open(Span<const Approach> approaches, uint32_t* open);

  double tolerance_;
  Beads& beads_;
  bool complete_ = false;
  Array<uint32_t> component_;  // of each curve, before snapping
  // The search for connections: distances that hold where the stamp is the current one.
  Array<double> best_;
  Array<uint32_t> stamp_;
  Array<uint32_t> queue_;
  uint32_t now_ = 0;
  uint32_t steps_ = 0;
};

// The end or node near the candidate takes part instead of it, if it lies within the tolerance.
void Snapper::promote(const Vec3& other, Candidate* candidate) const {
  const uint32_t b = beads_.special_near(beads_.locate(candidate->place), tolerance_);
  if (b == k_none || !(length(beads_.bead[b].position - other) <= tolerance_)) return;
  *candidate = {beads_.place_of(b), beads_.bead[b].position, b};
}

// The candidate moves to the place of its curve that is nearest to the other one.
void Snapper::approach(const Candidate& other, Candidate* candidate) const {
  candidate->place = beads_.nearest_place(candidate->place, other.at, 2.0 * tolerance_);
  candidate->at = beads_.point_at(candidate->place);
}

Status Snapper::relax(uint32_t bead, double distance, double radius) {
  if (bead == k_none || !(distance <= radius)) return {};
  if (stamp_[bead] == now_ && best_[bead] <= distance) return {};
  stamp_[bead] = now_;
  best_[bead] = distance;
  if (++steps_ % 16384 == 0) TRY(context().checkpoint());
  return queue_.push(bead);
}

Status Snapper::connected(const BeadPlace& a, const BeadPlace& b, double radius, bool* result) {
  ++now_;
  queue_.clear();
  TRY(relax(a.bead, a.behind, radius));
  if (a.behind > 0.0)
    TRY(relax(beads_.bead[a.bead].next, beads_.bead[a.bead].to_next - a.behind, radius));
  for (size_t k = 0; k < queue_.size(); ++k) {
    const uint32_t u = queue_[k], before = beads_.bead[u].previous;
    const double distance = best_[u];
    TRY(relax(beads_.bead[u].next, distance + beads_.bead[u].to_next, radius));
    if (before != k_none) TRY(relax(before, distance + beads_.bead[before].to_next, radius));
    TRY(relax(beads_.bead[u].ring, distance, radius));
  }
  const auto reached = [&](uint32_t bead, double behind) {
    return bead != k_none && stamp_[bead] == now_ && best_[bead] + behind <= radius;
  };
  *result = reached(b.bead, b.behind);
  if (b.behind > 0.0) {
    *result = *result || reached(beads_.bead[b.bead].next, beads_.bead[b.bead].to_next - b.behind);
  }
  *result = *result || (a.bead == b.bead && std::fabs(a.behind - b.behind) <= radius);
  return {};
}

// How long a way through the network counts as a connection. A loose end is there to be joined:
// only the tip of a curve that has crossed the other one (at 30 degrees or more) already is not.
double Snapper::detour(uint32_t free_ends, double distance) const {
  if (free_ends == 0) return k_connected * tolerance_;
  const double factor = free_ends == 1 ? 4.0 : 2.0, least = free_ends == 1 ? 1.0 : 0.5;
  return factor * distance > least * tolerance_ ? factor * distance : least * tolerance_;
}

Status Snapper::unite(const Candidate& a, const Candidate& b, SnapResult* result) {
  const uint32_t x = beads_.make_bead(a.place);
  const uint32_t z = beads_.make_bead(b.place);
  if (beads_.sets.find(x) == beads_.sets.find(z)) return {};
  Snap snap = {beads_.origin_of(a.place), beads_.origin_of(b.place), a.at, b.at,
               length(a.at - b.at),       SnapKind::inside_inside};
  if (beads_.is_end(x) || beads_.is_end(z)) snap.kind = SnapKind::end_inside;
  if (beads_.is_end(x) && beads_.is_end(z)) snap.kind = SnapKind::end_end;
  TRY(result->snaps.push(snap));
  beads_.unite(x, z);
  return {};
}

Status Snapper::join(const Approach& found, SnapResult* result) {
  Candidate a = {found.a, found.at_a}, b = {found.b, found.at_b};
  promote(b.at, &a);
  if (a.special != k_none) approach(a, &b);
  promote(a.at, &b);
  if (b.special != k_none && a.special == k_none) {
    approach(b, &a);
    promote(b.at, &a);
  }
  const double distance = length(a.at - b.at);
  if (!(distance <= tolerance_)) return {};
  const auto is_free = [this](const Candidate& c) {
    return c.special != k_none && beads_.is_free_end(c.special);
  };
  const uint32_t free_ends = is_free(a) + is_free(b);
  const double crossing = complete_ ? k_crossing_in_complete : k_crossing;
  if (free_ends == 0 && distance > crossing * tolerance_ &&
      component_[beads_.curve[a.place.edge]] == component_[beads_.curve[b.place.edge]]) {
    return {};
  }
  bool together = false;
  TRY(connected(beads_.locate(a.place), beads_.locate(b.place), detour(free_ends, distance),
                &together));
  return together ? Status{} : unite(a, b, result);
}

// Pairs of components that come nearer to each other than the tolerance.
Status Snapper::count_open(Span<const Approach> approaches, uint32_t* open) {
  struct Pair {
    uint32_t a, b;
  };
  DisjointSets joined(context());
  Array<Pair> pairs(context());
  TRY(joined.reset(wires().curves()));
  for (uint32_t b = 0; b < beads_.bead.size(); ++b)
    joined.unite(beads_.curve_of(b), beads_.curve_of(beads_.bead[b].ring));
  TRY(pairs.reserve(approaches.size()));
  for (const Approach& approach : approaches) {
    const uint32_t a = joined.find(beads_.curve[approach.a.edge]);
    const uint32_t b = joined.find(beads_.curve[approach.b.edge]);
    if (a != b) pairs.push_reserved(a < b ? Pair{a, b} : Pair{b, a});
  }
  const auto less = [](const Pair& p, const Pair& q) { return p.a != q.a ? p.a < q.a : p.b < q.b; };
  sort(pairs.span(), less);
  *open = 0;
  for (size_t k = 0; k < pairs.size(); ++k) *open += k == 0 || less(pairs[k - 1], pairs[k]);
  return {};
}

Status Snapper::run(SnapResult* result) {
  WireCounts counts;
  Array<Approach> approaches(context());
  TRY(curve_of_samples(wires(), &beads_.curve));
  TRY(count_wires(wires(), &component_, &counts));
  complete_ = counts.dangling == 0 && counts.components == 1;
  const double reach = (complete_ ? k_crossing_in_complete : 1.0) * tolerance_;
  TRY(find_approaches(wires(), beads_.curve.span(), reach, &approaches));
  sort(approaches.span(), [](const Approach& p, const Approach& q) {
    if (p.distance != q.distance) return p.distance < q.distance;
    if (p.a.edge != q.a.edge) return p.a.edge < q.a.edge;
    if (p.b.edge != q.b.edge) return p.b.edge < q.b.edge;
    return p.a.part != q.a.part ? p.a.part < q.a.part : p.b.part < q.b.part;
  });
  TRY(beads_.string_samples(approaches.size()));
  TRY(best_.assign(beads_.room(), 0.0));
  TRY(stamp_.assign(beads_.room(), 0));
  TRY(count_open(approaches.span(), &result->open_before));
  for (size_t k = 0; k < approaches.size(); ++k) {
    TRY(join(approaches[k], result));
    if (k % 64 == 63) TRY(context().checkpoint());
  }
  return count_open(approaches.span(), &result->open_after);
}

Status automatic_tolerance(const Wires& wires, double diagonal, double* tolerance) {
  Array<double> lengths(wires.position.context());
  TRY(lengths.reserve(wires.samples()));
  for (uint32_t c = 0; c < wires.curves(); ++c) {
    for (uint32_t i = wires.start[c]; i < wires.start[c + 1]; ++i) {
      const uint32_t j = wires.next(c, i);
      if (j != k_none) lengths.push_reserved(length(wires.position[j] - wires.position[i]));
    }
  }
  sort(lengths.span(), [](double a, double b) { return a < b; });
  const double median = lengths.empty() ? 0.0 : lengths[lengths.size() / 2];
  *tolerance = median < 0.01 * diagonal ? median : 0.01 * diagonal;
  return {};
}

Status snap_wires(double tolerance, Wires* wires, SnapResult* result) {
  Context& context = wires->position.context();
  Wires joined(context);
  {
    Beads beads(*wires);
    TRY(Snapper(tolerance, &beads).run(result));
    TRY(write_beads(&beads, &joined));
  }
  *wires = static_cast<Wires&&>(joined);
  return {};
}

}  // namespace wireskin::network
