#include "network/kept_parts.h"

#include <doctest/doctest.h>

#include <random>
#include <set>
#include <vector>

#include "support/context.h"

using wireskin::k_none;
using wireskin::Span;
using wireskin::Vec3;
using namespace wireskin::network;

namespace {

struct Net {
  std::vector<uint32_t> start = {0}, kept_start = {0}, kept, node;
  std::vector<uint8_t> closed;
  std::vector<Vec3> position, normal;

  // Every second sample is dropped unless it is a node.
  void add(const std::vector<uint32_t>& nodes) {
    for (uint32_t k = 0; k < nodes.size(); ++k) {
      if (nodes[k] != k_none || k % 2 == 0) kept.push_back(k);
      node.push_back(nodes[k]);
      position.push_back({1.0 * closed.size(), 1.0 * k, 0.0});
      normal.push_back({0, 0, 1});
    }
    closed.push_back(closed.size() % 2 == 1);
    start.push_back(static_cast<uint32_t>(node.size()));
    kept_start.push_back(static_cast<uint32_t>(kept.size()));
  }
  KeptSamples samples() {
    return {{start.data(), start.size()},
            {kept_start.data(), kept_start.size()},
            {kept.data(), kept.size()},
            {node.data(), node.size()},
            {},
            {closed.data(), closed.size()},
            {position.data(), position.size()},
            {normal.data(), normal.size()}};
  }
};

// The curve that sample `k` of a part's curve `c` is of: its position says so.
uint32_t curve_of(const KeptSamples& part, uint32_t c) {
  return static_cast<uint32_t>(part.position[part.start[c] + part.kept[part.kept_start[c]]].x);
}

}  // namespace

TEST_CASE("curves that share nodes are one part, in the order given") {
  Net net;
  net.add({5, k_none, k_none, 2});
  net.add({k_none, k_none, k_none});  // alone
  net.add({9, k_none, 9});
  net.add({k_none, 2, k_none, 7});
  net.add({7});
  unit::Heap heap;
  KeptParts parts(heap.context);
  REQUIRE(parts.split(net.samples()).ok());
  REQUIRE(parts.count() == 3);
  const std::vector<std::vector<uint32_t>> expected = {{0, 3, 4}, {1}, {2}};
  for (uint32_t p = 0; p < 3; ++p) {
    const KeptSamples part = parts.part(p);
    REQUIRE(part.closed.size() == expected[p].size());
    REQUIRE(part.kept_start.size() == expected[p].size() + 1);
    CHECK(part.kept_start[part.closed.size()] == part.kept.size());
    for (uint32_t c = 0; c < part.closed.size(); ++c) {
      const uint32_t curve = expected[p][c];
      CHECK(curve_of(part, c) == curve);
      CHECK(part.start[c] == net.start[curve]);
      CHECK(part.closed[c] == net.closed[curve]);
      const uint32_t count = net.kept_start[curve + 1] - net.kept_start[curve];
      REQUIRE(part.kept_start[c + 1] - part.kept_start[c] == count);
      for (uint32_t k = 0; k < count; ++k) {
        CHECK(part.kept[part.kept_start[c] + k] == net.kept[net.kept_start[curve] + k]);
      }
    }
  }
  // Nodes count from zero in each part.
  const KeptSamples first = parts.part(0), last = parts.part(2);
  CHECK(first.node[0] == 0);
  CHECK(first.node[3] == 1);
  CHECK(first.node[net.start[3] + 1] == 1);
  CHECK(first.node[net.start[3] + 3] == 2);
  CHECK(first.node[net.start[4]] == 2);
  CHECK(last.node[net.start[2]] == 0);
  CHECK(last.node[net.start[2] + 1] == k_none);
}

TEST_CASE("no curves, no parts") {
  Net net;
  unit::Heap heap;
  KeptParts parts(heap.context);
  REQUIRE(parts.split(net.samples()).ok());
  CHECK(parts.count() == 0);
}

TEST_CASE("random networks against flooding") {
  std::mt19937 random(3);
  for (int trial = 0; trial < 50; ++trial) {
    Net net;
    const uint32_t curves = 1 + random() % 20;
    std::vector<std::set<uint32_t>> nodes(curves);
    for (uint32_t c = 0; c < curves; ++c) {
      std::vector<uint32_t> own;
      for (uint32_t k = 0; k < 4; ++k) own.push_back(random() % 3 ? k_none : random() % 30);
      for (const uint32_t n : own) nodes[c].insert(n);
      nodes[c].erase(k_none);
      net.add(own);
    }
    // The least curve reachable, by repeated passes.
    std::vector<uint32_t> least(curves);
    for (uint32_t c = 0; c < curves; ++c) least[c] = c;
    for (uint32_t pass = 0; pass < curves; ++pass) {
      for (uint32_t a = 0; a < curves; ++a) {
        for (uint32_t b = 0; b < curves; ++b) {
          for (const uint32_t n : nodes[a]) {
            if (nodes[b].count(n) && least[b] < least[a]) least[a] = least[b];
          }
        }
      }
    }
    unit::Heap heap;
    KeptParts parts(heap.context);
    REQUIRE(parts.split(net.samples()).ok());
    CHECK(parts.count() == std::set<uint32_t>(least.begin(), least.end()).size());
    for (uint32_t p = 0; p < parts.count(); ++p) {
      const KeptSamples part = parts.part(p);
      for (uint32_t c = 0; c < part.closed.size(); ++c) {
        CHECK(least[curve_of(part, c)] == curve_of(part, 0));
      }
    }
  }
}
