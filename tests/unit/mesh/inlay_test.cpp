#include "mesh/inlay.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "mesh/band.h"
#include "mesh/chart.h"
#include "mesh/loop_mesh.h"
#include "mesh/mesh.h"
#include "num/predicates.h"
#include "support/meshes.h"

using namespace unit;
using namespace wireskin;

namespace {

// The tube of radius 1 between z = 0 and z = height.
struct Tube {
  Heap heap;
  std::vector<uint32_t> start = {0, 40, 80};
  std::vector<Vec3> rim;
  Array<Vec3> position{heap.context};
  Array<uint32_t> triangle{heap.context};

  explicit Tube(double height, double spacing = 0.16) {
    std::vector<Vec3> normal;
    for (int end = 0; end < 2; ++end) {
      for (int i = 0; i < 40; ++i) {
        const double t = (end == 0 ? 1 : -1) * 2 * k_pi * i / 40;
        rim.push_back({std::cos(t), std::sin(t), end * height});
        normal.push_back({std::cos(t), std::sin(t), 0});
      }
    }
    mesh::LoopMesh mesh(heap.context);
    must(mesh::mesh_band(heap.context, {loops(), {rim.data(), 80}, {normal.data(), 80}}, spacing,
                         &mesh));
    for (const Vec3& p : rim) must(position.push(p));
    for (const Vec3& p : mesh.inner) must(position.push(p));
    must(triangle.copy(mesh.triangle.span()));
  }
  Span<const uint32_t> loops() const { return {start.data(), 3}; }

  Status inlay(const std::vector<Vec3>& point, const std::vector<uint32_t>& edge) {
    return mesh::inlay_curves(heap.context, loops(),
                              {{point.data(), point.size()}, {edge.data(), edge.size()}}, 0.16,
                              &position, &triangle);
  }
  // All points where they were given, all edges there, still an annulus without needles.
  void check(const std::vector<Vec3>& point, const std::vector<uint32_t>& edge) {
    const uint32_t n = static_cast<uint32_t>(position.size());
    Array<uint32_t> twins(heap.context);
    mesh::Topology topology(heap.context);
    must(mesh::find_twins(n, triangle.span(), &twins));
    must(mesh::find_topology(n, triangle.span(), twins.span(), &topology));
    CHECK(topology.euler_characteristic == 0);
    CHECK(topology.boundary_loops == 2);
    std::set<std::pair<uint32_t, uint32_t>> edges;
    for (uint32_t h = 0; h < triangle.size(); ++h) {
      const uint32_t a = triangle[h], b = triangle[mesh::next_half_edge(h)];
      edges.emplace(std::min(a, b), std::max(a, b));
    }
    for (size_t i = 0; i < 80; ++i) CHECK(position[i] == rim[i]);
    for (size_t i = 0; i < point.size(); ++i) CHECK(position[80 + i] == point[i]);
    for (size_t e = 0; e < edge.size(); e += 2) CHECK(edges.count({edge[e], edge[e + 1]}) == 1);
    CHECK(least_angle_of(position.span(), triangle.span()) > 3.0);
  }
};

Vec3 on_tube(double angle, double z, double radius = 1.0) {
  return {radius * std::cos(angle), radius * std::sin(angle), z};
}

}  // namespace

TEST_CASE("a chart of a tube and of a disc folds nothing and keeps loops on the circle") {
  for (const double height : {0.3, 2.0, 12.0}) {
    CAPTURE(height);
    const Tube tube(height);
    Heap heap;
    Array<Vec2> flat(heap.context);
    must(mesh::lay_flat(heap.context, tube.loops(), tube.position.span(), tube.triangle.span(),
                        &flat));
    REQUIRE(flat.size() == tube.position.size());
    for (size_t t = 0; t < tube.triangle.size(); t += 3) {
      CHECK(orient2d(flat[tube.triangle[t]], flat[tube.triangle[t + 1]],
                     flat[tube.triangle[t + 2]]) > 0.0);
    }
    double greatest = 0.0;
    for (size_t v = 80; v < flat.size(); ++v) greatest = std::fmax(greatest, length(flat[v]));
    CHECK(greatest < 1.0);
    for (size_t v = 0; v < 40; ++v) CHECK(length(flat[v]) == doctest::Approx(1.0));
  }
}

TEST_CASE("curves and points beside a tube become edges and vertices of it") {
  std::vector<Vec3> point;
  std::vector<uint32_t> edge;
  for (uint32_t i = 0; i <= 20; ++i) {
    point.push_back(on_tube(0.16 * i, 0.5 + 0.05 * i, 1.0 + 0.1 * std::sin(0.15 * i)));
    if (i > 0) edge.insert(edge.end(), {80 + i - 1, 80 + i});
  }
  point.push_back(on_tube(5.0, 1.0, 1.2));
  point.push_back(on_tube(4.0, 0.4));
  Tube tube(2.0);
  REQUIRE_MESSAGE(tube.inlay(point, edge).ok(), std::string("refused"));
  tube.check(point, edge);
  // The shift bends the tube gently: its farthest point is the highest one given, or nearly so.
  for (const Vec3& p : tube.position) {
    CHECK(std::hypot(p.x, p.y) < 1.25);
    CHECK(std::hypot(p.x, p.y) > 0.95);
  }
}

TEST_CASE("a curve that starts on a loop, and random points") {
  std::vector<Vec3> point;
  std::vector<uint32_t> edge = {0, 80};
  for (uint32_t i = 0; i < 10; ++i) {
    point.push_back(on_tube(0.05 * i, 0.15 * (i + 1)));
    if (i > 0) edge.insert(edge.end(), {80 + i - 1, 80 + i});
  }
  std::mt19937 random(3);
  std::uniform_real_distribution<double> angle(1.0, 5.8), height(0.2, 1.8), off(0.93, 1.07);
  for (int i = 0; i < 60; ++i) {
    point.push_back(on_tube(angle(random), height(random), off(random)));
  }
  Tube tube(2.0);
  REQUIRE(tube.inlay(point, edge).ok());
  const uint32_t n = static_cast<uint32_t>(tube.position.size());
  Array<uint32_t> twins(tube.heap.context);
  must(mesh::find_twins(n, tube.triangle.span(), &twins));
  for (size_t i = 0; i < point.size(); ++i) CHECK(tube.position[80 + i] == point[i]);
}

TEST_CASE("curves that cross, and curves that leave the tube, are refused by their point") {
  Tube tube(2.0);
  const std::vector<Vec3> crossing = {on_tube(0, 0.8), on_tube(0.3, 1.2), on_tube(0, 1.2),
                                      on_tube(0.3, 0.8)};
  const Status crossed = tube.inlay(crossing, {80, 81, 82, 83});
  CHECK(crossed.code == Code::patch_folded);
  CHECK(crossed.place.vertex >= 80);
  CHECK(crossed.place.vertex < 84);
  const std::vector<Vec3> outside = {on_tube(0, 1.5), on_tube(0.1, 2.5)};
  CHECK(Tube(2.0).inlay(outside, {80, 81}).code == Code::patch_folded);
}
