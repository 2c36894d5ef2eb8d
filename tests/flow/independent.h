// What the tests of flow count and check by their own means: Betti numbers by reducing the boundary
// matrix, and crossings of triangles pair by pair. Nothing here looks at the library's bookkeeping.
#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <set>
#include <vector>

#include "num/predicates3.h"
#include "num/vec.h"

namespace flow_tests {

using wireskin::Vec3;

using Corners = std::array<uint32_t, 3>;
using Pair = std::array<uint32_t, 2>;

struct Betti {
  long b0, b1, b2;
  bool operator==(const Betti& other) const {
    return b0 == other.b0 && b1 == other.b1 && b2 == other.b2;
  }
};

inline Pair sorted_pair(uint32_t a, uint32_t b) {
  return a < b ? Pair{a, b} : Pair{b, a};
}

// Of the complex of the triangles and of more edges and vertices, over the field of two elements.
inline Betti betti_numbers(const std::vector<Corners>& triangles, const std::vector<Pair>& edges,
                           const std::vector<uint32_t>& points) {
  std::map<Pair, uint32_t> edge_number;
  std::set<uint32_t> vertices(points.begin(), points.end());
  const auto number_of = [&](uint32_t a, uint32_t b) {
    vertices.insert(a);
    vertices.insert(b);
    return edge_number.emplace(sorted_pair(a, b), uint32_t(edge_number.size())).first->second;
  };
  for (const Pair& e : edges) number_of(e[0], e[1]);
  std::vector<std::vector<uint32_t>> column;
  for (const Corners& t : triangles) {
    std::vector<uint32_t> c = {number_of(t[0], t[1]), number_of(t[1], t[2]), number_of(t[2], t[0])};
    std::sort(c.begin(), c.end());
    column.push_back(c);
  }
  // Rank of the second boundary matrix: columns are reduced until their last entries differ.
  std::map<uint32_t, size_t> owner;
  long rank2 = 0;
  for (size_t i = 0; i < column.size(); ++i) {
    while (!column[i].empty()) {
      const auto found = owner.find(column[i].back());
      if (found == owner.end()) {
        owner[column[i].back()] = i;
        ++rank2;
        break;
      }
      std::vector<uint32_t> sum;
      std::set_symmetric_difference(column[i].begin(), column[i].end(),
                                    column[found->second].begin(), column[found->second].end(),
                                    std::back_inserter(sum));
      column[i] = sum;
    }
  }
  // Rank of the first: vertices less components.
  std::map<uint32_t, uint32_t> parent;
  for (const uint32_t v : vertices) parent[v] = v;
  const auto root = [&](uint32_t v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  long rank1 = 0;
  for (const auto& e : edge_number) {
    const uint32_t a = root(e.first[0]), b = root(e.first[1]);
    if (a == b) continue;
    parent[a] = b;
    ++rank1;
  }
  return {long(vertices.size()) - rank1, long(edge_number.size()) - rank1 - rank2,
          long(triangles.size()) - rank2};
}

// ---- Crossings ----------------------------------------------------------------------------------

inline int side(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p) {
  const double d = wireskin::orient3d(a, b, c, p);
  return (d > 0) - (d < 0);
}

// Whether the open segment pq passes through the inside of the triangle or of one of its edges.
inline bool pierces(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& c) {
  const int sp = side(a, b, c, p), sq = side(a, b, c, q);
  if (sp * sq >= 0) return false;
  const int ab = side(p, q, a, b), bc = side(p, q, b, c), ca = side(p, q, c, a);
  const int least = std::min({ab, bc, ca}), most = std::max({ab, bc, ca});
  if (least < 0 && most > 0) return false;
  return (ab == 0) + (bc == 0) + (ca == 0) < 2;  // two zeros: it only passes a corner
}

// Pairs of triangles that pierce each other, by a sweep along x over all pairs.
inline size_t count_crossings(const std::vector<Vec3>& position,
                              const std::vector<Corners>& triangles) {
  struct Box {
    Vec3 low, high;
    uint32_t triangle;
  };
  std::vector<Box> boxes;
  for (uint32_t t = 0; t < triangles.size(); ++t) {
    Box box = {position[triangles[t][0]], position[triangles[t][0]], t};
    for (const uint32_t v : triangles[t]) {
      const Vec3& p = position[v];
      box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y), std::min(box.low.z, p.z)};
      box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y), std::max(box.high.z, p.z)};
    }
    boxes.push_back(box);
  }
  std::sort(boxes.begin(), boxes.end(),
            [](const Box& a, const Box& b) { return a.low.x < b.low.x; });
  size_t count = 0;
  for (size_t i = 0; i < boxes.size(); ++i) {
    for (size_t k = i + 1; k < boxes.size() && boxes[k].low.x <= boxes[i].high.x; ++k) {
      if (boxes[k].low.y > boxes[i].high.y || boxes[i].low.y > boxes[k].high.y) continue;
      if (boxes[k].low.z > boxes[i].high.z || boxes[i].low.z > boxes[k].high.z) continue;
      const Corners &s = triangles[boxes[i].triangle], &t = triangles[boxes[k].triangle];
      bool cross = false;
      for (int e = 0; e < 3 && !cross; ++e) {
        const Vec3 &a = position[s[e]], &b = position[s[(e + 1) % 3]];
        const Vec3 &c = position[t[e]], &d = position[t[(e + 1) % 3]];
        cross = pierces(a, b, position[t[0]], position[t[1]], position[t[2]]) ||
                pierces(c, d, position[s[0]], position[s[1]], position[s[2]]);
      }
      count += cross;
    }
  }
  return count;
}

}  // namespace flow_tests
