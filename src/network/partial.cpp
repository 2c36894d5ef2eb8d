#include "network/partial.h"

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

Status drop_patches(Span<const Status> status, Array<Node>* nodes, Network* network,
                    Array<uint32_t>* original) {
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
    TRY(result.segment.push(segment));
  }
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
  return {};
}

}  // namespace wireskin::network
