#include "network/group.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>

#include "support/curve_nets.h"

using namespace unit;
using namespace wireskin::network;

namespace {

// A circle of the unit sphere at the height z.
void add_parallel(CurveNet* net, double z, bool boundary) {
  const double r = std::sqrt(1.0 - z * z);
  net->add(48, true, boundary, [=](double t) {
    const Vec3 p = {r * std::cos(2 * k_pi * t), r * std::sin(2 * k_pi * t), z};
    return std::make_pair(p, p);
  });
}

// A circle of radius r about the z axis, normals away from it.
void add_hoop(CurveNet* net, double r, double z, bool boundary) {
  net->add(48, true, boundary, [=](double t) {
    const Vec3 n = {std::cos(2 * k_pi * t), std::sin(2 * k_pi * t), 0};
    return std::make_pair(r * n + Vec3{0, 0, z}, n);
  });
}

// The number of loops of each patch, in descending order.
std::vector<uint32_t> loops_of(Stages& s, double spacing = 0.2) {
  REQUIRE_MESSAGE(s.group(spacing), std::string(s.status.sentence));
  std::vector<uint32_t> loops;
  for (uint32_t p = 0; p < s.network.patches(); ++p) {
    loops.push_back(s.network.patch_start[p + 1] - s.network.patch_start[p]);
  }
  std::sort(loops.rbegin(), loops.rend());
  return loops;
}

using Loops = std::vector<uint32_t>;

// The mesh of all patches is a manifold of this topology.
void check_topology(Stages& s, double spacing, int euler, uint32_t boundary_loops,
                    uint32_t components = 1) {
  REQUIRE_MESSAGE(s.mesh_patches(spacing), std::string(s.status.sentence));
  Array<uint32_t> twins(s.heap.context);
  wireskin::mesh::Topology topology(s.heap.context);
  must(wireskin::mesh::find_twins(s.mesh.vertices, s.mesh.triangle.span(), &twins));
  must(find_topology(s.mesh.vertices, s.mesh.triangle.span(), twins.span(), &topology));
  CHECK(topology.euler_characteristic == euler);
  CHECK(topology.boundary_loops == boundary_loops);
  CHECK(topology.components == components);
  for (const auto& shape : s.mesh.shape) CHECK(shape.area > 0.0);
}

}  // namespace

TEST_CASE("group: a tagged circle in a disc is a hole, an untagged one holds the inside") {
  for (bool tagged : {false, true}) {
    CurveNet net;
    net.add_circle({}, 4, true);
    net.add_circle({0.5, 0.5, 0}, 1, tagged);
    Stages s(net);
    CHECK(loops_of(s) == (tagged ? Loops{2} : Loops{2, 1}));
    Stages meshed(net);
    check_topology(meshed, 0.5, tagged ? 0 : 1, tagged ? 2 : 1);
  }
}

TEST_CASE("group: an island in a hole is a surface of its own") {
  CurveNet net;
  net.add_circle({}, 1, true);
  net.add_circle({}, 4, true);
  net.add_circle({}, 2, true);
  Stages s(net);
  CHECK(loops_of(s) == Loops{2, 1});
  Stages meshed(net);
  check_topology(meshed, 0.4, 1, 3, 2);
}

TEST_CASE("group: several holes, and one with a patch in it") {
  CurveNet net;
  net.add_circle({}, 5, true);
  for (double x : {-2.5, 0.0, 2.5}) net.add_circle({x, 0.5, 0}, 0.8, x < 1.0);
  Stages s(net);
  CHECK(loops_of(s) == Loops{4, 1});
  Stages meshed(net);
  check_topology(meshed, 0.3, -1, 3);
}

TEST_CASE("group: two circles make a band") {
  for (double height : {0.3, 1.0, 2.0, 3.0}) {
    CurveNet net;
    add_hoop(&net, 1.0, 0.0, true);
    add_hoop(&net, 1.0, height, true);
    Stages s(net);
    CHECK(loops_of(s) == Loops{2});
    Stages meshed(net);
    check_topology(meshed, 0.25, 0, 2);
  }
}

TEST_CASE("group: a sphere cut by parallels") {
  for (const std::vector<double>& heights : {std::vector<double>{-0.1, 0.1},
                                             {-0.7, 0.2},
                                             {-0.8, 0.8},
                                             {0.5, 0.7, 0.9},
                                             {-0.5, 0.0, 0.5}}) {
    CurveNet net;
    for (double z : heights) add_parallel(&net, z, false);
    Stages s(net);
    Loops expected(heights.size() - 1, 2);
    expected.insert(expected.end(), 2, 1);
    CHECK(loops_of(s) == expected);
    Stages meshed(net);
    check_topology(meshed, 0.2, 2, 0);
  }
}

TEST_CASE("group: a great circle has two sides, and a tagged one none to choose") {
  CurveNet net;
  add_parallel(&net, 0.0, false);
  Stages s(net);
  CHECK(loops_of(s) == Loops{1, 1});
  CurveNet tagged;
  add_parallel(&tagged, 0.0, true);
  Stages t(tagged);
  CHECK(!t.group(0.2));
  CHECK(t.status.code == Code::open_network);
  CHECK(t.status.place.curve == 0);
}

TEST_CASE("group: a torus of five meridians") {
  const auto at = [](double u, double v) {
    const Vec3 n = {std::cos(v) * std::cos(u), std::cos(v) * std::sin(u), std::sin(v)};
    return std::make_pair(Vec3{4 * std::cos(u), 4 * std::sin(u), 0} + 1.0 * n, n);
  };
  CurveNet meridians;
  for (int k = 0; k < 5; ++k) {
    meridians.add(24, true, false, [&](double t) { return at(2 * k_pi * k / 5, 2 * k_pi * t); });
  }
  Stages s(meridians);
  CHECK(loops_of(s) == Loops{2, 2, 2, 2, 2});
  Stages meshed(meridians);
  check_topology(meshed, 0.4, 0, 0);
}

TEST_CASE("group: separate surfaces stay apart") {
  CurveNet net;
  for (double x : {0.0, 2.1, 9.0}) {
    CurveNet sphere = octant_net();
    for (NetCurve c : sphere.curves) {
      for (Vec3& p : c.position) p.x += x;
      net.curves.push_back(c);
    }
  }
  net.add_circle({20, 0, 0}, 1, true);
  net.add_circle({22.2, 0, 0}, 1, true);
  Stages s(net);
  CHECK(loops_of(s) == Loops(26, 1));
}

TEST_CASE("group: balls whose open sides look past each other are closed each by itself") {
  // A tilted part of a sphere beyond a latitude: four meridians to its pole, four arcs of its rim.
  const auto add_ball = [](CurveNet* net, const Vec3& centre, double radius, double up, double tilt,
                           double latitude) {
    const auto at = [=](double polar, double around) {
      const Vec3 n = {std::cos(polar) * std::cos(around), std::cos(polar) * std::sin(around),
                      up * std::sin(polar)};
      const Vec3 turned = {std::cos(tilt) * n.x - std::sin(tilt) * n.z, n.y,
                           std::sin(tilt) * n.x + std::cos(tilt) * n.z};
      return std::make_pair(centre + radius * turned, turned);
    };
    for (int q = 0; q < 4; ++q) {
      const double around = q * k_pi / 2;
      net->add(8, false, false,
               [&](double t) { return at(latitude + t * (k_pi / 2 - latitude), around); });
      net->add(8, false, false, [&](double t) { return at(latitude, around + t * k_pi / 2); });
    }
  };
  struct Ball {
    double height, radius, tilt, latitude;
  };
  const struct {
    Ball upper, lower;
    double aside;
  } pairs[] = {{{1.81, 0.62, -0.76, 0.05}, {-0.82, 0.57, -0.12, -0.57}, 1.41},
               {{0.77, 0.68, -0.60, -0.29}, {-0.86, 0.72, 0.18, -0.32}, 1.24},
               {{0.88, 0.67, -0.33, -0.30}, {-0.11, 0.55, -0.10, -0.57}, 1.12}};
  for (const auto& [upper, lower, aside] : pairs) {
    CurveNet net;
    add_ball(&net, {0, 0, upper.height}, upper.radius, 1, upper.tilt, upper.latitude);
    add_ball(&net, {aside, 0, lower.height}, lower.radius, -1, lower.tilt, lower.latitude);
    Stages s(net);
    CHECK(loops_of(s, 0.05) == Loops(10, 1));
  }
}

TEST_CASE("group: a curve between two loops lies inside their patch") {
  CurveNet net;
  net.add_circle({}, 4, true);
  net.add_circle({}, 1, true);
  net.add_line({1, 0, 0}, {4, 0, 0}, {0, 0, 1});
  Stages s(net);
  CHECK(loops_of(s) == Loops{2});
  CHECK(s.network.inner[0].size() == 1);
}
