#include "network/group_facing.h"

#include "base/sort.h"
#include "network/facing.h"
#include "num/minmax.h"

namespace wireskin::network {

// Conormals must lead to the other loop with at least this cosine in the mean.
static constexpr double k_least_facing_cosine = 0.2;
// And with this one where both loops are of one component, neither of them being closed alone.
static constexpr double k_least_facing_in_component = 0.6;
// A ring whose normals agree less with its axis has no side of its own: closing it alone is no way.
static constexpr double k_unclear_side = 0.02;
// Choices whose areas differ by less than this part are equally good.
static constexpr double k_hardly_more = 1.1;

namespace {

struct Band {
  uint32_t a, b;
  double area;
};

}  // namespace

static Status list_facing(Grouping* g, Span<const uint8_t> decided, Array<Facing>* facing,
                          Array<Probe>* probes) {
  const Network& network = *g->network;
  Border border(g->parent.context());
  for (uint32_t p = 0; p < network.patches(); ++p) {
    if (g->root(p) != p || g->reversed[p] || g->settled[p] ||
        network.patch_start[p + 1] != network.patch_start[p] + 1)
      continue;
    TRY(border_of_patch(network, g->vertices, p, &border));
    double area = 0.0;
    const double cosine = closing_cosine(border, &area);
    TRY(add_facing(border, 0, p, false, cosine, area, facing, probes));
    if (network.ring[p] && !decided[p]) {
      // A ring alone takes the cheaper side.
      TRY(add_facing(border, 0, p, true, -cosine, area, facing, probes));
      Facing *one = &(*facing)[facing->size() - 2], *other = &facing->back();
      const bool unclear = std::fabs(cosine) < k_unclear_side;
      one->alone = other->alone = smaller(one->alone, other->alone);
      one->sideless = other->sideless = unclear;
    }
    TRY(border.vertex.context().checkpoint());
  }
  return {};
}

static Status list_bands(const Grouping& g, Span<const Facing> facing, Span<const Probe> probes,
                         Array<Band>* bands) {
  constexpr double k_far = 8.0;
  for (uint32_t i = 0; i < facing.size(); ++i) {
    const Facing& a = facing[i];
    for (uint32_t j = 0; a.needy && j < facing.size(); ++j) {
      const Facing& b = facing[j];
      const bool same = g.component[a.patch] == g.component[b.patch];
      if ((same && !b.needy) || a.patch == b.patch || (b.needy && j < i)) continue;
      const double least = same ? k_least_facing_in_component : k_least_facing_cosine;
      if (length(a.centre - b.centre) > k_far * (a.radius + b.radius)) continue;
      const double from_a = half_band(a, b, probes, least);
      if (from_a < 0.0) continue;
      const double from_b = half_band(b, a, probes, least);
      if (from_b < 0.0) continue;
      TRY(bands->push({i, j, from_a + from_b}));
    }
    TRY(bands->context().checkpoint());
  }
  sort(bands->span(), [](const Band& x, const Band& y) {
    if (x.area != y.area) return x.area < y.area;
    return x.a != y.a ? x.a < y.a : x.b < y.b;
  });
  return {};
}

namespace {

// How far rule 4 has come.
struct Pairing {
  Array<Facing> facing;
  Array<uint8_t> joined;   // facing
  Array<uint8_t> decided;  // patch: which side of a ring has the surface

  explicit Pairing(Context& context) : facing(context), joined(context), decided(context) {}
};

}  // namespace

// What closing the two loops by themselves would cost, as far as they are not joined yet.
static double cost_alone(const Pairing& pairing, const Band& band) {
  return (pairing.joined[band.a] ? 0.0 : pairing.facing[band.a].alone) +
         (pairing.joined[band.b] ? 0.0 : pairing.facing[band.b].alone);
}

static bool loops_may_join(Grouping* g, const Pairing& pairing, const Band& band) {
  const Facing &a = pairing.facing[band.a], &b = pairing.facing[band.b];
  const bool wrong_side = (pairing.decided[a.patch] && (g->reversed[a.patch] != 0) != a.reversed) ||
                          (pairing.decided[b.patch] && (g->reversed[b.patch] != 0) != b.reversed);
  const bool both_alone = !pairing.joined[band.a] && !pairing.joined[band.b];
  const bool no_other_way = both_alone && (a.sideless || b.sideless);
  if (!(no_other_way || band.area < cost_alone(pairing, band)) || wrong_side) return false;
  return !share_vertex(g, a.patch, b.patch);
}

// Whether closing the loops alone, or one of the bands that follow, which are larger, was hardly
// worse than the first band and contradicts it.
static bool is_ambiguous(Grouping* g, const Pairing& pairing, Span<const Band> bands) {
  const Band& band = bands[0];
  if (cost_alone(pairing, band) < k_hardly_more * band.area) return true;
  const uint32_t own[2] = {pairing.facing[band.a].patch, pairing.facing[band.b].patch};
  for (size_t i = 1; i < bands.size() && bands[i].area < k_hardly_more * band.area; ++i) {
    const Facing &a = pairing.facing[bands[i].a], &b = pairing.facing[bands[i].b];
    for (int k = 0; k < 2; ++k) {
      const bool reversed = pairing.facing[k == 0 ? band.a : band.b].reversed;
      // The same loop by its other side, or where it has one side only, with another loop.
      const bool by_a = a.patch == own[k] && (a.reversed != reversed || b.patch != own[1 - k]);
      const bool by_b = b.patch == own[k] && (b.reversed != reversed || a.patch != own[1 - k]);
      if ((by_a || by_b) && loops_may_join(g, pairing, bands[i])) return true;
    }
  }
  return false;
}

Status join_facing(Grouping* g) {
  Context& context = g->parent.context();
  Pairing pairing(context);
  Array<Probe> probes(context);
  Array<Band> bands(context);
  Array<uint8_t>&joined = pairing.joined, &decided = pairing.decided;
  TRY(decided.assign(g->parent.size(), 0));
  for (uint32_t p = 0; p < decided.size(); ++p) {
    if (g->root(p) != p) decided[p] = decided[g->root(p)] = 1;
  }
  TRY(list_facing(g, decided.span(), &pairing.facing, &probes));
  TRY(list_bands(*g, pairing.facing.span(), probes.span(), &bands));
  TRY(joined.assign(pairing.facing.size(), 0));
  for (size_t i = 0; i < joined.size(); ++i) joined[i] = decided[pairing.facing[i].patch];
  for (size_t i = 0; i < bands.size(); ++i) {
    const Band& band = bands[i];
    if (!loops_may_join(g, pairing, band)) continue;
    const Facing &a = pairing.facing[band.a], &b = pairing.facing[band.b];
    if (is_ambiguous(g, pairing, bands.span().part(i, bands.size() - i))) {
      g->ambiguous[a.patch] = g->ambiguous[b.patch] = 1;
    }
    decided[a.patch] = decided[b.patch] = 1;
    g->reversed[a.patch] = a.reversed;
    g->reversed[b.patch] = b.reversed;
    joined[band.a] = joined[band.b] = 1;
    g->join(a.patch, b.patch);
    TRY(context.checkpoint());
  }
  return {};
}

}  // namespace wireskin::network
