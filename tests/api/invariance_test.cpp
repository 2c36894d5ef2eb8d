// The result does not depend on how the same curves are handed over: units, order, direction,
// starting sample, strides, thread.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <thread>

#include "support/call.h"

using namespace scenes;

static void scale(std::vector<double>& values, int exponent) {
  for (double& value : values) value = std::ldexp(value, exponent);
}

TEST_CASE("lengths scaled by a power of two scale the result by it, exactly") {
  std::vector<int> powers = {-300, -1, 33, 300};
  if (tries_all_places()) powers = {-300, -151, -20, -1, 1, 33, 170, 300};
  for (const Scene& scene : all()) {
    CAPTURE(scene.name);
    for (const bool own_spacing : {true, false}) {
      Scene reference = scene;
      if (!own_spacing) reference.spacing = 0.0;
      if (!own_spacing && !scene.curves.empty() && scene.name != "saddle") continue;  // large
      const Call whole = watched_scene(reference);
      REQUIRE(whole.status == WSK_OK);
      for (const int k : powers) {
        CAPTURE(k);
        Scene scaled = reference;
        for (Curve& curve : scaled.curves) {
          scale(curve.positions, k);
          curve.soft = std::ldexp(curve.soft, k);
        }
        scale(scaled.positions, k);
        for (scenes::SensorCurve& sensor : scaled.sensors) scale(sensor.arc_lengths, k);
        scaled.spacing = std::ldexp(reference.spacing, k);
        scaled.noise = std::ldexp(reference.noise, k);
        scaled.soft = std::ldexp(reference.soft, k);
        Call call = watched_scene(scaled);
        REQUIRE(call.status == WSK_OK);
        CHECK(call.report.spacing == std::ldexp(whole.report.spacing, k));
        CHECK(call.report.min_angle_deg == whole.report.min_angle_deg);
        scale(call.result.positions, -k);
        scale(call.result.mean_curvature, k);
        CHECK(hash_of(call.result) == hash_of(whole.result));
      }
    }
  }
}

TEST_CASE("the length of normals does not matter, bit for bit under powers of two") {
  Scene scene = saddle();
  const Call whole = watched_scene(scene);
  REQUIRE(whole.status == WSK_OK);
  for (Curve& curve : scene.curves) scale(curve.normals, -9);
  const Call call = watched_scene(scene);
  REQUIRE(call.status == WSK_OK);
  CHECK(hash_of(call.result) == hash_of(whole.result));
}

// ---- Order and direction ------------------------------------------------------------------------

static double distance(const double* a, const double* b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

static double diagonal(const Result& result) {
  std::array<double, 3> low, high;
  low.fill(std::numeric_limits<double>::infinity());
  high.fill(-std::numeric_limits<double>::infinity());
  for (size_t i = 0; i < result.positions.size(); ++i) {
    low[i % 3] = std::min(low[i % 3], result.positions[i]);
    high[i % 3] = std::max(high[i % 3], result.positions[i]);
  }
  return distance(low.data(), high.data());
}

// For each vertex of `a` the nearest of `b`.
static std::vector<uint32_t> nearest_vertices(const Result& a, const Result& b) {
  std::vector<uint32_t> nearest;
  for (size_t i = 0; i < a.positions.size(); i += 3) {
    size_t best = 0;
    for (size_t j = 3; j < b.positions.size(); j += 3) {
      if (distance(&a.positions[i], &b.positions[j]) <
          distance(&a.positions[i], &b.positions[best])) {
        best = j;
      }
    }
    nearest.push_back(static_cast<uint32_t>(best / 3));
  }
  return nearest;
}

// Triangles as a set, each starting from its least vertex, numbered by `names`.
static std::set<std::array<uint32_t, 3>> triangle_set(const Result& result,
                                                      const std::vector<uint32_t>& names) {
  std::set<std::array<uint32_t, 3>> set;
  for (size_t t = 0; t < result.triangles.size(); t += 3) {
    std::array<uint32_t, 3> triangle;
    for (size_t i = 0; i < 3; ++i) triangle[i] = names[result.triangles[t + i]];
    std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()),
                triangle.end());
    set.insert(triangle);
  }
  return set;
}

static void check_same_surface(const Result& a, const Result& b) {
  REQUIRE(a.positions.size() == b.positions.size());
  REQUIRE(a.triangles.size() == b.triangles.size());
  CHECK(a.patch_count == b.patch_count);
  const std::vector<uint32_t> nearest = nearest_vertices(a, b);
  double worst = 0.0;
  for (size_t i = 0; i < nearest.size(); ++i) {
    worst = std::max(worst, distance(&a.positions[3 * i], &b.positions[3 * nearest[i]]));
  }
  CHECK(worst <= 1e-9 * diagonal(a));
  std::vector<uint32_t> own(nearest.size());
  for (uint32_t i = 0; i < own.size(); ++i) own[i] = i;
  CHECK(triangle_set(a, nearest) == triangle_set(b, own));
}

static void reverse(Curve& curve) {
  const auto reverse_triples = [](std::vector<double>& values) {
    std::reverse(values.begin(), values.end());
    for (size_t i = 0; i < values.size(); i += 3) std::swap(values[i], values[i + 2]);
  };
  reverse_triples(curve.positions);
  reverse_triples(curve.normals);
  std::reverse(curve.nodes.begin(), curve.nodes.end());
}

static void start_at(Curve& curve, ptrdiff_t sample) {
  std::rotate(curve.positions.begin(), curve.positions.begin() + 3 * sample, curve.positions.end());
  std::rotate(curve.normals.begin(), curve.normals.begin() + 3 * sample, curve.normals.end());
  std::rotate(curve.nodes.begin(), curve.nodes.begin() + sample, curve.nodes.end());
}

static Result surfaced(const Scene& scene) {
  const Call call = watched_scene(scene);
  REQUIRE(call.status == WSK_OK);
  return call.result;
}

TEST_CASE("curves in another order") {
  Scene scene = ellipsoid();
  const Result whole = surfaced(scene);
  std::rotate(scene.curves.begin(), scene.curves.begin() + 1, scene.curves.end());
  check_same_surface(whole, surfaced(scene));
  std::swap(scene.curves[0], scene.curves[1]);
  check_same_surface(whole, surfaced(scene));
}

TEST_CASE("curves the other way round") {
  const Scene scene = ellipsoid();
  const Result whole = surfaced(scene);
  for (size_t i = 0; i < scene.curves.size(); ++i) {
    CAPTURE(i);
    Scene changed = scene;
    reverse(changed.curves[i]);
    check_same_surface(whole, surfaced(changed));
  }
}

TEST_CASE("closed curves from another sample") {
  const Scene scene = ellipsoid();
  const Result whole = surfaced(scene);
  for (const ptrdiff_t sample : {1, 9, 23}) {
    CAPTURE(sample);
    Scene changed = scene;
    start_at(changed.curves[1], sample);
    check_same_surface(whole, surfaced(changed));
  }
}

TEST_CASE("nodes with other numbers") {
  Scene scene = octants();
  const Result whole = surfaced(scene);
  for (Curve& curve : scene.curves) {
    for (uint32_t& node : curve.nodes) {
      if (node != WSK_NONE) node = 0xfffffffeu - 1000003u * node;
    }
  }
  check_same_surface(whole, surfaced(scene));
}

TEST_CASE("a number that occurs once is an ordinary sample") {
  Scene scene = octants();
  const Result whole = surfaced(scene);
  uint32_t fresh = 100;
  for (Curve& curve : scene.curves) {
    for (uint32_t& node : curve.nodes) {
      if (node == WSK_NONE) node = fresh++;
    }
  }
  CHECK(hash_of(surfaced(scene)) == hash_of(whole));
}

// ---- Arrays and threads -------------------------------------------------------------------------

TEST_CASE("strides") {
  struct Vertex {
    float tag;
    double position[3];
    double normal[3];
    double other;
  };
  const Scene scene = saddle();
  std::vector<wsk_curve> curves = curves_of(scene);
  const Call packed = watched_build(curves, options_of(scene));
  REQUIRE(packed.status == WSK_OK);
  std::vector<std::vector<Vertex>> interleaved;
  for (size_t c = 0; c < curves.size(); ++c) {
    const Curve& curve = scene.curves[c];
    interleaved.emplace_back(curve.size());
    for (size_t i = 0; i < curve.size(); ++i) {
      Vertex& vertex = interleaved[c][i];
      vertex.tag = 1e30f;
      std::copy_n(&curve.positions[3 * i], 3, vertex.position);
      std::copy_n(&curve.normals[3 * i], 3, vertex.normal);
      vertex.other = std::nan("");
    }
    curves[c].positions = interleaved[c][0].position;
    curves[c].normals = interleaved[c][0].normal;
    curves[c].position_stride = curves[c].normal_stride = sizeof(Vertex);
  }
  const Call strided = watched_build(curves, options_of(scene));
  REQUIRE(strided.status == WSK_OK);
  CHECK(hash_of(strided.result) == hash_of(packed.result));
}

TEST_CASE("two threads at once") {
  const std::vector<Scene> scenes = all();
  std::vector<uint64_t> expected;
  for (const Scene& scene : scenes) expected.push_back(hash_of(result_of(scene)));
  std::array<std::vector<uint64_t>, 2> seen;
  const auto work = [&](std::vector<uint64_t>* hashes) {
    for (const Scene& scene : scenes) hashes->push_back(hash_of(result_of(scene)));
  };
  std::thread first(work, &seen[0]), second(work, &seen[1]);
  first.join();
  second.join();
  CHECK(seen[0] == expected);
  CHECK(seen[1] == expected);
}
