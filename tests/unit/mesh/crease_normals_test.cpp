#include "mesh/crease_normals.h"

#include <doctest/doctest.h>

#include "support/meshes.h"

using namespace unit;
using namespace wireskin::mesh;

namespace {

struct Creases {
  Heap heap;
  CornerNormals normals{heap.context};

  Creases(const std::vector<Vec3>& positions, const std::vector<uint32_t>& triangles,
          std::vector<uint8_t> on_curve = {}) {
    if (on_curve.empty()) on_curve.assign(positions.size(), 1);
    must(find_crease_normals(heap.context, view(positions), view(triangles), view(on_curve),
                             &normals));
  }
  std::vector<uint32_t> corners() const { return {normals.corner.begin(), normals.corner.end()}; }
};

Vec3 normal_of(const std::vector<Vec3>& p, const std::vector<uint32_t>& t, uint32_t corner) {
  const uint32_t* v = &t[corner / 3 * 3];
  return wireskin::unit(cross(p[v[1]] - p[v[0]], p[v[2]] - p[v[0]]));
}

const std::vector<Vec3> k_cube = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                  {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
const std::vector<uint32_t> k_cube_triangles = {0, 2, 1, 0, 3, 2, 4, 5, 6, 4, 6, 7,
                                                0, 1, 5, 0, 5, 4, 1, 2, 6, 1, 6, 5,
                                                2, 3, 7, 2, 7, 6, 3, 0, 4, 3, 4, 7};

// Two rectangles that share an edge, the second turned up by an angle of this tangent.
std::vector<Vec3> roof(double tangent) {
  return {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {1, 2, tangent}, {0, 2, tangent}};
}
const std::vector<uint32_t> k_roof_triangles = {0, 1, 2, 0, 2, 3, 3, 2, 4, 3, 4, 5};

}  // namespace

TEST_CASE("crease normals: every corner of a cube has the normal of its own face") {
  const Creases cube(k_cube, k_cube_triangles);
  REQUIRE(cube.corners().size() == 36);
  for (uint32_t h = 0; h < 36; ++h) {
    CHECK(cube.corners()[h] == h);
    CHECK(length(cube.normals.normal[h] - normal_of(k_cube, k_cube_triangles, h)) < 1e-15);
  }
}

TEST_CASE("crease normals: an edge of 21 degrees is a crease, one of 19 is not") {
  const Creases steep(roof(0.3839), k_roof_triangles);  // tan 21
  // The corners at vertices 2 and 3, and no others.
  CHECK(steep.corners() == std::vector<uint32_t>{2, 4, 5, 6, 7, 9});
  for (uint32_t i = 0; i < 6; ++i) {
    const Vec3 face = normal_of(roof(0.3839), k_roof_triangles, steep.corners()[i]);
    CHECK(length(steep.normals.normal[i] - face) < 1e-15);
  }
  CHECK(Creases(roof(0.3443), k_roof_triangles).corners().empty());  // tan 19
}

TEST_CASE("crease normals: only edges of curves are creases") {
  CHECK(Creases(roof(1.0), k_roof_triangles, {0, 0, 1, 0, 0, 0}).corners().empty());
  CHECK(Creases(roof(1.0), k_roof_triangles, {0, 0, 1, 1, 0, 0}).corners().size() == 6);
}

TEST_CASE("crease normals: a triangle without area is no crease") {
  // Vertex 4 lies on the edge from 1 to 2.
  const std::vector<Vec3> flat = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {2, 0, 0}, {1, 0.5, 0}};
  CHECK(Creases(flat, {0, 1, 4, 0, 4, 2, 1, 2, 4, 1, 3, 2}).corners().empty());
}

TEST_CASE("crease normals: a crease that ends inside the surface leaves its end alone") {
  // A fan of six triangles round vertex 0, folded along the edge from 0 to 1 alone.
  const std::vector<Vec3> fan = {{0, 0, 0},  {1, 0, 0.6},   {0.5, 1, 0}, {-0.5, 1, 0},
                                 {-1, 0, 0}, {-0.5, -1, 0}, {0.5, -1, 0}};
  const std::vector<uint32_t> triangles = {0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 5, 0, 5, 6, 0, 6, 1};
  const Creases creases(fan, triangles, {1, 1, 0, 0, 0, 0, 0});
  // Vertex 0 keeps one sector; vertex 1, on the border, has two.
  CHECK(creases.corners() == std::vector<uint32_t>{1, 17});
}

TEST_CASE("crease normals: where three sheets meet, or two only touch, each has its own") {
  // Three rectangles at the z axis.
  const std::vector<Vec3> book = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0},  {1, 0, 1},
                                  {0, 1, 0}, {0, 1, 1}, {-1, 0, 0}, {-1, 0, 1}};
  const std::vector<uint32_t> pages = {0, 2, 3, 0, 3, 1, 0, 4, 5, 0, 5, 1, 0, 6, 7, 0, 7, 1};
  const Creases three(book, pages, std::vector<uint8_t>(8, 0));
  CHECK(three.corners() == std::vector<uint32_t>{0, 3, 5, 6, 9, 11, 12, 15, 17});
  for (size_t i = 0; i < 9; ++i) {
    const Vec3 face = normal_of(book, pages, three.corners()[i]);
    CHECK(length(three.normals.normal[i] - face) < 1e-15);
  }
  // Two triangles that share a corner.
  const std::vector<Vec3> bow = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, 0, 1}};
  const Creases two(bow, {0, 1, 2, 0, 3, 4});
  CHECK(two.corners() == std::vector<uint32_t>{0, 3});
  CHECK(two.normals.normal[0] == Vec3{0, 0, 1});
  CHECK(two.normals.normal[1] == Vec3{0, 1, 0});
}
