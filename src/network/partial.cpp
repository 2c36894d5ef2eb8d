#include "network/partial.h"

#include "network/wires.h"

namespace wireskin::network {

namespace {

// New numbers, k_none for what goes.
struct Renumbering {
  Array<uint32_t> segment, node;

  explicit Renumbering(Context& context) : segment(context), node(context) {}
};

}  // namespace

static Status renumber(const Network& network, Span<const Status> status, size_t nodes,
                       Renumbering* fresh, Array<uint8_t>* sides) {
  TRY(fresh->segment.assign(network.segment.size(), k_none));
  TRY(fresh->node.assign(nodes, k_none));
  TRY(sides->assign(network.segment.size(), 0));
  for (uint32_t p = 0; p < network.patches(); ++p) {
    if (!status[p].ok()) continue;
    for (uint32_t h : network.cycle(p)) ++(*sides)[h / 2];
    for (uint32_t s : network.inner[p]) (*sides)[s] = 2;
    for (uint32_t v : network.point[p]) fresh->node[v] = 0;
  }
  uint32_t count = 0;
  for (uint32_t s = 0; s < network.segment.size(); ++s) {
    if ((*sides)[s] == 0) continue;
    fresh->segment[s] = count++;
    if (network.segment[s].from == k_none) continue;
    fresh->node[network.segment[s].from] = fresh->node[network.segment[s].to] = 0;
  }
  count = 0;
  for (uint32_t& number : fresh->node) {
    if (number != k_none) number = count++;
  }
  return {};
}

static Status copy_patch(const Network& old, uint32_t p, const Renumbering& fresh,
                         Network* result) {
  for (uint32_t l = old.patch_start[p]; l < old.patch_start[p + 1]; ++l) {
    for (uint32_t h : old.loop[l]) {
      TRY(result->loop.item.push(2 * fresh.segment[h / 2] + h % 2));
    }
    TRY(result->loop.close());
  }
  for (uint32_t s : old.inner[p]) TRY(result->inner.item.push(fresh.segment[s]));
  for (uint32_t v : old.point[p]) TRY(result->point.item.push(fresh.node[v]));
  TRY(result->inner.close());
  TRY(result->point.close());
  TRY(result->ring.push(old.ring[p]));
  return result->patch_start.push(result->loop.count());
}

// Joins those ends of segments (2 s where s begins, 2 s + 1 where it ends) that patches join at
// their nodes: half-segment h leaves at end h. `first` is scratch: of each node, an end that the
// patch has there.
static void join_ends(const Network& network, Array<uint32_t>* first, DisjointSets* ends) {
  for (uint32_t p = 0; p < network.patches(); ++p) {
    for (uint32_t l = network.patch_start[p]; l < network.patch_start[p + 1]; ++l) {
      const Span<const uint32_t> loop = network.loop[l];
      for (size_t i = 0; i < loop.size(); ++i) {
        const uint32_t h = loop[i], before = loop[i == 0 ? loop.size() - 1 : i - 1];
        const Segment& segment = network.segment[h / 2];
        if (segment.from == k_none) continue;
        ends->unite(h, opposite(before));
        (*first)[h % 2 == 0 ? segment.from : segment.to] = h;
      }
    }
    for (uint32_t s : network.inner[p]) {
      const uint32_t node[2] = {network.segment[s].from, network.segment[s].to};
      for (uint32_t k = 0; k < 2; ++k) {
        if (node[k] == k_none) continue;
        uint32_t& known = (*first)[node[k]];
        if (known == k_none) known = 2 * s + k;
        ends->unite(known, 2 * s + k);
      }
    }
    for (uint32_t h : network.cycle(p)) {
      if (network.segment[h / 2].from == k_none) continue;
      (*first)[network.segment[h / 2].from] = (*first)[network.segment[h / 2].to] = k_none;
    }
    for (uint32_t s : network.inner[p]) {
      if (network.segment[s].from == k_none) continue;
      (*first)[network.segment[s].from] = (*first)[network.segment[s].to] = k_none;
    }
  }
}

// Gives each fan of patches round a node a node of its own.
static Status part_nodes(Array<Node>* nodes, Network* network) {
  Context& context = nodes->context();
  DisjointSets ends(context);
  Array<uint32_t> first(context), own(context);
  const uint32_t given = static_cast<uint32_t>(nodes->size());
  const uint32_t count = 2 * static_cast<uint32_t>(network->segment.size());
  TRY(ends.reset(count));
  TRY(first.assign(given, k_none));
  join_ends(*network, &first, &ends);
  TRY(own.assign(count, k_none));  // of each set of ends: its node
  Array<uint8_t> taken(context);
  TRY(taken.assign(given, 0));
  for (uint32_t e = 0; e < count; ++e) {
    Segment& segment = network->segment[e / 2];
    uint32_t& node = e % 2 == 0 ? segment.from : segment.to;
    if (node == k_none) continue;
    uint32_t& fan = own[ends.find(e)];
    if (fan == k_none && !taken[node]) {
      taken[node] = 1;
      fan = node;
    } else if (fan == k_none) {
      fan = static_cast<uint32_t>(nodes->size());
      TRY(nodes->push((*nodes)[node]));
    }
    node = fan;
  }
  return {};
}

Status drop_patches(Span<const Status> status, Array<Node>* nodes, Network* network,
                    Array<uint32_t>* original, Array<Status>* faults) {
  Context& context = nodes->context();
  Network result(context);
  Renumbering fresh(context);
  Array<uint8_t> sides(context);
  TRY(renumber(*network, status, nodes->size(), &fresh, &sides));
  for (uint32_t s = 0; s < network->segment.size(); ++s) {
    if (fresh.segment[s] == k_none) continue;
    Segment segment = network->segment[s];
    segment.boundary = sides[s] == 1;
    if (segment.from != k_none) {
      segment.from = fresh.node[segment.from];
      segment.to = fresh.node[segment.to];
    }
    if (faults != nullptr && !faults->empty()) (*faults)[result.segment.size()] = (*faults)[s];
    TRY(result.segment.push(segment));
  }
  if (faults != nullptr && !faults->empty()) faults->shrink(result.segment.size());
  original->clear();
  TRY(result.patch_start.push(0));
  for (uint32_t p = 0; p < network->patches(); ++p) {
    if (!status[p].ok()) continue;
    TRY(original->push(p));
    TRY(copy_patch(*network, p, fresh, &result));
  }
  size_t kept = 0;
  for (size_t v = 0; v < nodes->size(); ++v) {
    if (fresh.node[v] != k_none) (*nodes)[kept++] = (*nodes)[v];
  }
  nodes->shrink(kept);
  *network = static_cast<Network&&>(result);
  return part_nodes(nodes, network);
}

}  // namespace wireskin::network
