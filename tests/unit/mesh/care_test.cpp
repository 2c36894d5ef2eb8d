#include "mesh/care.h"

#include <doctest/doctest.h>

#include "support/meshes.h"

using namespace unit;
using namespace wireskin::mesh;

namespace {

constexpr uint32_t k_side = 13;

struct Sheet {
  Mesh mesh = grid(k_side, k_side, 1.0);
  std::vector<uint32_t> patch;
  std::vector<uint8_t> held;

  Sheet() {
    for (size_t t = 0; t < mesh.triangle.size() / 3; ++t) patch.push_back(0);
    for (uint32_t v = 0; v < mesh.vertices(); ++v) {
      const uint32_t i = v % k_side, j = v / k_side;
      held.push_back(i == 0 || j == 0 || i == k_side - 1 || j == k_side - 1);
    }
  }
  Movable movable() { return {span(mesh.position), span(mesh.triangle), view(patch), view(held)}; }
  uint32_t vertex(uint32_t i, uint32_t j) const { return j * k_side + i; }
};

uint32_t unfolded(Sheet& sheet, std::vector<uint32_t> folds = {7}) {
  Heap heap;
  must(unfold(heap.context, sheet.movable(), span(folds)));
  return folds[0];
}

uint32_t facing_down(const Sheet& sheet) {
  uint32_t count = 0;
  for (size_t t = 0; t < sheet.mesh.triangle.size(); t += 3) {
    const uint32_t* v = &sheet.mesh.triangle[t];
    const auto& p = sheet.mesh.position;
    count += cross(p[v[1]] - p[v[0]], p[v[2]] - p[v[0]]).z <= 0.0;
  }
  return count;
}

}  // namespace

TEST_CASE("a mesh without folds stays as it is, bit for bit") {
  Sheet sheet;
  for (Vec3& p : sheet.mesh.position) p.z = 0.3 * p.x * p.x;
  const Mesh before = sheet.mesh;
  CHECK(unfolded(sheet) == 0);
  CHECK(sheet.mesh.triangle == before.triangle);
  CHECK(sheet.mesh.position == before.position);
}

TEST_CASE("vertices pulled over their neighbours come back") {
  Sheet sheet;
  sheet.mesh.position[sheet.vertex(6, 6)] += Vec3{2.6, 0.3, 0.0};
  sheet.mesh.position[sheet.vertex(3, 8)] += Vec3{-0.2, -1.9, 0.0};
  const std::vector<Vec3> before = sheet.mesh.position;
  REQUIRE(facing_down(sheet) > 0);
  CHECK(unfolded(sheet) == 0);
  CHECK(facing_down(sheet) == 0);
  for (uint32_t v = 0; v < sheet.mesh.vertices(); ++v) {
    if (sheet.held[v]) CHECK(sheet.mesh.position[v] == before[v]);
  }
  CHECK(sheet.mesh.position[sheet.vertex(11, 2)] == before[sheet.vertex(11, 2)]);  // far away
}

TEST_CASE("two patches: only the folded one moves") {
  Sheet sheet;
  for (uint32_t v = 0; v < sheet.mesh.vertices(); ++v) {
    if (v % k_side == 6) sheet.held[v] = 1;
  }
  for (size_t t = 0; t < sheet.patch.size(); ++t) {
    const uint32_t* v = &sheet.mesh.triangle[3 * t];
    for (int k = 0; k < 3; ++k) {
      if (v[k] % k_side > 6) sheet.patch[t] = 1;
    }
  }
  sheet.mesh.position[sheet.vertex(3, 6)] += Vec3{0.0, 2.7, 0.0};
  const std::vector<Vec3> before = sheet.mesh.position;
  Heap heap;
  std::vector<uint32_t> folds = {5, 5};
  must(unfold(heap.context, sheet.movable(), span(folds)));
  CHECK(folds == std::vector<uint32_t>{0, 0});
  CHECK(sheet.mesh.position[sheet.vertex(3, 6)] != before[sheet.vertex(3, 6)]);
  for (uint32_t v = 0; v < sheet.mesh.vertices(); ++v) {
    if (v % k_side >= 6) CHECK(sheet.mesh.position[v] == before[v]);
  }
}

TEST_CASE("a hairpin of held vertices is rounded by more than one edge") {
  // A wall stands on a curve that turns back on itself; of the middle vertex only one edge goes up,
  // between two triangles that face against each other.
  Sheet sheet;
  for (Vec3& p : sheet.mesh.position) {
    const double x = p.x - 6.0;
    p = {std::fabs(x), 0.5 * x, p.y};
  }
  uint32_t turns = 0;
  for (size_t h = 0; h < sheet.mesh.triangle.size(); ++h) {
    turns += sheet.mesh.triangle[h] == sheet.vertex(6, 0);
  }
  CHECK(turns <= 3);
  CHECK(unfolded(sheet) == 0);
}

TEST_CASE("what cannot be unfolded is counted") {
  // All vertices but one are held, in a heap: no place of that one helps.
  Sheet sheet;
  for (uint32_t v = 0; v < sheet.mesh.vertices(); ++v) sheet.held[v] = v != sheet.vertex(6, 6);
  sheet.mesh.position[sheet.vertex(5, 6)] += Vec3{4.0, 0.0, 0.0};
  sheet.mesh.position[sheet.vertex(7, 6)] += Vec3{-4.0, 0.0, 0.0};
  CHECK(unfolded(sheet) > 0);
}
