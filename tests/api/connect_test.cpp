// wsk_connect and wsk_integrate through the C API: what they refuse, failures at every allocation
// and checkpoint, units, places, options.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <random>

#include "support/faulty_allocator.h"
#include "support/scenes.h"

using scenes::Curve;
using scenes::FaultyAllocator;
using scenes::Scene;

namespace {

// The scene's curves without node numbers, cut in two where they are open, ends moved a little
// apart, every third normal forgotten.
Scene broken(Scene scene) {
  std::vector<Curve> pieces;
  for (const Curve& curve : scene.curves) {
    const size_t edges = curve.size() - (curve.closed ? 0 : 1), half = edges / 2;
    for (const auto& [from, to] : {std::pair{size_t{0}, half}, std::pair{half, edges}}) {
      Curve piece;
      piece.boundary = curve.boundary;
      for (size_t k = from; k <= to; ++k) {
        const size_t i = k % curve.size();
        for (size_t x = 0; x < 3; ++x) {
          const double gap = k == from && x == 2 ? 1.0 / 4096 : 0.0;
          piece.positions.push_back(curve.positions[3 * i + x] + gap);
          piece.normals.push_back(i % 3 == 1 ? 0.0 : curve.normals[3 * i + x]);
        }
        piece.nodes.push_back(WSK_NONE);
      }
      pieces.push_back(piece);
    }
  }
  scene.curves = pieces;
  return scene;
}

struct Run {
  FaultyAllocator allocator;
  size_t cancel_at = SIZE_MAX, cancel_calls = 0, memory_cap = 0;
  double snap = 0.0;
  bool orient = true;
  wsk_report report;
  std::vector<double> numbers;  // all that the network holds
  wsk_network_view view;        // counts only: the arrays are gone

  wsk_status operator()(const std::vector<wsk_curve>& curves) {
    wsk_options options;
    wsk_options_init(&options, sizeof options);
    allocator.install(&options);
    options.memory_cap = memory_cap;
    options.cancel = [](void* user) -> int32_t {
      Run& self = *static_cast<Run*>(user);
      return self.cancel_calls++ == self.cancel_at;
    };
    options.cancel_user = this;
    wsk_connect_options connect;
    wsk_connect_options_init(&connect, sizeof connect);
    connect.options = &options;
    connect.snap = snap;
    connect.orient = orient;
    wsk_report_init(&report, sizeof report);
    wsk_network* const sentinel = reinterpret_cast<wsk_network*>(&options);
    wsk_network* network = sentinel;
    const wsk_status status =
        wsk_connect(curves.data(), curves.size(), &connect, &network, &report);
    CHECK(report.status == status);
    if (status == WSK_OK) {
      wsk_network_get_view(network, &view, sizeof view);
      take(view);
      wsk_network_free(network);
    } else {
      CHECK(network == sentinel);
      CHECK(report.sentence[0] != '\0');
    }
    CHECK(allocator.clean());
    return status;
  }

 private:
  void take(const wsk_network_view& v) {
    for (uint32_t c = 0; c < v.curve_count; ++c) {
      const wsk_curve& curve = v.curves[c];
      numbers.insert(numbers.end(), curve.positions, curve.positions + 3 * curve.sample_count);
      if (curve.normals == nullptr) continue;
      numbers.insert(numbers.end(), curve.normals, curve.normals + 3 * curve.sample_count);
    }
    for (uint32_t i = 0; i < v.sample_count; ++i) {
      numbers.push_back(v.given_curve[i]);
      numbers.push_back(v.given_sample[i]);
      numbers.push_back(v.given_part[i]);
      numbers.push_back(v.curves[0].nodes[i]);
    }
    for (uint32_t k = 0; k < v.snap_count; ++k) numbers.push_back(v.snaps[k].distance);
  }
};

Scene scaled(Scene scene, int exponent) {
  for (Curve& curve : scene.curves) {
    for (double& x : curve.positions) x = std::ldexp(x, exponent);
  }
  return scene;
}

}  // namespace

TEST_CASE("broken scenes are joined, and can be surfaced") {
  for (const Scene& whole : {scenes::octants(), scenes::saddle(), scenes::band()}) {
    CAPTURE(whole.name);
    if (whole.curves.empty()) continue;
    const Scene scene = broken(whole);
    Run run;
    REQUIRE(run(scenes::curves_of(scene)) == WSK_OK);
    CHECK(run.view.before.dangling_ends > 0);
    CHECK(run.view.after.dangling_ends == 0);
    CHECK(run.view.snap_count > 0);
    CHECK(run.view.filled_normals > 0);
    CHECK(run.view.curves_without_normals == 0);
  }
}

TEST_CASE("every allocation may fail, every checkpoint cancel, the cap hold") {
  const Scene scene = broken(scenes::octants());
  const std::vector<wsk_curve> curves = scenes::curves_of(scene);
  Run whole;
  REQUIRE(whole(curves) == WSK_OK);
  REQUIRE(whole.allocator.calls > 50);
  for (size_t i = 0; i < whole.allocator.calls; ++i) {
    CAPTURE(i);
    Run run;
    run.allocator.fail_at = i;
    CHECK(run(curves) == WSK_ERROR_OUT_OF_MEMORY);
  }
  for (size_t i = 0; i < whole.cancel_calls; ++i) {
    CAPTURE(i);
    Run run;
    run.cancel_at = i;
    CHECK(run(curves) == WSK_ERROR_CANCELLED);
  }
  for (const size_t cap : {whole.allocator.peak_bytes, whole.allocator.peak_bytes - 1}) {
    Run run;
    run.memory_cap = cap;
    CHECK(run(curves) == (cap < whole.allocator.peak_bytes ? WSK_ERROR_MEMORY_CAP : WSK_OK));
  }
  for (const int pattern : {0x00, 0xff, FaultyAllocator::k_small_numbers}) {
    Run run;
    run.allocator.pattern = pattern;
    CHECK(run(curves) == WSK_OK);
    CHECK(run.numbers == whole.numbers);
  }
}

TEST_CASE("powers of two scale the network exactly") {
  const Scene scene = broken(scenes::octants());
  Run whole;
  REQUIRE(whole(scenes::curves_of(scene)) == WSK_OK);
  for (const int k : {-200, -3, 1, 170}) {
    CAPTURE(k);
    const Scene other = scaled(scene, k);
    Run run;
    REQUIRE(run(scenes::curves_of(other)) == WSK_OK);
    CHECK(run.view.snap_count == whole.view.snap_count);
    CHECK(run.view.tolerance == std::ldexp(whole.view.tolerance, k));
    REQUIRE(run.numbers.size() == whole.numbers.size());
    // Lengths scale, all else is equal; which is which is told by the value itself.
    size_t wrong = 0;
    for (size_t i = 0; i < run.numbers.size(); ++i) {
      const double a = whole.numbers[i], b = run.numbers[i];
      wrong += b != a && b != std::ldexp(a, k);
    }
    CHECK(wrong == 0);
  }
}

TEST_CASE("bad input is named") {
  Scene scene = scenes::octants();
  Run run;
  CHECK(run({}) == WSK_ERROR_EMPTY);
  scene.curves[1].positions[3 * 7] = std::nan("");
  CHECK(run(scenes::curves_of(scene)) == WSK_ERROR_NOT_A_NUMBER);
  CHECK(run.report.curve == 1);
  CHECK(run.report.sample == 7);
  scene = scenes::octants();
  scene.curves[2].normals[5] = std::ldexp(1.0, 1023) * 2;
  CHECK(run(scenes::curves_of(scene)) == WSK_ERROR_INFINITE);
  CHECK(run.report.curve == 2);
  scene = scenes::octants();
  run.snap = 1.0;  // of a diagonal of 3.5
  CHECK(run(scenes::curves_of(scene)) == WSK_ERROR_BAD_ARGUMENT);
  run.snap = std::nan("");
  CHECK(run(scenes::curves_of(scene)) == WSK_ERROR_BAD_ARGUMENT);
  run.snap = 0.0;
  // One node number at two places.
  scene.curves[0].nodes[1] = 4711;
  scene.curves[1].nodes[6] = 4711;
  CHECK(run(scenes::curves_of(scene)) == WSK_ERROR_NODE_MISMATCH);
  CHECK(run.report.node == 4711);
  wsk_network* none = nullptr;
  CHECK(wsk_connect(nullptr, 3, nullptr, &none, nullptr) == WSK_ERROR_BAD_ARGUMENT);
  CHECK(wsk_connect(nullptr, 3, nullptr, nullptr, nullptr) == WSK_ERROR_BAD_ARGUMENT);
  wsk_connect_options zero = {};
  CHECK(wsk_connect(nullptr, 3, &zero, &none, nullptr) == WSK_ERROR_BAD_ARGUMENT);
  CHECK(none == nullptr);
  wsk_network_free(nullptr);
  wsk_network_view view;
  wsk_network_get_view(nullptr, &view, sizeof view);
  CHECK(view.curve_count == 0);
}

namespace {

// Lines along both axes on a saddle, of `samples` each, as OBJ files have them: nothing but places.
Scene crossing_lines(size_t samples) {
  Scene scene;
  for (int line = 0; line < 8; ++line) {
    Curve curve;
    for (size_t i = 0; i < samples; ++i) {
      const double x = -1.0 + 3.0 * double(i) / double(samples - 1), y = line % 4 - 1.0;
      const double at[2] = {line < 4 ? x : y, line < 4 ? y : x};
      const double z = (at[0] * at[0] - at[1] * at[1]) / 4;
      curve.positions.insert(curve.positions.end(), {at[0], at[1], z});
      curve.nodes.push_back(WSK_NONE);
    }
    scene.curves.push_back(curve);
  }
  return scene;
}

}  // namespace

// A grid of cells as large as the mean edge would have all but one edge in one cell, and compare
// each with each: beyond the cap.
TEST_CASE("a position far out costs no more than any other") {
  Scene scene = crossing_lines(2500);
  Run run;
  run.memory_cap = size_t{16} << 20;
  REQUIRE(run(scenes::curves_of(scene)) == WSK_OK);
  const uint32_t nodes = run.report.nodes;
  CHECK(nodes == 16);
  run.snap = 1e-6;
  for (const double far : {1e3, 1e9}) {
    scene.curves[5].positions[3 * 1250] = far;  // between the meetings with the other lines
    CHECK(run(scenes::curves_of(scene)) == WSK_OK);
    CHECK(run.report.nodes >= nodes);
  }
  scene.curves[5].positions[3 * 1250] = 1e302;  // beside this, all others are points
  run.snap = 0.0;
  CHECK(run(scenes::curves_of(scene)) == WSK_ERROR_ZERO_LENGTH_CURVE);
  CHECK(run.report.curve == 0);
}

TEST_CASE("a lattice of lines that all cross is no tolerance too large") {
  Scene scene;
  constexpr int k_lines = 90;
  for (int line = 0; line < 2 * k_lines; ++line) {
    const double along = line % k_lines + 1.0;
    Curve curve;
    for (const double end : {0.0, k_lines + 1.0}) {
      if (line < k_lines) curve.positions.insert(curve.positions.end(), {along, end, 0.0});
      if (line >= k_lines) curve.positions.insert(curve.positions.end(), {end, along, 0.0});
      curve.nodes.push_back(WSK_NONE);
    }
    scene.curves.push_back(curve);
  }
  Run run;
  run.snap = 0.01;
  CHECK(run(scenes::curves_of(scene)) == WSK_OK);
  CHECK(run.report.nodes == k_lines * k_lines);
}

TEST_CASE("a tolerance that brings all near all is refused") {
  Scene scene = crossing_lines(150);
  for (Curve& curve : scene.curves) {
    for (size_t i = 0; i < curve.size(); ++i)
      curve.positions[3 * i + i % 3] += 0.01 * double(i % 7);
  }
  scene.curves[5].positions[3 * 75] = 1e3;
  Run run;
  run.snap = 50.0;
  CHECK(run(scenes::curves_of(scene)) == WSK_ERROR_BAD_ARGUMENT);
  CHECK(std::string(run.report.sentence).find("too many places") != std::string::npos);
  run.snap = 0.01;
  CHECK(run(scenes::curves_of(scene)) == WSK_OK);
}

TEST_CASE(
    "a tangle of thousands of lines is refused at once, though each pair comes near once only") {
  std::mt19937 random(1);
  const auto uniform = [&random] { return random() / 4294967296.0; };
  Scene scene;
  for (int line = 0; line < 5000; ++line) {
    Curve curve;
    double from[3];
    for (double& x : from) x = uniform();
    curve.positions.assign(from, from + 3);
    for (const double x : from) curve.positions.push_back(x + 0.9 * (uniform() - 0.5));
    curve.nodes.assign(2, WSK_NONE);
    scene.curves.push_back(curve);
  }
  Run run;
  run.snap = 0.17;
  CHECK(run(scenes::curves_of(scene)) == WSK_ERROR_BAD_ARGUMENT);
  CHECK(std::string(run.report.sentence).find("too many places") != std::string::npos);
}

TEST_CASE("a tolerance that covers hundreds of samples of a noisy curve is refused at once") {
  constexpr int k_samples = 20000;
  std::mt19937 random(1);
  Scene scene;
  scene.curves.resize(1);
  Curve& curve = scene.curves[0];
  for (int i = 0; i < k_samples; ++i) {
    for (int k = 0; k < 3; ++k) {
      const double noise = random() / 2147483648.0 - 1.0;
      curve.positions.push_back((k == 0 ? double(i) / k_samples : 0.0) + 1e-4 * noise);
    }
  }
  curve.nodes.assign(k_samples, WSK_NONE);
  Run run;
  run.snap = 0.01;
  CHECK(run(scenes::curves_of(scene)) == WSK_ERROR_BAD_ARGUMENT);
  CHECK(std::string(run.report.sentence).find("covers too many samples") != std::string::npos);
  run.snap = 0.0002;
  CHECK(run(scenes::curves_of(scene)) == WSK_OK);
}

TEST_CASE("degenerate curves are passed on, whatever they are") {
  const double points[] = {0, 0, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 1, 1, 0};
  for (size_t count = 1; count <= 6; ++count) {
    for (const int closed : {0, 1}) {
      std::vector<wsk_curve> curves(3);
      for (wsk_curve& curve : curves) {
        std::memset(&curve, 0, sizeof curve);
        curve.sample_count = count;
        curve.positions = points;
        curve.closed = closed;
      }
      Run run;
      CHECK(run(curves) == WSK_OK);
    }
  }
}

TEST_CASE("errors of wsk_build name the caller's places") {
  Scene scene = broken(scenes::octants());
  Curve& bad = scene.curves[3];
  for (size_t x = 0; x < 3; ++x) bad.positions[3 * 5 + x] = bad.positions[3 * 4 + x];
  const std::vector<wsk_curve> curves = scenes::curves_of(scene);
  wsk_network* network = nullptr;
  wsk_report report;
  wsk_report_init(&report, sizeof report);
  REQUIRE(wsk_connect(curves.data(), curves.size(), nullptr, &network, &report) == WSK_OK);
  wsk_network_view view;
  wsk_network_get_view(network, &view, sizeof view);
  wsk_surface* surface = nullptr;
  CHECK(wsk_build(view.curves, view.curve_count, nullptr, &surface, &report) ==
        WSK_ERROR_DUPLICATE_SAMPLES);
  wsk_network_name_places(network, &report);
  CHECK(report.curve == 3);
  CHECK((report.sample == 4 || report.sample == 5));
  wsk_network_free(network);
}

TEST_CASE("joints get numbers that the caller did not use") {
  // Two lines that cross in the middle of edges, with numbers up to the greatest there is.
  const double a[] = {-1, 0, 0, -0.4, 0, 0, 0.6, 0, 0, 1, 0, 0};
  const double b[] = {0, -1, 0, 0, -0.4, 0, 0, 0.6, 0, 0, 1, 0};
  const uint32_t numbers[] = {0, 0xfffffffeu, 1, 7};
  wsk_curve curves[2] = {};
  curves[0].sample_count = curves[1].sample_count = 4;
  curves[0].positions = a;
  curves[1].positions = b;
  curves[0].nodes = numbers;
  wsk_network* network = nullptr;
  REQUIRE(wsk_connect(curves, 2, nullptr, &network, nullptr) == WSK_OK);
  wsk_network_view view;
  wsk_network_get_view(network, &view, sizeof view);
  REQUIRE(view.snap_count == 1);
  CHECK(view.snaps[0].kind == WSK_SNAP_INSIDE_INSIDE);
  CHECK(view.snaps[0].distance < 1e-15);
  CHECK(view.snaps[0].a.sample == 1);
  CHECK(view.snaps[0].a.part == doctest::Approx(0.4));
  REQUIRE(view.curves[0].sample_count == 5);
  REQUIRE(view.curves[1].sample_count == 5);
  CHECK(view.curves[0].nodes[2] == view.curves[1].nodes[2]);
  CHECK(view.curves[0].nodes[2] == 2);  // the least unused
  for (int x = 0; x < 3; ++x) {
    CHECK(view.curves[0].positions[6 + x] == view.curves[1].positions[6 + x]);
    CHECK(std::fabs(view.curves[0].positions[6 + x]) < 1e-15);
  }
  wsk_network_free(network);
}

TEST_CASE("a point above another leaves no needle in the plane of a patch") {
  // A tube of four rings and four columns, whose lowest ring has one sample beside its column: the
  // end of the column and that sample lie one above the other along the normal of a patch.
  Scene scene;
  const double x[] = {1, 0, -1, 0}, y[] = {0, 1, 0, -1};
  for (int ring = 0; ring < 4; ++ring) {
    Curve curve;
    curve.closed = true;
    for (int k = 0; k < 4; ++k) {
      const double radius = ring == 0 && k == 0 ? 1.125 : 1.0;
      curve.positions.insert(curve.positions.end(), {radius * x[k], radius * y[k], 1.0 * ring});
      curve.normals.insert(curve.normals.end(), {x[k], y[k], 0});
    }
    curve.nodes.assign(4, WSK_NONE);
    scene.curves.push_back(curve);
  }
  for (int k = 0; k < 4; ++k) {
    Curve curve;
    for (int ring = 0; ring < 4; ++ring) {
      curve.positions.insert(curve.positions.end(), {x[k], y[k], 1.0 * ring});
      curve.normals.insert(curve.normals.end(), {x[k], y[k], 0});
    }
    curve.nodes.assign(4, WSK_NONE);
    scene.curves.push_back(curve);
  }
  const std::vector<wsk_curve> curves = scenes::curves_of(scene);
  wsk_network* network = nullptr;
  REQUIRE(wsk_connect(curves.data(), curves.size(), nullptr, &network, nullptr) == WSK_OK);
  wsk_network_view joined;
  wsk_network_get_view(network, &joined, sizeof joined);
  for (int method = 0; method < WSK_METHOD_COUNT; ++method) {
    CAPTURE(method);
    wsk_options options;
    wsk_options_init(&options, sizeof options);
    options.method = static_cast<wsk_method>(method);
    options.spacing = 0.57;
    wsk_surface* surface = nullptr;
    wsk_report report;
    wsk_report_init(&report, sizeof report);
    REQUIRE(wsk_build(joined.curves, joined.curve_count, &options, &surface, &report) == WSK_OK);
    wsk_surface_view view;
    wsk_surface_get_view(surface, &view, sizeof view);
    double greatest = 0.0;
    for (size_t i = 0; i < 3 * view.vertex_count; ++i) {
      greatest = std::max(greatest, std::fabs(view.positions[i]));
    }
    CHECK(greatest < 6.0);  // the ends are closed by domes
    wsk_surface_free(surface);
  }
  wsk_network_free(network);
}
