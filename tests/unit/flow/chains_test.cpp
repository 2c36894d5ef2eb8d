// Chains: fragments joined, junctions passed, corners told from noise.
#include "flow/chains.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "flow/networks.h"
#include "flow/unseen.h"

using namespace flow_tests;
using namespace wireskin::flow;

namespace {

struct Chained {
  unit::Heap heap;
  Arcs arcs{heap.context};
  Chains chains{heap.context};

  explicit Chained(const Net& net, double noise = 0.0) {
    const NetArrays arrays(net);
    unit::must(find_arcs(heap.context, arrays.view(), &arcs));
    unit::must(find_chains(heap.context, arcs, noise, &chains));
  }
  int corners() const {
    return int(std::count(chains.corner.begin(), chains.corner.end(), uint8_t{1}));
  }
};

// Every edge of the arcs is in one chain, once.
void check_edges(const Chained& c) {
  std::vector<std::array<uint32_t, 2>> of_arcs, of_chains;
  const auto add = [](std::vector<std::array<uint32_t, 2>>* list, uint32_t a, uint32_t b) {
    list->push_back({std::min(a, b), std::max(a, b)});
  };
  for (uint32_t a = 0; a < c.arcs.size(); ++a) {
    for (uint32_t i = c.arcs.start[a]; i + 1 < c.arcs.start[a + 1]; ++i) {
      add(&of_arcs, c.arcs.path[i], c.arcs.path[i + 1]);
    }
  }
  for (uint32_t k = 0; k < c.chains.size(); ++k) {
    const uint32_t first = c.chains.start[k], last = c.chains.start[k + 1] - 1;
    for (uint32_t i = first; i < last; ++i) {
      add(&of_chains, c.chains.vertex[i], c.chains.vertex[i + 1]);
    }
    if (c.chains.closed[k] != 0) add(&of_chains, c.chains.vertex[last], c.chains.vertex[first]);
  }
  std::sort(of_arcs.begin(), of_arcs.end());
  std::sort(of_chains.begin(), of_chains.end());
  CHECK(of_arcs == of_chains);
}

// A square of so many samples a side, moved by so much.
Net square(int samples, double sigma, uint32_t seed) {
  unit::Random random(seed);
  Net net;
  std::vector<uint32_t> curve;
  for (int side = 0; side < 4; ++side) {
    for (int i = 0; i < samples; ++i) {
      const double t = double(i) / samples;
      const double x[4] = {t, 1, 1 - t, 0}, y[4] = {0, t, 1, 1 - t};
      double move[3] = {};
      for (double& m : move) {
        for (int k = 0; k < 12; ++k) m += 0.5 * sigma * random();
      }
      curve.push_back(net.add({x[side] + move[0], y[side] + move[1], move[2]}));
    }
  }
  curve.push_back(curve.front());
  net.curve.push_back(curve);
  return net;
}

}  // namespace

TEST_CASE("Curves go on through junctions, fragments become curves") {
  const Chained circles(great_circles());
  check_edges(circles);
  CHECK(circles.chains.size() == 3);
  for (const uint8_t closed : circles.chains.closed) CHECK(closed == 1);
  CHECK(circles.corners() == 0);

  const Chained cube(lattice(1, 1, 1));
  check_edges(cube);
  CHECK(cube.chains.size() == 12);

  Net pieces;  // a circle of forty curves of two samples
  for (int i = 0; i < 40; ++i) {
    const double a = 2 * k_pi * i / 40;
    pieces.add({std::cos(a), std::sin(a), 0});
  }
  for (uint32_t i = 0; i < 40; ++i) pieces.edge((7 * i) % 40, (7 * i + 1) % 40);
  const Chained whole(pieces);
  check_edges(whole);
  CHECK(whole.chains.size() == 1);
  CHECK(whole.chains.closed[0] == 1);
  CHECK(whole.corners() == 0);
}

TEST_CASE("Corners are found in noise, and noise makes none") {
  for (const double part : {0.0, 0.02, 0.05, 0.1, 0.15}) {
    CAPTURE(part);
    int false_corners = 0, missed = 0;
    for (uint32_t seed = 1; seed <= 10; ++seed) {
      const int samples = 25;
      const Chained c(square(samples, part / samples, seed));
      check_edges(c);
      REQUIRE(c.chains.size() == 1);
      for (uint32_t i = 0; i < c.chains.corner.size(); ++i) {
        const Vec3& p = c.arcs.vertex[c.chains.vertex[i]];
        const double off =
            std::fabs(std::fabs(p.x - 0.5) - 0.5) + std::fabs(std::fabs(p.y - 0.5) - 0.5);
        const bool at_corner = off < 1.2 / samples;  // or right beside it
        false_corners += c.chains.corner[i] != 0 && !at_corner;
      }
      missed += std::max(0, 4 - c.corners());
    }
    CHECK(false_corners <= 2);               // of a thousand samples
    CHECK(missed <= (part < 0.12 ? 1 : 6));  // of forty
  }
}

TEST_CASE("Polygons are all corners, unless noise is stated") {
  Net stairs;
  std::vector<uint32_t> curve;
  for (int i = 0; i < 12; ++i) {
    curve.push_back(stairs.add({double(i), double(i), 0}));
    curve.push_back(stairs.add({i + 1.0, double(i), 0}));
  }
  stairs.curve.push_back(curve);
  CHECK(Chained(stairs).corners() == 22);
  CHECK(Chained(stairs, 0.5).corners() == 0);
  CHECK(Chained(square(2, 0.0, 1)).corners() == 4);     // one sample amid each side
  CHECK(Chained(square(40, 0.015, 1)).corners() < 20);  // noise of more than half a step
}
