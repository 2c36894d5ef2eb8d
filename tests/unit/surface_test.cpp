#include "surface/from_triangles.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "support/curve_nets.h"
#include "wireskin.h"

using namespace unit;
using wireskin::length;
using wireskin::Surface;
using wireskin::smooth::Method;

namespace {

// A network as surface_curves takes it.
struct Input {
  Heap heap;
  std::vector<uint32_t> start = {0}, number;
  std::vector<Vec3> position, normal;
  std::vector<uint8_t> closed, boundary;
  std::vector<double> soft;
  Surface surface{heap.context};

  explicit Input(const CurveNet& net) {
    number = Stages(net).number;
    for (const NetCurve& c : net.curves) {
      position.insert(position.end(), c.position.begin(), c.position.end());
      normal.insert(normal.end(), c.normal.begin(), c.normal.end());
      start.push_back(static_cast<uint32_t>(position.size()));
      closed.push_back(c.closed);
      boundary.push_back(c.boundary);
      soft.push_back(0.0);
    }
  }
  Status run(double spacing, Method method = Method::stanko) {
    return surface_curves(heap.context,
                          {view(start), span(position), span(normal), view(number), view(closed),
                           view(boundary), view(soft)},
                          {method, spacing, {wireskin::network::Noise::none, 0.0}}, &surface);
  }
};

struct TriangleInput {
  Heap heap;
  Mesh mesh;
  std::vector<Vec3> normal;
  std::vector<uint8_t> held;
  Surface surface{heap.context};

  explicit TriangleInput(Mesh m)
      : mesh(std::move(m)), normal(mesh.position), held(mesh.vertices()) {}
  Status run(Method method = Method::stanko) {
    return surface_triangles(
        heap.context, {view(mesh.position), view(normal), view(held), view(mesh.triangle), 0.0},
        {method, 0.0, {}}, &surface);
  }
};

wsk_status build(const CurveNet& net, double factor, double spacing, wsk_report* report) {
  const Input input(net);
  std::vector<std::vector<double>> arrays;
  std::vector<wsk_curve> curves;
  for (const NetCurve& c : net.curves) {
    for (int k = 0; k < 2; ++k) {
      arrays.emplace_back();
      for (const Vec3& p : k == 0 ? c.position : c.normal) {
        for (double x : {p.x, p.y, p.z}) arrays.back().push_back(k == 0 ? factor * x : x);
      }
    }
  }
  for (size_t c = 0; c < net.curves.size(); ++c) {
    wsk_curve curve = {};
    curve.sample_count = net.curves[c].position.size();
    curve.positions = arrays[2 * c].data();
    curve.normals = arrays[2 * c + 1].data();
    curve.nodes = &input.number[input.start[c]];
    curve.closed = net.curves[c].closed;
    curve.boundary = net.curves[c].boundary;
    curves.push_back(curve);
  }
  wsk_options options;
  wsk_options_init(&options, sizeof options);
  wsk_report_init(report, sizeof *report);
  options.spacing = spacing;
  wsk_surface* surface = nullptr;
  const wsk_status status = wsk_build(curves.data(), curves.size(), &options, &surface, report);
  wsk_surface_free(surface);
  return status;
}

}  // namespace

TEST_CASE("surface: a sphere from three great circles, counted") {
  Input input(octant_net());
  must(input.run(0.5 * k_pi / 12));
  const wireskin::Counts& c = input.surface.counts;
  CHECK(c.curves == 3);
  CHECK(c.nodes == 6);
  CHECK(c.segments == 12);
  CHECK(c.patches == 8);
  CHECK(c.components == 1);
  CHECK(c.boundary_loops == 0);
  CHECK(c.euler_characteristic == 2);
  CHECK(c.vertices == input.surface.position.size());
  CHECK(c.vertices - c.free_vertices == 138);
  CHECK(c.triangles == 2 * c.vertices - 4);
  CHECK(c.residual < 1e-10);
  CHECK(c.least_angle > 15.0);
  for (uint32_t v = 0; v < c.vertices; ++v) {
    const Vec3& p = input.surface.position[v];
    CHECK(std::fabs(length(p) - 1.0) < 0.03);
    CHECK(wireskin::dot(input.surface.normal[v], p) > 0.97);
    CHECK(input.surface.mean_curvature[v] == doctest::Approx(1.0).epsilon(0.35));
    const bool free = v >= 138;
    CHECK((input.surface.vertex_curve[v] == k_none) == free);
    CHECK((input.surface.constraint_normal[v] == Vec3{}) == free);
  }
  REQUIRE(input.surface.curve_edge.size() == 2 * 144);
  for (size_t e = 0; e < 144; ++e) {
    const Vec3 &a = input.surface.position[input.surface.curve_edge[2 * e]],
               &b = input.surface.position[input.surface.curve_edge[2 * e + 1]];
    CHECK(length(b - a) == doctest::Approx(0.5 * k_pi / 12).epsilon(0.01));
    const uint32_t k = input.surface.curve_edge_curve[e];  // lies in a coordinate plane
    const double off[3] = {a.z, a.x, a.y};
    CHECK(std::fabs(off[k]) < 1e-12);
  }
}

TEST_CASE("surface: the default spacing is a hundredth of the diagonal") {
  Input input(saddle_net());
  must(input.run(0.0, Method::biharmonic));
  CHECK(input.surface.counts.spacing ==
        doctest::Approx(0.01 * std::sqrt(4 + 4 + 1)).epsilon(1e-12));
  CHECK(input.surface.counts.boundary_loops == 1);
}

TEST_CASE("surface: neighbouring samples that a node makes one are named") {
  CurveNet net = saddle_net();
  NetCurve& c = net.curves[4];
  c.position.insert(c.position.begin() + 11, c.position[10] + Vec3{0, 1e-10, 0});
  c.normal.insert(c.normal.begin() + 11, c.normal[10]);
  Input input(net);
  const Status s = input.run(0.1);
  CHECK(s.code == Code::duplicate_samples);
  CHECK(s.place.curve == 4);
  CHECK(s.place.sample == 11);
}

TEST_CASE("surface: closed patches that meet in a point only are named by the node") {
  // Two discs in a plane with one common point of their borders.
  CurveNet eight;
  eight.add_circle({-1, 0, 0}, 1, true, 48, 0.0);
  eight.add_circle({1, 0, 0}, 1, true, 48, k_pi);
  Input input(eight);
  const Status s = input.run(0.2);
  CHECK(s.code == Code::open_network);
  CHECK(s.place.node == 0);
  CHECK(s.place.vertex == k_none);
}

TEST_CASE("surface: a mesh that nothing holds is named") {
  Random random(1);
  TriangleInput input(sphere(1, 0.0, random));
  Status s = input.run();
  CHECK(s.code == Code::unconstrained);
  CHECK(s.place.vertex == 0);
  for (uint32_t v = 0; v < 20; ++v) input.held[v] = 1;
  TriangleInput again(input.mesh);
  again.held = input.held;
  CHECK(again.run().ok());
  CHECK(again.surface.counts.free_vertices == 22);

  TriangleInput band(tube(8, 3, 1.0, false));
  for (uint32_t v = 0; v < 24; ++v) band.held[v] = (v < 8 || v >= 16) && v != 18;
  s = band.run();
  CHECK(s.code == Code::unconstrained);
  CHECK(s.place.vertex == 18);

  Mesh two = icosahedron();
  for (uint32_t v = 0; v < 12; ++v) two.position.push_back(two.position[v] + Vec3{5, 0, 0});
  for (size_t h = 0; h < 60; ++h) two.triangle.push_back(two.triangle[h] + 12);
  TriangleInput pair(two);
  pair.held[3] = 1;
  s = pair.run();
  CHECK(s.code == Code::unconstrained);
  CHECK(s.place.vertex == 12);
}

TEST_CASE("surface: a mesh held everywhere comes back as it was") {
  TriangleInput input(icosahedron());
  for (uint8_t& h : input.held) h = 1;
  must(input.run());
  CHECK(to_vector(input.surface.position) == input.mesh.position);
  CHECK(to_vector(input.surface.triangle) == input.mesh.triangle);
  CHECK(input.surface.counts.least_angle == doctest::Approx(60.0).epsilon(1e-12));
}

TEST_CASE("surface: triangles without area are refused before they divide") {
  Mesh flat = grid(3, 3, 1.0);
  flat.position[4] = flat.position[1];
  TriangleInput input(flat);
  for (uint8_t& h : input.held) h = 1;
  CHECK(input.run().code == Code::bad_mesh);
}

TEST_CASE("surface: a triangle that is all but flat as the caller gives it is no fault of ours") {
  for (const double height : {1e-12, 1e-15, 1e-100}) {
    CAPTURE(height);
    Mesh sheet = grid(5, 5, 1.0);
    // Its corner at the border, held as that is, drawn to the line between its neighbours.
    const uint32_t a = sheet.triangle[0], b = sheet.triangle[1], c = sheet.triangle[2];
    sheet.position[b] = 0.5 * (sheet.position[a] + sheet.position[c]);
    sheet.position[b].z += height;
    TriangleInput input(sheet);
    for (uint8_t& h : input.held) h = 1;
    for (Vec3& n : input.normal) n = {0, 0, 1};
    input.held[12] = 0;
    CHECK(input.run(Method::biharmonic).ok());
  }
}

// A tube so long that what spreads from its ends is lost in rounding, and one that is not.
TEST_CASE("surface: a mesh that smoothing would flatten is refused") {
  for (const double height : {4.0, 80.0}) {
    for (const Method method : {Method::biharmonic, Method::triharmonic}) {
      CAPTURE(height);
      CAPTURE(static_cast<int>(method));
      const uint32_t rows = 1 + static_cast<uint32_t>(2.0 * height);
      TriangleInput input(tube(12, rows, height, false));
      for (uint32_t v = 0; v < 12 * rows; ++v) {
        input.held[v] = v < 12 || v >= 12 * (rows - 1);
        input.normal[v].z = 0.0;
      }
      const Status status = input.run(method);
      if (height < 10.0) {
        CHECK(status.ok());
        continue;
      }
      CHECK(status.code == Code::not_positive_definite);
      REQUIRE(status.place.triangle < 24 * (rows - 1));
      const uint32_t row = input.mesh.triangle[3 * size_t{status.place.triangle}] / 12;
      CHECK(row > rows / 8);  // inside, not at the end
    }
  }
}

// Scaled to the size of such a network the spacing vanishes, which must not mean the default.
TEST_CASE("surface: a spacing that underflows is too small") {
  wsk_report report;
  CHECK(build(octant_net(), 1e300, 1e-100, &report) == WSK_ERROR_TOO_LARGE);
  CHECK(build(octant_net(), 1e-300, 1e-301, &report) == WSK_OK);
  CHECK(report.spacing == doctest::Approx(1e-301));
  CHECK(build(octant_net(), 1e-300, 1e300, &report) == WSK_OK);  // as coarse as can be
  CHECK(report.segments == 12);
}
