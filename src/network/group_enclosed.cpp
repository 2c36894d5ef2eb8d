#include "network/group_enclosed.h"

#include "base/sort.h"
#include "network/sight.h"

namespace wireskin::network {

// Pieces that face their plane less clearly are asked where they lie in space.
static constexpr double k_clearly_facing = 0.5;
// A loop whose normals face the plane less goes on out of it: a tube in a tube.
static constexpr double k_least_facing_of_hole = 0.2;

// Of each component the patches, ascending.
static Status list_patches(const Grouping& g, Lists* lists) {
  TRY(lists->start.assign(g.components.members.count() + size_t{1}, 0));
  TRY(lists->item.resize(g.component.size()));
  for (uint32_t c : g.component) ++lists->start[c];
  starts_from_counts(lists->start.span());
  for (uint32_t p = 0; p < g.component.size(); ++p) lists->item[lists->start[g.component[p]]++] = p;
  shift_starts_back(lists->start.span());
  return {};
}

// Whether a closed curve in a patch of another one has surface on both sides: then more than the
// plane tells where its sides belong (network/group_rings.h).
static bool is_ring_in_ring(const Grouping& g, uint32_t c, uint32_t outer) {
  return g.closed[c] == 2 && g.closed[g.component[outer]] != k_none;
}

// The patch of an enclosed component whose border runs clockwise seen from the enclosing one's
// normal, and faces the same way; of several the largest.
static Status clockwise_patch(const Grouping& g, Span<const uint32_t> patches, const Vec3& normal,
                              uint32_t* found) {
  Border border(g.parent.context());
  double greatest = 0.0;
  bool in_plane = true;
  *found = k_none;
  for (uint32_t p : patches) {
    TRY(border_of_patch(*g.network, g.vertices, p, &border));
    const double area = dot(vector_area(border), normal) * (g.network->ring[p] ? 1.0 : -1.0);
    const double facing = dot(mean_normal(border), normal);
    if (facing < 0.0 || !(area > greatest)) continue;
    greatest = area;
    *found = p;
    in_plane = facing > k_least_facing_of_hole || !knows_normals(border, 0);
  }
  if (!in_plane) *found = k_none;
  return {};
}

Status join_enclosed(Grouping* g) {
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
    if (g->reversed[outer.patch] || is_ring_in_ring(*g, c, outer.patch)) continue;
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

}  // namespace wireskin::network
