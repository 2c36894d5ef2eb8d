#include "network/group_guests.h"

#include "network/nearest_patch.h"
#include "num/minmax.h"

namespace wireskin::network {

// A loop that lies on a patch faces the way the patch does.
static constexpr double k_least_facing_of_loop = 0.5;

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
                       loop ? k_farthest_loop : k_farthest_piece,
                       loop ? k_least_facing_of_loop : 0.0, guest.patch};
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

Status join_guests(Grouping* g, Span<const uint8_t> settled) {
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

}  // namespace wireskin::network
