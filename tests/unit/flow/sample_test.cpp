// Arcs and samples: where polylines are split, equal first steps, steps near other arcs, Gabriel.
#include "flow/sample.h"

#include <doctest/doctest.h>

#include <cmath>

#include "flow/networks.h"
#include "flow/unseen.h"

using namespace flow_tests;
using namespace wireskin::flow;

namespace {

struct Sampled {
  unit::Heap heap;
  Arcs arcs{heap.context};
  Samples samples{heap.context};

  Sampled(const Net& net, double step) {
    const NetArrays arrays(net);
    unit::must(find_arcs(heap.context, arrays.view(), &arcs));
    unit::must(sample_arcs(heap.context, arcs, step, &samples));
  }
  double step(uint32_t i) const {
    return length(samples.position[samples.at[i + 1]] - samples.position[samples.at[i]]);
  }
};

void check_gabriel(const Sampled& s) {
  for (uint32_t a = 0; a + 1 < s.samples.start.size(); ++a) {
    for (uint32_t i = s.samples.start[a]; i + 1 < s.samples.start[a + 1]; ++i) {
      const uint32_t p = s.samples.at[i], q = s.samples.at[i + 1];
      for (uint32_t r = 0; r < s.samples.position.size(); ++r) {
        if (r == p || r == q) continue;
        CHECK(dot(s.samples.position[p] - s.samples.position[r],
                  s.samples.position[q] - s.samples.position[r]) >= -1e-15);
      }
    }
  }
}

}  // namespace

TEST_CASE("Polylines are split at junctions and corners, and nowhere else") {
  Net net;
  add_circle(net, {}, {1, 0, 0}, {0, 1, 0}, 32, {});
  Sampled circle(net, 0.1);
  CHECK(circle.arcs.size() == 1);
  CHECK(circle.arcs.closed[0] == 1);
  Sampled cube(lattice(1, 1, 1), 0.1);
  CHECK(cube.arcs.size() == 12);
  Net bent;
  for (const Vec3& p : {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{2, 0.5, 0}, Vec3{2, 2, 0}}) bent.add(p);
  bent.curve.push_back({0, 1, 2, 3});  // turns by 27 and by 63 degrees
  Sampled corner(bent, 0.1);
  CHECK(corner.arcs.size() == 2);
}

TEST_CASE("Nodes are samples, first steps at a node are equal, segments are Gabriel") {
  for (const Net& net : {lattice(1, 1, 2), octahedron(), great_circles(), pyramid(5, 1.0)}) {
    Sampled s(net, 0.1);
    std::vector<double> first(s.samples.position.size(), 0.0);
    for (uint32_t a = 0; a < s.arcs.size(); ++a) {
      const uint32_t begin = s.samples.start[a], end = s.samples.start[a + 1] - 1;
      const double steps[2] = {s.samples.along[begin + 1] - s.samples.along[begin],
                               s.samples.along[end] - s.samples.along[end - 1]};
      const uint32_t nodes[2] = {s.samples.at[begin], s.samples.at[end]};
      for (int k = 0; k < 2; ++k) {
        if (first[nodes[k]] == 0.0) first[nodes[k]] = steps[k];
        CHECK(steps[k] == doctest::Approx(first[nodes[k]]).epsilon(1e-9));
      }
      for (uint32_t i = begin; i < end; ++i) CHECK(s.step(i) <= 0.1 * (1.0 + 1e-9));
    }
    check_gabriel(s);
    CHECK(s.samples.too_short == 0);
  }
}

TEST_CASE("Arcs near each other are sampled at half their distance") {
  Net net;
  for (int i = 0; i < 2; ++i) {
    const uint32_t a = net.add({0, 0.04 * i, 0}), b = net.add({1, 0.04 * i, 0});
    net.edge(a, b);
  }
  Sampled s(net, 0.1);
  for (uint32_t a = 0; a < 2; ++a) {
    for (uint32_t i = s.samples.start[a]; i + 1 < s.samples.start[a + 1]; ++i) {
      CHECK(s.step(i) <= 0.02 * (1.0 + 1e-9));
      CHECK(s.step(i) > 0.015);
    }
  }
}

TEST_CASE("A point close to a curve makes its segment split") {
  Net net;
  const uint32_t a = net.add({0, 0, 0}), b = net.add({1, 0, 0});
  net.edge(a, b);
  net.curve.push_back({net.add({0.52, 0.001, 0})});
  Sampled s(net, 0.3);
  CHECK(s.samples.splits > 0);
  CHECK(s.arcs.point.size() == 1);
  check_gabriel(s);
}

TEST_CASE("Given points lie near the segments, however the curve turns") {
  for (const int pieces : {7, 12, 20, 50, 400}) {
    for (const double step : {0.05, 0.2, 0.6}) {
      CAPTURE(pieces);
      CAPTURE(step);
      // A wave on a circle, its turns below and above 35 degrees.
      Net net;
      std::vector<uint32_t> curve;
      for (int i = 0; i < pieces; ++i) {
        const double a = 2 * k_pi * i / pieces;
        const double r = 1.0 + 0.1 * std::sin(9.0 * a);
        curve.push_back(net.add({r * std::cos(a), r * std::sin(a), 0.1 * std::cos(5.0 * a)}));
      }
      curve.push_back(curve.front());
      net.curve.push_back(curve);
      Sampled s(net, step);
      for (uint32_t a = 0; a < s.arcs.size(); ++a) {
        uint32_t i = s.samples.start[a];
        for (uint32_t k = s.arcs.start[a]; k < s.arcs.start[a + 1]; ++k) {
          while (i + 2 < s.samples.start[a + 1] && s.samples.along[i + 1] < s.arcs.along[k]) ++i;
          const Vec3 p = s.arcs.vertex[s.arcs.path[k]];
          const Vec3 b = s.samples.position[s.samples.at[i]];
          const Vec3 d = s.samples.position[s.samples.at[i + 1]] - b;
          const double t = std::fmax(0.0, std::fmin(1.0, dot(p - b, d) / dot(d, d)));
          CHECK(length(p - b - t * d) <= k_given_distance * step * (1 + 1e-9));
        }
      }
      check_gabriel(s);
    }
  }
}

TEST_CASE("Curves side by side get samples side by side, however near they are") {
  for (const double slant : {0.0, 0.3}) {
    for (const double gap : {1e-2, 1e-3, 1e-4, 1e-6, 1e-8, 1e-12}) {
      CAPTURE(gap);
      CAPTURE(slant);
      // Two lines, shifted along each other, the second turned a little.
      Net net;
      for (int i = 0; i < 2; ++i) {
        const uint32_t a = net.add({0.0137 * i, gap * i, 0});
        net.edge(a, net.add({1 + 0.0071 * i, gap * i, slant * gap * i}));
      }
      Sampled s(net, 0.02);
      // Not one for each time the gap goes into the length.
      CHECK(s.samples.position.size() < 1500);
      if (gap < 1e-4) continue;
      check_gabriel(s);
      CHECK(s.samples.too_short == 0);
    }
  }
}

TEST_CASE("Curves that all but coincide are split down to the least step and no further") {
  for (const double gap : {1e-3, 1e-4, 1e-5, 1e-6, 1e-8, 1e-12, 0.0}) {
    CAPTURE(gap);
    // Two circles, their corners turned against each other, the lesser bent to and fro.
    Net net;
    add_circle(net, {}, {1, 0, 0}, {0, 1, 0}, 500, {});
    std::vector<uint32_t> curve;
    for (int i = 0; i < 333; ++i) {
      const double a = 2 * k_pi * i / 333.0, r = 1.0 - gap * (2.0 + std::sin(7.0 * a));
      curve.push_back(net.add({r * std::cos(a), r * std::sin(a), gap * std::cos(5.0 * a)}));
    }
    curve.push_back(curve.front());
    net.curve.push_back(curve);
    constexpr double k_step = 0.06;
    Sampled s(net, k_step);
    const double at_least_step = 2.0 * 2.0 * k_pi / (0.02 * k_step);
    CHECK(s.samples.position.size() < 2.5 * at_least_step);
    CHECK((s.samples.too_short == 0) == (gap >= 1e-4));
  }
}

TEST_CASE("Curves that lie on each other have the same samples there") {
  Net net;
  const Vec3 a = {0.1, 0.2, 0.3}, b = {1.1, 0.4, -0.2};
  const auto at = [&](double t) { return net.add(a + t * (b - a)); };
  const uint32_t from = at(0.0), to = at(1.0);
  net.edge(from, to);
  net.curve.push_back({from, at(0.3), at(0.65), to});
  net.edge(at(0.123), at(0.777));
  const Sampled s(net, 0.02);
  CHECK(s.samples.position.size() < 500);
  // Each sample of one curve that lies within another's extent is a sample of that, bit for bit.
  size_t alone = 0;
  for (uint32_t i = s.samples.start[1]; i < s.samples.start[2]; ++i) {
    bool found = false;
    for (uint32_t k = s.samples.start[0]; k < s.samples.start[1]; ++k) {
      found = found || s.samples.position[s.samples.at[i]] == s.samples.position[s.samples.at[k]];
    }
    alone += !found;
  }
  CHECK(alone == 0);
}

TEST_CASE("Circles a ten-thousandth apart are sampled like one") {
  Net net;
  for (const double z : {0.0, 1e-4}) add_circle(net, {0, 0, z}, {1, 0, 0}, {0, 1, 0}, 96, {});
  CHECK(Sampled(net, 0.05).samples.position.size() < 600);
}
