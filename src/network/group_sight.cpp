#include "network/group_sight.h"

#include "base/sort.h"
#include "network/sight.h"
#include "num/minmax.h"
#include "num/trig.h"

namespace wireskin::network {

// A disc inside a loop that asks has at least this curvature.
static constexpr double k_least_curvature = 2.5;
// What is seen by fewer of a loop's places, or at a lower mean cosine, is not asked for.
static constexpr double k_sight_share = 0.1, k_sight_cosine = 0.25;
// Of the evidence: against joining, for a short way, for the loop's curvature, for what is spared.
static constexpr double k_against = 0.45, k_for_way = 0.8, k_for_curvature = 0.5,
                        k_for_spared = 0.6;
// Less evidence than this may as well be none.
static constexpr double k_clear_evidence = 0.1;

namespace {

// What one loop sees of a group, summed over its places as shares of them.
struct Tally {
  uint32_t loop = k_none;  // the first one seen of the group
  double share = 0.0, cosine = 0.0, way = 0.0;
};

struct Match {
  uint32_t from, to;  // loops
  double evidence;
};

struct Lookout {
  Grouping* g;
  SightMap map;
  Array<double> cap;         // of each loop: the area of the cap over it, by its length
  Array<uint8_t> asks;       // of each loop
  Array<uint8_t> stale;      // of each loop that asks: it must look again
  Array<Sight> seen;         // of each place
  Array<uint32_t> first;     // of each patch: its first loop; the others follow
  Array<double> curvature;   // of each root
  Array<uint8_t> undecided;  // of each patch: a ring that may turn over yet
  Array<uint8_t> hidden;     // of each loop, zero between questions
  Array<uint32_t> covered;   // the loops hidden
  Array<Tally> tally;        // of each root, empty between questions
  Array<uint32_t> counted;   // the roots tallied
  Array<Match> match;        // of each loop: the best one

  Lookout(Context& context, Grouping* grouping)
      : g(grouping),
        map(context, grouping->corner),
        cap(context),
        asks(context),
        stale(context),
        seen(context),
        first(context),
        curvature(context),
        undecided(context),
        hidden(context),
        covered(context),
        tally(context),
        counted(context),
        match(context) {}
};

}  // namespace

// Whether a patch is a loop that looks for others.
static bool asks_for_others(const Grouping& g, uint32_t p, const Border& border) {
  return !g.network->ring[p] && g.is_alone(p) && !g.settled[p] && border.loops() == 1 &&
         curvature_inside(border, 0) >= k_least_curvature && knows_normals(border, 0);
}

// Most networks have no loop that asks, and need no places.
static Status find_any_that_asks(const Grouping& g, bool* any) {
  Border border(g.parent.context());
  *any = false;
  for (uint32_t p = 0; p < g.network->patches() && !*any; ++p) {
    TRY(border_of_patch(*g.network, g.vertices, p, &border));
    *any = asks_for_others(g, p, border);
    if (p % 64 == 63) TRY(border.vertex.context().checkpoint());
  }
  return {};
}

// Adds the loops of a patch, those of an undecided ring by both sides.
static Status add_patch(uint32_t p, Border* border, Lookout* out) {
  const Grouping& g = *out->g;
  TRY(border_of_patch(*g.network, g.vertices, p, border));
  double area = 0.0;
  const double cosine = closing_cosine(*border, &area), perimeter = border_length(*border);
  const bool asks = asks_for_others(g, p, *border);
  TRY(out->first.push(static_cast<uint32_t>(out->map.loop.size())));
  out->curvature[p] = -4.0 * k_pi * (border->loops() - 1);
  out->undecided[p] = g.network->ring[p] && g.is_alone(p) && border->loops() == 1;
  for (uint32_t l = 0; l < border->loops(); ++l) {
    for (int side = 0; side < 2; ++side) {
      if (out->undecided[p] ? false : side != g.reversed[p]) continue;
      TRY(add_sight_loop(*border, l, p, side != 0, &out->map));
      const SightLoop& loop = out->map.loop.back();
      const double least = larger(1.0 + (side == 0 ? cosine : -cosine), 1e-3);
      TRY(out->cap.push(8.0 * area / (least * least * least) / perimeter));
      TRY(out->asks.push(asks));
      if (side == g.reversed[p]) out->curvature[p] += loop.curvature;
    }
  }
  return {};
}

static Status take_loops(Lookout* out) {
  Grouping* g = out->g;
  const uint32_t patches = g->network->patches();
  Border border(g->parent.context());
  TRY(out->curvature.assign(patches, 0.0));
  TRY(out->undecided.assign(patches, 0));
  TRY(out->tally.assign(patches, Tally{}));
  for (uint32_t p = 0; p < patches; ++p) {
    TRY(add_patch(p, &border, out));
    if (p % 64 == 63) TRY(border.vertex.context().checkpoint());
  }
  TRY(out->first.push(static_cast<uint32_t>(out->map.loop.size())));
  for (uint32_t p = 0; p < patches; ++p) {
    const uint32_t r = g->root(p);
    if (r != p) out->curvature[r] += out->curvature[p] - 4.0 * k_pi;
  }
  const size_t loops = out->map.loop.size();
  TRY(out->hidden.assign(loops, 0));
  TRY(out->match.assign(loops, Match{k_none, k_none, 0.0}));
  TRY(out->stale.copy(out->asks.span()));
  return out->seen.assign(out->map.place.size(), Sight{});
}

// Hides the loops of all groups that meet the group of patch p at a vertex.
static Status hide_neighbours(uint32_t p, Lookout* out) {
  Grouping* g = out->g;
  uint32_t own = p;
  do {
    for (uint32_t v : g->corner[own]) {
      for (uint32_t q : g->at_corner[v]) {
        if (g->root(q) == g->root(p) || out->hidden[out->first[q]]) continue;
        uint32_t other = q;
        do {
          for (uint32_t l = out->first[other]; l < out->first[other + 1]; ++l) {
            out->hidden[l] = 1;
            TRY(out->covered.push(l));
          }
          other = g->next[other];
        } while (other != q);
      }
    }
    own = g->next[own];
  } while (own != p);
  return {};
}

static Status look_round(uint32_t l, Lookout* out) {
  const SightLoop& loop = out->map.loop[l];
  TRY(hide_neighbours(loop.patch, out));
  for (uint32_t i = loop.first; i < loop.first + loop.count; ++i) {
    out->seen[i] = look(&out->map, i, out->hidden.span());
  }
  for (uint32_t h : out->covered) out->hidden[h] = 0;
  out->covered.clear();
  return out->seen.context().checkpoint();
}

// The curvature of what lies inside a loop's group if that side of a ring is taken.
static double curvature_of(Lookout* out, uint32_t loop) {
  const SightLoop& l = out->map.loop[loop];
  return out->undecided[l.patch] ? l.curvature : out->curvature[out->g->root(l.patch)];
}

// The amount of curvature of the group alone; a ring takes the side with less.
static double least_curvature(Lookout* out, uint32_t loop) {
  const SightLoop& l = out->map.loop[loop];
  const double own = std::fabs(curvature_of(out, loop));
  if (!out->undecided[l.patch]) return own;
  return smaller(own, std::fabs(4.0 * k_pi - l.curvature));
}

static double evidence_for(Lookout* out, uint32_t from, const Tally& t) {
  const double cap = larger(out->cap[from], DBL_MIN);
  const double joint = std::fabs(curvature_of(out, from) + curvature_of(out, t.loop) - 4.0 * k_pi);
  const double spared = least_curvature(out, from) + least_curvature(out, t.loop) - joint;
  const double own = smaller(out->map.loop[from].curvature / (2.0 * k_pi), 1.0);
  return t.cosine + k_for_way / (1.0 + 0.5 * t.way / (t.share * cap)) + k_for_curvature * own +
         k_for_spared * spared / (4.0 * k_pi) - k_against;
}

// Sums up what loop l sees of each group; of an undecided ring by the side seen first. What rule 2
// has settled hides what lies behind it, but is not joined again.
static Status count_seen(uint32_t l, Lookout* out) {
  Grouping* g = out->g;
  const SightLoop& loop = out->map.loop[l];
  const uint32_t own = g->root(loop.patch);
  for (const Sight& s : out->seen.span().part(loop.first, loop.count)) {
    if (s.loop == k_none) continue;
    const SightLoop& other = out->map.loop[s.loop];
    const uint32_t r = g->root(other.patch);
    const bool turned_away = g->network->ring[other.patch] && !out->undecided[other.patch] &&
                             other.reversed != (g->reversed[other.patch] != 0);
    if (r == own || turned_away || g->settled[other.patch]) continue;
    Tally* t = &out->tally[r];
    if (t->loop == k_none) {
      t->loop = s.loop;
      TRY(out->counted.push(r));
    }
    if (out->undecided[r] && t->loop != s.loop) continue;
    t->share += 1.0 / loop.count;
    t->cosine += s.cosine / loop.count;
    t->way += s.way / loop.count;
  }
  return {};
}

// The group that loop l is to be joined with for the greatest evidence.
static Status find_match(uint32_t l, Lookout* out) {
  Match* best = &out->match[l];
  *best = {l, k_none, 0.0};
  TRY(count_seen(l, out));
  for (uint32_t r : out->counted) {
    const Tally t = out->tally[r];
    out->tally[r] = Tally{};
    if (t.share < k_sight_share || t.cosine < k_sight_cosine * t.share) continue;
    const double evidence = evidence_for(out, l, t);
    if (evidence > best->evidence) *best = {l, t.loop, evidence};
  }
  out->counted.clear();
  return {};
}

static void join_loops(const Match& match, Lookout* out) {
  Grouping* g = out->g;
  const double joint = curvature_of(out, match.from) + curvature_of(out, match.to) - 4.0 * k_pi;
  const uint32_t loops[2] = {match.from, match.to};
  for (uint32_t l : loops) {
    const SightLoop& loop = out->map.loop[l];
    if (out->undecided[loop.patch]) g->reversed[loop.patch] = loop.reversed;
    out->undecided[loop.patch] = 0;
    if (match.evidence < k_clear_evidence) g->ambiguous[loop.patch] = 1;
  }
  const uint32_t a = out->map.loop[match.from].patch, b = out->map.loop[match.to].patch;
  g->join(a, b);
  out->curvature[g->root(a)] = joint;
}

// Joins the best matches of groups that nothing was joined to in this round; `changed`: of each
// patch, whether its group was.
static Status join_matches(Lookout* out, Array<uint8_t>* changed, bool* any) {
  Grouping* g = out->g;
  Array<Match> order(changed->context());
  TRY(changed->assign(g->parent.size(), 0));
  for (const Match& m : out->match) {
    if (m.to != k_none) TRY(order.push(m));
  }
  sort(order.span(), [](const Match& x, const Match& y) {
    return x.evidence != y.evidence ? x.evidence > y.evidence : x.from < y.from;
  });
  *any = !order.empty();
  for (const Match& m : order) {
    const uint32_t a = g->root(out->map.loop[m.from].patch);
    const uint32_t b = g->root(out->map.loop[m.to].patch);
    if ((*changed)[a] || (*changed)[b]) continue;
    join_loops(m, out);
    (*changed)[a] = (*changed)[b] = 1;
  }
  return {};
}

// Loops look again whose own group was joined to another one, or that see one that was.
static void forget_changed(Span<const uint8_t> changed, Lookout* out) {
  Grouping* g = out->g;
  for (uint32_t l = 0; l < out->map.loop.size(); ++l) {
    if (!out->asks[l]) continue;
    const SightLoop& loop = out->map.loop[l];
    bool stale = changed[g->root(loop.patch)] != 0;
    for (const Sight& s : out->seen.span().part(loop.first, loop.count)) {
      stale = stale || (s.loop != k_none && changed[g->root(out->map.loop[s.loop].patch)]);
    }
    out->stale[l] = stale;
  }
}

Status join_in_sight(Grouping* g) {
  Context& context = g->parent.context();
  Lookout out(context, g);
  Array<uint8_t> changed(context);
  bool any = false;
  TRY(find_any_that_asks(*g, &any));
  if (!any) return {};
  TRY(take_loops(&out));
  TRY(build_sight_tree(&out.map));
  while (any) {
    for (uint32_t l = 0; l < out.map.loop.size(); ++l) {
      if (!out.stale[l]) continue;
      TRY(look_round(l, &out));
      TRY(find_match(l, &out));
    }
    TRY(join_matches(&out, &changed, &any));
    forget_changed(changed.span(), &out);
    TRY(context.checkpoint());
  }
  return {};
}

}  // namespace wireskin::network
