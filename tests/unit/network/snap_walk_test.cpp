#include "network/snap_walk.h"

#include <doctest/doctest.h>

#include <random>

#include "support/wire_nets.h"

using namespace wireskin;
using namespace wireskin::network;
using namespace unit;

namespace {

// Samples of curve c no farther along it from sample i than `reach`, without i.
uint32_t brute_count(const Wires& wires, uint32_t c, uint32_t i, double reach) {
  uint32_t count = 0;
  for (const bool forward : {false, true}) {
    double arc = 0.0;
    for (uint32_t k = i; forward ? k + 1 < wires.start[c + 1] : k > wires.start[c];) {
      const uint32_t next = forward ? k + 1 : k - 1;
      arc += length(wires.position[next] - wires.position[k]);
      if (arc > reach) break;
      ++count;
      k = next;
    }
  }
  return count;
}

}  // namespace

TEST_CASE("walks pass the samples within reach, both ways, on the curve alone") {
  std::mt19937 random(5);
  WireNet net;
  for (const size_t samples : {1u, 2u, 7u, 90u}) {
    std::vector<Vec3> points;
    for (size_t i = 0; i < samples; ++i) {
      points.push_back({double(random() % 8), double(random() % 8), double(random() % 3 == 0)});
    }
    net.add(points);
  }
  for (const double reach : {0.0, 1.5, 7.3, 60.1, 1e9}) {
    Array<uint32_t> walk(net.heap.context);
    must(count_walks(net.wires, reach, &walk));
    REQUIRE(walk.size() == net.wires.samples());
    for (uint32_t c = 0; c < net.wires.curves(); ++c) {
      for (uint32_t i = net.wires.start[c]; i < net.wires.start[c + 1]; ++i) {
        CHECK(walk[i] == brute_count(net.wires, c, i, reach));
      }
    }
  }
}

TEST_CASE("walks that pass more than 2^26 samples are refused") {
  unit::Heap heap;
  const std::vector<uint32_t> walk = {1u << 16, 1u << 15};
  std::vector<Approach> approaches(512);
  for (Approach& approach : approaches) approach.a.edge = approach.b.edge = 0;
  const auto check = [&] {
    return check_walks({approaches.data(), approaches.size()}, {walk.data(), walk.size()},
                       heap.context);
  };
  CHECK(check().ok());  // 2^26
  approaches.push_back(approaches[0]);
  CHECK(check().code == Code::bad_argument);
  approaches.back().a.edge = approaches.back().b.edge = 1;
  approaches[0] = approaches.back();
  CHECK(check().ok());
}
