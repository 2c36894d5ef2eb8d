#include "network/patch_mesh.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <set>

#include "support/curve_nets.h"

using namespace unit;
using namespace wireskin::network;

namespace {

struct Checked {
  wireskin::mesh::Topology topology;
  std::map<std::pair<uint32_t, uint32_t>, int> triangles_at;  // each edge, lower vertex first

  explicit Checked(Stages* s) : topology(s->heap.context) {
    Array<uint32_t> twins(s->heap.context);
    const PatchMesh& mesh = s->mesh;
    must(wireskin::mesh::find_twins(mesh.vertices, mesh.triangle.span(), &twins));
    must(find_topology(mesh.vertices, mesh.triangle.span(), twins.span(), &topology));
    for (uint32_t h = 0; h < mesh.triangle.size(); ++h) {
      const auto e =
          std::minmax(mesh.triangle[h], mesh.triangle[wireskin::mesh::next_half_edge(h)]);
      ++triangles_at[{e.first, e.second}];
    }
    REQUIRE(mesh.patch.size() * 3 == mesh.triangle.size());
    REQUIRE(mesh.shape.size() == mesh.patch.size());
    for (const auto& shape : mesh.shape) CHECK(shape.area > 0.0);
    check_curve_edges(*s);
    check_patches(*s);
  }

  void check_curve_edges(const Stages& s) {
    for (uint32_t k = 0; k < s.network.segment.size(); ++k) {
      for (uint32_t e = 0; e < s.vertices.edges[k]; ++e) {
        const uint32_t a = segment_vertex(s.network, s.vertices, k, e);
        const uint32_t b = segment_vertex(s.network, s.vertices, k, e + 1);
        const int expected = s.network.segment[k].boundary ? 1 : 2;
        CHECK(triangles_at[{std::min(a, b), std::max(a, b)}] == expected);
      }
    }
  }

  // Every free vertex belongs to one patch, and every patch has triangles.
  void check_patches(const Stages& s) {
    std::vector<uint32_t> patch_of(s.mesh.vertices, k_none);
    std::set<uint32_t> patches;
    for (size_t h = 0; h < s.mesh.triangle.size(); ++h) {
      const uint32_t v = s.mesh.triangle[h], p = s.mesh.patch[h / 3];
      patches.insert(p);
      if (v < s.mesh.curve_vertices) continue;
      if (patch_of[v] == k_none) patch_of[v] = p;
      CHECK(patch_of[v] == p);
    }
    CHECK(patches.size() == s.network.patches());
    CHECK(*patches.rbegin() + 1 == s.network.patches());
  }
};

void check_mesh(const CurveNet& net, double spacing, int euler, uint32_t loops) {
  Stages s(net);
  REQUIRE_MESSAGE(s.mesh_patches(spacing), s.status.sentence);
  CHECK(s.mesh.curve_vertices == s.vertices.position.size());
  const Checked c(&s);
  CHECK(c.topology.euler_characteristic == euler);
  CHECK(c.topology.boundary_loops == loops);
  CHECK(c.topology.components == 1);
}

// Meridians of a flat spheroid: all of them join the two poles, which are nearer to each other than
// neighbouring meridians are.
CurveNet melon(uint32_t meridians, double half_height) {
  CurveNet net;
  for (uint32_t k = 0; k < meridians; ++k) {
    const double u = 2 * k_pi * k / meridians;
    net.add(24, false, false, [=](double t) {
      const double a = k_pi * (t - 0.5), c = std::cos(a);
      const Vec3 p = {c * std::cos(u), c * std::sin(u), half_height * std::sin(a)};
      return std::make_pair(p, Vec3{p.x, p.y, p.z / (half_height * half_height)});
    });
  }
  return net;
}

}  // namespace

TEST_CASE("patch_mesh: patches meet conformingly") {
  for (double spacing : {1.0, 0.4, 0.1}) {
    check_mesh(octant_net(), spacing, 2, 0);
    check_mesh(saddle_net(), spacing, 1, 1);
    check_mesh(cylinder_net(4), spacing, 0, 2);
  }
  check_mesh(torus_net(4, 4), 0.5, 0, 0);
}

TEST_CASE("patch_mesh: the coarsest networks have no vertices inside") {
  Stages s(octant_net());
  REQUIRE(s.mesh_patches(100.0));
  const Checked c(&s);
  CHECK(s.mesh.triangle.size() == 24);
  CHECK(s.mesh.vertices == 6);
  CHECK(c.topology.euler_characteristic == 2);
}

TEST_CASE("patch_mesh: a line of a single edge from loop to loop is an edge of the mesh") {
  for (const double turn : {0.0, 0.125, 0.25}) {
    CAPTURE(turn);
    CurveNet net;
    const auto on_tube = [](double angle, double z) {
      const Vec3 n = {std::cos(2 * k_pi * angle), std::sin(2 * k_pi * angle), 0};
      return std::make_pair(n + Vec3{0, 0, z}, n);
    };
    net.add(24, true, true, [&](double t) { return on_tube(t, -1); });
    net.add(24, true, true, [&](double t) { return on_tube(t, 1); });
    net.add(12, false, false, [&](double t) { return on_tube(turn * t, 2 * t - 1); });
    check_mesh(net, 4.0, 0, 2);
  }
}

TEST_CASE("patch_mesh: the free vertices follow the spacing") {
  Stages s(octant_net());
  REQUIRE(s.mesh_patches(0.5 * k_pi / 20));
  const size_t n = s.mesh.vertices - s.mesh.curve_vertices;
  CHECK(n > 1500);
  CHECK(n < 2600);
}

TEST_CASE("patch_mesh: a chord of two patches is split") {
  // Seen along its mean normal a patch of the melon is a rhombus, cut from pole to pole.
  for (uint32_t meridians : {3u, 4u, 5u}) {
    Stages s(melon(meridians, 0.3));
    REQUIRE_MESSAGE(s.mesh_patches(100.0), s.status.sentence);
    for (uint32_t e : s.vertices.edges) CHECK(e == 2);
    Checked c(&s);
    CHECK(c.topology.euler_characteristic == 2);
    CHECK(c.topology.boundary_loops == 0);
    CHECK(c.triangles_at.count({0, 1}) == 0);
    // The vertex in the middle of each former chord has both poles and two curves round it.
    CHECK(s.mesh.vertices - s.mesh.curve_vertices == meridians);
    CHECK(s.mesh.triangle.size() == 3 * 4 * meridians);
    for (uint32_t v = s.mesh.curve_vertices; v < s.mesh.vertices; ++v) {
      CHECK(c.triangles_at.count({0, v}) == 1);
      CHECK(c.triangles_at.count({1, v}) == 1);
    }
    // Split in the middle, so that the four parts have equal areas.
    for (size_t t = 1; t < s.mesh.shape.size(); ++t) {
      CHECK(s.mesh.shape[t].area == doctest::Approx(s.mesh.shape[0].area).epsilon(1e-3));
    }
  }
}

TEST_CASE("patch_mesh: failures name the patch") {
  CurveNet clockwise = saddle_net(false);  // the outside of the square
  Stages t(clockwise);
  CHECK(!t.mesh_patches(0.3));
  CHECK(t.status.code == Code::patch_without_plane);
  CHECK(t.status.place.patch < 5);

  CurveNet eight;  // crosses itself
  eight.add(60, true, true, [](double u) {
    const double a = 2 * k_pi * (u + 0.01);
    return std::make_pair(Vec3{std::sin(2 * a), 0.6 * std::sin(a) + 1e-3, 0.0}, Vec3{0, 0, 1});
  });
  Stages e(eight);
  CHECK(!e.mesh_patches(0.2));
  CHECK(e.status.code == Code::patch_folded);
  CHECK(e.status.place.patch == 0);
}

TEST_CASE("patch_mesh: what no plane shows is meshed in space") {
  CurveNet capped = cylinder_net(4, false);  // the caps' normals lie in their planes
  Stages s(capped);
  REQUIRE(s.mesh_patches(0.3));
  size_t in_space = 0;
  for (wireskin::network::PatchWay way : s.mesh.way) {
    in_space += way == wireskin::network::PatchWay::minimal_area;
  }
  CHECK(in_space == 2);

  CurveNet ramp;  // an eight whose two branches pass above each other
  ramp.add(60, true, true, [](double u) {
    const double a = 2 * k_pi * (u + 0.01);
    return std::make_pair(Vec3{std::sin(2 * a), 0.6 * std::sin(a) + 1e-3, 0.3 * std::cos(a)},
                          Vec3{0, 0, 1});
  });
  Stages e(ramp);
  REQUIRE(e.mesh_patches(0.2));
  CHECK(e.mesh.way[0] == wireskin::network::PatchWay::minimal_area);
}

TEST_CASE("patch_mesh: every failed allocation is a status, without a leak") {
  size_t first = 0, last = 0;
  {
    Stages s(melon(3, 0.3));
    REQUIRE(s.resample(100.0));
    first = s.heap.allocator.calls;
    must(mesh_patches(s.network, s.vertices, -1.0, false, &s.mesh));
    last = s.heap.allocator.calls;
  }
  CHECK(last > first);
  for (size_t at = first; at < last; ++at) {
    Stages s(melon(3, 0.3));
    s.heap.allocator.fail_at = at;
    CHECK(!s.mesh_patches(100.0));
    CHECK(s.status.code == Code::out_of_memory);
    CHECK(s.status.place.patch == k_none);
  }
}
