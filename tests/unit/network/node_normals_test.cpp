#include "network/node_normals.h"

#include <doctest/doctest.h>

#include "support/curve_nets.h"

using namespace unit;
using namespace wireskin::network;
using wireskin::Code;
using wireskin::dot;

namespace {

// Straight curves without normals between the given nodes.
struct Wires {
  Heap heap;
  wireskin::curves::Curves curves{heap.context};
  std::vector<Node> nodes;

  Wires(const std::vector<Vec3>& points, const std::vector<std::pair<uint32_t, uint32_t>>& edges) {
    for (uint32_t i = 0; i < points.size(); ++i) nodes.push_back({points[i], {}, i + 10});
    for (Node& n : nodes) {
      n.crease = true;
      n.certain = false;
    }
    for (const auto& e : edges) {
      const std::vector<Vec3> position = {
          points[e.first], 0.5 * (points[e.first] + points[e.second]), points[e.second]};
      const std::vector<Vec3> normal(3);
      const std::vector<uint32_t> node = {e.first, k_none, e.second};
      must(wireskin::curves::add_curve({view(position), view(normal), view(node), false}, &curves));
    }
  }
  Status complete() { return complete_node_normals(curves, {nodes.data(), nodes.size()}); }
};

std::vector<std::pair<uint32_t, uint32_t>> cube_edges() {
  std::vector<std::pair<uint32_t, uint32_t>> edges;
  for (uint32_t i = 0; i < 8; ++i) {
    for (uint32_t axis = 1; axis < 8; axis *= 2) {
      if ((i & axis) == 0) edges.push_back({i, i | axis});
    }
  }
  return edges;
}

std::vector<Vec3> cube_corners() {
  std::vector<Vec3> points;
  for (uint32_t i = 0; i < 8; ++i) {
    points.push_back({i & 1 ? 1. : 0., i & 2 ? 1. : 0., i & 4 ? 1. : 0.});
  }
  return points;
}

const std::vector<Vec3> k_tetrahedron = {{0, 0, 0}, {1, 0, 0}, {0.2, 0.9, 0}, {0.3, 0.3, 0.8}};
const std::vector<std::pair<uint32_t, uint32_t>> k_all_pairs = {{0, 1}, {0, 2}, {0, 3},
                                                                {1, 2}, {1, 3}, {2, 3}};

}  // namespace

TEST_CASE("node normals: corners of convex solids point outward") {
  Wires cube(cube_corners(), cube_edges());
  must(cube.complete());
  for (const Node& n : cube.nodes) {
    const Vec3 outward = wireskin::unit(n.position - Vec3{0.5, 0.5, 0.5});
    CHECK(wireskin::length(n.normal - outward) < 1e-9);
  }
  Wires tetrahedron(k_tetrahedron, k_all_pairs);
  must(tetrahedron.complete());
  for (const Node& n : tetrahedron.nodes) {
    CHECK(dot(n.normal, n.position - Vec3{0.375, 0.3, 0.2}) > 0.2);
  }
}

TEST_CASE("node normals: one that is known decides the sense of all") {
  for (double sense : {1.0, -1.0}) {
    Wires cube(cube_corners(), cube_edges());
    cube.nodes[5].normal = sense * wireskin::unit({1, -0.5, 1});
    must(cube.complete());
    for (const Node& n : cube.nodes) {
      CHECK(sense * dot(n.normal, n.position - Vec3{0.5, 0.5, 0.5}) > 0.5);
    }
  }
}

TEST_CASE("node normals: what is certain stays") {
  Wires cube(cube_corners(), cube_edges());
  const Vec3 given = wireskin::unit({1, -0.5, 1});
  cube.nodes[5].normal = given;
  cube.nodes[5].certain = true;
  must(cube.complete());
  CHECK(cube.nodes[5].normal == given);
}

TEST_CASE("node normals: of a flat network nothing tells the outer side") {
  Wires flat({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, -1, 0}}, k_all_pairs);
  const Status s = flat.complete();
  CHECK(s.code == Code::missing_normals);
  CHECK(s.place.node == 10);
  Wires below({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, -1, 0}}, k_all_pairs);
  below.nodes[2].normal = {0, 0, -1};
  must(below.complete());
  for (const Node& n : below.nodes) CHECK(n.normal.z == doctest::Approx(-1));
}
