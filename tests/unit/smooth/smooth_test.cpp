#include "smooth/smooth.h"

#include <doctest/doctest.h>

#include "support/meshes.h"
#include "wireskin.h"

using namespace unit;
using namespace wireskin::smooth;
using wireskin::length;

namespace {

// A planar square cut by the lines x = .5 and y = .5, tilted in space, with its rim.
struct Square {
  static constexpr uint32_t n = 21;
  Mesh flat, tilted;
  Vec3 normal;
  std::vector<uint8_t> held, rim;

  Square() {
    Random random(1);
    flat = grid(n, n, 0.05, &random);
    const Vec3 u = wireskin::unit({1, 2, -1}), side = wireskin::unit({2, -1, 0});
    normal = wireskin::cross(u, side);
    for (uint32_t v = 0; v < n * n; ++v) {
      const uint32_t i = v % n, j = v / n;
      rim.push_back(i == 0 || i == n - 1 || j == 0 || j == n - 1);
      held.push_back(rim[v] || i == n / 2 || j == n / 2);
      if (!held[v]) flat.position[v] += 0.012 * Vec3{random(), random(), 0};
    }
    tilted = flat;
    for (Vec3& p : tilted.position) p = Vec3{0.3, 0.1, -0.2} + p.x * u + p.y * side;
  }
};

// A band of the unit cylinder with its circles held; the result's radius half way up.
double middle_radius(double tilt, wsk_method method) {
  const uint32_t around = 80, rows = 17;  // the middle is row 8
  const Mesh band = tube(around, rows, 1.2, false);
  std::vector<double> positions, normals;
  std::vector<uint8_t> constrained;
  for (uint32_t v = 0; v < band.vertices(); ++v) {
    const Vec3& p = band.position[v];
    const double up = p.z > 0 ? std::sin(tilt) : -std::sin(tilt);
    positions.insert(positions.end(), {p.x, p.y, p.z});
    normals.insert(normals.end(), {std::cos(tilt) * p.x, std::cos(tilt) * p.y, up});
    constrained.push_back(v < around || v >= around * (rows - 1));
  }
  wsk_mesh mesh = {};
  mesh.vertex_count = band.vertices();
  mesh.positions = positions.data();
  mesh.normals = normals.data();
  mesh.constrained = constrained.data();
  mesh.triangle_count = band.triangle.size() / 3;
  mesh.triangles = band.triangle.data();
  wsk_options options;
  wsk_report report;
  wsk_options_init(&options, sizeof options);
  wsk_report_init(&report, sizeof report);
  options.method = method;
  wsk_surface* surface = nullptr;
  REQUIRE_MESSAGE(wsk_smooth_mesh(&mesh, &options, &surface, &report) == WSK_OK, report.sentence);
  wsk_surface_view view;
  wsk_surface_get_view(surface, &view, sizeof view);
  double least = 1e9, most = 0.0;
  for (uint32_t v = 8 * around; v < 9 * around; ++v) {
    const double* p = view.positions + 3 * v;
    const double r = std::sqrt(p[0] * p[0] + p[1] * p[1]);
    least = std::fmin(least, r);
    most = std::fmax(most, r);
    CHECK(std::fabs(p[2]) < 0.01);
  }
  wsk_surface_free(surface);
  CHECK(most - least < 1e-3);  // the band stays round
  return 0.5 * (least + most);
}

}  // namespace

TEST_CASE("smooth: a planar patch with plane normals stays plane, whatever the method") {
  const Square s;
  for (Method method : {Method::stanko, Method::biharmonic, Method::triharmonic, Method::clamped}) {
    for (Metric metric : {Metric::planes, Metric::space}) {
      Heap heap;
      Array<wireskin::mesh::TriangleShape> shapes(heap.context);
      must(triangle_shapes(view(s.flat.position), view(s.flat.triangle), &shapes));
      std::vector<Vec3> position = s.tilted.position, normal(position.size(), s.normal);
      for (uint32_t v = 0; v < position.size(); ++v) {
        if (!s.held[v]) position[v] = {7, 7, 7}, normal[v] = {};
      }
      double residual = -1.0;
      must(wireskin::smooth::smooth(
          heap.context, {view(s.flat.triangle), shapes.span(), view(s.held), view(s.rim), metric},
          method, {span(position), span(normal)}, &residual));
      CHECK(residual >= 0.0);
      CHECK(residual < 1e-9);
      double off_plane = 0.0;
      for (uint32_t v = 0; v < position.size(); ++v) {
        const double height = wireskin::dot(position[v] - s.tilted.position[0], s.normal);
        off_plane = std::fmax(off_plane, std::fabs(height));
        if (s.held[v]) CHECK(position[v] == s.tilted.position[v]);
        // Propagated normals are unit, and those of the plane.
        const bool uses_normals = method == Method::stanko || method == Method::clamped;
        if (uses_normals) CHECK(length(normal[v] - s.normal) < 1e-11);
      }
      CAPTURE(static_cast<int>(method));
      CAPTURE(static_cast<int>(metric));
      // The penalty of the clamped method costs five digits of the factor.
      CHECK(off_plane < (method == Method::clamped ? 1e-10 : 1e-12));
    }
  }
}

TEST_CASE("smooth: the paper's method follows a sphere where the biharmonic one falls short") {
  // The cap of a jittered sphere, whose rest is held with exact normals, in its own metric.
  Random random(2);
  const Mesh mesh = sphere(3, 0.01, random);
  std::vector<uint8_t> held, rim(mesh.vertices(), 0);
  for (const Vec3& p : mesh.position) held.push_back(p.z < 0.3);
  Heap heap;
  Array<wireskin::mesh::TriangleShape> shapes(heap.context);
  must(triangle_shapes(view(mesh.position), view(mesh.triangle), &shapes));
  const auto error = [&](Method method) {
    std::vector<Vec3> position = mesh.position, normal = mesh.position;
    double residual = 0.0, worst = 0.0;
    must(wireskin::smooth::smooth(
        heap.context, {view(mesh.triangle), shapes.span(), view(held), view(rim), Metric::space},
        method, {span(position), span(normal)}, &residual));
    for (const Vec3& p : position) worst = std::fmax(worst, std::fabs(length(p) - 1.0));
    return worst;
  };
  const double paper = error(Method::stanko), biharmonic = error(Method::biharmonic);
  MESSAGE("cap: paper ", paper, ", biharmonic ", biharmonic);
  CHECK(paper < 0.5 * biharmonic);
}

// Figure 1 of the paper: the same two circles, their normals turned.
TEST_CASE("smooth: cylinder, barrel and bottleneck from the same two circles") {
  const double degree = k_pi / 180;
  const double cylinder = middle_radius(0, WSK_METHOD_STANKO);
  const double barrel = middle_radius(35 * degree, WSK_METHOD_STANKO);
  const double neck = middle_radius(-35 * degree, WSK_METHOD_STANKO);
  MESSAGE("radius in the middle: cylinder ", cylinder, ", barrel ", barrel, ", bottleneck ", neck);
  CHECK(std::fabs(cylinder - 1.0) < 1e-3);
  CHECK(barrel > 1.05);
  CHECK(barrel < 1.4);
  CHECK(neck < 0.95);
  CHECK(neck > 0.5);
  const double slight = middle_radius(15 * degree, WSK_METHOD_STANKO);
  CHECK(slight > cylinder + 0.01);
  CHECK(slight < barrel);
}

TEST_CASE("smooth: cancelled at any checkpoint, out of any memory") {
  const Square s;
  size_t checkpoints = 0, allocations = 0;
  const auto run = [&](size_t cancel_at, size_t fail_at) {
    Heap heap;
    heap.cancel_at = cancel_at;
    heap.allocator.fail_at = fail_at;
    Status status;
    {
      Array<wireskin::mesh::TriangleShape> shapes(heap.context);
      status = triangle_shapes(view(s.flat.position), view(s.flat.triangle), &shapes);
      std::vector<Vec3> position = s.tilted.position, normal(position.size(), s.normal);
      double residual = 0.0;
      if (status.ok()) {
        status = wireskin::smooth::smooth(
            heap.context,
            {view(s.flat.triangle), shapes.span(), view(s.held), view(s.rim), Metric::space},
            Method::clamped, {span(position), span(normal)}, &residual);
      }
      checkpoints = heap.checkpoints;
      allocations = heap.allocator.calls;
    }
    CHECK(heap.allocator.clean());
    return status.code;
  };
  CHECK(run(SIZE_MAX, SIZE_MAX) == Code::ok);
  const size_t all_checkpoints = checkpoints, all_allocations = allocations;
  CHECK(all_checkpoints >= 8);
  for (size_t k = 0; k < all_checkpoints; ++k) CHECK(run(k, SIZE_MAX) == Code::cancelled);
  for (size_t k = 0; k < all_allocations; ++k) CHECK(run(SIZE_MAX, k) == Code::out_of_memory);
}
