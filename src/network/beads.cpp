#include "network/beads.h"

#include "network/bend.h"

namespace wireskin::network {

Status Beads::string_samples(size_t joints) {
  const uint32_t n = wires.samples();
  const size_t room = n + 2 * joints;
  if (room >= k_none) return fail(Code::too_large, "too many near places for 32-bit indices");
  TRY(bead.reserve(room));
  TRY(touched.assign(room, 0));
  TRY(sets.reset(static_cast<uint32_t>(room)));
  PointMembers members(context());
  TRY(list_members(wires, &members));
  for (uint32_t i = 0; i < n; ++i) {
    Bead sample;
    sample.position = wires.position[i];
    sample.edge = i;
    sample.next = wires.next(curve[i], i);
    sample.previous = wires.previous(curve[i], i);
    if (sample.next != k_none) sample.to_next = edge_length(i);
    sample.given = wires.point[i];
    bead.push_reserved(sample);
  }
  for (uint32_t p = 0; p < wires.points; ++p) {
    const Span<const uint32_t> own = members[p];
    for (size_t k = 0; k < own.size(); ++k) {
      bead[own[k]].ring = own[(k + 1) % own.size()];
      bead[own[k]].joined = own.size() > 1;
      sets.unite(own[0], own[k]);
      // Samples of one number that the caller gave at different places meet.
      if (length(wires.position[own[k]] - wires.position[own[0]]) > 1e-9) touched[own[0]] = 1;
    }
  }
  return {};
}

Origin Beads::origin_of(const WirePlace& place) const {
  if (place.part == 0.0) return wires.origin[place.edge];
  const EdgeOrigin& along = wires.along[place.edge];
  return {along.curve, along.sample, along.backwards ? 1.0 - place.part : place.part};
}

BeadPlace Beads::locate(const WirePlace& place) const {
  uint32_t b = place.edge;
  if (place.part == 0.0) return {b, 0.0};
  while (bead[bead[b].next].part != 0.0 && bead[bead[b].next].part <= place.part) {
    b = bead[b].next;
  }
  return {b, (place.part - bead[b].part) * edge_length(place.edge)};
}

uint32_t Beads::special_near(const BeadPlace& place, double reach) const {
  const auto special = [this](uint32_t b) { return bead[b].ring != b || is_end(b); };
  uint32_t found = k_none;
  double away = place.behind, least = reach;
  for (uint32_t b = place.bead; b != k_none && away <= least;) {
    if (special(b)) {
      found = b;
      least = away;
      break;
    }
    b = bead[b].previous;
    if (b != k_none) away += bead[b].to_next;
    if (b == place.bead) break;
  }
  away = bead[place.bead].to_next - place.behind;
  for (uint32_t b = bead[place.bead].next; b != k_none && away < least; b = bead[b].next) {
    if (special(b)) return b;
    away += bead[b].to_next;
    if (b == place.bead) break;
  }
  return found;
}

WirePlace Beads::nearest_place(const WirePlace& near, const Vec3& target, double reach) const {
  const uint32_t c = curve[near.edge];
  WirePlace best = near;
  double least = length(point_at(near) - target);
  const auto consider = [&](uint32_t i) {
    const WirePlace place = nearest_on_edge(wires, c, i, target);
    const double distance = length(point_at(place) - target);
    if (distance < least) {
      least = distance;
      best = place;
    }
  };
  double away = 0.0;
  uint32_t steps = 0;
  for (uint32_t i = near.edge; wires.next(c, i) != k_none && away <= reach;) {
    consider(i);
    if (i != near.edge) away += edge_length(i);
    i = wires.next(c, i);
    if (++steps == wires.size(c)) return best;
  }
  away = 0.0;
  for (uint32_t i = near.edge; wires.previous(c, i) != k_none && away <= reach;) {
    i = wires.previous(c, i);
    consider(i);
    away += edge_length(i);
    if (++steps >= 2 * wires.size(c)) return best;
  }
  return best;
}

uint32_t Beads::make_bead(const WirePlace& place) {
  const BeadPlace at = locate(place);
  constexpr double k_same = 1e-3;  // of the edge: nearer than this a sample serves
  const Bead& before = bead[at.bead];
  if (at.behind <= k_same * before.to_next) return at.bead;
  if (before.to_next - at.behind <= k_same * before.to_next) return before.next;
  Bead fresh;
  fresh.position = point_at(place);
  fresh.part = place.part;
  fresh.edge = place.edge;
  fresh.previous = at.bead;
  fresh.next = before.next;
  fresh.to_next = before.to_next - at.behind;
  const uint32_t index = static_cast<uint32_t>(bead.size());
  fresh.ring = index;
  fresh.given = wires.points + (index - wires.samples());
  bead[at.bead].next = index;
  bead[at.bead].to_next = at.behind;
  bead[fresh.next].previous = index;
  bead.push_reserved(fresh);
  return index;
}

void Beads::unite(uint32_t x, uint32_t z) {
  sets.unite(x, z);
  const uint32_t kept = bead[x].ring;
  bead[x].ring = bead[z].ring;
  bead[z].ring = kept;
  touched[sets.find(x)] = 1;
}

// ---- Curves again -------------------------------------------------------------------------------

// Where the beads of a point meet: the mean of the places of those of its former points that rank
// highest, each counted once.
static Vec3 target_of(const Beads& beads, uint32_t root, Span<uint32_t> seen, uint32_t mark) {
  const auto rank = [&beads](uint32_t b) {
    return beads.bead[b].joined ? 2 : beads.is_end(b) ? 0 : 1;
  };
  int highest = 0;
  uint32_t b = root;
  do {
    highest = rank(b) > highest ? rank(b) : highest;
    b = beads.bead[b].ring;
  } while (b != root);
  Vec3 sum, first;
  uint32_t count = 0;
  do {
    if (rank(b) == highest && seen[beads.bead[b].given] != mark) {
      seen[beads.bead[b].given] = mark;
      if (count == 0) first = beads.bead[b].position;
      sum += beads.bead[b].position;
      ++count;
    }
    b = beads.bead[b].ring;
  } while (b != root);
  return count == 1 ? first : (1.0 / count) * sum;
}

static Status bend_beads(const Beads& beads, Span<Vec3> displacement, Span<uint8_t> pinned) {
  Array<double> arc(beads.context());
  Array<uint32_t> order(beads.context());
  Array<uint8_t> pins(beads.context());
  Array<Vec3> shift(beads.context());
  TRY(arc.reserve(beads.bead.size()));
  TRY(order.reserve(beads.bead.size()));
  TRY(pins.reserve(beads.bead.size()));
  TRY(shift.reserve(beads.bead.size()));
  for (uint32_t c = 0; c < beads.wires.curves(); ++c) {
    arc.clear(), order.clear(), pins.clear(), shift.clear();
    double length = 0.0;
    bool moves = false;
    for (uint32_t b = beads.wires.start[c]; b != k_none; b = beads.bead[b].next) {
      if (b == beads.wires.start[c] && !order.empty()) break;
      order.push_reserved(b);
      arc.push_reserved(length);
      pins.push_reserved(pinned[b]);
      shift.push_reserved(displacement[b]);
      moves = moves || displacement[b] != Vec3{};
      length += beads.bead[b].to_next;
    }
    if (!moves) continue;
    bend_curve({arc.span(), length, beads.wires.closed[c] != 0, pins.span(), shift.span()});
    for (size_t k = 0; k < order.size(); ++k) displacement[order[k]] = shift[k];
  }
  return {};
}

static Vec3 normal_between(const Vec3& a, const Vec3& b, double part) {
  const double sum = dot(a, a) * dot(b, b);
  return sum > 0.0 ? unit((1.0 - part) * a + part * b) : Vec3{};
}

// Where every bead comes to lie.
struct BeadMoves {
  Array<Vec3> target, displacement;
  Array<uint8_t> pinned;  // at a point of several beads

  explicit BeadMoves(Context& context) : target(context), displacement(context), pinned(context) {}
};

// All points that were united come to their place; samples between them follow.
static Status find_moves(Beads* beads, BeadMoves* moves) {
  Array<uint32_t> seen(beads->context());
  const uint32_t n = static_cast<uint32_t>(beads->bead.size());
  TRY(moves->displacement.assign(n, Vec3{}));
  TRY(moves->target.resize(n));
  TRY(moves->pinned.assign(n, 0));
  TRY(seen.assign(beads->wires.points + size_t{n}, k_none));
  for (uint32_t b = 0; b < n; ++b) {
    const Bead& bead = beads->bead[b];
    const uint32_t root = beads->sets.find(b);
    moves->target[b] = bead.position;
    moves->pinned[b] = bead.ring != b;
    if (!beads->touched[root]) continue;
    moves->target[b] = root == b ? target_of(*beads, root, seen.span(), root) : moves->target[root];
    moves->displacement[b] = moves->target[b] - bead.position;
  }
  return bend_beads(*beads, moves->displacement.span(), moves->pinned.span());
}

static void write_bead(const Beads& beads, uint32_t b, const BeadMoves& moves, Wires* out) {
  const Bead& bead = beads.bead[b];
  const Wires& wires = beads.wires;
  const uint32_t i = bead.edge;
  const bool moved = moves.displacement[b] != Vec3{};
  out->position.push_reserved(moves.pinned[b] ? moves.target[b]
                              : moved         ? bead.position + moves.displacement[b]
                                              : bead.position);
  const bool given = bead.part == 0.0;
  const uint32_t j = given ? i : wires.next(beads.curve[i], i);
  out->number.push_reserved(given ? wires.number[i] : k_none);
  out->origin.push_reserved(given ? wires.origin[i] : beads.origin_of({i, bead.part}));
  const Span<const Vec3> normal = wires.normal.span(), right = wires.right.span();
  out->normal.push_reserved(given ? normal[i] : normal_between(normal[i], normal[j], bead.part));
  if (right.empty()) return;
  out->right.push_reserved(given ? right[i] : normal_between(right[i], right[j], bead.part));
}

Status write_beads(Beads* beads, Wires* out) {
  const Wires& wires = beads->wires;
  const uint32_t n = static_cast<uint32_t>(beads->bead.size());
  BeadMoves moves(beads->context());
  Array<uint32_t> name(beads->context());
  TRY(name.assign(n, k_none));
  TRY(find_moves(beads, &moves));
  TRY(reserve_wires(wires.curves(), n, !wires.right.empty(), out));
  out->start.push_reserved(0);
  out->points = 0;
  for (uint32_t c = 0; c < wires.curves(); ++c) {
    for (uint32_t b = wires.start[c]; b != k_none; b = beads->bead[b].next) {
      if (b == wires.start[c] && out->samples() > out->start[c]) break;
      const uint32_t root = beads->sets.find(b);
      if (name[root] == k_none) name[root] = out->points++;
      out->point.push_reserved(name[root]);
      write_bead(*beads, b, moves, out);
    }
    out->closed.push_reserved(wires.closed[c]);
    out->boundary.push_reserved(wires.boundary[c]);
    out->sharp.push_reserved(wires.sharp[c]);
    out->soft.push_reserved(wires.soft[c]);
    out->start.push_reserved(out->samples());
  }
  return {};
}

}  // namespace wireskin::network
