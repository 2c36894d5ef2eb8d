// Raw curves for tests of single stages: points in, Wires out.
#pragma once

#include <vector>

#include "network/wires.h"
#include "support/context.h"

namespace unit {

struct WireNet {
  Heap heap;
  wireskin::network::Wires wires{heap.context};

  WireNet() { must(wires.start.push(0)); }
  // Normals may be empty: none known.
  void add(const std::vector<Vec3>& points, bool closed = false,
           const std::vector<Vec3>& normals = {}, const std::vector<uint32_t>& numbers = {}) {
    const uint32_t c = wires.curves();
    for (uint32_t i = 0; i < points.size(); ++i) {
      must(wires.position.push(points[i]));
      must(wires.normal.push(normals.empty() ? Vec3{} : normals[i]));
      must(wires.number.push(numbers.empty() ? k_none : numbers[i]));
      must(wires.origin.push({c, i, 0.0}));
      must(wires.along.push({c, i, 0}));
    }
    must(wires.closed.push(closed));
    must(wires.boundary.push(0));
    must(wires.sharp.push(0));
    must(wires.soft.push(0.0));
    must(wires.start.push(wires.samples()));
  }
  void weld() { must(wireskin::network::weld(&wires)); }
  std::vector<Vec3> points_of(uint32_t c) const {
    return {wires.position.begin() + wires.start[c], wires.position.begin() + wires.start[c + 1]};
  }
};

// n + 1 points from a to b.
inline std::vector<Vec3> line(Vec3 a, Vec3 b, uint32_t n) {
  std::vector<Vec3> points;
  for (uint32_t i = 0; i <= n; ++i) {
    const double t = static_cast<double>(i) / n;
    points.push_back((1 - t) * a + t * b);
  }
  return points;
}

}  // namespace unit
