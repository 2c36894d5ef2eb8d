// Soft constraints through the C API.
#include <doctest/doctest.h>

#include <cmath>

#include "support/call.h"

using namespace scenes;

// The octants with rough samples; nodes too, for they are soft as well.
static Scene rough() {
  Scene scene = octants();
  uint32_t state = 7;
  std::vector<double> shift(64, 0.0);
  const auto next = [&] {
    state = state * 1664525u + 1013904223u;
    return 0.04 * (static_cast<double>(state >> 8) / 16777216.0 - 0.5);
  };
  for (double& s : shift) s = next();
  for (Curve& curve : scene.curves) {
    for (size_t i = 0; i < curve.size(); ++i) {
      for (size_t k = 0; k < 3; ++k) {
        const uint32_t node = curve.nodes[i];
        curve.positions[3 * i + k] += node == WSK_NONE ? next() : shift[3 * node % 60 + k];
      }
    }
  }
  return scene;
}

static Call built(const Scene& scene, wsk_method method, double soft) {
  wsk_options options = options_of(scene);
  options.method = method;
  options.smoothing = WSK_SMOOTHING_NONE;
  options.soft = soft;
  return watched_scene(scene, options);
}

static double rms_to_sphere(const Result& result) {
  double sum = 0.0;
  for (size_t i = 0; i < result.positions.size(); i += 3) {
    const double* p = &result.positions[i];
    const double error = std::hypot(p[0], p[1], p[2]) - 1.0;
    sum += error * error;
  }
  return std::sqrt(3.0 * sum / static_cast<double>(result.positions.size()));
}

TEST_CASE("soft curves smooth rough samples away") {
  const Scene scene = rough();
  for (const wsk_method method : {WSK_METHOD_ITERATED, WSK_METHOD_FAIR}) {
    CAPTURE(method);
    const Call hard = built(scene, method, 0.0), soft = built(scene, method, 0.3);
    REQUIRE(hard.status == WSK_OK);
    REQUIRE(soft.status == WSK_OK);
    CHECK(rms_to_sphere(soft.result) < 0.7 * rms_to_sphere(hard.result));
    CHECK(soft.report.constraint_distance_rms > 2.0 * hard.report.constraint_distance_rms);
    CHECK(soft.report.constraint_distance_max < 0.15);
  }
}

TEST_CASE("a cutoff far below the spacing holds; one that keeps nothing is refused") {
  const Scene scene = rough();
  const Call hard = built(scene, WSK_METHOD_FAIR, 0.0);
  CHECK(hash_of(built(scene, WSK_METHOD_FAIR, 1e-9).result) == hash_of(hard.result));
  const Call weak = built(scene, WSK_METHOD_FAIR, 1.0);
  CHECK(weak.status == WSK_ERROR_BAD_ARGUMENT);
  CHECK(weak.report.curve == 0);
}

TEST_CASE("each curve may have its own softness") {
  const Scene scene = rough();
  std::vector<wsk_curve> curves = curves_of(scene);
  wsk_options options = options_of(scene);
  options.method = WSK_METHOD_ITERATED;
  options.smoothing = WSK_SMOOTHING_NONE;
  options.soft = 0.3;
  const Call hard = built(scene, WSK_METHOD_ITERATED, 0.0);
  curves[0].soft = -1.0;  // this one holds
  const Call mixed = watched_build(curves, options);
  REQUIRE(mixed.status == WSK_OK);
  size_t kept = 0, moved = 0;
  for (size_t v = 0; v < mixed.result.vertex_curve.size(); ++v) {
    if (mixed.result.vertex_curve[v] == WSK_NONE) continue;
    const bool same = std::equal(&mixed.result.positions[3 * v], &mixed.result.positions[3 * v] + 3,
                                 &hard.result.positions[3 * v]);
    if (mixed.result.vertex_curve[v] == 0) {
      CHECK(same);
      ++kept;
    } else {
      moved += !same;
    }
  }
  CHECK(kept > 10);
  CHECK(moved > 10);
}

TEST_CASE("softness scales with the network") {
  Scene scene = rough();
  const Call one = built(scene, WSK_METHOD_FAIR, 0.25);
  const double factor = std::ldexp(1.0, 40);
  scene.spacing *= factor;
  for (Curve& curve : scene.curves) {
    for (double& x : curve.positions) x *= factor;
  }
  const Call large = built(scene, WSK_METHOD_FAIR, 0.25 * factor);
  REQUIRE(one.result.positions.size() == large.result.positions.size());
  size_t different = 0;
  for (size_t i = 0; i < one.result.positions.size(); ++i) {
    different += one.result.positions[i] * factor != large.result.positions[i];
  }
  CHECK(different == 0);
}

TEST_CASE("noise found in one part does not wipe out a tiny one") {
  // Two spheres, the small one a thousandth of the large; both without noise, unevenly sampled.
  Scene scene = ellipsoid();
  scene.method = WSK_METHOD_FAIR;
  const size_t large = scene.curves.size();
  for (size_t c = 0; c < large; ++c) {
    Curve small = scene.curves[c];
    for (size_t i = 0; i < small.positions.size(); ++i) {
      small.positions[i] = 1e-3 * small.positions[i] + (i % 3 == 0 ? 3.0 : 0.0);
    }
    for (uint32_t& node : small.nodes) node = node == WSK_NONE ? node : node + 100;
    scene.curves.push_back(small);
  }
  const Call call = watched_scene(scene);
  REQUIRE(call.status == WSK_OK);
  double low = 1e9, high = -1e9;
  for (size_t i = 0; i < call.result.positions.size(); i += 3) {
    if (call.result.positions[i] < 2.0) continue;
    low = std::fmin(low, call.result.positions[i]);
    high = std::fmax(high, call.result.positions[i]);
  }
  CHECK(high - low > 1.8e-3);
  CHECK(high - low < 2.3e-3);
}

TEST_CASE("noise stated larger than the shape is refused") {
  const Scene scene = octants();
  wsk_options options = options_of(scene);
  options.smoothing = WSK_SMOOTHING_GIVEN;
  options.noise = 1e3;
  CHECK(watched_scene(scene, options).status == WSK_ERROR_BAD_ARGUMENT);
}

TEST_CASE("vertices of a caller's mesh may be soft too") {
  size_t meshes = 0;
  for (const Scene& scene : all()) {
    if (scene.way != Way::smooth_mesh) continue;
    CAPTURE(scene.name);
    wsk_options options = options_of(scene);
    options.soft = 0.1;
    const Call call = watched_scene(scene, options);
    REQUIRE(call.status == WSK_OK);
    double moved = 0.0;
    for (size_t i = 0; i < scene.positions.size(); ++i) {
      if (scene.constrained[i / 3] == 0) continue;
      moved = std::fmax(moved, std::fabs(call.result.positions[i] - scene.positions[i]));
    }
    CHECK(moved > 0.0);
    CHECK(moved < options.soft);
    ++meshes;
  }
  CHECK(meshes > 0);
}
