// What every network must satisfy that a reader hands over.
#pragma once

#include <string>

#include "network.h"

namespace cli_test {

// "" if the invariants of network.h hold, else the one that does not.
inline std::string broken_invariant(const wireskin_cli::Network& network) {
  const size_t count = network.vertex_count();
  if (network.positions.size() != 3 * count) return "positions";
  if (!network.normals.empty() && network.normals.size() != 3 * count) return "normals";
  if (!network.has_normal.empty() && network.has_normal.size() != count) return "has_normal";
  if (!network.has_normal.empty() && network.normals.empty()) return "has_normal alone";
  if (!network.nodes.empty() && network.nodes.size() != count) return "nodes";
  for (const uint32_t node : network.nodes) {
    if (node >= count || network.nodes[node] != node) return "node";
  }
  for (const wireskin_cli::NetworkCurve& curve : network.curves) {
    if (curve.vertices.empty()) return "empty curve";
    for (const uint32_t vertex : curve.vertices) {
      if (vertex >= count) return "vertex of a curve";
    }
  }
  for (const uint32_t point : network.points) {
    if (point >= count) return "point";
  }
  for (const wireskin_cli::RawCurve& curve : network.raw_curves) {
    const size_t samples = curve.arc_lengths.size();
    const bool whole = curve.tangents.size() == 3 * samples &&
                       curve.normals.size() == 3 * samples && curve.sample_lines.size() == samples;
    if (!whole || curve.nodes.size() != curve.global_nodes.size()) return "raw curve";
    if (!curve.nodes.empty() && curve.nodes.back() >= samples) return "raw node";
  }
  return "";
}

}  // namespace cli_test
