#include "network/group.h"

#include "base/sort.h"
#include "network/facing.h"
#include "network/nearest_patch.h"
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
// Pieces that face their plane less clearly are asked where they lie in space.
static constexpr double k_clearly_facing = 0.5;
// A loop whose normals agree with its axis less than this is the outside of what it encloses, and
// belongs to the patch round it.
static constexpr double k_inside_out = -0.2;
namespace {

// What is being decided of each patch: `parent` as in union-find, reversed where the other side of
// a ring was taken.
struct Grouping {
  const CurveVertices& vertices;
  Network* network;
  Components components;
  Array<Enclosing> enclosing;  // of each component
  Array<uint32_t> component;   // of each patch
  Array<uint32_t> parent;      // of each patch
  Array<uint8_t> reversed;     // of each patch
  Array<uint8_t> told;         // of each patch: a ring whose side something inside it tells
  Array<uint32_t> holder;      // of each component that bounds nothing: its patch
  Array<uint32_t> doubtful;    // the same where another patch may be the right one
  Array<uint8_t> ambiguous;    // of each patch
  Array<uint8_t> passed;       // of each vertex, zero between questions

  Grouping(Context& context, const CurveVertices& of, Network* net)
      : vertices(of),
        network(net),
        components(context),
        enclosing(context),
        component(context),
        parent(context),
        reversed(context),
        told(context),
        holder(context),
        doubtful(context),
        ambiguous(context),
        passed(context) {}
  uint32_t root(uint32_t p) {
    while (parent[p] != p) p = parent[p] = parent[parent[p]];
    return p;
  }
  void join(uint32_t a, uint32_t b) {
    const uint32_t x = root(a), y = root(b);
    (x < y ? parent[y] : parent[x]) = x < y ? x : y;
  }
};

struct Band {
  uint32_t a, b;
  double area;
};

}  // namespace

static Status take_components(Grouping* g) {
  const Network& network = *g->network;
  const uint32_t patches = network.patches();
  TRY(find_components(network, g->vertices, &g->components));
  TRY(g->component.resize(patches));
  TRY(g->parent.resize(patches));
  TRY(g->reversed.assign(patches, 0));
  TRY(g->told.assign(patches, 0));
  TRY(g->ambiguous.assign(patches, 0));
  TRY(g->passed.assign(g->vertices.position.size(), 0));
  TRY(g->holder.assign(g->components.members.count(), k_none));
  TRY(g->doubtful.assign(g->components.members.count(), k_none));
  for (uint32_t p = 0; p < patches; ++p) {
    g->parent[p] = p;
    g->component[p] =
        g->components.of_vertex[segment_vertex(network, g->vertices, network.cycle(p)[0] / 2, 0)];
  }
  return {};
}

// ---- Rule 1 -------------------------------------------------------------------------------------

// Of each component the patches, ascending.
static Status list_patches(const Grouping& g, Lists* lists) {
  TRY(lists->start.assign(g.components.members.count() + size_t{1}, 0));
  TRY(lists->item.resize(g.component.size()));
  for (uint32_t c : g.component) ++lists->start[c];
  starts_from_counts(lists->start.span());
  for (uint32_t p = 0; p < g.component.size(); ++p) lists->item[lists->start[g.component[p]]++] = p;
  for (size_t c = lists->start.size() - 1; c > 0; --c) lists->start[c] = lists->start[c - 1];
  lists->start[0] = 0;
  return {};
}

// The patch of an enclosed component whose border runs clockwise seen from the enclosing one's
// normal, and faces the same way; of several the largest.
static Status clockwise_patch(const Grouping& g, Span<const uint32_t> patches, const Vec3& normal,
                              uint32_t* found) {
  Border border(g.parent.context());
  double greatest = 0.0;
  *found = k_none;
  for (uint32_t p : patches) {
    TRY(border_of_patch(*g.network, g.vertices, p, &border));
    const double area = dot(vector_area(border), normal) * (g.network->ring[p] ? 1.0 : -1.0);
    if (dot(mean_normal(border), normal) < 0.0 || !(area > greatest)) continue;
    greatest = area;
    *found = p;
  }
  return {};
}

static Status join_enclosed(Grouping* g) {
  const uint32_t count = g->components.members.count();
  Context& context = g->parent.context();
  Array<uint32_t> order(context);
  Lists patches(context);
  TRY(list_patches(*g, &patches));
  for (uint32_t c = 0; c < count; ++c) {
    if (g->enclosing[c].patch != k_none) TRY(order.push(c));
  }
  // The outermost first: the inside of a hole encloses nothing.
  const auto score = [&](uint32_t c) { return g->enclosing[c].score; };
  sort(order.span(),
       [&](uint32_t a, uint32_t b) { return score(a) != score(b) ? score(a) > score(b) : a < b; });
  for (uint32_t c : order) {
    const Enclosing& outer = g->enclosing[c];
    if (g->reversed[outer.patch]) continue;
    if (!g->components.bounds[c]) {
      (outer.facing < k_clearly_facing ? g->doubtful : g->holder)[c] = outer.patch;
      continue;
    }
    uint32_t inner = k_none;
    TRY(clockwise_patch(*g, patches[c], outer.normal, &inner));
    if (inner == k_none) continue;
    g->reversed[inner] = g->network->ring[inner];
    g->join(outer.patch, inner);
  }
  return {};
}

// ---- Rule 2 -------------------------------------------------------------------------------------

// The cosine between normals and axis in the mean over a loop, and the area that it encloses.
static double closing_cosine(const Border& border, double* area) {
  const Vec3 axis = vector_area(border);
  *area = 0.5 * length(axis);
  return dot(mean_normal(border), unit(axis));
}

static Status list_facing(Grouping* g, Span<const uint8_t> decided, Array<Facing>* facing,
                          Array<Probe>* probes) {
  const Network& network = *g->network;
  Border border(g->parent.context());
  for (uint32_t p = 0; p < network.patches(); ++p) {
    if (g->root(p) != p || g->reversed[p] ||
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

// Whether two groups are one, or have loops that pass the same vertex: a patch that meets itself
// across a curve is never what normals ask for where another loop was nearer.
static bool share_vertex(Grouping* g, uint32_t a, uint32_t b) {
  const Network& network = *g->network;
  const uint32_t roots[2] = {g->root(a), g->root(b)};
  bool share = roots[0] == roots[1];
  for (int side = 0; side < 2 && !share; ++side) {
    for (uint32_t p = 0; p < network.patches(); ++p) {
      if (g->root(p) != roots[side]) continue;
      for (uint32_t h : network.cycle(p)) {
        const uint32_t v = segment_vertex(network, g->vertices, h / 2, 0);
        const uint32_t w = segment_vertex(network, g->vertices, h / 2, g->vertices.edges[h / 2]);
        if (side == 1) share = share || g->passed[v] || g->passed[w];
        if (side == 0) g->passed[v] = g->passed[w] = 1;
      }
    }
  }
  for (uint32_t h : network.loop.item) {
    g->passed[segment_vertex(network, g->vertices, h / 2, 0)] = 0;
    g->passed[segment_vertex(network, g->vertices, h / 2, g->vertices.edges[h / 2])] = 0;
  }
  return share;
}

namespace {

// How far rule 2 has come.
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

static Status join_facing(Grouping* g) {
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

// ---- The result ---------------------------------------------------------------------------------

// A ring on its own needs normals that tell inside from outside.
static Status check_rings(Grouping* g) {
  constexpr double k_no_cosine = 1e-6, k_clear_area = 1.0 / 60.0;
  Border border(g->parent.context());
  Array<uint32_t> members(g->parent.context());
  if (g->parent.empty()) return {};
  TRY(members.assign(g->parent.size(), 0));
  for (uint32_t p = 0; p < members.size(); ++p) ++members[g->root(p)];
  for (uint32_t p = 0; p < members.size(); ++p) {
    if (!g->network->ring[p] || members[g->root(p)] != 1 || g->told[p]) continue;
    TRY(border_of_patch(*g->network, g->vertices, p, &border));
    double area = 0.0;
    bool known = false;
    for (const Vec3& n : border.normal) known = known || n != Vec3{};
    const double cosine = closing_cosine(border, &area), perimeter = border_length(border);
    const bool clear = area > k_clear_area * perimeter * perimeter;
    if (!known || !clear || std::fabs(cosine) > k_no_cosine) continue;
    Place place;
    place.curve = g->network->segment[g->network->cycle(p)[0] / 2].curve;
    place.sample = 0;
    return fail(Code::open_network,
                "the normals do not tell on which side of this boundary curve the surface lies",
                place);
  }
  return {};
}

static Status check_holders(const Grouping& g, Span<const uint8_t> settled) {
  const Network& network = *g.network;
  for (uint32_t c = 0; c < g.holder.size(); ++c) {
    if (g.components.bounds[c] || settled[c] || g.holder[c] != k_none) continue;
    const uint32_t v = g.components.members[c][0];
    Place place;
    place.curve = g.vertices.curve[v];
    for (const Segment& s : network.segment) {
      const bool here = s.from != k_none && (g.components.of_vertex[s.from] == c);
      if (here && s.curve < place.curve) place.curve = s.curve;
    }
    return fail(Code::open_network,
                place.curve == k_none ? "the point lies inside no patch"
                                      : "the curve bounds no patch and lies inside none",
                place);
  }
  return {};
}

static Status append_loops(const Grouping& g, uint32_t p, Lists* loops) {
  const Network& old = *g.network;
  for (uint32_t l = old.patch_start[p]; l < old.patch_start[p + 1]; ++l) {
    const Span<const uint32_t> half = old.loop[l];
    for (size_t i = 0; i < half.size(); ++i) {
      TRY(loops->item.push(g.reversed[p] ? opposite(half[half.size() - 1 - i]) : half[i]));
    }
    TRY(loops->close());
  }
  return {};
}

// What lies inside each patch: the segments of its own cycle, loose pieces and points. `held` lists
// the components by holder, `piece` the list of loose segments of each component.
static Status append_inside(const Grouping& g, uint32_t p, Span<const uint32_t> held,
                            Span<const uint32_t> piece, Network* fresh) {
  const Network& old = *g.network;
  for (uint32_t s : old.inner[p]) TRY(fresh->inner.item.push(s));
  if (old.point.count() > 0) {
    for (uint32_t v : old.point[p]) TRY(fresh->point.item.push(v));
  }
  for (uint32_t c : held) {
    if (piece[c] == k_none) {
      TRY(fresh->point.item.push(g.components.members[c][0]));
      continue;
    }
    for (uint32_t s : old.loose[piece[c]]) TRY(fresh->inner.item.push(s));
  }
  return {};
}

// Sorted by holder; `start[p]` .. `start[p + 1]` are those of patch p.
static Status list_held(const Grouping& g, Lists* held) {
  TRY(held->start.assign(g.parent.size() + 1, 0));
  for (uint32_t p : g.holder) {
    if (p != k_none) ++held->start[p];
  }
  TRY(held->item.resize(starts_from_counts(held->start.span())));
  for (uint32_t c = 0; c < g.holder.size(); ++c) {
    if (g.holder[c] != k_none) held->item[held->start[g.holder[c]]++] = c;
  }
  for (size_t p = held->start.size() - 1; p > 0; --p) held->start[p] = held->start[p - 1];
  held->start[0] = 0;
  return {};
}

// Writes the groups as the network's patches, in the order of the least patch of each. `number`: of
// each old patch the new one; `ambiguous`: of each new patch.
static Status rebuild(Grouping* g, Array<uint32_t>* number, Array<uint8_t>* ambiguous) {
  Network& old = *g->network;
  Context& context = old.segment.context();
  Network fresh(context);
  Lists held(context);
  Array<uint32_t> order(context), piece(context);
  TRY(list_held(*g, &held));
  TRY(piece.assign(g->holder.size(), k_none));
  for (uint32_t i = 0; i < old.loose.count(); ++i) {
    piece[g->components.of_vertex[old.segment[old.loose[i][0]].from]] = i;
  }
  TRY(order.resize(old.patches()));
  TRY(number->resize(old.patches()));
  ambiguous->clear();
  for (uint32_t p = 0; p < order.size(); ++p) order[p] = p;
  sort(order.span(), [&](uint32_t a, uint32_t b) {
    const uint32_t x = g->root(a), y = g->root(b);
    return x != y ? x < y : a < b;
  });
  TRY(fresh.patch_start.push(0));
  for (size_t first = 0, end = 0; first < order.size(); first = end) {
    uint8_t any = 0;
    while (end < order.size() && g->root(order[end]) == g->root(order[first])) {
      const uint32_t p = order[end++];
      any |= g->ambiguous[p];
      (*number)[p] = fresh.patches();
      TRY(append_loops(*g, p, &fresh.loop));
      TRY(append_inside(*g, p, held[p], piece.span(), &fresh));
    }
    TRY(ambiguous->push(any));
    TRY(fresh.patch_start.push(fresh.loop.count()));
    TRY(fresh.ring.push(end - first == 1 ? old.ring[order[first]] : uint8_t{0}));
    TRY(fresh.inner.close());
    TRY(fresh.point.close());
    TRY(context.checkpoint());
  }
  fresh.segment = static_cast<Array<Segment>&&>(old.segment);
  fresh.loose = static_cast<Lists&&>(old.loose);
  old = static_cast<Network&&>(fresh);
  return {};
}

// ---- Rule 3 -------------------------------------------------------------------------------------

namespace {

// What may lie on a surface: a component that bounds nothing (patch k_none), or one with a loop
// that is no outer one.
struct Guest {
  uint32_t component;
  uint32_t patch;
};

}  // namespace

static void reverse_loop(Border* border) {
  const auto reverse = [](auto& array) {
    for (size_t i = 0, j = array.size() - 1; i < j; ++i, --j) {
      const auto kept = array[i];
      array[i] = array[j];
      array[j] = kept;
    }
  };
  reverse(border->vertex);
  reverse(border->position);
  reverse(border->normal);
}

// `clockwise`: of each patch, whether it has one loop and that runs so.
static Status list_guests(const Grouping& g, Span<const uint8_t> settled, Array<uint8_t>* clockwise,
                          Array<Guest>* guests) {
  constexpr double k_clearly_round = 0.3;
  const Network& network = *g.network;
  Border border(guests->context());
  TRY(clockwise->assign(network.patches(), 0));
  for (uint32_t c = 0; c < g.holder.size(); ++c) {
    if (!g.components.bounds[c] && !settled[c]) TRY(guests->push({c, k_none}));
  }
  for (uint32_t p = 0; p < network.patches(); ++p) {
    if (network.patch_start[p + 1] != network.patch_start[p] + 1) continue;
    TRY(border_of_patch(network, g.vertices, p, &border));
    double area = 0.0;
    const double cosine = closing_cosine(border, &area);
    (*clockwise)[p] = !network.ring[p] && cosine < -k_clearly_round;
    const bool round_ring = network.ring[p] && std::fabs(cosine) > k_clearly_round;
    if ((*clockwise)[p] || round_ring) TRY(guests->push({g.component[p], p}));
  }
  return {};
}

// Whether some guest is no farther from the border's box than its diagonal.
static bool has_guest_near(const Grouping& g, const Border& border, Span<const Guest> guests) {
  Vec3 centre;
  double reach = 0.0;
  for (const Vec3& p : border.position) centre += (1.0 / border.size()) * p;
  for (const Vec3& p : border.position) reach = larger(reach, length(p - centre));
  for (const Guest& guest : guests) {
    const Vec3& p = g.vertices.position[g.components.members[guest.component][0]];
    if (length(p - centre) < 3.0 * reach) return true;
  }
  return false;
}

static Status guess_patches(const Grouping& g, Span<const uint8_t> clockwise,
                            Span<const Guest> guests, PatchGuesses* guesses) {
  constexpr double k_either_side = 0.3;
  Border border(guesses->patch.context());
  for (uint32_t p = 0; p < g.network->patches(); ++p) {
    if (clockwise[p]) continue;
    TRY(border_of_patch(*g.network, g.vertices, p, &border));
    if (!has_guest_near(g, border, guests)) continue;
    double area = 0.0;
    const double cosine = closing_cosine(border, &area);
    const bool ring = g.network->ring[p] != 0;
    if (!ring || cosine > -k_either_side) TRY(add_guess(border, 2 * p, guesses));
    if (!ring || cosine > k_either_side) continue;
    reverse_loop(&border);
    TRY(add_guess(border, 2 * p + 1, guesses));
  }
  return {};
}

// The patch on which a guest lies; a ring is turned to the side found. `border` is that of the
// guest's loop.
static uint32_t host_of(Grouping* g, const Guest& guest, const Border& border,
                        const PatchGuesses& guesses, Span<uint8_t> turned) {
  constexpr double k_farthest_piece = 0.5, k_farthest_loop = 0.25;
  const bool loop = guest.patch != k_none;
  const Piece piece = {loop ? border.vertex.span() : g->components.members[guest.component],
                       loop ? k_farthest_loop : k_farthest_piece, loop ? k_clearly_facing : 0.0,
                       guest.patch};
  const uint32_t found = nearest_patch(g->vertices, piece, guesses);
  if (found == k_none) return k_none;
  const uint32_t host = guesses.patch[found].number / 2, side = guesses.patch[found].number % 2;
  if (g->network->ring[host] && turned[host] != side + 1) {
    if (turned[host] != 0) return k_none;  // another guest has turned it the other way
    turned[host] = static_cast<uint8_t>(side + 1);
    g->reversed[host] = static_cast<uint8_t>(side);
    g->told[host] = 1;
  }
  return host;
}

static Status join_guests(Grouping* g, Span<const uint8_t> settled) {
  Context& context = g->parent.context();
  Array<Guest> guests(context);
  Array<uint8_t> clockwise(context), turned(context);
  PatchGuesses guesses(context);
  Border border(context);
  TRY(list_guests(*g, settled, &clockwise, &guests));
  if (guests.empty()) return {};
  TRY(guess_patches(*g, clockwise.span(), guests.span(), &guesses));
  TRY(turned.assign(g->network->patches(), 0));
  for (const Guest& guest : guests) {
    if (guest.patch != k_none) {
      TRY(border_of_patch(*g->network, g->vertices, guest.patch, &border));
    }
    const uint32_t host = host_of(g, guest, border, guesses, turned.span());
    TRY(context.checkpoint());
    if (guest.patch == k_none) {
      g->holder[guest.component] = host != k_none ? host : g->doubtful[guest.component];
      continue;
    }
    if (host == k_none || share_vertex(g, host, guest.patch)) continue;
    g->reversed[guest.patch] = g->network->ring[guest.patch];
    g->join(host, guest.patch);
  }
  return {};
}

// ---- Rule 4 -------------------------------------------------------------------------------------

// The loop of the group that most places of loop `own` look at, k_none where no group has most of
// them; `area`: about what the surface between has.
static uint32_t loop_in_sight(Grouping* g, uint32_t own, Span<const Facing> facing,
                              Span<const Probe> probes, Span<const uint8_t> hidden,
                              Span<double> votes, double* area) {
  constexpr double k_most = 0.5;
  double total = 0.0;
  *area = 0.0;
  for (double& v : votes) v = 0.0;
  for (const Probe& p : probes.part(facing[own].first, facing[own].count)) {
    const Sight sight = look(p, facing, probes, hidden);
    total += p.share;
    if (sight.loop == k_none) continue;
    votes[g->root(facing[sight.loop].patch)] += p.share;
    *area += p.share * sight.distance;
  }
  for (uint32_t i = 0; i < facing.size(); ++i) {
    if (votes[g->root(facing[i].patch)] > k_most * total) return i;
  }
  return k_none;
}

static Status join_in_sight(Grouping* g) {
  const Network& network = *g->network;
  Context& context = g->parent.context();
  Array<Facing> facing(context);
  Array<Probe> probes(context);
  Array<double> cosine(context), votes(context);
  Array<uint8_t> hidden(context);
  Border border(context);
  for (uint32_t p = 0; p < network.patches(); ++p) {
    if (network.ring[p]) continue;
    TRY(border_of_patch(network, g->vertices, p, &border));
    double area = 0.0;
    const double closing = closing_cosine(border, &area);
    for (uint32_t l = 0; l < border.loops(); ++l) {
      TRY(add_facing(border, l, p, false, closing, area, &facing, &probes));
      // Loops that are together already look for nothing more.
      TRY(cosine.push(border.loops() == 1 ? closing : 1.0));
    }
    TRY(context.checkpoint());
  }
  TRY(hidden.resize(facing.size()));
  TRY(votes.assign(network.patches(), 0.0));
  for (uint32_t i = 0; i < facing.size(); ++i) {
    if (!(cosine[i] < k_inside_out)) continue;
    for (uint32_t j = 0; j < facing.size(); ++j) {
      hidden[j] = share_vertex(g, facing[i].patch, facing[j].patch);
    }
    double area = 0.0;
    const uint32_t j =
        loop_in_sight(g, i, facing.span(), probes.span(), hidden.span(), votes.span(), &area);
    TRY(context.checkpoint());
    if (j == k_none || !(area < facing[i].alone)) continue;
    g->join(facing[i].patch, facing[j].patch);
  }
  return {};
}

static void count_ambiguous(Span<const uint8_t> ambiguous, Ambiguity* ambiguity) {
  for (uint32_t p = 0; p < ambiguous.size(); ++p) {
    if (ambiguous[p] && ambiguity->patches++ == 0) ambiguity->first = p;
  }
}

Status group_patches(const CurveVertices& vertices, Network* network, Ambiguity* ambiguity) {
  Ambiguity unasked;
  Context& context = network->segment.context();
  Grouping planes(context, vertices, network), spaces(context, vertices, network);
  Array<uint32_t> number(context);
  Array<uint8_t> settled(context), ambiguous(context);
  TRY(take_components(&planes));
  TRY(find_enclosing(*network, vertices, planes.components, &planes.enclosing));
  TRY(join_enclosed(&planes));
  TRY(join_facing(&planes));
  TRY(rebuild(&planes, &number, &ambiguous));
  TRY(take_components(&spaces));
  TRY(settled.assign(planes.holder.size(), 0));
  for (size_t c = 0; c < settled.size(); ++c) {
    settled[c] = planes.holder[c] != k_none;
    const uint32_t doubtful = planes.doubtful[c];
    if (doubtful != k_none) spaces.doubtful[c] = number[doubtful];
  }
  for (size_t p = 0; p < ambiguous.size(); ++p) spaces.ambiguous[p] = ambiguous[p];
  TRY(join_guests(&spaces, settled.span()));
  TRY(join_in_sight(&spaces));
  TRY(check_rings(&spaces));
  TRY(check_holders(spaces, settled.span()));
  TRY(rebuild(&spaces, &number, &ambiguous));
  count_ambiguous(ambiguous.span(), ambiguity != nullptr ? ambiguity : &unasked);
  return {};
}

}  // namespace wireskin::network
