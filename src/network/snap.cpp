#include "network/snap.h"

#include "base/sort.h"
#include "network/bend.h"

namespace wireskin::network {

// Insides are connected if the network joins them within this many tolerances.
static constexpr double k_connected = 4.0;
// Within one component insides are joined only this much nearer than the tolerance: where curves
// cross, and not where they pass each other. A complete network rarely has any crossing left.
static constexpr double k_crossing = 0.25, k_crossing_in_complete = 0.01;
// The gap at a crossing tells how exact the curves are: a node that is farther away than this many
// gaps, and than this part of the tolerance, is another place.
static constexpr double k_gaps_to_node = 3.0, k_exact = 0.05;
// The order in which approaches are joined.
static constexpr uint8_t k_settled = 0, k_crosses = 1, k_beside = 2;
// New nodes that are nearer along a curve than this part of the tolerance are one.
static constexpr double k_one_node = 0.01;
// Curves whose directions differ by less than this sine run along each other.
static constexpr double k_along = 0.17;

// A sample, or a place that became one. The beads of a curve are a list, the beads of a point a
// ring. Beads of samples have the sample's index.
struct Bead {
  Vec3 position;
  double to_next = 0.0;  // along the chords
  double part = 0.0;     // of the edge after sample `edge`; zero for samples
  uint32_t edge = k_none;
  uint32_t previous = k_none, next = k_none;
  uint32_t ring = k_none;
  uint32_t given = k_none;  // the point before snapping
  bool joined = false;      // that had more than one sample
};

// A place in the list: a bead, or that far behind it.
struct BeadPlace {
  uint32_t bead = k_none;
  double behind = 0.0;
};

struct Meeting {
  WirePlace a, b;
  Vec3 at_a, at_b;
  uint32_t free_ends;
};

class Snapper {
 public:
  Snapper(double tolerance, const Wires& wires)
      : wires_(wires),
        tolerance_(tolerance),
        bead_(wires.position.context()),
        curve_(wires.position.context()),
        component_(wires.position.context()),
        best_(wires.position.context()),
        stamp_(wires.position.context()),
        queue_(wires.position.context()),
        touched_(wires.position.context()),
        sets_(wires.position.context()),
        parts_(wires.position.context()) {}

  Status run(SnapResult* result);
  Status write(Wires* out);

 private:
  Context& context() const { return wires_.position.context(); }
  Status string_beads(size_t approaches);
  double edge_length(uint32_t i) const {
    return length(wires_.position[wires_.next(curve_[i], i)] - wires_.position[i]);
  }
  bool is_end(uint32_t b) const {
    return bead_[b].part == 0.0 && wires_.is_end(curve_[bead_[b].edge], bead_[b].edge);
  }
  bool is_free_end(uint32_t b) const { return bead_[b].ring == b && is_end(b); }
  uint32_t curve_of(uint32_t b) const { return curve_[bead_[b].edge]; }

  BeadPlace locate(const WirePlace& place) const;
  double node_reach(double gap) const;
  Status plan(Span<const Approach> approaches, Array<uint8_t>* pass);
  uint32_t special_near(const BeadPlace& place, double reach) const;
  WirePlace nearest_place(const WirePlace& near, const Vec3& target) const;
  bool would_touch(uint32_t bead, const WirePlace& place) const;
  uint32_t promote(const WirePlace& place, const WirePlace& other, const Vec3& at,
                   double reach) const;
  Status relax(uint32_t bead, double distance, double radius);
  Status connected(const BeadPlace& a, const BeadPlace& b, double radius, bool own, bool* result);
  uint32_t make_bead(const WirePlace& place);
  Origin origin_of(const WirePlace& place) const;
  double detour(uint32_t free_ends, double distance, double reach) const;
  Vec3 direction_at(const WirePlace& place) const;
  Vec3 normal_at(const WirePlace& place) const;
  bool ends_on(const Approach& approach) const;
  bool is_beside(const Approach& approach) const;
  Meeting meet(const Approach& approach, double reach) const;
  Status unite(const Meeting& meeting, SnapResult* result);
  Status join(const Approach& approach, bool beside, SnapResult* result);
  Status count_open(Span<const Approach> approaches, uint32_t* open);
  void unite_points(uint32_t a, uint32_t b);
  void unite_close_nodes();
  void list_beads(uint32_t c, Array<uint32_t>* order, Array<double>* arc);
  Vec3 target_of(uint32_t root, Span<uint32_t> seen, uint32_t mark) const;
  Status bend(Span<Vec3> displacement, Span<uint8_t> pinned);

  const Wires& wires_;
  double tolerance_;
  bool exact_ = false;  // most gaps are next to nothing
  bool complete_ = false;
  Array<Bead> bead_;
  Array<uint32_t> curve_;      // of each sample
  Array<uint32_t> component_;  // of each curve, before snapping
  // The search for connections: distances that hold where the stamp is the current one.
  Array<double> best_;
  Array<uint32_t> stamp_;
  Array<uint32_t> queue_;
  uint32_t now_ = 0;
  uint32_t steps_ = 0;
  Array<uint8_t> touched_;  // of each bead that names a point: something came to it
  DisjointSets sets_;
  DisjointSets parts_;  // of the components before snapping
};

Status Snapper::string_beads(size_t approaches) {
  const uint32_t n = wires_.samples();
  const size_t room = n + 2 * approaches;
  if (room >= k_none) return fail(Code::too_large, "too many near places for 32-bit indices");
  TRY(bead_.reserve(room));
  TRY(best_.assign(room, 0.0));
  TRY(stamp_.assign(room, 0));
  TRY(touched_.assign(room, 0));
  TRY(sets_.reset(static_cast<uint32_t>(room)));
  PointMembers members(context());
  TRY(list_members(wires_, &members));
  for (uint32_t i = 0; i < n; ++i) {
    Bead bead;
    bead.position = wires_.position[i];
    bead.edge = i;
    bead.next = wires_.next(curve_[i], i);
    bead.previous = wires_.previous(curve_[i], i);
    if (bead.next != k_none) bead.to_next = edge_length(i);
    bead.given = wires_.point[i];
    bead_.push_reserved(bead);
  }
  for (uint32_t p = 0; p < wires_.points; ++p) {
    const Span<const uint32_t> own = members[p];
    for (size_t k = 0; k < own.size(); ++k) {
      bead_[own[k]].ring = own[(k + 1) % own.size()];
      bead_[own[k]].joined = own.size() > 1;
      sets_.unite(own[0], own[k]);
      // Samples of one number that the caller gave at different places meet.
      if (length(wires_.position[own[k]] - wires_.position[own[0]]) > 1e-9) touched_[own[0]] = 1;
    }
  }
  return {};
}

BeadPlace Snapper::locate(const WirePlace& place) const {
  uint32_t b = place.edge;
  if (place.part == 0.0) return {b, 0.0};
  while (bead_[bead_[b].next].part != 0.0 && bead_[bead_[b].next].part <= place.part) {
    b = bead_[b].next;
  }
  return {b, (place.part - bead_[b].part) * edge_length(place.edge)};
}

double Snapper::node_reach(double gap) const {
  const double reach = k_exact * tolerance_ + k_gaps_to_node * gap;
  return exact_ && reach < tolerance_ ? reach : tolerance_;
}

// The nearest loose end of the curve, no farther along it than the tolerance, or joined bead within
// `reach`.
uint32_t Snapper::special_near(const BeadPlace& place, double reach) const {
  const auto special = [&](uint32_t b, double away) {
    return bead_[b].ring != b ? away <= reach : is_end(b);
  };
  uint32_t found = k_none;
  double away = place.behind, least = tolerance_;
  for (uint32_t b = place.bead; b != k_none && away <= least;) {
    if (special(b, away)) {
      found = b;
      least = away;
      break;
    }
    b = bead_[b].previous;
    if (b != k_none) away += bead_[b].to_next;
    if (b == place.bead) break;
  }
  away = bead_[place.bead].to_next - place.behind;
  for (uint32_t b = bead_[place.bead].next; b != k_none && away < least; b = bead_[b].next) {
    if (special(b, away)) return b;
    away += bead_[b].to_next;
    if (b == place.bead) break;
  }
  return found;
}

// The place nearest to `target` on the same curve, within two tolerances along it.
WirePlace Snapper::nearest_place(const WirePlace& near, const Vec3& target) const {
  const uint32_t c = curve_[near.edge];
  WirePlace best = near;
  double least = length(point_of_place(wires_, c, near) - target);
  const auto consider = [&](uint32_t i) {
    const WirePlace place = nearest_on_edge(wires_, c, i, target);
    const double distance = length(point_of_place(wires_, c, place) - target);
    if (distance < least) {
      least = distance;
      best = place;
    }
  };
  double away = 0.0;
  uint32_t steps = 0;
  for (uint32_t i = near.edge; wires_.next(c, i) != k_none && away <= 2.0 * tolerance_;) {
    consider(i);
    if (i != near.edge) away += edge_length(i);
    i = wires_.next(c, i);
    if (++steps == wires_.size(c)) return best;
  }
  away = 0.0;
  for (uint32_t i = near.edge; wires_.previous(c, i) != k_none && away <= 2.0 * tolerance_;) {
    i = wires_.previous(c, i);
    consider(i);
    away += edge_length(i);
    if (++steps >= 2 * wires_.size(c)) return best;
  }
  return best;
}

// Whether the curve of `place`, coming to the node of bead b, would meet a curve there that runs
// along it.
bool Snapper::would_touch(uint32_t b, const WirePlace& place) const {
  const Vec3 own = unit(direction_at(place));
  for (uint32_t other = bead_[b].ring; other != b; other = bead_[other].ring) {
    if (curve_of(other) == curve_[place.edge]) continue;
    const Vec3 there = unit(direction_at({bead_[other].edge, bead_[other].part}));
    if (length(cross(own, there)) < k_along) return true;
  }
  return false;
}

// The end or node near `place` that takes part instead of it; k_none if there is none. `other`: the
// place that comes to it, at the point `at`.
uint32_t Snapper::promote(const WirePlace& place, const WirePlace& other, const Vec3& at,
                          double reach) const {
  const uint32_t b = special_near(locate(place), reach);
  if (b == k_none) return k_none;
  const double gap = length(bead_[b].position - at);
  if (is_free_end(b)) return gap <= tolerance_ ? b : k_none;
  if (!(gap <= reach)) return k_none;
  return exact_ && gap > k_one_node * tolerance_ && would_touch(b, other) ? k_none : b;
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
  const uint32_t curve_a = curve_of(a.bead), curve_b = curve_of(b.bead);
  ++now_;
  queue_.clear();
  TRY(relax(a.bead, a.behind, radius));
  if (a.behind > 0.0) TRY(relax(bead_[a.bead].next, bead_[a.bead].to_next - a.behind, radius));
  for (size_t k = 0; k < queue_.size(); ++k) {
    const uint32_t u = queue_[k], before = bead_[u].previous;
    const double distance = best_[u];
    TRY(relax(bead_[u].ring, distance, radius));
    if (own && curve_of(u) != curve_a && curve_of(u) != curve_b) continue;
    TRY(relax(bead_[u].next, distance + bead_[u].to_next, radius));
    if (before != k_none) TRY(relax(before, distance + bead_[before].to_next, radius));
  }
  const auto reached = [&](uint32_t bead, double behind) {
    return bead != k_none && stamp_[bead] == now_ && best_[bead] + behind <= radius;
  };
  *result = reached(b.bead, b.behind);
  if (b.behind > 0.0) {
    *result = *result || reached(bead_[b.bead].next, bead_[b.bead].to_next - b.behind);
  }
  *result = *result || (a.bead == b.bead && std::fabs(a.behind - b.behind) <= radius);
  return {};
}

// The bead at a place; a new one between beads.
uint32_t Snapper::make_bead(const WirePlace& place) {
  const BeadPlace at = locate(place);
  constexpr double k_same = 1e-3;  // of the edge: nearer than this a sample serves
  const Bead& before = bead_[at.bead];
  if (at.behind <= k_same * before.to_next) return at.bead;
  if (before.to_next - at.behind <= k_same * before.to_next) return before.next;
  Bead bead;
  bead.position = point_of_place(wires_, curve_[place.edge], place);
  bead.part = place.part;
  bead.edge = place.edge;
  bead.previous = at.bead;
  bead.next = before.next;
  bead.to_next = before.to_next - at.behind;
  const uint32_t index = static_cast<uint32_t>(bead_.size());
  bead.ring = index;
  bead.given = wires_.points + (index - wires_.samples());
  bead_[at.bead].next = index;
  bead_[at.bead].to_next = at.behind;
  bead_[bead.next].previous = index;
  bead_.push_reserved(bead);
  return index;
}

Origin Snapper::origin_of(const WirePlace& place) const {
  if (place.part == 0.0) return wires_.origin[place.edge];
  const EdgeOrigin& along = wires_.along[place.edge];
  return {along.curve, along.sample, along.backwards ? 1.0 - place.part : place.part};
}

// How long a way through the network counts as a connection. A loose end is there to be joined:
// only the tip of a curve that has crossed the other one (at 30 degrees or more) already is not.
double Snapper::detour(uint32_t free_ends, double distance, double reach) const {
  if (free_ends == 0) return k_connected * reach;
  const double factor = free_ends == 1 ? 4.0 : 2.0, least = free_ends == 1 ? 1.0 : 0.5;
  return factor * distance > least * tolerance_ ? factor * distance : least * tolerance_;
}

// Along the curve, of any length.
Vec3 Snapper::direction_at(const WirePlace& place) const {
  constexpr double k_step = 1.0 / 16.0;
  const uint32_t c = curve_[place.edge], before = wires_.previous(c, place.edge);
  if (wires_.next(c, place.edge) == k_none) {
    return wires_.position[place.edge] - point_of_place(wires_, c, {before, 1.0 - k_step});
  }
  const double step = place.part + k_step < 1.0 ? k_step : -k_step;
  const Vec3 there = point_of_place(wires_, c, {place.edge, place.part + step});
  return (1.0 / step) * (there - point_of_place(wires_, c, place));
}

// Not unit; zero where it is not known.
Vec3 Snapper::normal_at(const WirePlace& place) const {
  const uint32_t next = wires_.next(curve_[place.edge], place.edge);
  const Vec3& own = wires_.normal[place.edge];
  if (place.part == 0.0 || next == k_none) return own;
  return (1.0 - place.part) * own + place.part * wires_.normal[next];
}

// Whether an end of a curve clearly meets the other curve.
bool Snapper::ends_on(const Approach& approach) const {
  const double near = k_crossing * tolerance_;
  const auto near_end = [&](const WirePlace& place, const Vec3& at) {
    const uint32_t c = curve_[place.edge];
    if (wires_.closed[c]) return false;
    const Vec3 &first = wires_.position[wires_.start[c]],
               &last = wires_.position[wires_.start[c + 1] - 1];
    return length(first - at) <= near || length(last - at) <= near;
  };
  return approach.distance <= near &&
         (near_end(approach.a, approach.at_a) || near_end(approach.b, approach.at_b));
}

// Whether the curves pass each other side by side there instead of crossing: they run along each
// other, or the gap between them lies in the surface.
bool Snapper::is_beside(const Approach& approach) const {
  if (approach.distance <= k_exact * tolerance_) return false;
  const Vec3 gap = unit(approach.at_b - approach.at_a);
  const Vec3 along_a = unit(direction_at(approach.a)), along_b = unit(direction_at(approach.b));
  const auto square = [](double x) { return x * x; };
  // One goes on where the other one ends.
  if (square(dot(gap, along_a)) + square(dot(gap, along_b)) > 0.5) return false;
  const Vec3 a = normal_at(approach.a), b = normal_at(approach.b);
  if (a != Vec3{} && b != Vec3{}) {
    return square(dot(gap, unit(a))) + square(dot(gap, unit(b))) < 0.5;
  }
  return length(cross(along_a, along_b)) < k_along;
}

// The places that are to be joined: those of the approach, or the ends and nodes near them.
Meeting Snapper::meet(const Approach& approach, double reach) const {
  Meeting m = {approach.a, approach.b, approach.at_a, approach.at_b, 0};
  const auto take = [&](uint32_t bead, WirePlace* place, Vec3* at) {
    *place = {bead_[bead].edge, bead_[bead].part};
    *at = bead_[bead].position;
    m.free_ends += is_free_end(bead);
  };
  const auto follow = [this](const Vec3& target, WirePlace* place, Vec3* at) {
    *place = nearest_place(*place, target);
    *at = point_of_place(wires_, curve_[place->edge], *place);
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

void Snapper::unite_points(uint32_t a, uint32_t b) {
  if (!sets_.unite(a, b)) return;
  const uint32_t kept = bead_[a].ring;
  bead_[a].ring = bead_[b].ring;
  bead_[b].ring = kept;
  touched_[sets_.find(a)] = 1;
}

Status Snapper::unite(const Meeting& m, SnapResult* result) {
  const uint32_t x = make_bead(m.a), z = make_bead(m.b);
  if (sets_.find(x) == sets_.find(z)) return {};
  Snap snap = {origin_of(m.a), origin_of(m.b), m.at_a, m.at_b, 0.0, SnapKind::inside_inside};
  snap.distance = length(m.at_a - m.at_b);
  if (is_end(x) || is_end(z)) snap.kind = SnapKind::end_inside;
  if (is_end(x) && is_end(z)) snap.kind = SnapKind::end_end;
  TRY(result->snaps.push(snap));
  unite_points(x, z);
  parts_.unite(component_[curve_of(x)], component_[curve_of(z)]);
  return {};
}

// Curves that pass side by side are joined only where nothing else joins their components. Where
// curves cross they share a point, however near the ways round by other curves are; so do an end
// and the curve on which it lies.
Status Snapper::join(const Approach& approach, bool beside, SnapResult* result) {
  const double reach = node_reach(approach.distance);
  const Meeting m = meet(approach, reach);
  const double distance = length(m.at_a - m.at_b);
  if (!(distance <= tolerance_)) return {};
  const uint32_t a = component_[curve_[m.a.edge]], b = component_[curve_[m.b.edge]];
  const double crossing = (complete_ ? k_crossing_in_complete : k_crossing) * tolerance_;
  if (m.free_ends == 0) {
    if (a == b && distance > crossing) return {};
    if (beside && parts_.find(a) == parts_.find(b)) return {};
  }
  bool together = false;
  const bool on_it = exact_ && m.free_ends == 1 && distance <= k_exact * tolerance_;
  TRY(connected(locate(m.a), locate(m.b), detour(m.free_ends, distance, reach), on_it, &together));
  if (!together) return unite(m, result);
  if (!exact_ || m.free_ends > 0 || beside || approach.distance > crossing) return {};
  TRY(connected(locate(approach.a), locate(approach.b), detour(0, distance, reach), true,
                &together));
  if (together) return {};
  return unite({approach.a, approach.b, approach.at_a, approach.at_b, 0}, result);
}

// Pairs of components that come nearer to each other than the tolerance.
Status Snapper::count_open(Span<const Approach> approaches, uint32_t* open) {
  struct Pair {
    uint32_t a, b;
  };
  DisjointSets joined(context());
  Array<Pair> pairs(context());
  TRY(joined.reset(wires_.curves()));
  for (uint32_t b = 0; b < bead_.size(); ++b) joined.unite(curve_of(b), curve_of(bead_[b].ring));
  TRY(pairs.reserve(approaches.size()));
  for (const Approach& approach : approaches) {
    const uint32_t a = joined.find(curve_[approach.a.edge]);
    const uint32_t b = joined.find(curve_[approach.b.edge]);
    if (a != b) pairs.push_reserved(a < b ? Pair{a, b} : Pair{b, a});
  }
  const auto less = [](const Pair& p, const Pair& q) { return p.a != q.a ? p.a < q.a : p.b < q.b; };
  sort(pairs.span(), less);
  *open = 0;
  for (size_t k = 0; k < pairs.size(); ++k) *open += k == 0 || less(pairs[k - 1], pairs[k]);
  return {};
}

// In which pass each approach is joined. Of exact curves, ends that clearly meet a curve are
// settled first, or crossings near them would take them away; curves side by side come last, when
// all is joined that crosses. Of others what is nearest is what is likeliest.
Status Snapper::plan(Span<const Approach> approaches, Array<uint8_t>* pass) {
  TRY(pass->resize(approaches.size()));
  size_t others = 0, exact = 0;
  for (size_t k = 0; k < approaches.size(); ++k) {
    const Approach& a = approaches[k];
    (*pass)[k] = is_beside(a) ? k_beside : ends_on(a) ? k_settled : k_crosses;
    if ((*pass)[k] == k_beside) continue;
    ++others;
    exact += a.distance <= k_exact * tolerance_;
  }
  exact_ = !complete_ && 4 * exact >= 3 * others;
  for (size_t k = 0; k < pass->size() && !exact_; ++k) (*pass)[k] = k_crosses;
  return {};
}

Status Snapper::run(SnapResult* result) {
  WireCounts counts;
  Array<Approach> approaches(context());
  TRY(curve_of_samples(wires_, &curve_));
  TRY(count_wires(wires_, &component_, &counts));
  complete_ = counts.dangling == 0 && counts.components == 1;
  const double reach = (complete_ ? k_crossing_in_complete : 1.0) * tolerance_;
  TRY(find_approaches(wires_, curve_.span(), reach, &approaches));
  sort(approaches.span(), [](const Approach& p, const Approach& q) {
    if (p.distance != q.distance) return p.distance < q.distance;
    if (p.a.edge != q.a.edge) return p.a.edge < q.a.edge;
    if (p.b.edge != q.b.edge) return p.b.edge < q.b.edge;
    return p.a.part != q.a.part ? p.a.part < q.a.part : p.b.part < q.b.part;
  });
  TRY(string_beads(approaches.size()));
  TRY(count_open(approaches.span(), &result->open_before));
  Array<uint8_t> pass(context());
  TRY(parts_.reset(counts.components));
  TRY(plan(approaches.span(), &pass));
  for (uint8_t now = k_settled; now <= k_beside; ++now) {
    for (size_t k = 0; k < approaches.size(); ++k) {
      if (pass[k] == now) TRY(join(approaches[k], now == k_beside, result));
      if (k % 64 == 63) TRY(context().checkpoint());
    }
  }
  unite_close_nodes();
  return count_open(approaches.span(), &result->open_after);
}

// Where the beads of a point meet: the mean of the places of those of its former points that rank
// highest, each counted once.
Vec3 Snapper::target_of(uint32_t root, Span<uint32_t> seen, uint32_t mark) const {
  const auto rank = [this](uint32_t b) { return bead_[b].joined ? 2 : is_end(b) ? 0 : 1; };
  int highest = 0;
  uint32_t b = root;
  do {
    highest = rank(b) > highest ? rank(b) : highest;
    b = bead_[b].ring;
  } while (b != root);
  Vec3 sum, first;
  uint32_t count = 0;
  do {
    if (rank(b) == highest && seen[bead_[b].given] != mark) {
      seen[bead_[b].given] = mark;
      if (count == 0) first = bead_[b].position;
      sum += bead_[b].position;
      ++count;
    }
    b = bead_[b].ring;
  } while (b != root);
  return count == 1 ? first : (1.0 / count) * sum;
}

Status Snapper::bend(Span<Vec3> displacement, Span<uint8_t> pinned) {
  Array<double> arc(context());
  Array<uint32_t> order(context());
  Array<uint8_t> pins(context());
  Array<Vec3> shift(context());
  TRY(arc.reserve(bead_.size()));
  TRY(order.reserve(bead_.size()));
  TRY(pins.reserve(bead_.size()));
  TRY(shift.reserve(bead_.size()));
  for (uint32_t c = 0; c < wires_.curves(); ++c) {
    arc.clear(), order.clear(), pins.clear(), shift.clear();
    double length = 0.0;
    bool moves = false;
    for (uint32_t b = wires_.start[c]; b != k_none; b = bead_[b].next) {
      if (b == wires_.start[c] && !order.empty()) break;
      order.push_reserved(b);
      arc.push_reserved(length);
      pins.push_reserved(pinned[b]);
      shift.push_reserved(displacement[b]);
      moves = moves || displacement[b] != Vec3{};
      length += bead_[b].to_next;
    }
    if (!moves) continue;
    bend_curve({arc.span(), length, wires_.closed[c] != 0, pins.span(), shift.span()});
    for (size_t k = 0; k < order.size(); ++k) displacement[order[k]] = shift[k];
  }
  return {};
}

static Vec3 normal_between(const Vec3& a, const Vec3& b, double part) {
  const double sum = dot(a, a) * dot(b, b);
  return sum > 0.0 ? unit((1.0 - part) * a + part * b) : Vec3{};
}

// New nodes next to each other on a curve, as where many curves meet in about one point.
void Snapper::unite_close_nodes() {
  for (uint32_t c = 0; c < wires_.curves(); ++c) {
    const uint32_t first = wires_.start[c];
    uint32_t last = k_none, b = first;
    double away = 0.0;
    do {
      if (bead_[b].ring != b) {
        const bool near = last != k_none && away <= k_one_node * tolerance_;
        if (near && (touched_[sets_.find(last)] || touched_[sets_.find(b)])) unite_points(last, b);
        last = b;
        away = 0.0;
      }
      away += bead_[b].to_next;
      b = bead_[b].next;
    } while (b != k_none && b != first);
  }
}

// The beads of a curve without those on a short way from a new node back to itself.
void Snapper::list_beads(uint32_t c, Array<uint32_t>* order, Array<double>* arc) {
  order->clear(), arc->clear();
  double length = 0.0;
  const auto take_back = [&](uint32_t root, double from) {
    for (size_t k = order->size(); k-- > 0 && from - (*arc)[k] <= 2.0 * tolerance_;) {
      if (sets_.find((*order)[k]) != root) continue;
      order->shrink(k + 1), arc->shrink(k + 1);
      return true;
    }
    return false;
  };
  for (uint32_t b = wires_.start[c]; b != k_none; b = bead_[b].next) {
    if (b == wires_.start[c] && !order->empty()) break;
    if (!touched_[sets_.find(b)] || !take_back(sets_.find(b), length)) {
      order->push_reserved(b), arc->push_reserved(length);
    }
    length += bead_[b].to_next;
  }
  const uint32_t first = (*order)[0];
  if (wires_.closed[c] && touched_[sets_.find(first)] && order->size() > 1) {
    if (take_back(sets_.find(first), length) && order->size() > 1) order->pop();
  }
  if (order->size() >= (wires_.closed[c] ? 3 : 2)) return;
  order->clear();  // nothing would be left
  for (uint32_t b = wires_.start[c]; b != k_none; b = bead_[b].next) {
    if (b == wires_.start[c] && !order->empty()) break;
    order->push_reserved(b);
  }
}

// All points that were united come to their place; samples between them follow.
Status Snapper::write(Wires* out) {
  Array<Vec3> displacement(context()), target(context());
  Array<uint8_t> pinned(context());
  Array<uint32_t> seen(context()), name(context()), order(context());
  Array<double> arc(context());
  const uint32_t n = static_cast<uint32_t>(bead_.size());
  TRY(displacement.assign(n, Vec3{}));
  TRY(target.resize(n));
  TRY(pinned.assign(n, 0));
  TRY(name.assign(n, k_none));
  TRY(order.reserve(n));
  TRY(arc.reserve(n));
  TRY(seen.assign(wires_.points + size_t{n}, k_none));
  for (uint32_t b = 0; b < n; ++b) {
    const uint32_t root = sets_.find(b);
    target[b] = bead_[b].position;
    pinned[b] = bead_[b].ring != b;
    if (!touched_[root]) continue;
    target[b] = root == b ? target_of(root, seen.span(), root) : target[root];
    displacement[b] = target[b] - bead_[b].position;
  }
  TRY(bend(displacement.span(), pinned.span()));
  TRY(reserve_wires(wires_.curves(), n, !wires_.right.empty(), out));
  out->start.push_reserved(0);
  out->points = 0;
  for (uint32_t c = 0; c < wires_.curves(); ++c) {
    list_beads(c, &order, &arc);
    for (const uint32_t b : order) {
      const Bead& bead = bead_[b];
      const uint32_t i = bead.edge, root = sets_.find(b);
      if (name[root] == k_none) name[root] = out->points++;
      const bool moved = displacement[b] != Vec3{};
      out->position.push_reserved(pinned[b] ? target[b]
                                  : moved   ? bead.position + displacement[b]
                                            : bead.position);
      out->point.push_reserved(name[root]);
      const bool given = bead.part == 0.0;
      const uint32_t j = given ? i : wires_.next(c, i);
      out->number.push_reserved(given ? wires_.number[i] : k_none);
      out->origin.push_reserved(given ? wires_.origin[i] : origin_of({i, bead.part}));
      const Span<const Vec3> normal = wires_.normal.span(), right = wires_.right.span();
      out->normal.push_reserved(given ? normal[i]
                                      : normal_between(normal[i], normal[j], bead.part));
      if (right.empty()) continue;
      out->right.push_reserved(given ? right[i] : normal_between(right[i], right[j], bead.part));
    }
    out->closed.push_reserved(wires_.closed[c]);
    out->boundary.push_reserved(wires_.boundary[c]);
    out->sharp.push_reserved(wires_.sharp[c]);
    out->soft.push_reserved(wires_.soft[c]);
    out->start.push_reserved(out->samples());
  }
  return {};
}

Status snap_wires(double tolerance, Wires* wires, SnapResult* result) {
  Context& context = wires->position.context();
  Wires joined(context);
  {
    Snapper snapper(tolerance, *wires);
    TRY(snapper.run(result));
    TRY(snapper.write(&joined));
  }
  *wires = static_cast<Wires&&>(joined);
  return {};
}

}  // namespace wireskin::network
