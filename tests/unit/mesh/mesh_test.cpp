#include "mesh/mesh.h"

#include <doctest/doctest.h>

#include <ctime>

#include "support/meshes.h"

using namespace unit;
using namespace wireskin::mesh;
using wireskin::Place;

namespace {

// Counts of a mesh that must pass both checks.
struct Counted {
  Heap heap;
  Array<uint32_t> twins{heap.context};
  Topology topology{heap.context};

  explicit Counted(const Mesh& mesh) {
    must(find_twins(mesh.vertices(), view(mesh.triangle), &twins));
    must(find_topology(mesh.vertices(), view(mesh.triangle), twins.span(), &topology));
  }
};

Status check(uint32_t vertices, const std::vector<uint32_t>& triangles) {
  Heap heap;
  Array<uint32_t> twins(heap.context);
  Topology topology(heap.context);
  Status status = find_twins(vertices, view(triangles), &twins);
  if (status.ok()) status = find_topology(vertices, view(triangles), twins.span(), &topology);
  return status;
}

// A fan of n triangles round one vertex, which is the first or the last.
std::vector<uint32_t> wheel(uint32_t n, bool hub_first) {
  std::vector<uint32_t> triangles;
  const uint32_t hub = hub_first ? 0 : n, rim = hub_first ? 1 : 0;
  for (uint32_t i = 0; i < n; ++i) {
    for (uint32_t v : {hub, rim + i, rim + (i + 1) % n}) triangles.push_back(v);
  }
  return triangles;
}

}  // namespace

TEST_CASE("mesh: half-edges of a triangle follow each other") {
  for (uint32_t h = 0; h < 30; ++h) {
    CHECK(next_half_edge(h) / 3 == h / 3);
    CHECK(previous_half_edge(next_half_edge(h)) == h);
    CHECK(next_half_edge(next_half_edge(next_half_edge(h))) == h);
    CHECK(next_half_edge(h) != h);
  }
}

TEST_CASE("mesh: twins run the other way, borders have none") {
  Random random(1);
  for (const Mesh& mesh :
       {icosahedron(), tube(9, 5, 2.0, true), tube(9, 5, 2.0, false), grid(7, 4, 1.0, &random)}) {
    Counted c(mesh);
    size_t borders = 0;
    for (uint32_t h = 0; h < c.twins.size(); ++h) {
      const uint32_t t = c.twins[h];
      if (t == k_none) {
        ++borders;
        CHECK(c.topology.on_border[mesh.triangle[h]] == 1);
        continue;
      }
      CHECK(c.twins[t] == h);
      CHECK(mesh.triangle[t] == mesh.triangle[next_half_edge(h)]);
      CHECK(mesh.triangle[next_half_edge(t)] == mesh.triangle[h]);
    }
    CHECK(c.topology.edges == (mesh.triangle.size() + borders) / 2);
  }
}

TEST_CASE("mesh: closed surfaces") {
  Counted tetra(tetrahedron());
  CHECK(tetra.topology.edges == 6);
  CHECK(tetra.topology.euler_characteristic == 2);
  CHECK(tetra.topology.boundary_loops == 0);
  CHECK(tetra.topology.components == 1);
  Counted icosa(icosahedron());
  CHECK(icosa.topology.edges == 30);
  CHECK(icosa.topology.euler_characteristic == 2);
  Counted torus(tube(8, 6, 0.0, true));
  CHECK(torus.topology.euler_characteristic == 0);
  CHECK(torus.topology.boundary_loops == 0);
  for (uint8_t border : torus.topology.on_border) CHECK(border == 0);
}

TEST_CASE("mesh: surfaces with border") {
  Counted annulus(tube(8, 4, 1.0, false));
  CHECK(annulus.topology.euler_characteristic == 0);
  CHECK(annulus.topology.boundary_loops == 2);
  for (uint32_t v = 0; v < 32; ++v) {
    CHECK(annulus.topology.on_border[v] == (v < 8 || v >= 24 ? 1 : 0));
  }
  Counted disc(grid(5, 3, 1.0));
  CHECK(disc.topology.euler_characteristic == 1);
  CHECK(disc.topology.boundary_loops == 1);
  CHECK(disc.topology.edges == 22 + 8);
  Counted triangle({{{}, {}, {}}, {0, 1, 2}});
  CHECK(triangle.topology.euler_characteristic == 1);
  CHECK(triangle.topology.boundary_loops == 1);
}

TEST_CASE("mesh: components are numbered by their least vertex") {
  // 0 3 5 and 1 2 6 7 and 4 8 9.
  Counted c({std::vector<Vec3>(10), {5, 0, 3, 7, 6, 1, 1, 6, 2, 9, 8, 4}});
  CHECK(c.topology.components == 3);
  CHECK(to_vector(c.topology.component) == std::vector<uint32_t>{0, 1, 1, 0, 2, 0, 1, 1, 2, 2});
  CHECK(c.topology.boundary_loops == 3);
  CHECK(c.topology.euler_characteristic == 3);
}

TEST_CASE("mesh: what is no oriented manifold is named") {
  SUBCASE("Moebius strip") {
    // A strip of six triangles over vertices 0 .. 5 whose end is glued on twisted.
    const Status s = check(6, {0, 1, 2, 2, 1, 3, 2, 3, 4, 4, 3, 5, 4, 5, 1, 1, 5, 0});
    CHECK(s.code == Code::bad_mesh);
    CHECK(s.place.triangle == 5);
  }
  SUBCASE("neighbours of opposite orientation") {
    const Status s = check(4, {0, 1, 2, 0, 1, 3});
    CHECK(s.code == Code::bad_mesh);
    CHECK(s.place.triangle == 1);
  }
  SUBCASE("three triangles at an edge") {
    const Status s = check(5, {0, 1, 2, 1, 0, 3, 0, 1, 4});
    CHECK(s.code == Code::bad_mesh);
    CHECK(s.place.triangle == 2);
  }
  SUBCASE("bow tie") {
    const Status s = check(5, {1, 2, 0, 0, 3, 4});
    CHECK(s.code == Code::bad_mesh);
    CHECK(s.place.vertex == 0);
    CHECK(s.place.triangle == k_none);
  }
  SUBCASE("two closed surfaces that share a vertex") {
    const Status s =
        check(7, {0, 1, 2, 0, 3, 1, 0, 2, 3, 1, 3, 2, 3, 4, 5, 3, 6, 4, 3, 5, 6, 4, 6, 5});
    CHECK(s.code == Code::bad_mesh);
    CHECK(s.place.vertex == 3);
  }
  SUBCASE("a closed fan and an open one at a vertex") {
    const Status s = check(6, {0, 1, 2, 0, 3, 1, 0, 2, 3, 1, 3, 2, 3, 4, 5});
    CHECK(s.code == Code::bad_mesh);
    CHECK(s.place.vertex == 3);
  }
  SUBCASE("vertex without triangle") {
    const Status s = check(5, {0, 1, 2, 4, 2, 1});
    CHECK(s.code == Code::bad_mesh);
    CHECK(s.place.vertex == 3);
  }
  SUBCASE("no triangle at all") {
    CHECK(check(1, {}).code == Code::bad_mesh);
  }
  SUBCASE("bad index") {
    const Status s = check(3, {0, 1, 2, 0, 2, 3});
    CHECK(s.code == Code::index_out_of_range);
    CHECK(s.place.triangle == 1);
  }
  SUBCASE("greatest index") {
    CHECK(check(3, {0, 1, k_none}).code == Code::index_out_of_range);
  }
  SUBCASE("repeated vertex") {
    for (const auto& t : {std::vector<uint32_t>{0, 0, 1}, {0, 1, 0}, {1, 0, 0}}) {
      const Status s = check(2, t);
      CHECK(s.code == Code::bad_mesh);
      CHECK(s.place.triangle == 0);
    }
  }
}

TEST_CASE("mesh: corners list the triangles of every vertex in order") {
  Heap heap;
  const Mesh mesh = icosahedron();
  Array<uint32_t> start(heap.context), corner(heap.context);
  must(find_corners(12, view(mesh.triangle), &start, &corner));
  CHECK(start[0] == 0);
  CHECK(start[12] == 60);
  for (uint32_t v = 0; v < 12; ++v) {
    CHECK(start[v + 1] - start[v] == 5);
    for (uint32_t k = start[v]; k < start[v + 1]; ++k) {
      CHECK(mesh.triangle[corner[k]] == v);
      if (k > start[v]) CHECK(corner[k] > corner[k - 1]);
    }
  }
}

// Comparing each of the triangles with each would take most of a minute.
TEST_CASE("mesh: a vertex of any valence costs linear time") {
  for (bool hub_first : {true, false}) {
    const uint32_t n = 200000;
    const std::clock_t begin = std::clock();
    CHECK(check(n + 1, wheel(n, hub_first)).ok());
    const double seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    CHECK(seconds < 5.0);
  }
}

TEST_CASE("mesh: triangles without area") {
  const std::vector<Vec3> position = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}};
  const std::vector<uint32_t> good = {0, 1, 2}, flat = {0, 1, 2, 0, 1, 3};
  Heap heap;
  CHECK(check_areas(heap.context, view(position), view(good)).ok());
  const Status s = check_areas(heap.context, view(position), view(flat));
  CHECK(s.code == Code::bad_mesh);
  CHECK(s.place.triangle == 1);
}

TEST_CASE("mesh: least angles") {
  const double root = std::sqrt(3.0);
  const std::vector<Vec3> position = {{0, 0, 0},    {1, 0, 0},          {0, 1, 0},
                                      {root, 0, 0}, {.5, .5 * root, 0}, {1000, 1, 0}};
  const auto angle = [&](const std::vector<uint32_t>& t) {
    return least_angle_of(view(position), view(t));
  };
  CHECK(angle({0, 1, 2}) == doctest::Approx(45.0).epsilon(1e-15));
  CHECK(angle({0, 3, 2}) == doctest::Approx(30.0).epsilon(1e-14));
  CHECK(angle({0, 1, 4}) == doctest::Approx(60.0).epsilon(1e-14));
  CHECK(angle({0, 1, 4, 0, 3, 2, 0, 1, 2}) == doctest::Approx(30.0).epsilon(1e-14));
  CHECK(angle({1, 2, 0, 3, 2, 0, 1, 4, 0}) == doctest::Approx(30.0).epsilon(1e-14));
  const double needle = 180.0 / k_pi * (std::atan2(1.0, 999.0) - std::atan2(1.0, 1000.0));
  CHECK(angle({0, 1, 5}) == doctest::Approx(needle).epsilon(1e-8));
}
