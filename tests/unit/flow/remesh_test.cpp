#include "flow/remesh.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <map>

#include "flow/robustness.h"

using namespace flow_tests;
using namespace wireskin::flow;

namespace {

using Edge = std::pair<uint32_t, uint32_t>;

// A surface, and where more than two of its sheets meet, before and after it became a mesh.
struct Meshed {
  unit::Heap heap;
  Flow flow{heap.context};
  Reconstruction result{heap.context};
  FlowMesh mesh{heap.context};

  Meshed(const Net& net, double eps, double spacing) {
    const NetArrays arrays(net);
    FlowOptions options;
    options.sampling = eps;
    unit::must(build_flow(heap.context, arrays.view(), options, &flow));
    unit::must(reconstruct(heap.context, flow, {}, &result));
    unit::must(mesh_patches(heap.context, flow, result, spacing, &mesh));
  }
  // Edges of the walls off the curves where more than two triangles meet.
  size_t shared_in_walls() const {
    size_t count = 0;
    for (uint32_t e = 0; e < flow.complex.edge_count(); ++e) {
      count += result.topology.walls.degree[e] > 2 && !flow.curves.on_curve(e);
    }
    return count;
  }
  std::map<Edge, int> edges_of_mesh() const {
    std::map<Edge, int> count;
    for (size_t t = 0; t < mesh.triangle.size(); t += 3) {
      for (size_t k = 0; k < 3; ++k) {
        const uint32_t a = mesh.triangle[t + k], b = mesh.triangle[t + (k + 1) % 3];
        ++count[{std::min(a, b), std::max(a, b)}];
      }
    }
    return count;
  }
  bool is_segment(const Edge& e) const {
    const uint32_t u = mesh.sample[e.first], v = mesh.sample[e.second];
    if (u == k_none || v == k_none) return false;
    const uint32_t edge = find_edge(flow.complex, flow.complex.same_as[u], flow.complex.same_as[v]);
    return edge != k_none && flow.curves.on_curve(edge);
  }
  size_t shared_in_mesh() const {
    size_t count = 0;
    for (const auto& [edge, triangles] : edges_of_mesh()) {
      count += triangles > 2 && !is_segment(edge);
    }
    return count;
  }
  size_t segments_with(int triangles) const {
    size_t count = 0;
    for (const auto& [edge, of_edge] : edges_of_mesh()) {
      count += of_edge == triangles && is_segment(edge);
    }
    return count;
  }
  double area() const {
    double twice = 0.0;
    for (size_t t = 0; t < mesh.triangle.size(); t += 3) {
      const Vec3 &a = mesh.position[mesh.triangle[t]], &b = mesh.position[mesh.triangle[t + 1]];
      twice += length(cross(b - a, mesh.position[mesh.triangle[t + 2]] - a));
    }
    return 0.5 * twice;
  }
};

Net scaled(Net net, double factor) {
  for (Vec3& p : net.vertex) p = factor * p;
  return net;
}

}  // namespace

TEST_CASE("Sheets that share an ear short of a curve go on to it, each by itself") {
  for (uint32_t seed = 1; seed <= 5; ++seed) {
    CAPTURE(seed);
    const Meshed sphere(scaled(noisy(great_circles(), 0.002, seed), 0.3), 0.02, 0.02);
    REQUIRE(sphere.result.betti[2] == 1);
    REQUIRE(sphere.shared_in_walls() > 0);
    CHECK(sphere.shared_in_mesh() == 0);
    CHECK(sphere.mesh.crossings == 0);
    // Both sheets at every segment, and no third triangle.
    CHECK(sphere.segments_with(2) > 100);
    CHECK(sphere.segments_with(1) + sphere.segments_with(3) == 0);
  }
}

TEST_CASE("Where no sheets merge the mesh has the area of the walls") {
  const Meshed cube(scaled(lattice(1, 1, 1), 0.5), 0.02, 0.02);
  CHECK(cube.shared_in_mesh() == 0);
  CHECK(cube.mesh.crossings == 0);
  CHECK(cube.area() == doctest::Approx(1.5).epsilon(1e-9));
  CHECK(cube.segments_with(2) ==
        cube.flow.samples.at.size() - (cube.flow.samples.start.size() - 1));
}
