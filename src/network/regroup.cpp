#include "network/regroup.h"

#include "base/sort.h"

namespace wireskin::network {

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
  shift_starts_back(held->start.span());
  return {};
}

// Writes the groups as the network's patches, in the order of the least patch of each. `number`: of
// each old patch the new one; `ambiguous`: of each new patch.
Status rebuild(Grouping* g, Array<uint32_t>* number, Array<uint8_t>* ambiguous) {
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

}  // namespace wireskin::network
