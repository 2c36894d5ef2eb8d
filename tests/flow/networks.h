// Curve networks for the tests of surfaces from curves alone: those of the data folder and those
// made here, and what is known of them.
#pragma once

#include <array>
#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "flow/flow.h"
#include "support/context.h"

namespace flow_tests {

using unit::Vec3;
using wireskin::k_none;

struct Net {
  std::vector<Vec3> vertex;
  std::vector<std::vector<uint32_t>> curve;  // a closed one repeats its first vertex

  uint32_t add(const Vec3& p) {
    vertex.push_back(p);
    return static_cast<uint32_t>(vertex.size() - 1);
  }
  void edge(uint32_t a, uint32_t b) { curve.push_back({a, b}); }
};

inline Net read_obj(const std::string& file) {
  Net net;
  std::ifstream in(file);
  std::string line;
  while (std::getline(in, line)) {
    std::istringstream words(line);
    std::string key;
    words >> key;
    if (key == "v") {
      Vec3 p;
      words >> p.x >> p.y >> p.z;
      net.vertex.push_back(p);
    } else if (key == "l") {
      std::vector<uint32_t> curve;
      for (uint32_t i = 0; words >> i;) curve.push_back(i - 1);
      net.curve.push_back(curve);
    }
  }
  return net;
}

// The arrays behind a view of the net as the library reads it, scaled to an extent of about one.
struct NetArrays {
  std::vector<uint32_t> start, number;
  std::vector<Vec3> position;
  std::vector<uint8_t> closed;

  explicit NetArrays(const Net& net) {
    start.push_back(0);
    for (const auto& curve : net.curve) {
      const bool loop = curve.size() > 2 && curve.front() == curve.back();
      for (size_t i = 0; i < curve.size() - (loop ? 1 : 0); ++i) {
        position.push_back(net.vertex[curve[i]]);
        number.push_back(curve[i]);
      }
      closed.push_back(loop);
      start.push_back(static_cast<uint32_t>(position.size()));
    }
  }
  wireskin::flow::Polylines view() const {
    return {unit::span(start), unit::span(position), unit::span(number), unit::span(closed)};
  }
};

}  // namespace flow_tests
