#include "network/wires.h"

#include <doctest/doctest.h>

#include "support/wire_nets.h"

using namespace wireskin;
using namespace wireskin::network;
using namespace unit;

TEST_CASE("samples weld by number and by place") {
  WireNet net;
  net.add(line({0, 0, 0}, {1, 0, 0}, 2), false, {}, {5, k_none, 6});
  net.add(line({0, 1, 0}, {0, 2, 0}, 2), false, {}, {5, k_none, k_none});
  net.add(line({0.5, 0, 0}, {0.5, -1, 0}, 2));
  net.weld();
  const Array<uint32_t>& point = net.wires.point;
  CHECK(point[0] == point[3]);  // number 5
  CHECK(point[1] == point[6]);  // (0.5, 0, 0)
  CHECK(net.wires.points == 7);
  Array<uint32_t> component(net.heap.context);
  WireCounts counts;
  must(count_wires(net.wires, &component, &counts));
  CHECK(counts.nodes == 2);
  CHECK(counts.dangling == 3);
  CHECK(counts.components == 1);
}

TEST_CASE("minus zero is zero, and other numbers stay apart") {
  WireNet net;
  net.add({{-0.0, 0, 0}, {1, 0, 0}});
  net.add({{0.0, 0, -0.0}, {0, 1e-300, 0}});
  net.weld();
  CHECK(net.wires.point[0] == net.wires.point[2]);
  CHECK(net.wires.points == 3);
}

TEST_CASE("disjoint sets are named by their least members, against brute force") {
  Heap heap;
  Random random(3);
  for (int round = 0; round < 20; ++round) {
    DisjointSets sets(heap.context);
    must(sets.reset(30));
    std::vector<uint32_t> name(30);
    for (uint32_t i = 0; i < 30; ++i) name[i] = i;
    for (int k = 0; k < 25; ++k) {
      const uint32_t a = random.below(30), b = random.below(30);
      CHECK(sets.unite(a, b) == (name[a] != name[b]));
      const uint32_t low = std::min(name[a], name[b]), high = std::max(name[a], name[b]);
      for (uint32_t& n : name) n = n == high ? low : n;
      for (uint32_t i = 0; i < 30; ++i) CHECK(sets.find(i) == name[i]);
    }
  }
}
