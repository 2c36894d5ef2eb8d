#include "network/write_beads.h"

#include "base/in_parts.h"
#include "network/bend.h"

namespace wireskin::network {

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
  Pace pace(beads.context());
  for (uint32_t c = 0; c < beads.wires.curves(); ++c) {
    arc.clear(), order.clear(), pins.clear(), shift.clear();
    double length = 0.0;
    bool moves = false;
    for (uint32_t b = beads.wires.start[c]; b != k_none; b = beads.bead[b].next) {
      if (b == beads.wires.start[c] && !order.empty()) break;
      TRY(pace.after());
      order.push_reserved(b);
      arc.push_reserved(length);
      pins.push_reserved(pinned[b]);
      shift.push_reserved(displacement[b]);
      moves = moves || displacement[b] != Vec3{};
      length += beads.bead[b].to_next;
    }
    if (!moves) continue;
    TRY(bend_curve({arc.span(), length, beads.wires.closed[c] != 0, pins.span(), shift.span()},
                   &pace));
    TRY(in_parts(beads.context(), order.size(),
                 [&](size_t k) { displacement[order[k]] = shift[k]; }));
  }
  return {};
}

static Vec3 normal_between(const Vec3& a, const Vec3& b, double part) {
  const double sum = dot(a, a) * dot(b, b);
  return sum > 0.0 ? unit((1.0 - part) * a + part * b) : Vec3{};
}

// The beads of a curve without those on a short way from a new node back to itself.
static Status list_beads(uint32_t c, double detour, Beads* beads, Pace* pace,
                         Array<uint32_t>* order, Array<double>* arc) {
  order->clear(), arc->clear();
  double length = 0.0;
  const auto take_back = [&](uint32_t root, double from) {
    for (size_t k = order->size(); k-- > 0 && from - (*arc)[k] <= detour;) {
      pace->add(1);
      if (beads->sets.find((*order)[k]) != root) continue;
      order->shrink(k + 1), arc->shrink(k + 1);
      return true;
    }
    return false;
  };
  for (uint32_t b = beads->wires.start[c]; b != k_none; b = beads->bead[b].next) {
    if (b == beads->wires.start[c] && !order->empty()) break;
    TRY(pace->after());
    if (!beads->touched[beads->sets.find(b)] || !take_back(beads->sets.find(b), length)) {
      order->push_reserved(b), arc->push_reserved(length);
    }
    length += beads->bead[b].to_next;
  }
  const uint32_t first = (*order)[0];
  if (beads->wires.closed[c] && beads->touched[beads->sets.find(first)] && order->size() > 1) {
    if (take_back(beads->sets.find(first), length) && order->size() > 1) order->pop();
  }
  if (order->size() >= (beads->wires.closed[c] ? 3 : 2)) return {};
  order->clear();  // nothing would be left
  for (uint32_t b = beads->wires.start[c]; b != k_none; b = beads->bead[b].next) {
    if (b == beads->wires.start[c] && !order->empty()) break;
    TRY(pace->after());
    order->push_reserved(b);
  }
  return {};
}

// Where every bead comes to lie.
struct BeadMoves {
  Array<Vec3> target, displacement;
  Array<uint8_t> pinned;  // at a point of several beads

  explicit BeadMoves(Context& context) : target(context), displacement(context), pinned(context) {}
};

static Status find_moves(Beads* beads, BeadMoves* moves) {
  Array<uint32_t> seen(beads->context());
  const uint32_t n = static_cast<uint32_t>(beads->bead.size());
  TRY(assign_in_parts(n, Vec3{}, &moves->displacement));
  TRY(moves->target.resize(n));
  TRY(assign_in_parts(n, 0, &moves->pinned));
  TRY(assign_in_parts(beads->wires.points + size_t{n}, k_none, &seen));
  TRY(in_parts(beads->context(), n, [&](size_t i) {
    const uint32_t b = static_cast<uint32_t>(i);
    const Bead& bead = beads->bead[b];
    const uint32_t root = beads->sets.find(b);
    moves->target[b] = bead.position;
    moves->pinned[b] = bead.ring != b;
    if (!beads->touched[root]) return;
    moves->target[b] = root == b ? target_of(*beads, root, seen.span(), root) : moves->target[root];
    moves->displacement[b] = moves->target[b] - bead.position;
  }));
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

Status write_beads(double detour, Beads* beads, Wires* out) {
  const Wires& wires = beads->wires;
  const uint32_t n = static_cast<uint32_t>(beads->bead.size());
  BeadMoves moves(beads->context());
  Array<uint32_t> name(beads->context()), order(beads->context());
  Array<double> arc(beads->context());
  TRY(assign_in_parts(n, k_none, &name));
  TRY(order.reserve(n));
  TRY(arc.reserve(n));
  TRY(find_moves(beads, &moves));
  TRY(reserve_wires(wires.curves(), n, !wires.right.empty(), out));
  out->start.push_reserved(0);
  out->points = 0;
  Pace pace(beads->context());
  for (uint32_t c = 0; c < wires.curves(); ++c) {
    TRY(list_beads(c, detour, beads, &pace, &order, &arc));
    for (const uint32_t b : order) {
      TRY(pace.after());
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
