#include "network/grouping.h"

#include "base/sort.h"

namespace wireskin::network {

Grouping::Grouping(Context& context, const CurveVertices& of, Network* net)
    : vertices(of),
      network(net),
      components(context),
      corner(context),
      at_corner(context),
      enclosing(context),
      component(context),
      parent(context),
      next(context),
      reversed(context),
      told(context),
      holder(context),
      doubtful(context),
      ambiguous(context),
      settled(context),
      closed(context),
      passed(context) {}

void Grouping::join(uint32_t a, uint32_t b) {
  const uint32_t x = root(a), y = root(b);
  if (x == y) return;
  (x < y ? parent[y] : parent[x]) = x < y ? x : y;
  swap_values(next[x], next[y]);  // two rings become one
}

static Status list_corners(Grouping* g) {
  const Network& network = *g->network;
  Array<uint32_t> own(g->parent.context());
  for (uint32_t p = 0; p < network.patches(); ++p) {
    own.clear();
    for (uint32_t h : network.cycle(p)) {
      const uint32_t edges = g->vertices.edges[h / 2];
      TRY(own.push(segment_vertex(network, g->vertices, h / 2, 0)));
      TRY(own.push(segment_vertex(network, g->vertices, h / 2, edges)));
    }
    // Equal numbers are equal in every way, so their order does not matter.
    sort(own.span(), [](uint32_t a, uint32_t b) { return a < b; });
    for (size_t i = 0; i < own.size(); ++i) {
      if (i == 0 || own[i] != own[i - 1]) TRY(g->corner.item.push(own[i]));
    }
    TRY(g->corner.close());
  }
  return {};
}

static Status list_patches_at_corners(Grouping* g) {
  Lists& at = g->at_corner;
  TRY(at.start.assign(g->vertices.position.size() + 1, 0));
  TRY(at.item.resize(g->corner.item.size()));
  for (uint32_t v : g->corner.item) ++at.start[v];
  starts_from_counts(at.start.span());
  for (uint32_t p = 0; p < g->corner.count(); ++p) {
    for (uint32_t v : g->corner[p]) at.item[at.start[v]++] = p;
  }
  shift_starts_back(at.start.span());
  return {};
}

static Status find_closed_curves(Grouping* g) {
  const Network& network = *g->network;
  TRY(g->closed.assign(g->components.members.count(), 0));
  for (uint32_t p = 0; p < network.patches(); ++p) {
    uint32_t* count = &g->closed[g->component[p]];
    const bool one_loop = network.patch_start[p + 1] == network.patch_start[p] + 1;
    const uint32_t most = network.ring[p] ? 1 : 2;
    const bool fits = one_loop && network.inner[p].empty() && *count < most;
    *count = fits ? *count + 1 : k_none;
  }
  return {};
}

Status take_components(Grouping* g) {
  const Network& network = *g->network;
  const uint32_t patches = network.patches();
  TRY(find_components(network, g->vertices, &g->components));
  TRY(g->component.resize(patches));
  TRY(g->parent.resize(patches));
  TRY(g->next.resize(patches));
  TRY(g->reversed.assign(patches, 0));
  TRY(g->told.assign(patches, 0));
  TRY(g->ambiguous.assign(patches, 0));
  TRY(g->settled.assign(patches, 0));
  TRY(g->passed.assign(g->vertices.position.size(), 0));
  TRY(g->holder.assign(g->components.members.count(), k_none));
  TRY(g->doubtful.assign(g->components.members.count(), k_none));
  for (uint32_t p = 0; p < patches; ++p) {
    g->parent[p] = g->next[p] = p;
    g->component[p] =
        g->components.of_vertex[segment_vertex(network, g->vertices, network.cycle(p)[0] / 2, 0)];
  }
  TRY(find_closed_curves(g));
  TRY(list_corners(g));
  return list_patches_at_corners(g);
}

bool share_vertex(Grouping* g, uint32_t a, uint32_t b) {
  bool share = g->root(a) == g->root(b);
  if (share) return true;
  const auto for_corners = [g](uint32_t first, const auto& act) {
    uint32_t p = first;
    do {
      for (uint32_t v : g->corner[p]) act(&g->passed[v]);
      p = g->next[p];
    } while (p != first);
  };
  for_corners(a, [](uint8_t* passed) { *passed = 1; });
  for_corners(b, [&share](uint8_t* passed) { share = share || *passed != 0; });
  for_corners(a, [](uint8_t* passed) { *passed = 0; });
  return share;
}

double closing_cosine(const Border& border, double* area) {
  const Vec3 axis = vector_area(border);
  *area = 0.5 * length(axis);
  return dot(mean_normal(border), unit(axis));
}

}  // namespace wireskin::network
