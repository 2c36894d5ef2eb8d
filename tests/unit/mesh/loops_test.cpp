// mesh_loops: patches with several borders; what it does with one stands in loop_mesh_test.cpp.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "mesh/loop_mesh.h"
#include "mesh/mesh.h"
#include "support/context.h"
#include "support/fails_cleanly.h"

using namespace unit;
using namespace wireskin;
using mesh::LoopMesh;

namespace {

constexpr double k_turn = 6.283185307179586;

// Circles round the axis z with normals away from it; those that run backwards have the patch
// below.
struct Circles {
  std::vector<uint32_t> start{0};
  std::vector<Vec3> position, normal;

  void add(double x, double radius, double z, uint32_t count, bool backwards) {
    for (uint32_t i = 0; i < count; ++i) {
      const double t = (backwards ? -1.0 : 1.0) * k_turn * i / count;
      const Vec3 out = {std::cos(t), std::sin(t), 0.0};
      position.push_back(radius * out + Vec3{x, 0.0, z});
      normal.push_back(out);
    }
    start.push_back(static_cast<uint32_t>(position.size()));
  }
  Status mesh(Context& context, double spacing, LoopMesh* result) const {
    return mesh::mesh_loops(context, {view(start), view(position), view(normal)}, spacing, result);
  }
};

Circles barrel() {
  Circles circles;
  circles.add(0.0, 0.5, 0.0, 24, false);
  circles.add(0.0, 0.5, 0.6, 20, true);
  return circles;
}

// No two edges join the same vertices, and all is a sphere with a hole for each loop.
void check_topology(const Circles& loops, const LoopMesh& mesh) {
  Heap heap;
  const uint32_t vertices = static_cast<uint32_t>(loops.position.size() + mesh.inner.size());
  const int holes = static_cast<int>(loops.start.size() - 1);
  Array<uint32_t> twins(heap.context);
  must(mesh::find_twins(vertices, mesh.triangle.span(), &twins));
  mesh::Topology topology(heap.context);
  must(mesh::find_topology(vertices, mesh.triangle.span(), twins.span(), &topology));
  CHECK(topology.components == 1);
  CHECK(topology.boundary_loops == static_cast<uint32_t>(holes));
  CHECK(topology.euler_characteristic == 2 - holes);
}

}  // namespace

TEST_CASE("loops: between two circles lies a cylinder") {
  const Circles circles = barrel();
  Heap heap;
  LoopMesh result(heap.context);
  must(circles.mesh(heap.context, 0.1, &result));
  check_topology(circles, result);
  std::vector<Vec3> position = circles.position;
  position.insert(position.end(), result.inner.begin(), result.inner.end());

  double area = 0.0;
  for (size_t t = 0; t < result.triangle.size(); t += 3) {
    const Vec3 a = position[result.triangle[t]], b = position[result.triangle[t + 1]],
               c = position[result.triangle[t + 2]];
    const Vec3 twice = cross(b - a, c - a), middle = (1.0 / 3.0) * (a + b + c);
    area += 0.5 * length(twice);
    CHECK(dot(twice, Vec3{middle.x, middle.y, 0.0}) > 0.0);  // turned outwards
  }
  // The least area between them is a catenoid's, a little less than the cylinder's.
  CHECK(area < k_turn * 0.5 * 0.6);
  CHECK(area > 0.85 * k_turn * 0.5 * 0.6);
}

TEST_CASE("loops: what is no spacing, or too little to go by, is refused") {
  Heap heap;
  LoopMesh result(heap.context);
  for (const double spacing : {0.0, -1.0, HUGE_VAL, std::nan("")}) {
    CHECK(barrel().mesh(heap.context, spacing, &result).code == Code::bad_argument);
  }
  Circles pair = barrel();
  pair.start = {0, 2, 44};  // the first has two points
  CHECK(pair.mesh(heap.context, 0.1, &result).code == Code::patch_folded);
  CHECK(result.triangle.empty());
}

// Few vertices far apart: of the triangulations of the vertices alone most have two chords between
// the same two, one on either side of a loop.
TEST_CASE("loops: no two edges join the same vertices, however few of these there are") {
  Random random(7);
  for (int pair = 0; pair < 300; ++pair) {
    CAPTURE(pair);
    Circles loops;
    for (int l = 0; l < 2; ++l) {
      const double radius = l == 0 ? 1.0 : std::pow(0.5, random.below(7));
      const double x = random(), z = random();
      const uint32_t count = 3 + random.below(3);
      loops.add(x, radius, z, count, random.below(2) != 0);
    }
    for (Vec3& p : loops.position) p = p + Vec3{0.1 * random(), 0.1 * random(), 0.1 * random()};
    Heap heap;
    LoopMesh result(heap.context);
    must(loops.mesh(heap.context, 10.0, &result));
    check_topology(loops, result);
  }
}

TEST_CASE("loops: three borders, and whatever fails there") {
  Circles trousers;
  trousers.add(0.0, 0.6, 1.0, 16, true);
  trousers.add(-0.4, 0.25, 0.0, 10, false);
  trousers.add(0.4, 0.25, 0.0, 10, false);
  const auto call = [&](Context& context) -> Status {
    LoopMesh result(context);
    return trousers.mesh(context, 0.3, &result);
  };
  fails_cleanly(call);
}
