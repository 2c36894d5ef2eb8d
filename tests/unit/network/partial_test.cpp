#include "network/partial.h"

#include <doctest/doctest.h>

#include <vector>

#include "support/context.h"

using namespace unit;
using namespace wireskin::network;

namespace {

constexpr uint32_t k_nodes = 5;  // node i lies at x = i

struct Net {
  Heap heap;
  Array<Node> nodes{heap.context};
  Network network{heap.context};
  Array<uint32_t> original{heap.context};

  Net() {
    must(network.patch_start.push(0));
    for (uint32_t i = 0; i < k_nodes; ++i) must(nodes.push({{1.0 * i, 0, 0}, {0, 0, 1}, i}));
  }
  uint32_t segment(uint32_t from, uint32_t to) {
    const uint32_t s = static_cast<uint32_t>(network.segment.size());
    must(network.segment.push({s, 0, 1, from, to, false}));
    return s;
  }
  // With one loop, of half-segments, and segments inside.
  void patch(const std::vector<uint32_t>& loop, const std::vector<uint32_t>& inner) {
    for (const uint32_t h : loop) must(network.loop.item.push(h));
    must(network.loop.close());
    for (const uint32_t s : inner) must(network.inner.item.push(s));
    must(network.inner.close());
    must(network.point.close());
    must(network.ring.push(0));
    must(network.patch_start.push(network.loop.count()));
  }
  void drop(uint32_t patch) {
    std::vector<Status> status(network.patches());
    status[patch] = fail(Code::patch_folded, "");
    must(drop_patches(view(status), &nodes, &network, &original));
  }
};

}  // namespace

TEST_CASE("partial: curves inside a patch stay joined to it and to each other, and go with it") {
  Net net;
  // A patch of two sides between nodes 0 and 1, in it a curve from 0 by 2 to 3 and a closed one.
  const uint32_t there = net.segment(0, 1), back = net.segment(1, 0);
  const uint32_t inner = net.segment(0, 2), further = net.segment(2, 3);
  const uint32_t round = net.segment(k_none, k_none);
  net.patch({2 * there, 2 * back}, {inner, further, round});
  // One that goes, with a curve inside to node 4, and one that touches the first at node 0.
  const uint32_t gone = net.segment(1, 1), inner_gone = net.segment(1, 4);
  net.patch({2 * gone}, {inner_gone});
  const uint32_t touching = net.segment(0, 0);
  net.patch({2 * touching}, {});
  net.drop(1);

  const Network& n = net.network;
  REQUIRE(n.patches() == 2);
  CHECK(to_vector(net.original) == std::vector<uint32_t>{0, 2});
  REQUIRE(n.segment.size() == 6);
  CHECK(to_vector(n.inner.item) == std::vector<uint32_t>{inner, further, round});
  CHECK(n.inner[1].empty());
  // Node 4 went; 0 became two, for the patches share no curve there.
  REQUIRE(net.nodes.size() == 5);
  CHECK(net.nodes[4].position == net.nodes[0].position);
  CHECK(n.segment[there].from == 0);
  CHECK(n.segment[back].to == 0);
  CHECK(n.segment[inner].from == 0);
  CHECK(n.segment[inner].to == 2);
  CHECK(n.segment[further].from == 2);
  CHECK(n.segment[further].to == 3);
  CHECK(n.segment[round].from == k_none);
  CHECK(n.segment[5].from == 4);
  CHECK(n.segment[5].to == 4);
  CHECK(n.segment[there].boundary);
  CHECK(!n.segment[inner].boundary);
}
