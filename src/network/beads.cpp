#include "network/beads.h"

#include "base/in_parts.h"

namespace wireskin::network {

Status Beads::string_samples(size_t joints) {
  const uint32_t n = wires.samples();
  const size_t room = n + 2 * joints;
  if (room >= k_none) return fail(Code::too_large, "too many near places for 32-bit indices");
  TRY(bead.reserve(room));
  TRY(assign_in_parts(room, 0, &touched));
  TRY(sets.reset(static_cast<uint32_t>(room)));
  PointMembers members(context());
  TRY(list_members(wires, &members));
  TRY(in_parts(context(), n, [&](size_t s) {
    const uint32_t i = static_cast<uint32_t>(s);
    Bead sample;
    sample.position = wires.position[i];
    sample.edge = i;
    sample.next = wires.next(curve[i], i);
    sample.previous = wires.previous(curve[i], i);
    if (sample.next != k_none) sample.to_next = edge_length(i);
    sample.given = wires.point[i];
    bead.push_reserved(sample);
  }));
  Pace pace(context());
  for (uint32_t p = 0; p < wires.points; ++p) {
    const Span<const uint32_t> own = members[p];
    TRY(pace.after(own.size()));
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

Vec3 Beads::direction_at(const WirePlace& place) const {
  constexpr double k_step = 1.0 / 16.0;
  const uint32_t c = curve[place.edge], before = wires.previous(c, place.edge);
  if (wires.next(c, place.edge) == k_none) {
    if (before == k_none) return {};  // a point leads nowhere
    return wires.position[place.edge] - point_of_place(wires, c, {before, 1.0 - k_step});
  }
  const double step = place.part + k_step < 1.0 ? k_step : -k_step;
  const Vec3 there = point_of_place(wires, c, {place.edge, place.part + step});
  return (1.0 / step) * (there - point_at(place));
}

Vec3 Beads::normal_at(const WirePlace& place) const {
  const uint32_t next = wires.next(curve[place.edge], place.edge);
  const Vec3& own = wires.normal[place.edge];
  if (place.part == 0.0 || next == k_none) return own;
  return (1.0 - place.part) * own + place.part * wires.normal[next];
}

Origin Beads::origin_of(const WirePlace& place) const {
  if (place.part == 0.0) return wires.origin[place.edge];
  const EdgeOrigin& along = wires.along[place.edge];
  return {along.curve, along.sample, along.backwards ? 1.0 - place.part : place.part};
}

BeadPlace Beads::locate(const WirePlace& place) const {
  if (place.part == 0.0) return {place.edge, 0.0};
  uint32_t found = place.edge;
  for (uint32_t b = bead[found].upper; b != k_none;) {
    const bool beyond = bead[b].part > place.part;
    if (!beyond) found = b;
    b = beyond ? bead[b].lower : bead[b].upper;
  }
  return {found, (place.part - bead[found].part) * edge_length(place.edge)};
}

uint32_t Beads::special_near(const BeadPlace& place, double to_end, double to_node) const {
  const auto special = [&](uint32_t b, double away) {
    return bead[b].ring != b ? away <= to_node : is_end(b);
  };
  uint32_t found = k_none;
  double away = place.behind, least = to_end;
  for (uint32_t b = place.bead; b != k_none && away <= least;) {
    if (special(b, away)) {
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
    if (special(b, away)) return b;
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

// A bead's rank in the tree, drawn by lot, so that the tree is shallow in any order of the beads
// that was not made for these ranks: the mixing of S. Vigna's splitmix64 (2015), which gives no rank
// twice.
static uint64_t lot(uint32_t b) {
  uint64_t z = (b + 1ull) * 0x9e3779b97f4a7c15ull;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
  return z ^ (z >> 31);
}

void Beads::plant(uint32_t b) {
  const double part = bead[b].part;
  uint32_t* place = &bead[bead[b].edge].upper;
  while (*place != k_none && lot(*place) > lot(b)) {
    place = bead[*place].part < part ? &bead[*place].upper : &bead[*place].lower;
  }
  uint32_t rest = *place;
  *place = b;
  // What was there is parted into what is less and what is more.
  uint32_t *less = &bead[b].lower, *more = &bead[b].upper;
  while (rest != k_none) {
    uint32_t*& end = bead[rest].part < part ? less : more;
    *end = rest;
    end = bead[rest].part < part ? &bead[rest].upper : &bead[rest].lower;
    rest = *end;
  }
  *less = *more = k_none;
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
  plant(index);
  return index;
}

void Beads::unite(uint32_t a, uint32_t b) {
  if (!sets.unite(a, b)) return;
  const uint32_t kept = bead[a].ring;
  bead[a].ring = bead[b].ring;
  bead[b].ring = kept;
  touched[sets.find(a)] = 1;
}

Status Beads::unite_close(double reach) {
  Pace pace(context());
  for (uint32_t c = 0; c < wires.curves(); ++c) {
    const uint32_t first = wires.start[c];
    uint32_t last = k_none, b = first;
    double away = 0.0;
    do {
      TRY(pace.after());
      if (bead[b].ring != b) {
        const bool near = last != k_none && away <= reach;
        if (near && (touched[sets.find(last)] || touched[sets.find(b)])) unite(last, b);
        last = b;
        away = 0.0;
      }
      away += bead[b].to_next;
      b = bead[b].next;
    } while (b != k_none && b != first);
  }
  return {};
}

}  // namespace wireskin::network
