#include "mesh/cut.h"

#include <doctest/doctest.h>

#include <set>

#include "support/meshes.h"

using namespace unit;
using namespace wireskin::mesh;

namespace {

// A grid of n x n squares, each cut along a diagonal; vertex (i, j) is j (n + 1) + i.
std::vector<uint32_t> grid(uint32_t n) {
  std::vector<uint32_t> triangles;
  for (uint32_t j = 0; j < n; ++j) {
    for (uint32_t i = 0; i < n; ++i) {
      const uint32_t a = j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
      triangles.insert(triangles.end(), {a, b, d, a, d, c});
    }
  }
  return triangles;
}

struct CutGrid {
  Heap heap;
  std::vector<uint32_t> triangles;
  Cut cut{heap.context};
  Array<uint32_t> twins{heap.context};
  Topology topology{heap.context};

  // `path`: vertices one after the other along which the mesh is cut.
  CutGrid(uint32_t n, const std::vector<std::vector<uint32_t>>& paths) : triangles(grid(n)) {
    std::set<std::pair<uint32_t, uint32_t>> edges;
    for (const auto& path : paths) {
      for (size_t k = 1; k < path.size(); ++k) {
        edges.insert({path[k - 1], path[k]});
        edges.insert({path[k], path[k - 1]});
      }
    }
    std::vector<uint8_t> marked;
    for (uint32_t h = 0; h < triangles.size(); ++h) {
      marked.push_back(edges.count({triangles[h], triangles[next_half_edge(h)]}) != 0);
    }
    const uint32_t vertices = (n + 1) * (n + 1);
    must(find_twins(vertices, view(triangles), &twins));
    must(cut_open(vertices, view(triangles), twins.span(), view(marked), &cut));
    for (uint32_t v = 0; v < vertices; ++v) CHECK(cut.origin[v] == v);
    for (size_t h = 0; h < triangles.size(); ++h) {
      CHECK(cut.origin[cut.triangle[h]] == triangles[h]);
    }
    must(find_twins(cut.vertices(), cut.triangle.span(), &twins));
    must(find_topology(cut.vertices(), cut.triangle.span(), twins.span(), &topology));
  }
};

}  // namespace

TEST_CASE("cut: nothing marked changes nothing") {
  const CutGrid g(4, {});
  CHECK(g.cut.vertices() == 25);
  for (size_t h = 0; h < g.triangles.size(); ++h) CHECK(g.cut.triangle[h] == g.triangles[h]);
}

TEST_CASE("cut: from border to border makes two components") {
  const CutGrid g(4, {{2, 7, 12, 17, 22}});
  CHECK(g.cut.vertices() == 30);
  CHECK(g.topology.components == 2);
  CHECK(g.topology.boundary_loops == 2);
}

TEST_CASE("cut: one that dies inside leaves its end one vertex") {
  const CutGrid g(4, {{2, 7, 12}});
  CHECK(g.cut.vertices() == 27);  // 2 and 7 have two copies, 12 one
  for (uint32_t c = 25; c < 27; ++c) CHECK((g.cut.origin[c] == 2 || g.cut.origin[c] == 7));
  CHECK(g.topology.components == 1);
  CHECK(g.topology.boundary_loops == 1);
  CHECK(g.topology.on_border[12]);
}

TEST_CASE("cut: inside the mesh it opens a slit") {
  const CutGrid g(4, {{7, 12, 17}});
  CHECK(g.cut.vertices() == 26);
  CHECK(g.topology.boundary_loops == 2);
  CHECK(g.topology.euler_characteristic == 0);
}

TEST_CASE("cut: a cross gives its middle four copies, a ring comes off") {
  const CutGrid cross(4, {{2, 7, 12, 17, 22}, {10, 11, 12, 13, 14}});
  CHECK(cross.cut.vertices() == 25 + 3 + 8);
  CHECK(cross.topology.components == 4);
  const CutGrid ring(4, {{6, 7, 8, 13, 18, 17, 16, 11, 6}});
  CHECK(ring.cut.vertices() == 25 + 8);
  CHECK(ring.topology.components == 2);
  CHECK(ring.topology.boundary_loops == 3);
}
