#include "flow/loose_walls.h"

#include "flow/topology.h"

namespace wireskin::flow {

// Of a wall's border, how much makes it loose: ending in flat faces, and ending anywhere.
static constexpr double k_share_in_faces = 0.25, k_share_anywhere = 0.9;
// Rooms of a lesser ratio are noise of the samples; only flat faces are sure enough to tell by.
static constexpr double k_least_room = 1.02;
static constexpr int k_most_rounds = 8;
// The cosine between two walls at an edge, both seen from it, that continue each other: 160
// degrees.
static constexpr double k_continuing = -0.94;
static constexpr uint32_t k_most_at_edge = 16;

namespace {

enum class Ending : uint8_t { none, somewhere, in_face };

// The walls at the edges off the curves where three or more triangles meet.
struct LooseSearch {
  Sheet sheet;
  Array<uint32_t> mark, wall;
  Array<uint32_t> room;    // label_rooms() of the sheet
  Array<uint32_t> ending;  // of each edge, a bit for each place in triangles_of that ends there
  Array<uint8_t> in_face;  // of each edge: two of those that continue are a flat face

  explicit LooseSearch(Context& context)
      : sheet(context),
        mark(context),
        wall(context),
        room(context),
        ending(context),
        in_face(context) {}
};

struct EdgeFan {
  uint32_t count = 0;
  uint32_t place[k_most_at_edge];
  Vec3 into[k_most_at_edge];
  bool flat[k_most_at_edge];
};

}  // namespace

// From the edge into the triangle, orthogonal to the edge.
static Vec3 into_triangle(const Complex& complex, uint32_t e, uint32_t t) {
  const uint32_t a = complex.edge[2 * size_t{e}], b = complex.edge[2 * size_t{e} + 1];
  const uint32_t* const v = &complex.triangle[3 * size_t{t}];
  const uint32_t c = v[0] != a && v[0] != b ? v[0] : v[1] != a && v[1] != b ? v[1] : v[2];
  const Vec3 along = unit(complex.point[b] - complex.point[a]);
  const Vec3 to = complex.point[c] - complex.point[a];
  return unit(to - dot(to, along) * along);
}

static void gather_fan(const Complex& complex, const Sheet& sheet, Span<const Flatness> flatness,
                       uint32_t e, EdgeFan* fan) {
  const Span<const uint32_t> all = complex.triangles_of(e);
  for (uint32_t i = 0; i < all.size() && i < 32 && fan->count < k_most_at_edge; ++i) {
    if (sheet.in[all[i]] == 0) continue;
    fan->place[fan->count] = i;
    fan->into[fan->count] = into_triangle(complex, e, all[i]);
    fan->flat[fan->count++] = flatness[all[i]] != Flatness::none;
  }
}

// Pairs those that continue each other, from the flattest on; flat faces before all others.
static void pair_fan(const EdgeFan& fan, uint32_t* ending, uint8_t* in_face) {
  *ending = 0;
  for (uint32_t i = 0; i < fan.count; ++i) *ending |= 1u << fan.place[i];
  for (uint32_t pass = 0; pass < 2; ++pass) {
    const bool flat = pass == 0;
    while (true) {
      double least = k_continuing;
      uint32_t first = 0, second = 0;
      for (uint32_t i = 0; i < fan.count; ++i) {
        for (uint32_t k = i + 1; k < fan.count; ++k) {
          const bool free =
              (*ending >> fan.place[i] & 1u) != 0 && (*ending >> fan.place[k] & 1u) != 0;
          const double cosine = dot(fan.into[i], fan.into[k]);
          if (!free || (flat && !(fan.flat[i] && fan.flat[k])) || !(cosine < least)) continue;
          least = cosine;
          first = i;
          second = k;
        }
      }
      if (first == second) break;
      *ending &= ~(1u << fan.place[first]) & ~(1u << fan.place[second]);
      if (flat) *in_face = 1;
    }
  }
}

static void find_endings(const Complex& complex, const CurveEdges& curves,
                         Span<const Flatness> flatness, LooseSearch* search) {
  for (uint32_t e = 0; e < complex.edge_count(); ++e) {
    search->ending[e] = search->in_face[e] = 0;
    if (search->sheet.degree[e] < 3 || curves.by_curve(e)) continue;
    EdgeFan fan;
    gather_fan(complex, search->sheet, flatness, e, &fan);
    pair_fan(fan, &search->ending[e], &search->in_face[e]);
  }
}

static Ending ending_at(const Complex& complex, const LooseSearch& search, uint32_t e, uint32_t t) {
  const Span<const uint32_t> all = complex.triangles_of(e);
  for (uint32_t i = 0; search.ending[e] != 0 && i < all.size() && i < 32; ++i) {
    if (all[i] != t) continue;
    if ((search.ending[e] >> i & 1u) == 0) return Ending::none;
    return search.in_face[e] != 0 ? Ending::in_face : Ending::somewhere;
  }
  return Ending::none;
}

// Whether the wall parts a room from the outside. There a wall may end all round and hold
// nevertheless: where a pocket of uneven samples bulges from it, the pocket's floor continues the
// wall more evenly than its roof.
static bool is_outer(const Complex& complex, const LooseSearch& search) {
  const uint32_t outside = search.room[complex.tet_count()], t = search.wall[0];
  bool outer[2];
  for (uint32_t k = 0; k < 2; ++k) {
    const uint32_t side = complex.triangle_side[2 * size_t{t} + k];
    outer[k] = side == k_none || search.room[side] == outside;
  }
  return outer[0] != outer[1];
}

static bool is_loose(const Complex& complex, const CurveEdges& curves,
                     Span<const Flatness> flatness, const LooseSearch& search, bool only_in_faces) {
  double held = 0.0, somewhere = 0.0, in_face = 0.0;
  for (const uint32_t t : search.wall) {
    if (flatness[t] != Flatness::none) return false;
    for (uint32_t k = 0; k < 3; ++k) {
      const uint32_t e = complex.triangle_edge[3 * size_t{t} + k];
      const Ending ending = ending_at(complex, search, e, t);
      if (ending == Ending::none && !curves.by_curve(e)) continue;
      const double size = length(complex.point[complex.edge[2 * size_t{e}]] -
                                 complex.point[complex.edge[2 * size_t{e} + 1]]);
      (ending == Ending::in_face     ? in_face
       : ending == Ending::somewhere ? somewhere
                                     : held) += size;
    }
  }
  const double whole = held + somewhere + in_face;
  return in_face > k_share_in_faces * whole || (!only_in_faces && !is_outer(complex, search) &&
                                                somewhere + in_face > k_share_anywhere * whole);
}

// The walls of all rooms above a ratio.
static Status cut_rooms(const Complex& complex, const CurveEdges& curves,
                        const Persistence& persistence, double least_room, Sheet* sheet) {
  TRY(start_sheet(complex, sheet));
  for (uint32_t t = 0; t < complex.triangle_count(); ++t) {
    const uint32_t v = persistence.void_of[t];
    const bool room = v != k_none && !persistence.voids[v].loose;
    if (persistence.creator[t] == 0 || (room && persistence.voids[v].ratio > least_room)) {
      add_to_sheet(complex, t, sheet);
    }
  }
  peel(complex, curves, Protect::curves, sheet);
  return {};
}

// Marks the loose walls of the rooms above a ratio; true in *any if one is new.
static Status mark_loose(Context& context, const Complex& complex, const CurveEdges& curves,
                         Span<const Flatness> flatness, const Persistence& persistence,
                         double least_room, LooseSearch* search, Array<uint8_t>* loose, bool* any) {
  TRY(cut_rooms(complex, curves, persistence, least_room, &search->sheet));
  find_endings(complex, curves, flatness, search);
  TRY(label_rooms(complex, search->sheet, &search->room));
  TRY(context.checkpoint());
  for (uint32_t& m : search->mark) m = k_none;
  for (uint32_t t = 0; t < complex.triangle_count(); ++t) {
    if (search->sheet.in[t] == 0 || search->mark[t] != k_none) continue;
    TRY(flood_patch(complex, curves, search->sheet, t, t, search->mark.span(), &search->wall));
    if (!is_loose(complex, curves, flatness, *search, least_room < k_least_room)) continue;
    *any = true;
    for (const uint32_t member : search->wall) (*loose)[member] = 1;
  }
  return context.checkpoint();
}

Status find_persistence_of_faces(Context& context, const Complex& complex, const Samples& samples,
                                 const CurveEdges& curves, Array<Flatness>* flatness,
                                 Persistence* persistence, Array<uint8_t>* loose) {
  LooseSearch search(context);
  TRY(loose->assign(complex.triangle_count(), 0));
  TRY(search.mark.resize(complex.triangle_count()));
  TRY(search.ending.resize(complex.edge_count()));
  TRY(search.in_face.resize(complex.edge_count()));
  TRY(find_persistence(context, complex, persistence));
  TRY(cut_rooms(complex, curves, *persistence, 1.0, &search.sheet));
  TRY(find_flat_faces(context, complex, samples, curves, search.sheet, flatness));
  bool any = true;
  for (int round = 0; any && round < k_most_rounds; ++round) {
    any = false;
    for (uint32_t pass = 0; pass < 2; ++pass) {
      TRY(mark_loose(context, complex, curves, flatness->span(), *persistence,
                     pass == 0 ? 1.0 : k_least_room, &search, loose, &any));
    }
    if (any) TRY(find_persistence(context, complex, persistence, loose->span()));
  }
  return {};
}

}  // namespace wireskin::flow
