// Patches whose border has no plane: from curves to the mesh (src/network/patch_mesh.cpp).
#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "network/patch_mesh.h"
#include "support/faulty_allocator.h"

using namespace wireskin;
using network::PatchWay;

namespace {

constexpr double k_turn = 6.283185307179586;

// Closed curves with exact normals; samples of the same number are one node.
struct Wires {
  struct Curve {
    std::vector<Vec3> position, normal;
    std::vector<uint32_t> number;
  };
  std::vector<Curve> curves;
};

Wires great_circle() {
  Wires wires;
  wires.curves.resize(1);
  for (int i = 0; i < 60; ++i) {
    const double t = k_turn * i / 60;
    const Vec3 p = {std::cos(t), std::sin(t), 0};
    wires.curves[0].position.push_back(p);
    wires.curves[0].normal.push_back(p);
    wires.curves[0].number.push_back(k_none);
  }
  return wires;
}

// R = 4, r = 2: `meridians` circles round the tube and the circles on its top and its bottom.
Wires torus(int meridians) {
  Wires wires;
  const auto add = [&](double u, double v, uint32_t number) {
    Wires::Curve& curve = wires.curves.back();
    const Vec3 n = {std::cos(v) * std::cos(u), std::cos(v) * std::sin(u), std::sin(v)};
    curve.position.push_back(Vec3{4 * std::cos(u), 4 * std::sin(u), 0} + 2.0 * n);
    curve.normal.push_back(n);
    curve.number.push_back(number);
  };
  const int pieces = 12;
  for (int m = 0; m < meridians; ++m) {
    wires.curves.emplace_back();
    for (int i = 0; i < 4 * pieces; ++i) {
      const uint32_t node = i == pieces ? 2 * m : i == 3 * pieces ? 2 * m + 1 : k_none;
      add(k_turn * m / meridians, k_turn * i / (4 * pieces), node);
    }
  }
  for (uint32_t side = 0; side < 2; ++side) {
    wires.curves.emplace_back();
    for (int i = 0; i < meridians * pieces; ++i) {
      const uint32_t node = i % pieces == 0 ? 2 * static_cast<uint32_t>(i / pieces) + side : k_none;
      add(k_turn * i / (meridians * pieces), side == 0 ? k_turn / 4 : 3 * k_turn / 4, node);
    }
  }
  return wires;
}

Status mesh_wires(const Wires& wires, double spacing, network::PatchMesh* patches) {
  Context& context = patches->patch.context();
  std::vector<uint32_t> start = {0}, number;
  std::vector<Vec3> position, normal;
  for (const Wires::Curve& c : wires.curves) {
    position.insert(position.end(), c.position.begin(), c.position.end());
    normal.insert(normal.end(), c.normal.begin(), c.normal.end());
    number.insert(number.end(), c.number.begin(), c.number.end());
    start.push_back(static_cast<uint32_t>(number.size()));
  }
  Array<network::Node> nodes(context);
  Array<uint32_t> node(context);
  curves::Curves curves(context);
  network::Network network(context);
  network::CurveVertices vertices(context);
  TRY(network::find_nodes({{start.data(), start.size()},
                           {number.data(), number.size()},
                           {position.data(), position.size()},
                           {normal.data(), normal.size()}},
                          1e-9, &nodes, &node));
  for (size_t c = 0; c + 1 < start.size(); ++c) {
    const size_t count = start[c + 1] - start[c];
    TRY(curves::add_curve({{position.data() + start[c], count},
                           {normal.data() + start[c], count},
                           node.span().part(start[c], count),
                           true},
                          &curves));
  }
  const std::vector<uint8_t> boundary(wires.curves.size(), 0);
  TRY(network::find_patches(curves, {boundary.data(), boundary.size()}, nodes.span(), &network));
  TRY(network::resample(curves, nodes.span(), network, spacing, &vertices));
  return network::mesh_patches(network, vertices, -1.0, false, patches);
}

// A closed manifold of this Euler characteristic, with sound shapes.
void check_closed(const network::PatchMesh& patches, int euler_characteristic) {
  Context& context = patches.patch.context();
  Array<uint32_t> twins(context);
  mesh::Topology topology(context);
  REQUIRE(mesh::find_twins(patches.vertices, patches.triangle.span(), &twins).ok());
  REQUIRE(
      mesh::find_topology(patches.vertices, patches.triangle.span(), twins.span(), &topology).ok());
  CHECK(topology.boundary_loops == 0);
  CHECK(topology.components == 1);
  CHECK(topology.euler_characteristic == euler_characteristic);
  CHECK(patches.start.size() == patches.vertices);
  for (size_t t = 0; t < patches.shape.size(); ++t) CHECK(patches.shape[t].area > 0.0);
  // No edge inside a patch joins the ends of a curve's edge or of an edge in another patch: that
  // would be four triangles, which find_twins refuses. In a patch of minimal area the metric is
  // that of the start in space.
  for (uint32_t t = 0; t < patches.shape.size(); ++t) {
    if (patches.way[patches.patch[t]] != PatchWay::minimal_area) continue;
    const Vec3& a = patches.start[patches.triangle[3 * t]];
    const Vec3& b = patches.start[patches.triangle[3 * t + 1]];
    const Vec3& c = patches.start[patches.triangle[3 * t + 2]];
    CHECK(patches.shape[t].area == doctest::Approx(0.5 * length(cross(b - a, c - a))));
  }
}

}  // namespace

TEST_CASE("two hemispheres from one closed curve without node") {
  scenes::FaultyAllocator heap;
  Context context({heap.allocate, heap.release, &heap}, 0, {});
  // Few vertices: hardly any inner ones, so chords of the two sides would be the same.
  for (double spacing : {2.2, 1.5, 1.2, 1.0, 0.9, 0.7, 0.1}) {
    CAPTURE(spacing);
    network::PatchMesh patches(context);
    REQUIRE(mesh_wires(great_circle(), spacing, &patches).ok());
    REQUIRE(patches.way.size() == 2);
    CHECK(patches.way[0] == PatchWay::minimal_area);
    CHECK(patches.way[1] == PatchWay::minimal_area);
    check_closed(patches, 2);
  }
}

TEST_CASE("the torus by meridians, top and bottom: planes while normals have a mean, else space") {
  scenes::FaultyAllocator heap;
  Context context({heap.allocate, heap.release, &heap}, 0, {});
  for (int meridians : {2, 3, 4}) {
    CAPTURE(meridians);
    network::PatchMesh patches(context);
    REQUIRE(mesh_wires(torus(meridians), 0.3, &patches).ok());
    REQUIRE(patches.way.size() == 2 * static_cast<size_t>(meridians));
    check_closed(patches, 0);
    // The normals round half a tube over half a turn cancel out.
    for (PatchWay way : patches.way) {
      CHECK(way == (meridians == 2 ? PatchWay::minimal_area : PatchWay::plane));
    }
  }
}

TEST_CASE("each allocation of patches in space failed in turn") {
  scenes::FaultyAllocator counting;
  {
    Context context({counting.allocate, counting.release, &counting}, 0, {});
    network::PatchMesh patches(context);
    REQUIRE(mesh_wires(great_circle(), 0.8, &patches).ok());
  }
  CHECK(counting.clean());
  for (size_t k = 0; k < counting.calls; ++k) {
    scenes::FaultyAllocator heap;
    heap.fail_at = k;
    {
      Context context({heap.allocate, heap.release, &heap}, 0, {});
      network::PatchMesh patches(context);
      CHECK(mesh_wires(great_circle(), 0.8, &patches).code == Code::out_of_memory);
    }
    CHECK(heap.clean());
  }
}
