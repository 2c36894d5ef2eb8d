// What a result promises about itself: a manifold whose counts, arrays and report agree, nodes kept
// bit for bit, callbacks that are told the truth.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <set>

#include "support/call.h"

using namespace scenes;

struct Expected {
  Scene scene;
  int32_t euler;
  uint32_t boundary_loops, patches, nodes, segments;
};

static std::vector<Expected> expectations() {
  return {{octants(), 2, 0, 8, 6, 12}, {saddle(), 1, 1, 4, 9, 12}, {band(), 0, 2, 1, 0, 0}};
}

static double norm(const double* v) {
  return std::hypot(v[0], v[1], v[2]);
}

TEST_CASE("counts and arrays agree, and the mesh is an oriented manifold") {
  for (const Expected& expected : expectations()) {
    CAPTURE(expected.scene.name);
    const Call call = watched_scene(expected.scene);
    REQUIRE(call.status == WSK_OK);
    const wsk_report& report = call.report;
    const Result& result = call.result;
    CHECK(report.stage == WSK_STAGE_RESULT);
    CHECK(std::strcmp(report.sentence, "") == 0);
    CHECK(report.curves == expected.scene.curves.size());
    CHECK(report.nodes == expected.nodes);
    CHECK(report.segments == expected.segments);
    CHECK(report.patches == expected.patches);
    CHECK(report.components == 1);
    CHECK(report.boundary_loops == expected.boundary_loops);
    CHECK(report.euler_characteristic == expected.euler);
    CHECK(report.vertices == result.mean_curvature.size());
    CHECK(report.triangles == result.triangle_patch.size());
    CHECK(report.spacing > 0.0);
    CHECK(report.min_angle_deg > 5.0);
    CHECK(report.min_angle_deg <= 60.0);
    CHECK(report.residual < 1e-8);
    CHECK(report.inverted_triangles == 0);
    CHECK(report.first_inverted_patch == WSK_NONE);

    uint32_t free_vertices = 0;
    for (size_t v = 0; v < result.vertex_curve.size(); ++v) {
      CHECK(norm(&result.normals[3 * v]) == doctest::Approx(1.0).epsilon(1e-12));
      const bool is_free = result.vertex_curve[v] == WSK_NONE;
      free_vertices += is_free;
      const double along = norm(&result.constraint_normals[3 * v]);
      CHECK(along == doctest::Approx(is_free ? 0.0 : 1.0).epsilon(1e-12));
    }
    CHECK(report.free_vertices == free_vertices);

    std::set<std::pair<uint32_t, uint32_t>> halfedges;
    for (size_t t = 0; t < result.triangles.size(); t += 3) {
      CHECK(result.triangle_patch[t / 3] < report.patches);
      for (size_t i = 0; i < 3; ++i) {
        const uint32_t from = result.triangles[t + i], to = result.triangles[t + (i + 1) % 3];
        CHECK(from < report.vertices);
        CHECK(halfedges.insert({from, to}).second);
      }
    }
    for (size_t e = 0; e < result.curve_edges.size(); e += 2) {
      const uint32_t a = result.curve_edges[e], b = result.curve_edges[e + 1];
      CHECK(halfedges.count({a, b}) + halfedges.count({b, a}) >= 1);
    }
  }
}

TEST_CASE("nodes come back bit for bit, with the normal of their curves") {
  for (const Scene& scene : {octants(), saddle(), ellipsoid()}) {
    CAPTURE(scene.name);
    const Result result = result_of(scene);
    REQUIRE(!result.positions.empty());
    std::map<std::array<double, 3>, uint32_t> vertices;
    for (uint32_t v = 0; v < result.vertex_curve.size(); ++v) {
      const double* p = &result.positions[3 * size_t{v}];
      vertices[{p[0] + 0.0, p[1] + 0.0, p[2] + 0.0}] = v;
    }
    for (const Curve& curve : scene.curves) {
      for (size_t i = 0; i < curve.size(); ++i) {
        if (curve.nodes[i] == WSK_NONE) continue;
        const double* p = &curve.positions[3 * i];
        const double* n = &curve.normals[3 * i];
        const auto found = vertices.find({p[0] + 0.0, p[1] + 0.0, p[2] + 0.0});
        REQUIRE(found != vertices.end());
        const double* kept = &result.constraint_normals[3 * size_t{found->second}];
        for (size_t k = 0; k < 3; ++k) {
          CHECK(kept[k] == doctest::Approx(n[k] / norm(n)).epsilon(1e-12));
        }
      }
    }
  }
}

TEST_CASE("constrained vertices of a caller's mesh stay, the order stays, free ones move") {
  const Scene scene = band();
  const Result result = result_of(scene);
  REQUIRE(result.triangles == scene.triangles);
  size_t moved = 0;
  for (size_t v = 0; v < scene.constrained.size(); ++v) {
    const bool same =
        std::memcmp(&result.positions[3 * v], &scene.positions[3 * v], 3 * sizeof(double)) == 0;
    CHECK(result.vertex_curve[v] == (scene.constrained[v] ? 0u : WSK_NONE));
    if (scene.constrained[v]) {
      CHECK(same);
    } else {
      moved += !same;
      // The normals lean outwards at both ends, so the band becomes a barrel.
      CHECK(std::hypot(result.positions[3 * v], result.positions[3 * v + 1]) > 1.0);
    }
  }
  CHECK(moved > 0);
  CHECK(result.curve_edges.empty());
}

TEST_CASE("the surfaces lie near the truth") {
  const Result sphere = result_of(octants());
  REQUIRE(!sphere.positions.empty());
  for (size_t v = 0; v < sphere.vertex_curve.size(); ++v) {
    CHECK(std::fabs(norm(&sphere.positions[3 * v]) - 1.0) < 0.05);
    CHECK(sphere.normals[3 * v] * sphere.positions[3 * v] +
              sphere.normals[3 * v + 1] * sphere.positions[3 * v + 1] +
              sphere.normals[3 * v + 2] * sphere.positions[3 * v + 2] >
          0.97);
  }
  const Result square = result_of(saddle());
  REQUIRE(!square.positions.empty());
  for (size_t v = 0; v < square.vertex_curve.size(); ++v) {
    const double* p = &square.positions[3 * v];
    CHECK(std::fabs(p[2] - (p[0] * p[0] - p[1] * p[1]) / 2.0) < 0.01);
    CHECK(square.normals[3 * v + 2] > 0.0);
  }
}

struct Progress {
  std::vector<std::pair<wsk_stage, double>> told;
  double clock = 0.0;

  static void tell(wsk_stage stage, double fraction, void* user) {
    static_cast<Progress*>(user)->told.push_back({stage, fraction});
  }
  static double now(void* user) { return static_cast<Progress*>(user)->clock += 1.0; }
};

TEST_CASE("progress runs through the stages in order, and the clock's times add up") {
  const Scene scene = octants();
  Progress progress;
  wsk_options options = options_of(scene);
  options.progress = Progress::tell;
  options.progress_user = &progress;
  options.now = Progress::now;
  options.now_user = &progress;
  const Call call = watched_scene(scene, options);
  REQUIRE(call.status == WSK_OK);
  REQUIRE(!progress.told.empty());
  std::set<wsk_stage> stages;
  for (const auto& [stage, fraction] : progress.told) {
    CHECK(fraction >= 0.0);
    CHECK(fraction <= 1.0);
    stages.insert(stage);
  }
  CHECK(stages.size() == WSK_STAGE_COUNT);
  double sum = 0.0;
  for (int stage = 0; stage < WSK_STAGE_COUNT; ++stage) {
    CHECK(call.report.stage_ms[stage] > 0.0);
    sum += call.report.stage_ms[stage];
  }
  CHECK(call.report.total_ms >= sum);
  CHECK(hash_of(call.result) == hash_of(result_of(scene)));  // callbacks change nothing
  CHECK(watched_scene(scene).report.total_ms == 0.0);        // no clock, no time
}

TEST_CASE("the surface keeps the allocator that it came from, and all memory goes through it") {
  const Scene scene = octants();
  FaultyAllocator allocator;
  wsk_options options = options_of(scene);
  allocator.install(&options);
  wsk_surface* surface = nullptr;
  REQUIRE(run(scene, options, &surface, nullptr) == WSK_OK);
  CHECK(allocator.live_blocks > 0);
  const Result result = copy_of(surface);
  CHECK(allocator.live_bytes >=
        8 * (result.positions.size() + result.normals.size()) + 4 * result.triangles.size());
  std::memset(&options, 0, sizeof options);  // the options are the caller's again
  wsk_surface_free(surface);
  CHECK(allocator.clean());
}

TEST_CASE("triangles that lie upside down are counted") {
  // A flat grid of 6 x 6 squares; one vertex inside, held, stands beyond its neighbours or not.
  constexpr uint32_t n = 7;
  for (const bool beyond : {false, true}) {
    std::vector<double> positions;
    std::vector<uint8_t> held;
    std::vector<uint32_t> triangles;
    for (uint32_t v = 0; v < n * n; ++v) {
      positions.insert(positions.end(), {1.0 * (v % n), 1.0 * (v / n), 0.0});
      held.push_back(v % n > 4 || v % n < 3 || v / n > 4 || v / n < 2);
    }
    const uint32_t moved = 3 * n + 3;
    held[moved] = 1;
    if (beyond) positions[3 * moved] += 1.7;
    for (uint32_t v = 0; v < n * n; ++v) {
      if (v % n + 1 == n || v / n + 1 == n) continue;
      triangles.insert(triangles.end(), {v, v + 1, v + n + 1, v, v + n + 1, v + n});
    }
    wsk_mesh mesh = {};
    mesh.vertex_count = n * n;
    mesh.positions = positions.data();
    mesh.constrained = held.data();
    mesh.triangle_count = triangles.size() / 3;
    mesh.triangles = triangles.data();
    wsk_options options;
    wsk_options_init(&options, sizeof options);
    options.method = WSK_METHOD_BIHARMONIC;
    wsk_report report;
    wsk_report_init(&report, sizeof report);
    wsk_surface* surface = nullptr;
    REQUIRE(wsk_smooth_mesh(&mesh, &options, &surface, &report) == WSK_OK);
    wsk_surface_free(surface);
    CHECK((report.inverted_triangles > 0) == beyond);
    CHECK(report.first_inverted_patch == (beyond ? 0 : WSK_NONE));
  }
}
