#include "network/orient.h"

#include "base/in_parts.h"
#include "base/sort_in_parts.h"
#include "num/trig.h"

namespace wireskin::network {

static bool is_known(const Vec3& normal) {
  return normal != Vec3{};
}

Status orient_along(Wires* wires, Array<uint8_t>* turned, Array<Contradiction>* contradictions) {
  TRY(assign_in_parts(wires->samples(), 0, turned));
  Pace pace(turned->context());
  for (uint32_t c = 0; c < wires->curves(); ++c) {
    if (wires->sharp[c]) continue;
    uint32_t last = k_none, first = k_none;
    Vec3 carried;
    for (uint32_t i = wires->start[c]; i < wires->start[c + 1]; ++i) {
      TRY(pace.after());
      Vec3& normal = wires->normal[i];
      if (last != k_none) {
        carried = carry_normal(wires->position[i - 1], wires->position[i], carried);
      }
      if (!is_known(normal)) continue;
      if (last != k_none && dot(carried, normal) < 0.0) {
        normal = -normal;
        (*turned)[i] = 1;
      }
      if (first == k_none) first = i;
      last = i;
      carried = normal;
    }
    if (!wires->closed[c] || last == first) continue;
    const uint32_t end = wires->start[c + 1] - 1;
    for (uint32_t i = last; i != first;) {
      TRY(pace.after());
      const uint32_t next = i == end ? wires->start[c] : i + 1;
      carried = carry_normal(wires->position[i], wires->position[next], carried);
      i = next;
    }
    if (dot(carried, wires->normal[first]) < 0.0) {
      TRY(contradictions->push({wires->origin[last], wires->origin[first],
                                angle_between(carried, wires->normal[first])}));
    }
  }
  return {};
}

// Sets of curves whose signs relative to the set's first are known.
class SignedSets {
 public:
  explicit SignedSets(Context& context) : parent_(context), opposite_(context) {}
  Status reset(uint32_t size) {
    TRY(parent_.resize(size));
    TRY(assign_in_parts(size, 0, &opposite_));
    return in_parts<k_light_steps_per_checkpoint>(
        parent_.context(), size, [&](size_t i) { parent_[i] = static_cast<uint32_t>(i); });
  }
  // The set of i, and whether i is opposite to it.
  uint32_t find(uint32_t i, bool* opposite) {
    uint8_t sign = 0;
    uint32_t root = i;
    for (; parent_[root] != root; root = parent_[root]) sign ^= opposite_[root];
    *opposite = sign != 0;
    while (parent_[i] != root && i != root) {
      const uint32_t above = parent_[i];
      const uint8_t own = opposite_[i];
      parent_[i] = root;
      opposite_[i] = sign;
      sign ^= own;
      i = above;
    }
    return root;
  }
  void unite(uint32_t root_a, uint32_t root_b, bool opposite) {
    const uint32_t low = root_a < root_b ? root_a : root_b;
    const uint32_t high = root_a < root_b ? root_b : root_a;
    parent_[high] = low;
    opposite_[high] = opposite;
  }

 private:
  Array<uint32_t> parent_;
  Array<uint8_t> opposite_;
};

// Two samples at one point; agreement is that of their normals.
struct Encounter {
  uint32_t a, b;
  double agreement;
};

static Status list_encounters(const Wires& wires, Span<const uint32_t> curve,
                              Array<Encounter>* encounters) {
  Context& context = wires.position.context();
  PointMembers members(context);
  TRY(list_members(wires, &members));
  Pace pace(context);
  for (uint32_t p = 0; p < wires.points; ++p) {
    TRY(pace.after(members[p].size()));
    uint32_t last = k_none;
    for (uint32_t i : members[p]) {
      if (!is_known(wires.normal[i]) || wires.sharp[curve[i]]) continue;
      if (last != k_none) {
        TRY(encounters->push({last, i, dot(wires.normal[last], wires.normal[i])}));
      }
      last = i;
    }
  }
  return sort_in_parts(context, encounters->span(), [](const Encounter& x, const Encounter& y) {
    const double p = std::fabs(x.agreement), q = std::fabs(y.agreement);
    if (p != q) return p > q;
    return x.a != y.a ? x.a < y.a : x.b < y.b;
  });
}

// Each encounter says whether two curves are opposite, the clearest first.
static Status relate_curves(const Wires& wires, Span<const uint32_t> curve, SignedSets* sets,
                            Array<Contradiction>* contradictions) {
  Array<Encounter> encounters(wires.position.context());
  TRY(list_encounters(wires, curve, &encounters));
  Pace pace(wires.position.context());
  for (const Encounter& e : encounters) {
    TRY(pace.after());
    bool a = false, b = false;
    const uint32_t x = sets->find(curve[e.a], &a), y = sets->find(curve[e.b], &b);
    const bool differ = (e.agreement < 0.0) != (a != b);
    if (x != y) {
      sets->unite(x, y, differ);
    } else if (differ) {
      TRY(contradictions->push({wires.origin[e.a], wires.origin[e.b],
                                angle_between(wires.normal[e.a], wires.normal[e.b])}));
    }
  }
  return {};
}

namespace {

// What the samples of a component say about its sign.
struct Vote {
  uint32_t kept = 0, turned = 0;
  uint32_t samples = 0;
  Vec3 sum;          // of positions
  double out = 0.0;  // how much normals point away from the middle

  // Where neither sign has twice as many samples, that one wins which points away from the middle.
  bool for_turning() const {
    const bool undecided = kept < 2 * uint64_t{turned} && turned < 2 * uint64_t{kept};
    return undecided ? out < 0.0 : kept < turned;
  }
};

// Normals of components whose curves agree, and what their samples say.
struct Election {
  Wires* wires;
  Span<uint8_t> turned;
  Array<uint32_t> curve;  // of each sample
  SignedSets sets;        // of curves
  Array<Vote> votes;      // of the first curve of each set

  Election(Wires* of, Span<uint8_t> before)
      : wires(of),
        turned(before),
        curve(of->position.context()),
        sets(of->position.context()),
        votes(of->position.context()) {}

  Vote& vote_of(uint32_t i, bool* opposite) { return votes[sets.find(curve[i], opposite)]; }
  bool decides(uint32_t i) const { return is_known(wires->normal[i]) && !wires->sharp[curve[i]]; }
  void turn(uint32_t i) {
    wires->normal[i] = -wires->normal[i];
    turned[i] ^= 1;
  }
};

}  // namespace

// Gives all normals of a component the sign of its first curve, and counts what becomes of them.
static Status count_votes(Election* e) {
  Context& context = e->curve.context();
  const Wires& wires = *e->wires;
  TRY(in_parts(context, wires.samples(), [&](size_t s) {
    const uint32_t i = static_cast<uint32_t>(s);
    bool opposite = false;
    Vote& vote = e->vote_of(i, &opposite);
    vote.sum += wires.position[i];
    ++vote.samples;
    if (!e->decides(i)) return;
    if (opposite) e->turn(i);
    ++(e->turned[i] ? vote.turned : vote.kept);
  }));
  return in_parts(context, wires.samples(), [&](size_t s) {
    const uint32_t i = static_cast<uint32_t>(s);
    bool opposite = false;
    Vote& vote = e->vote_of(i, &opposite);
    if (wires.sharp[e->curve[i]]) return;
    vote.out += dot(wires.position[i] - (1.0 / vote.samples) * vote.sum, wires.normal[i]);
  });
}

Status orient_across(Wires* wires, Span<uint8_t> turned, Array<Contradiction>* contradictions) {
  Election election(wires, turned);
  TRY(curve_of_samples(*wires, &election.curve));
  TRY(election.sets.reset(wires->curves()));
  TRY(assign_in_parts(wires->curves(), Vote{}, &election.votes));
  TRY(relate_curves(*wires, election.curve.span(), &election.sets, contradictions));
  TRY(count_votes(&election));
  return in_parts(election.curve.context(), wires->samples(), [&](size_t s) {
    const uint32_t i = static_cast<uint32_t>(s);
    bool opposite = false;
    const Vote& vote = election.vote_of(i, &opposite);
    if (election.decides(i) && vote.for_turning()) election.turn(i);
  });
}

}  // namespace wireskin::network
