// Surfaces from curves alone through the C API: what comes out, what is kept, bad and degenerate
// input, memory, cancelling, scaling.
#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include "support/faulty_allocator.h"

namespace {

struct Curves {
  std::vector<std::vector<double>> positions, normals;
  std::vector<wsk_curve> curves;

  void add(const std::vector<double>& p, bool closed = false) {
    positions.push_back(p);
    wsk_curve curve = {};
    curve.sample_count = p.size() / 3;
    curve.closed = closed ? 1 : 0;
    curves.push_back(curve);
  }
  const std::vector<wsk_curve>& list() {
    for (size_t c = 0; c < curves.size(); ++c) {
      curves[c].positions = positions[c].data();
      curves[c].normals = c < normals.size() ? normals[c].data() : nullptr;
    }
    return curves;
  }
};

Curves cube(double size = 1.0) {
  Curves net;
  for (int axis = 0; axis < 3; ++axis) {
    for (int i = 0; i < 4; ++i) {
      double a[3] = {}, b[3] = {};
      a[(axis + 1) % 3] = b[(axis + 1) % 3] = (i % 2) * size;
      a[(axis + 2) % 3] = b[(axis + 2) % 3] = (i / 2) * size;
      b[axis] = size;
      net.add({a[0], a[1], a[2], b[0], b[1], b[2]});
    }
  }
  return net;
}

// Three great circles; with the normals of the sphere.
Curves sphere() {
  Curves net;
  constexpr int k_pieces = 32;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> p;
    for (int i = 0; i < k_pieces; ++i) {
      const double a = 2.0 * 3.14159265358979323846 * i / k_pieces;
      double q[3] = {};
      // Exact where circles meet, so that they coincide.
      q[axis] = i % 16 == 8 ? 0.0 : i == 0 ? 1.0 : i == 16 ? -1.0 : std::cos(a);
      q[(axis + 1) % 3] = i % 16 == 0 ? 0.0 : i == 8 ? 1.0 : i == 24 ? -1.0 : std::sin(a);
      if (i % 16 == 8) q[axis] = 0.0;
      p.insert(p.end(), q, q + 3);
    }
    net.add(p, true);
    net.normals.push_back(p);
  }
  return net;
}

struct Result {
  wsk_status built = WSK_OK, made = WSK_OK;
  wsk_report report, first;
  wsk_flow_view view = {};
  std::vector<wsk_flow_patch> patches;
  std::vector<wsk_void> voids;
  std::vector<double> positions;
  std::vector<uint32_t> triangles, triangle_patch;
};

wsk_options plain_options() {
  wsk_options options;
  wsk_options_init(&options, sizeof options);
  return options;
}

wsk_flow_options flow_defaults() {
  wsk_flow_options options;
  wsk_flow_options_init(&options, sizeof options);
  return options;
}

void take_surface(wsk_flow* flow, const wsk_options& options, const wsk_flow_options& wish,
                  Result* result) {
  wsk_surface* surface = nullptr;
  wsk_report_init(&result->report, sizeof result->report);
  result->made = wsk_flow_surface(flow, &options, &wish, &surface, &result->report);
  if (result->made != WSK_OK) {
    CHECK(surface == nullptr);
    return;
  }
  wsk_surface_view view;
  wsk_surface_get_view(surface, &view, sizeof view);
  wsk_flow_get_view(flow, &result->view, sizeof result->view);
  result->positions.assign(view.positions, view.positions + 3 * size_t{view.vertex_count});
  result->triangles.assign(view.triangles, view.triangles + 3 * size_t{view.triangle_count});
  if (view.triangle_count > 0) {
    result->triangle_patch.assign(view.triangle_patch, view.triangle_patch + view.triangle_count);
  }
  if (result->view.patch_count > 0) {
    result->patches.assign(result->view.patches, result->view.patches + result->view.patch_count);
  }
  if (result->view.void_count > 0) {
    result->voids.assign(result->view.voids, result->view.voids + result->view.void_count);
  }
  wsk_surface_free(surface);
}

Result surface_of(Curves net, wsk_options options = plain_options(),
                  const wsk_flow_options& wish = flow_defaults()) {
  scenes::FaultyAllocator allocator;
  Result result;
  if (options.allocate == nullptr) allocator.install(&options);
  wsk_flow* flow = nullptr;
  wsk_report_init(&result.first, sizeof result.first);
  const std::vector<wsk_curve>& curves = net.list();
  result.built =
      wsk_flow_build(curves.data(), curves.size(), &options, &wish, &flow, &result.first);
  CHECK(result.first.status == result.built);
  if (result.built == WSK_OK) {
    take_surface(flow, options, wish, &result);
    wsk_flow_free(flow);
  } else {
    CHECK(flow == nullptr);
    CHECK(std::strlen(result.first.sentence) > 0);
  }
  CHECK(allocator.clean());
  return result;
}

}  // namespace

TEST_CASE("A cube's edges become a cube") {
  const Result r = surface_of(cube());
  REQUIRE(r.built == WSK_OK);
  REQUIRE(r.made == WSK_OK);
  CHECK(r.view.betti[0] == 1);
  CHECK(r.view.betti[1] == 0);
  CHECK(r.view.betti[2] == 1);
  CHECK(r.view.patch_count == 6);
  CHECK(r.report.euler_characteristic == 2);
  CHECK(r.view.manifold == 1);
  CHECK(r.view.smoothed == 0);
  CHECK(r.view.bare_count == 0);
  REQUIRE(!r.voids.empty());
  CHECK(r.voids[0].chosen == 1);
  CHECK(r.voids[0].creation == doctest::Approx(0.5).epsilon(0.01));
  CHECK(r.voids[0].filling == doctest::Approx(std::sqrt(0.5)).epsilon(0.01));
  // Six times the signed volume, positive where triangles face outward.
  double volume = 0.0;
  for (size_t t = 0; t < r.triangles.size(); t += 3) {
    const double* const a = &r.positions[3 * r.triangles[t]];
    const double* const b = &r.positions[3 * r.triangles[t + 1]];
    const double* const c = &r.positions[3 * r.triangles[t + 2]];
    volume += a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
              a[2] * (b[0] * c[1] - b[1] * c[0]);
  }
  CHECK(volume / 6.0 == doctest::Approx(1.0).epsilon(1e-9));
  for (const wsk_flow_patch& p : r.patches) {
    CHECK(p.loop_count == 1);
    CHECK(p.euler_characteristic == 1);
    CHECK(p.front == 0);
    CHECK(p.back == 1);
    CHECK(p.area == doctest::Approx(1.0).epsilon(1e-6));
  }
}

TEST_CASE("Loops run along arcs, and arcs along the surface's vertices") {
  Curves net = cube();
  const wsk_options options = plain_options();
  wsk_flow* flow = nullptr;
  REQUIRE(wsk_flow_build(net.list().data(), net.curves.size(), &options, nullptr, &flow, nullptr) ==
          WSK_OK);
  wsk_surface* surface = nullptr;
  REQUIRE(wsk_flow_surface(flow, &options, nullptr, &surface, nullptr) == WSK_OK);
  wsk_flow_view view;
  wsk_flow_get_view(flow, &view, sizeof view);
  CHECK(view.arc_count == 12);
  CHECK(view.loop_count == 6);
  for (uint32_t l = 0; l < view.loop_count; ++l) {
    CHECK(view.loop_first[l + 1] - view.loop_first[l] == 4);
    for (uint32_t i = view.loop_first[l]; i < view.loop_first[l + 1]; ++i) {
      const uint32_t next = i + 1 < view.loop_first[l + 1] ? i + 1 : view.loop_first[l];
      const wsk_flow_run &a = view.runs[i], &b = view.runs[next];
      CHECK(view.arc_vertices[view.arc_first[a.arc] + a.to] ==
            view.arc_vertices[view.arc_first[b.arc] + b.from]);
    }
  }
  wsk_surface_free(surface);
  wsk_flow_free(flow);
}

TEST_CASE("One flow makes surfaces of any number of voids, the same each time") {
  Curves net = cube();
  const wsk_options options = plain_options();
  wsk_flow* flow = nullptr;
  REQUIRE(wsk_flow_build(net.list().data(), net.curves.size(), &options, nullptr, &flow, nullptr) ==
          WSK_OK);
  Result automatic, none, again;
  wsk_flow_options wish = flow_defaults();
  take_surface(flow, options, wish, &automatic);
  wish.voids = 0;
  take_surface(flow, options, wish, &none);
  CHECK(none.view.betti[2] == 0);
  CHECK(none.view.patch_count == 5);
  wish.voids = WSK_VOIDS_AUTO;
  take_surface(flow, options, wish, &again);
  CHECK(again.positions == automatic.positions);
  CHECK(again.triangles == automatic.triangles);
  wish.raw = 1;
  Result raw;
  take_surface(flow, options, wish, &raw);
  CHECK(raw.triangles.size() < again.triangles.size());
  CHECK(raw.view.betti[2] == 1);
  wsk_flow_free(flow);
}

TEST_CASE("Normals shape the surface") {
  wsk_options options = plain_options();
  options.spacing = 0.1;
  const Result r = surface_of(sphere(), options);
  REQUIRE(r.built == WSK_OK);
  REQUIRE(r.made == WSK_OK);
  CHECK(r.view.patch_count == 8);
  CHECK(r.view.smoothed == 1);
  CHECK(r.view.crossing_count == 0);
  double worst = 0.0;
  for (size_t v = 0; v < r.positions.size(); v += 3) {
    const double* const p = &r.positions[v];
    worst = std::fmax(worst, std::fabs(std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]) - 1.0));
  }
  CHECK(worst < 1e-3);
  Curves bare = sphere();
  bare.normals.clear();
  CHECK(surface_of(bare, options).view.smoothed == 0);
}

TEST_CASE("Scaling by a power of two scales the result exactly") {
  const Result one = surface_of(cube()), big = surface_of(cube(0x1p+40));
  REQUIRE(one.positions.size() == big.positions.size());
  CHECK(one.triangles == big.triangles);
  bool exact = true;
  for (size_t i = 0; i < one.positions.size(); ++i) {
    exact = exact && one.positions[i] * 0x1p+40 == big.positions[i];
  }
  CHECK(exact);
}

TEST_CASE("Degenerate input has defined results") {
  Curves two;
  two.add({0, 0, 0, 1, 0, 0});
  Curves line;
  line.add({0, 0, 0, 1, 0, 0, 2, 0, 0, 5, 0, 0});
  line.add({7, 0, 0, 8, 0, 0});
  Curves point;
  point.add({1, 2, 3});
  Curves points;
  for (int i = 0; i < 8; ++i) points.add({double(i % 2), double(i / 2 % 2), double(i / 4)});
  Curves square;
  square.add({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, true);
  Curves same;
  same.add({1, 1, 1, 1, 1, 1, 1, 1, 1});
  Curves twice = cube();
  for (const std::vector<double>& p : cube().positions) twice.add(p);
  CHECK(surface_of(points).made == WSK_OK);
  for (const Curves& net : {two, line, point, same}) {
    const Result r = surface_of(net);
    CHECK(r.built == WSK_OK);
    CHECK(r.made == WSK_OK);
    CHECK(r.view.betti[2] == 0);
  }
  const Result flat = surface_of(square);
  CHECK(flat.made == WSK_OK);
  CHECK(flat.view.patch_count == 1);
  CHECK(flat.view.betti[1] == 0);
  const Result doubled = surface_of(twice);
  CHECK(doubled.view.patch_count == 6);
  CHECK(doubled.view.betti[2] == 1);
}

TEST_CASE("Bad input has a status and a place") {
  Curves net = cube();
  net.positions[3][4] = std::numeric_limits<double>::quiet_NaN();
  Result r = surface_of(net);
  CHECK(r.built == WSK_ERROR_NOT_A_NUMBER);
  CHECK(r.first.curve == 3);
  CHECK(r.first.sample == 1);
  net.positions[3][4] = std::numeric_limits<double>::infinity();
  CHECK(surface_of(net).built == WSK_ERROR_INFINITE);
  CHECK(surface_of(Curves()).built == WSK_ERROR_EMPTY);
  net = cube();
  net.add({});
  CHECK(surface_of(net).built == WSK_ERROR_TOO_FEW_SAMPLES);
  wsk_flow_options wish = flow_defaults();
  wish.sampling = -1.0;
  CHECK(surface_of(cube(), plain_options(), wish).built == WSK_ERROR_BAD_ARGUMENT);
  wish = flow_defaults();
  wish.most_tetrahedra = 10;
  CHECK(surface_of(cube(), plain_options(), wish).built == WSK_ERROR_TOO_LARGE);
  wish = flow_defaults();
  wish.sampling = 1e-9;
  CHECK(surface_of(cube(), plain_options(), wish).built == WSK_ERROR_TOO_LARGE);
  CHECK(wsk_flow_build(nullptr, 3, nullptr, nullptr, nullptr, nullptr) == WSK_ERROR_BAD_ARGUMENT);
  wsk_surface* surface = nullptr;
  CHECK(wsk_flow_surface(nullptr, nullptr, nullptr, &surface, nullptr) == WSK_ERROR_BAD_ARGUMENT);
  wsk_flow_free(nullptr);
  wsk_flow_view view;
  wsk_flow_get_view(nullptr, &view, sizeof view);
  CHECK(view.patch_count == 0);
  // Samples of one node that lie apart.
  const uint32_t numbers[2] = {7, 7};
  Curves apart = cube();
  apart.list();
  apart.curves[0].nodes = numbers;
  CHECK(surface_of(apart).built == WSK_ERROR_NODE_MISMATCH);
}

TEST_CASE("Failing memory and cancelling end a call cleanly") {
  Curves net = cube();
  wsk_flow_options wish = flow_defaults();
  wish.sampling = 0.2;
  const auto attempt = [&](scenes::FaultyAllocator* allocator, wsk_options options) {
    allocator->install(&options);
    wsk_flow* flow = nullptr;
    wsk_surface* surface = nullptr;
    wsk_status status =
        wsk_flow_build(net.list().data(), net.curves.size(), &options, &wish, &flow, nullptr);
    if (status == WSK_OK) status = wsk_flow_surface(flow, &options, &wish, &surface, nullptr);
    wsk_flow_free(flow);
    wsk_surface_free(surface);
    return status;
  };
  scenes::FaultyAllocator count;
  REQUIRE(attempt(&count, plain_options()) == WSK_OK);
  REQUIRE(count.calls > 50);
  const size_t step = count.calls / 60 + 1;
  for (size_t i = 0; i < count.calls; i += step) {
    scenes::FaultyAllocator faulty;
    faulty.fail_at = i;
    CHECK(attempt(&faulty, plain_options()) == WSK_ERROR_OUT_OF_MEMORY);
    CHECK(faulty.clean());
  }
  struct Cancel {
    size_t asked = 0, at = SIZE_MAX;
  } cancel;
  wsk_options options = plain_options();
  options.cancel = [](void* user) -> int32_t {
    Cancel& self = *static_cast<Cancel*>(user);
    return self.asked++ == self.at ? 1 : 0;
  };
  options.cancel_user = &cancel;
  scenes::FaultyAllocator whole;
  REQUIRE(attempt(&whole, options) == WSK_OK);
  const size_t all = cancel.asked;
  REQUIRE(all > 10);
  for (size_t at = 0; at < all; at += all / 40 + 1) {
    cancel = {0, at};
    scenes::FaultyAllocator allocator;
    CHECK(attempt(&allocator, options) == WSK_ERROR_CANCELLED);
    CHECK(allocator.clean());
  }
  options = plain_options();
  options.memory_cap = 20000;
  scenes::FaultyAllocator capped;
  CHECK(attempt(&capped, options) == WSK_ERROR_MEMORY_CAP);
  CHECK(capped.clean());
  CHECK(capped.peak_bytes <= 20000 + 4096);
}
