#include "network/group_rings.h"

#include "network/ring_pairs.h"
#include "num/minmax.h"

namespace wireskin::network {

// A lid whose normals point to its other side is large, not endless.
static constexpr double k_least_lid = 0.5;
// A ring of boundary curves whose normals agree less with its axis cannot be closed alone.
static constexpr double k_sideless = 0.02, k_no_lid = 1e3;
// Other curves within so many lengths of both loops may bound a patch with a ring: then the rules
// that follow tell, also for the rings that are as near to that one.
static constexpr double k_others_reach = 1.0;
// A side alone joins a band if so many of its places see it, at such a cosine in the mean, and not
// so much farther off than these see each other.
static constexpr double k_third_share = 0.5, k_third_cosine = 0.25, k_third_nearer = 1.2;

namespace {

// The border of a patch from afar.
struct RingOutline {
  Vec3 centre;
  double length;
  bool ring;  // a side of a closed curve that meets no other
};

struct Rings {
  Grouping* g;
  Array<RingOutline> outline;  // of each patch
  RingBands bands;
  Array<uint32_t> partner;  // of each side
  Array<uint8_t> doubtful;  // of each side: another choice is hardly worse

  Rings(Context& context, Grouping* grouping)
      : g(grouping), outline(context), bands(context), partner(context), doubtful(context) {}
};

}  // namespace

// ---- Sides --------------------------------------------------------------------------------------

// Most networks have no two closed curves apart from the rest.
static bool has_rings(const Grouping& g) {
  uint32_t first = k_none;
  for (uint32_t p = 0; p < g.parent.size(); ++p) {
    const uint32_t c = g.component[p];
    if (g.closed[c] == k_none || !g.is_alone(p)) continue;
    if (first != k_none && first != c) return true;
    first = c;
  }
  return false;
}

static Status take_outlines(Border* border, Rings* rings) {
  const Grouping& g = *rings->g;
  for (uint32_t p = 0; p < g.parent.size(); ++p) {
    TRY(border_of_patch(*g.network, g.vertices, p, border));
    Vec3 centre;
    for (const Vec3& x : border->position) centre += (1.0 / border->size()) * x;
    const bool ring =
        g.closed[g.component[p]] != k_none && border->loops() == 1 && knows_normals(*border, 0);
    TRY(rings->outline.push({centre, border_length(*border), ring}));
    if (p % 64 == 63) TRY(border->vertex.context().checkpoint());
  }
  return {};
}

// Rings near other curves are none of our business, nor are those near such ones.
static Status leave_rings_near_others(Rings* rings) {
  Array<uint32_t> others(rings->partner.context());
  for (uint32_t p = 0; p < rings->outline.size(); ++p) {
    if (!rings->outline[p].ring) TRY(others.push(p));
  }
  for (size_t i = 0; i < others.size(); ++i) {
    const RingOutline other = rings->outline[others[i]];
    for (uint32_t p = 0; p < rings->outline.size(); ++p) {
      RingOutline* own = &rings->outline[p];
      const double reach = k_others_reach * (own->length + other.length);
      if (!own->ring || !(length(own->centre - other.centre) < reach)) continue;
      own->ring = false;
      TRY(others.push(p));
    }
    TRY(others.context().checkpoint());
  }
  return {};
}

static double lid_area(double area, double cosine) {
  const double least = larger(1.0 + cosine, k_least_lid);
  return 8.0 * area / (least * least * least);
}

static Status add_sides_of_patch(uint32_t p, Border* border, Rings* rings) {
  const Grouping& g = *rings->g;
  TRY(border_of_patch(*g.network, g.vertices, p, border));
  double area = 0.0;
  RingSide side;
  side.patch = p;
  side.component = g.component[p];
  side.cosine = closing_cosine(*border, &area);
  if (!g.network->ring[p]) {
    side.lid = side.alone = lid_area(area, side.cosine);
    return add_ring_side(*border, side, &rings->bands);
  }
  const bool sideless = std::fabs(side.cosine) < k_sideless;
  const uint32_t own = static_cast<uint32_t>(rings->bands.side.size());
  side.cosine = std::fabs(side.cosine);
  side.lid = lid_area(area, side.cosine);
  side.alone = sideless ? k_no_lid * area : side.lid;
  for (uint32_t k = 0; k < 2; ++k) {
    side.reversed = k != 0;
    side.twin = own + 1 - k;
    TRY(add_ring_side(*border, side, &rings->bands));
  }
  return {};
}

// Tells the two sides of an untagged curve of each other.
static Status name_other_sides(Rings* rings) {
  Array<uint32_t> first(rings->partner.context());
  TRY(first.assign(rings->g->closed.size(), k_none));
  for (uint32_t s = 0; s < rings->bands.side.size(); ++s) {
    RingSide* side = &rings->bands.side[s];
    if (side->twin != k_none) continue;
    uint32_t* of_curve = &first[side->component];
    if (*of_curve != k_none) {
      side->other = *of_curve;
      rings->bands.side[*of_curve].other = s;
    }
    *of_curve = s;
  }
  return {};
}

static Status take_sides(Rings* rings) {
  const Grouping& g = *rings->g;
  Border border(rings->partner.context());
  TRY(take_outlines(&border, rings));
  TRY(leave_rings_near_others(rings));
  for (uint32_t p = 0; p < g.parent.size(); ++p) {
    if (rings->outline[p].ring && g.is_alone(p)) TRY(add_sides_of_patch(p, &border, rings));
    if (p % 64 == 63) TRY(border.vertex.context().checkpoint());
  }
  return name_other_sides(rings);
}

// ---- Groups -------------------------------------------------------------------------------------

static void choose_side(const RingSide& side, Grouping* g) {
  if (side.twin != k_none) g->reversed[side.patch] = side.reversed;
}

static void join_partners(Rings* rings) {
  Grouping* g = rings->g;
  for (uint32_t s = 0; s < rings->partner.size(); ++s) {
    const RingSide& side = rings->bands.side[s];
    const uint32_t other = rings->partner[s];
    if (rings->doubtful[s]) g->ambiguous[side.patch] = 1;
    if (other != k_none || side.twin == k_none) g->settled[side.patch] = 1;
    if (other == k_none || other < s) continue;
    choose_side(side, g);
    choose_side(rings->bands.side[other], g);
    g->join(side.patch, rings->bands.side[other].patch);
  }
}

// The way from a place to the nearest that it sees of a side.
static Sight look_at_side(const RingBands& bands, const SightPlace& from, uint32_t side) {
  Sight seen;
  for (uint32_t j = 0; j < k_ring_places; ++j) {
    const SightPlace& to = bands.place[side * k_ring_places + j];
    const double way = way_between(from, to);
    if (!(way > 0.0) || (seen.loop != k_none && way >= seen.way)) continue;
    seen = {side * k_ring_places + j, way, turn_between(from, to).out};
  }
  return seen;
}

// The cost of a side that joins a band, by what its places see of both loops, as far as those are
// no nearer to each other; negative where too few places see one.
static double cost_of_third(const Rings& rings, uint32_t s, uint32_t one) {
  const RingBands& bands = rings.bands;
  const uint32_t loops[2] = {one, rings.partner[one]};
  double sum = 0.0, cosine = 0.0, seen = 0.0;
  for (uint32_t i = 0; i < k_ring_places; ++i) {
    const SightPlace& from = bands.place[s * k_ring_places + i];
    Sight best;
    for (uint32_t k = 0; k < 2; ++k) {
      const Sight sight = look_at_side(bands, from, loops[k]);
      if (sight.loop == k_none || (best.loop != k_none && sight.way >= best.way)) continue;
      const Sight back = look_at_side(bands, bands.place[sight.loop], loops[1 - k]);
      if (back.loop == k_none || sight.way <= k_third_nearer * back.way) best = sight;
    }
    if (best.loop == k_none) continue;
    seen += 1.0;
    sum += best.way;
    cosine += best.cosine;
  }
  if (seen < k_third_share * k_ring_places || cosine < k_third_cosine * seen) return -1.0;
  return 0.5 * sum / seen * bands.side[s].length / band_weight(cosine / seen);
}

static bool has_partner(const Rings& rings, uint32_t s) {
  const uint32_t twin = rings.bands.side[s].twin;
  return rings.partner[s] != k_none || (twin != k_none && rings.partner[twin] != k_none);
}

// The band that each side alone would join for the least cost; `least` begins with that of staying
// alone.
static Status find_hosts(Rings* rings, Array<double>* least, Array<uint32_t>* host) {
  const uint32_t sides = static_cast<uint32_t>(rings->partner.size());
  TRY(least->resize(sides));
  TRY(host->assign(sides, k_none));
  for (uint32_t s = 0; s < sides; ++s) (*least)[s] = rings->bands.side[s].alone;
  for (const RingBand& band : rings->bands.band) {
    const uint32_t ends[2] = {band.a, band.b};
    for (uint32_t k = 0; k < 2; ++k) {
      const uint32_t s = ends[k], other = ends[1 - k];
      if (has_partner(*rings, s) || rings->partner[other] == k_none) continue;
      const double cost = cost_of_third(*rings, s, other);
      if (cost < 0.0 || !(cost < (*least)[s])) continue;
      (*least)[s] = cost;
      (*host)[s] = other;
    }
    TRY(least->context().checkpoint());
  }
  return {};
}

// Sides that are still alone join the band that they see best: legs a body, branches a trunk.
static Status join_thirds(Rings* rings) {
  Grouping* g = rings->g;
  Array<double> least(rings->partner.context());
  Array<uint32_t> host(rings->partner.context());
  TRY(find_hosts(rings, &least, &host));
  for (uint32_t s = 0; s < host.size(); ++s) {
    const RingSide& side = rings->bands.side[s];
    if (host[s] == k_none) continue;
    if (side.twin != k_none && host[side.twin] != k_none && least[side.twin] < least[s]) continue;
    const uint32_t patch = rings->bands.side[host[s]].patch;
    if (share_vertex(g, side.patch, patch)) continue;
    choose_side(side, g);
    g->settled[side.patch] = 1;
    g->join(side.patch, patch);
    if (side.twin != k_none) host[side.twin] = k_none;
  }
  return {};
}

Status join_rings(Grouping* g) {
  if (!has_rings(*g)) return {};
  Rings rings(g->parent.context(), g);
  TRY(take_sides(&rings));
  TRY(pair_sides(&rings.bands, &rings.partner, &rings.doubtful));
  join_partners(&rings);
  return join_thirds(&rings);
}

}  // namespace wireskin::network
