#include "flow/chains.h"

#include "base/in_parts.h"
#include "base/sort_in_parts.h"

namespace wireskin::flow {

// End 2 a is the begin of arc a, 2 a + 1 its end.
static uint32_t vertex_at_end(const Arcs& arcs, uint32_t end) {
  const uint32_t a = end / 2;
  return arcs.path[end % 2 == 0 ? arcs.start[a] : arcs.start[a + 1] - 1];
}

static uint32_t curve_at_end(const Arcs& arcs, uint32_t end) {
  const uint32_t a = end / 2;
  return arcs.curve[end % 2 == 0 ? arcs.start[a] : arcs.start[a + 1] - 2];
}

// From the end into its arc.
static Vec3 direction_at_end(const Arcs& arcs, uint32_t end) {
  const uint32_t a = end / 2;
  const uint32_t next = arcs.path[end % 2 == 0 ? arcs.start[a] + 1 : arcs.start[a + 1] - 2];
  return unit(arcs.vertex[next] - arcs.vertex[vertex_at_end(arcs, end)]);
}

// The ends of arcs at node v are end[start[v]] .. end[start[v + 1] - 1].
static Status gather_ends(const Arcs& arcs, Array<uint32_t>* start, Array<uint32_t>* ends) {
  const uint32_t n = static_cast<uint32_t>(arcs.vertex.size());
  TRY(start->assign(size_t{n} + 1, 0));
  TRY(ends->resize(2 * size_t{arcs.size()}));
  for (uint32_t end = 0; end < ends->size(); ++end) ++(*start)[vertex_at_end(arcs, end)];
  starts_from_counts(start->span());
  for (uint32_t end = 0; end < ends->size(); ++end) {
    (*ends)[(*start)[vertex_at_end(arcs, end)]++] = end;
  }
  shift_starts_back(start->span());
  return {};
}

// At a junction: of the ends of one curve the straightest pair first. The ends are of one curve.
static void pair_straightest(const Arcs& arcs, Span<const uint32_t> ends, Span<uint32_t> partner) {
  constexpr size_t k_most = 8;  // a curve that passes a point more often is not followed
  constexpr double k_least_cosine = 0.5;
  if (ends.size() > k_most) return;
  while (true) {
    uint32_t best[2] = {k_none, k_none};
    double straightest = k_least_cosine;
    for (size_t i = 0; i < ends.size(); ++i) {
      for (size_t k = i + 1; k < ends.size(); ++k) {
        if (partner[ends[i]] != k_none || partner[ends[k]] != k_none) continue;
        const double cosine =
            -dot(direction_at_end(arcs, ends[i]), direction_at_end(arcs, ends[k]));
        if (!(cosine > straightest)) continue;
        straightest = cosine;
        best[0] = ends[i], best[1] = ends[k];
      }
    }
    if (best[0] == k_none) return;
    partner[best[0]] = best[1];
    partner[best[1]] = best[0];
  }
}

static Status pair_ends(const Arcs& arcs, Array<uint32_t>* partner) {
  Array<uint32_t> start(partner->context()), ends(partner->context());
  TRY(gather_ends(arcs, &start, &ends));
  TRY(partner->assign(ends.size(), k_none));
  for (uint32_t v = 0; v < arcs.vertex.size(); ++v) {
    const Span<uint32_t> here = ends.span().part(start[v], start[v + 1] - start[v]);
    if (arcs.is_node[v] == 0) continue;
    if (here.size() == 2) {
      (*partner)[here[0]] = here[1];
      (*partner)[here[1]] = here[0];
      continue;
    }
    sort(here, [&](uint32_t a, uint32_t b) {
      const uint32_t c = curve_at_end(arcs, a), d = curve_at_end(arcs, b);
      return c != d ? c < d : a < b;
    });
    for (size_t i = 0, first = 0; i < here.size(); ++i) {
      const bool last = i + 1 == here.size();
      if (!last && curve_at_end(arcs, here[i + 1]) == curve_at_end(arcs, here[first])) continue;
      pair_straightest(arcs, here.part(first, i + 1 - first), partner->span());
      first = i + 1;
    }
  }
  return {};
}

// Follows a chain from one end of an arc on, until nothing goes on or it is back.
static void trace_chain(const Arcs& arcs, Span<const uint32_t> partner, uint32_t end,
                        Span<uint8_t> used, Chains* chains) {
  const uint32_t first = end;
  bool closed = false;
  while (true) {
    const uint32_t a = end / 2, count = arcs.start[a + 1] - arcs.start[a];
    used[a] = 1;
    chains->arc_place[a] = static_cast<uint32_t>(chains->vertex.size());
    chains->arc_backward[a] = end % 2;
    for (uint32_t i = 0; i + 1 < count; ++i) {
      const uint32_t at = end % 2 == 0 ? arcs.start[a] + i : arcs.start[a + 1] - 1 - i;
      chains->vertex.push_reserved(arcs.path[at]);
    }
    closed = arcs.closed[a] != 0 || partner[end ^ 1u] == first;
    const uint32_t next = partner[end ^ 1u];
    if (!closed && next == k_none) chains->vertex.push_reserved(vertex_at_end(arcs, end ^ 1u));
    if (closed || next == k_none) break;
    end = next;
  }
  chains->closed.push_reserved(closed);
  chains->start.push_reserved(static_cast<uint32_t>(chains->vertex.size()));
}

static Status trace_chains(const Arcs& arcs, Chains* chains) {
  Array<uint32_t> partner(chains->vertex.context());
  Array<uint8_t> used(chains->vertex.context());
  TRY(pair_ends(arcs, &partner));
  TRY(used.assign(arcs.size(), 0));
  TRY(chains->start.reserve(size_t{arcs.size()} + 1));
  TRY(chains->closed.reserve(arcs.size()));
  TRY(chains->vertex.reserve(arcs.path.size()));
  TRY(chains->arc_place.resize(arcs.size()));
  TRY(chains->arc_backward.resize(arcs.size()));
  chains->start.clear();
  chains->closed.clear();
  chains->vertex.clear();
  chains->start.push_reserved(0);
  // Chains that begin somewhere first; what is left after that goes round.
  for (int pass = 0; pass < 2; ++pass) {
    for (uint32_t end = 0; end < partner.size(); ++end) {
      if (used[end / 2] != 0 || (pass == 0 && partner[end] != k_none)) continue;
      if (pass == 0 && arcs.closed[end / 2] != 0) continue;
      trace_chain(arcs, partner.span(), end, used.span(), chains);
    }
  }
  return {};
}

namespace {

// How a chain turns at one of its places, seen from neighbours so many places away.
struct Bend {
  double turn = 0.0;  // length of the difference of the two directions
  double move = 0.0;  // how far a sample must have moved to make that of a straight line
};

struct Turn {
  uint32_t place;
  Bend narrow, wide;
  bool flat;  // it goes on in the plane in which it turns, or at a right angle to that

  double strength() const { return narrow.turn + wide.turn; }
};

}  // namespace

static constexpr double k_sharp = 0.60141159900854613;  // between unit directions 35 degrees apart
static constexpr uint32_t k_wide = 3;
static constexpr size_t k_steps_of_bend = 8;  // what looking at a place takes

// Nothing where the chain ends before that.
static Bend bend_at(const Arcs& arcs, const Chains& chains, uint32_t chain, uint32_t place,
                    uint32_t away) {
  const uint32_t first = chains.start[chain], count = chains.start[chain + 1] - first;
  const uint32_t i = place - first;
  const bool inside = i >= away && i + away < count;
  if (!inside && (chains.closed[chain] == 0 || count <= 2 * away)) return {};
  const Vec3& p = arcs.vertex[chains.vertex[place]];
  const Vec3 to = p - arcs.vertex[chains.vertex[first + (i + count - away) % count]];
  const Vec3 from = arcs.vertex[chains.vertex[first + (i + away) % count]] - p;
  const double g = 1.0 / length(to), h = 1.0 / length(from);
  const double turn = length(h * from - g * to);
  return {turn, turn / std::sqrt(g * g + h * h + (g + h) * (g + h))};
}

// Polygons that people draw lie in planes, or are made of right angles; noise does neither.
static bool is_flat(const Arcs& arcs, const Chains& chains, uint32_t chain, uint32_t place) {
  constexpr double k_planar = 0.02;
  const uint32_t first = chains.start[chain], count = chains.start[chain + 1] - first;
  const uint32_t i = place - first;
  if (chains.closed[chain] == 0 && (i == 0 || i + 2 >= count)) return true;
  const auto point = [&](uint32_t k) -> const Vec3& {
    return arcs.vertex[chains.vertex[first + k % count]];
  };
  const Vec3 across = cross(point(i) - point(i + count - 1), point(i + 1) - point(i));
  const Vec3 next = point(i + 2) - point(i + 1);
  const double part = std::fabs(dot(across, next)) / (length(across) * length(next));
  return !(part > k_planar && part < 1.0 - k_planar);
}

// Of the noise, as the quarter of the samples that moved least show it: where curves are polygons
// with a few samples on each side, those are not corners. Displacements by sigma along both
// transverse axes have the lower quartile .76 sigma.
static Status noise_of(Span<const Turn> turns, Array<double>* moves, double* sigma) {
  constexpr double k_quartile_of_rayleigh = 0.76;
  Context& context = moves->context();
  TRY(moves->resize(turns.size()));
  TRY(in_parts(context, turns.size(), [&](size_t i) { (*moves)[i] = turns[i].narrow.move; }));
  TRY(sort_in_parts(context, moves->span(), Ascending()));
  *sigma = (*moves)[turns.size() / 4] / k_quartile_of_rayleigh;
  return {};
}

// Of the places nearby none turns more.
static bool turns_most(Span<const Turn> turns, size_t i, bool closed) {
  const size_t n = turns.size();
  for (size_t away = 1; away < k_wide && away < n; ++away) {
    const bool before = closed || i >= away, after = closed || i + away < n;
    if (before && turns[(i + n - away) % n].strength() > turns[i].strength()) return false;
    if (after && turns[(i + away) % n].strength() > turns[i].strength()) return false;
  }
  return true;
}

// Noise hides a corner from its neighbours sooner than from samples farther away.
static Status mark_corners_of(double noise, bool closed, Span<const Turn> turns,
                              Array<double>* moves, Span<uint8_t> corner) {
  constexpr double k_contrast = 4.7;  // one in 50 000 samples moves by more
  constexpr size_t k_statistics = 16;
  if (turns.empty()) return {};
  size_t sharp = 0, flat = 0;
  double sigma = noise;
  TRY(in_parts(moves->context(), turns.size(), [&](size_t i) {
    sharp += turns[i].narrow.turn > k_sharp;
    flat += turns[i].flat;
  }));
  const bool in_space = turns.size() >= k_statistics && 5 * flat < turns.size();
  const bool polygon = !(noise > 0.0) && !in_space && 4 * sharp > 3 * turns.size();
  if (!(noise > 0.0)) TRY(noise_of(turns, moves, &sigma));
  return in_parts(moves->context(), turns.size(), [&](size_t i) {
    const Bend &narrow = turns[i].narrow, &wide = turns[i].wide;
    if (!(narrow.turn > k_sharp)) return;
    const bool alone =
        wide.turn > k_sharp && wide.move > k_contrast * sigma && turns_most(turns, i, closed);
    corner[turns[i].place] = polygon || alone || narrow.move > k_contrast * sigma;
  });
}

static Status mark_corners(Context& context, const Arcs& arcs, double noise, Chains* chains) {
  Array<Turn> turns(context);
  Array<double> moves(context);
  Pace pace(context);
  TRY(turns.reserve(chains->vertex.size()));
  TRY(assign_in_parts(chains->vertex.size(), 0, &chains->corner));
  for (uint32_t c = 0; c < chains->size(); ++c) {
    const bool closed = chains->closed[c] != 0;
    turns.clear();
    for (uint32_t i = chains->start[c]; i < chains->start[c + 1]; ++i) {
      TRY(pace.after(k_steps_of_bend));
      const bool end = i == chains->start[c] || i + 1 == chains->start[c + 1];
      if (!closed && end) continue;
      turns.push_reserved({i, bend_at(arcs, *chains, c, i, 1), bend_at(arcs, *chains, c, i, k_wide),
                           is_flat(arcs, *chains, c, i)});
    }
    TRY(mark_corners_of(noise, closed, turns.span(), &moves, chains->corner.span()));
    TRY(pace.after());
  }
  return {};
}

Status find_chains(Context& context, const Arcs& arcs, double noise, Chains* chains) {
  TRY(trace_chains(arcs, chains));
  return mark_corners(context, arcs, noise, chains);
}

}  // namespace wireskin::flow
