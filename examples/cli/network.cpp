#include "network.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

namespace wireskin_cli {

// Bits instead of numbers, so that NaN has a place in the order too.
static std::array<uint64_t, 3> position_bits(const Network& network, uint32_t vertex) {
  std::array<uint64_t, 3> bits;
  for (size_t k = 0; k < 3; ++k) {
    const double positive_zero = network.positions[3 * size_t{vertex} + k] + 0.0;
    std::memcpy(&bits[k], &positive_zero, sizeof positive_zero);
  }
  return bits;
}

static void number_nodes(Network& network) {
  std::vector<std::pair<std::array<uint64_t, 3>, uint32_t>> order(network.vertex_count());
  for (uint32_t v = 0; v < order.size(); ++v) order[v] = {position_bits(network, v), v};
  std::sort(order.begin(), order.end());
  network.nodes.resize(order.size());
  uint32_t node = 0;
  for (size_t i = 0; i < order.size(); ++i) {
    if (i == 0 || order[i].first != order[i - 1].first) node = order[i].second;
    network.nodes[order[i].second] = node;
  }
}

void identify_equal_positions(Network& network) {
  number_nodes(network);
  const auto same_point = [&network](uint32_t a, uint32_t b) {
    return network.nodes[a] == network.nodes[b];
  };
  std::vector<NetworkCurve> curves;
  for (NetworkCurve& curve : network.curves) {
    std::vector<uint32_t>& vertices = curve.vertices;
    // An instrument that rests gives the same place again and again.
    if (vertices.size() > 2) {
      vertices.erase(std::unique(vertices.begin(), vertices.end(), same_point), vertices.end());
    }
    if (vertices.size() < 2) {
      network.points.insert(network.points.end(), vertices.begin(), vertices.end());
      continue;
    }
    const bool ends_meet = network.nodes[vertices.front()] == network.nodes[vertices.back()];
    if (!curve.closed && vertices.size() > 2 && ends_meet) {
      curve.closed = true;
      vertices.pop_back();
    }
    curves.push_back(std::move(curve));
  }
  network.curves = std::move(curves);
}

struct FaceEdge {
  uint32_t low;
  uint32_t high;
  uint32_t face;
  uint32_t corner;  // the edge runs from this one to the next
};

static std::vector<FaceEdge> edges_of(const std::vector<NetworkCurve>& loops) {
  std::vector<FaceEdge> edges;
  for (uint32_t face = 0; face < loops.size(); ++face) {
    const std::vector<uint32_t>& v = loops[face].vertices;
    for (uint32_t i = 0; i < v.size(); ++i) {
      const uint32_t next = v[(i + 1) % v.size()];
      edges.push_back({std::min(v[i], next), std::max(v[i], next), face, i});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const FaceEdge& a, const FaceEdge& b) {
    return std::array<uint32_t, 4>{a.low, a.high, a.face, a.corner} <
           std::array<uint32_t, 4>{b.low, b.high, b.face, b.corner};
  });
  return edges;
}

static bool same_edge(const FaceEdge& a, const FaceEdge& b) {
  return a.low == b.low && a.high == b.high;
}

// One edge, the first of the `count` equal ones that start at `edge`.
static NetworkCurve curve_of(const std::vector<NetworkCurve>& loops, const FaceEdge* edge,
                             size_t count) {
  NetworkCurve curve;
  const NetworkCurve& loop = loops[edge->face];
  const size_t corner_count = loop.vertices.size();
  curve.vertices = {loop.vertices[edge->corner], loop.vertices[(edge->corner + 1) % corner_count]};
  curve.line = loop.line;
  curve.name = loop.name;
  curve.boundary = count == 1 && loop.boundary;
  for (size_t i = 0; i < count; ++i) curve.sharp = curve.sharp || loops[edge[i].face].sharp;
  return curve;
}

void add_faces(std::vector<NetworkCurve>&& loops, Network& network) {
  const std::vector<FaceEdge> edges = edges_of(loops);
  const bool shared = std::adjacent_find(edges.begin(), edges.end(), same_edge) != edges.end();
  if (!shared) {
    for (NetworkCurve& loop : loops) network.curves.push_back(std::move(loop));
    return;
  }
  for (size_t i = 0; i < edges.size();) {
    size_t count = 1;
    while (i + count < edges.size() && same_edge(edges[i], edges[i + count])) ++count;
    if (edges[i].low != edges[i].high) {
      network.curves.push_back(curve_of(loops, &edges[i], count));
    }
    i += count;
  }
}

}  // namespace wireskin_cli
