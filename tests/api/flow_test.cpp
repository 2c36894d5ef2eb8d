// Surfaces from curves alone through the C API: what comes out, what is kept, bad and degenerate
// input, memory, cancelling, scaling.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "support/faulty_allocator.h"
#include "support/scenes.h"

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
Curves sphere(int pieces = 32) {
  Curves net;
  const int half = pieces / 2, quarter = pieces / 4;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> p;
    for (int i = 0; i < pieces; ++i) {
      const double a = 2.0 * 3.14159265358979323846 * i / pieces;
      double q[3] = {};
      // Exact where circles meet, so that they coincide.
      q[axis] = i % half == quarter ? 0.0 : i == 0 ? 1.0 : i == half ? -1.0 : std::cos(a);
      q[(axis + 1) % 3] = i % half == 0         ? 0.0
                          : i == quarter        ? 1.0
                          : i == half + quarter ? -1.0
                                                : std::sin(a);
      if (i % half == quarter) q[axis] = 0.0;
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

TEST_CASE("Corners at a cube's edges have their own faces' normals") {
  const scenes::Scene cube = [] {
    for (const scenes::Scene& scene : scenes::all()) {
      if (scene.name == "flow_box") return scene;
    }
    return scenes::Scene{};
  }();
  const scenes::Result r = scenes::result_of(cube);
  REQUIRE(!r.crease_corners.empty());
  for (size_t i = 0; i < r.crease_corners.size(); ++i) {
    const uint32_t* v = &r.triangles[r.crease_corners[i] / 3 * 3];
    double edge[2][3], across[3], norm = 0.0, cosine = 0.0;
    for (size_t k = 0; k < 6; ++k) {
      edge[k / 3][k % 3] = r.positions[3 * v[1 + k / 3] + k % 3] - r.positions[3 * v[0] + k % 3];
    }
    for (size_t k = 0; k < 3; ++k) {
      const size_t m = (k + 1) % 3, n = (k + 2) % 3;
      across[k] = edge[0][m] * edge[1][n] - edge[0][n] * edge[1][m];
      norm += across[k] * across[k];
      cosine += across[k] * r.crease_normals[3 * i + k];
    }
    CHECK(cosine / std::sqrt(norm) > 1.0 - 1e-9);
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

// Two circles and four rails.
static Curves can() {
  Curves net;
  std::vector<double> low, high;
  for (int i = 0; i < 48; ++i) {
    const double a = 2.0 * 3.14159265358979323846 * i / 48;
    low.insert(low.end(), {std::cos(a), std::sin(a), 0.0});
    high.insert(high.end(), {std::cos(a), std::sin(a), 2.0});
  }
  net.add(low, true);
  net.add(high, true);
  for (size_t i = 0; i < 48; i += 12) {
    net.add({low[3 * i], low[3 * i + 1], 0.0, high[3 * i], high[3 * i + 1], 2.0});
  }
  return net;
}

TEST_CASE("Round ends are open or closed as asked for, and those left open are counted") {
  wsk_flow_options wish = flow_defaults();
  CHECK(wish.lids == WSK_LIDS_SINGLE);
  const Result tube = surface_of(can(), plain_options(), wish);
  REQUIRE(tube.made == WSK_OK);
  CHECK(tube.view.patch_count == 5);
  CHECK(tube.view.open_lid_count == 1);
  wish.lids = WSK_LIDS_ALL;
  const Result closed = surface_of(can(), plain_options(), wish);
  REQUIRE(closed.made == WSK_OK);
  CHECK(closed.view.patch_count == 6);
  CHECK(closed.view.betti[2] == 1);
  CHECK(closed.view.open_lid_count == 0);
  CHECK(closed.view.caged_count == 1);
  wish.voids = 0;
  const Result bare = surface_of(can(), plain_options(), wish);
  REQUIRE(bare.made == WSK_OK);
  // Both ends stay: it is a side that is left open.
  CHECK(bare.view.betti[2] == 0);
  CHECK(bare.view.patch_count == 5);
  CHECK(bare.view.open_lid_count == 0);
}

// Cubes in rows, none of whose faces is flat.
static Curves crooked_grid(int cells) {
  Curves net;
  const int n = cells + 1;
  const auto corner = [&](int i) {
    const int at[3] = {i % n, i / n % n, i / n / n};
    std::array<double, 3> p;
    for (int k = 0; k < 3; ++k) p[size_t(k)] = at[k] + 0.1 * std::sin(7.0 * i + 2.0 * k);
    return p;
  };
  for (int i = 0; i < n * n * n; ++i) {
    for (int step = 1; step < n * n * n; step *= n) {
      if (i / step % n == cells) continue;
      const std::array<double, 3> a = corner(i), b = corner(i + step);
      net.add({a[0], a[1], a[2], b[0], b[1], b[2]});
    }
  }
  return net;
}

TEST_CASE("Voids beyond the most that are looked at are counted") {
  const Result few = surface_of(crooked_grid(2));
  CHECK(few.view.betti[2] == 8);
  CHECK(few.view.untried_count == 0);
  const Result many = surface_of(crooked_grid(6));
  CHECK(many.view.betti[2] == 200);
  CHECK(many.view.untried_count >= 16);
}

TEST_CASE("A view tells the sampling, and what was not looked at") {
  const Result plain = surface_of(cube());
  CHECK(plain.view.sampling == doctest::Approx(0.02 * std::sqrt(3.0)));
  CHECK(plain.view.faces_skipped == 0);
  CHECK(plain.view.untried_count == 0);
  wsk_flow_options wish = flow_defaults();
  wish.sampling = 0.1;
  CHECK(surface_of(cube(), plain_options(), wish).view.sampling == doctest::Approx(0.1));
  // A spacing coarser than that coarsens the inside only: all samples stay.
  wsk_options coarse = plain_options();
  coarse.spacing = 0.3;
  const Result wide = surface_of(cube(), coarse);
  CHECK(wide.view.sample_count == plain.view.sample_count);
  CHECK(wide.triangles.size() < plain.triangles.size());
  CHECK(wide.positions.size() >= 3 * size_t{wide.view.sample_count});
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

TEST_CASE("Curves of few samples with normals are taken for smooth ones") {
  for (const int pieces : {12, 16, 20, 24, 32, 64}) {
    CAPTURE(pieces);
    const Result r = surface_of(sphere(pieces));
    REQUIRE(r.made == WSK_OK);
    CHECK(r.view.manifold == 1);
    CHECK(r.view.smoothed == 1);
    double worst = 0.0;
    for (size_t v = 0; v < r.positions.size(); v += 3) {
      const double* const p = &r.positions[v];
      worst = std::fmax(worst, std::fabs(std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]) - 1.0));
    }
    CHECK(worst < (pieces == 12 ? 3e-3 : 1e-3));
  }
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

// ---- Noise, normals that cannot be used, voids
// ---------------------------------------------------

namespace {

// Adds Gaussian noise (a sum of twelve uniform numbers) of the given deviation to every coordinate;
// samples at the same place move together.
Curves shaken(Curves net, double sigma) {
  uint64_t state = 1;
  const auto uniform = [&]() {
    state = state * 6364136223846793005ull + 1442695040888963407ull;
    return double(state >> 11) * 0x1p-53;
  };
  std::vector<std::array<double, 6>> moved;
  for (std::vector<double>& p : net.positions) {
    for (size_t i = 0; i < p.size(); i += 3) {
      const std::array<double, 3> at = {p[i], p[i + 1], p[i + 2]};
      const auto same = std::find_if(moved.begin(), moved.end(), [&](const auto& m) {
        return m[0] == at[0] && m[1] == at[1] && m[2] == at[2];
      });
      if (same != moved.end()) {
        std::copy(same->begin() + 3, same->end(), p.begin() + std::ptrdiff_t(i));
        continue;
      }
      std::array<double, 6> move = {at[0], at[1], at[2], 0, 0, 0};
      for (size_t k = 0; k < 3; ++k) {
        double sum = -6.0;
        for (int n = 0; n < 12; ++n) sum += uniform();
        move[3 + k] = p[i + k] = at[k] + sigma * sum;
      }
      moved.push_back(move);
    }
  }
  return net;
}

// Of the surface's vertices from the unit sphere, at the given samples' curves only.
double curve_error(const Curves& net, const wsk_options& options, wsk_report* report) {
  Curves copy = net;
  const std::vector<wsk_curve>& curves = copy.list();
  wsk_flow* flow = nullptr;
  wsk_surface* surface = nullptr;
  wsk_report_init(report, sizeof *report);
  REQUIRE(wsk_flow_build(curves.data(), curves.size(), &options, nullptr, &flow, report) == WSK_OK);
  const double noise = report->noise_position;
  REQUIRE(wsk_flow_surface(flow, &options, nullptr, &surface, report) == WSK_OK);
  CHECK(report->noise_position == noise);
  wsk_surface_view view;
  wsk_surface_get_view(surface, &view, sizeof view);
  double sum = 0.0;
  size_t count = 0;
  for (uint32_t v = 0; v < view.vertex_count; ++v) {
    if (view.vertex_curve[v] == WSK_NONE) continue;
    const double* const p = view.positions + 3 * size_t{v};
    const double off = std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]) - 1.0;
    sum += off * off;
    ++count;
  }
  wsk_surface_free(surface);
  wsk_flow_free(flow);
  return std::sqrt(sum / double(count));
}

Curves without_normals(Curves net) {
  net.normals.clear();
  return net;
}

// The great circles in pieces of two samples each, in disorder.
Curves fragments(const Curves& net) {
  Curves pieces;
  for (size_t stride = 0; stride < 2; ++stride) {
    for (const std::vector<double>& p : net.positions) {
      for (size_t i = 3 * stride; i < p.size(); i += 6) {
        const size_t next = i + 3 < p.size() ? i + 3 : 0;
        pieces.add({p[i], p[i + 1], p[i + 2], p[next], p[next + 1], p[next + 2]});
      }
    }
  }
  return pieces;
}

}  // namespace

TEST_CASE("Noise on curves alone is found and taken out, clean curves keep their bits") {
  const double sigma = 0.01;
  for (const bool broken : {false, true}) {
    CAPTURE(broken);
    const Curves clean = broken ? fragments(sphere(128)) : without_normals(sphere(128));
    const Curves noisy = shaken(clean, sigma);
    wsk_options options = plain_options();
    wsk_report report;
    options.smoothing = WSK_SMOOTHING_NONE;
    const double raw = curve_error(noisy, options, &report);
    CHECK(report.noise_position == 0.0);
    CHECK(report.constraint_distance_max < 0.05 * 0.02 * 2 * std::sqrt(3.0));
    options.smoothing = WSK_SMOOTHING_DEFAULT;
    const double found = curve_error(noisy, options, &report);
    CHECK(report.noise_position > 0.7 * sigma);
    CHECK(report.noise_position < 1.3 * sigma);
    CHECK(report.constraint_distance_rms > 0.5 * sigma);
    options.smoothing = WSK_SMOOTHING_GIVEN;
    options.noise = sigma;
    const double given = curve_error(noisy, options, &report);
    CHECK(report.noise_position == doctest::Approx(sigma).epsilon(1e-12));
    CHECK(raw > 0.7 * sigma);
    CHECK(given < 0.6 * raw);
    CHECK(found < (broken ? 0.8 : 0.6) * raw);
    options = plain_options();
    const Result plain = surface_of(clean, options);
    options.smoothing = WSK_SMOOTHING_NONE;
    CHECK(surface_of(clean, options).positions == plain.positions);
    CHECK(plain.report.noise_position < 1e-4);
  }
}

TEST_CASE("Corners stay corners while noise is taken out between them") {
  // A square of 4 x 20 samples as one closed curve, shaken by a tenth of the spacing.
  Curves square;
  std::vector<double> p;
  for (int side = 0; side < 4; ++side) {
    for (int i = 0; i < 20; ++i) {
      const double t = i / 20.0;
      const double x[4] = {t, 1, 1 - t, 0}, y[4] = {0, t, 1, 1 - t};
      p.insert(p.end(), {x[side], y[side], 0.0});
    }
  }
  square.add(p, true);
  const double sigma = 0.005;
  const Curves noisy = shaken(square, sigma);
  wsk_report report;
  wsk_options options = plain_options();
  wsk_flow* flow = nullptr;
  Curves copy = noisy;
  wsk_report_init(&report, sizeof report);
  REQUIRE(wsk_flow_build(copy.list().data(), 1, &options, nullptr, &flow, &report) == WSK_OK);
  wsk_surface* surface = nullptr;
  REQUIRE(wsk_flow_surface(flow, &options, nullptr, &surface, &report) == WSK_OK);
  CHECK(report.noise_position > 0.6 * sigma);
  CHECK(report.segments == 4);
  wsk_surface_view view;
  wsk_surface_get_view(surface, &view, sizeof view);
  for (int corner = 0; corner < 4; ++corner) {
    const double* const c = &square.positions[0][size_t(60 * corner)];
    double least = 1.0;
    for (uint32_t v = 0; v < view.vertex_count; ++v) {
      const double* const q = view.positions + 3 * size_t{v};
      least = std::fmin(least, std::hypot(q[0] - c[0], std::hypot(q[1] - c[1], q[2] - c[2])));
    }
    CHECK(least < 4 * sigma);
  }
  wsk_surface_free(surface);
  wsk_flow_free(flow);
  // Without noise nothing moves, however coarse and angular the curve is.
  Curves stairs;
  std::vector<double> steps;
  for (int i = 0; i < 12; ++i)
    steps.insert(steps.end(), {i / 12.0, i / 12.0, 0, (i + 1) / 12.0, i / 12.0, 0});
  steps.insert(steps.end(), {0.0, 1.0, 0.0});
  stairs.add(steps, true);
  const Result stepped = surface_of(stairs);
  options.smoothing = WSK_SMOOTHING_NONE;
  CHECK(surface_of(stairs, options).positions == stepped.positions);
  CHECK(stepped.report.constraint_distance_max == 0.0);
}

TEST_CASE("Given samples lie within a twentieth of the sampling, junctions are vertices") {
  const Curves net = without_normals(sphere());  // 32 samples a circle
  wsk_flow_options wish = flow_defaults();
  wsk_options options = plain_options();
  options.smoothing = WSK_SMOOTHING_NONE;
  for (const double sampling : {0.05, 0.1, 0.2, 0.4, 0.7}) {
    CAPTURE(sampling);
    wish.sampling = sampling;
    const Result r = surface_of(net, options, wish);
    REQUIRE(r.made == WSK_OK);
    CHECK(r.report.constraint_distance_max <= 0.05 * sampling);
    for (const std::vector<double>& p : net.positions) {
      for (size_t i = 0; i < p.size(); i += 24 * p.size() / 96) {  // where circles cross
        bool kept = false;
        for (size_t v = 0; v < r.positions.size(); v += 3) {
          kept = kept || std::memcmp(&r.positions[v], &p[i], 24) == 0;
        }
        CHECK(kept);
      }
    }
  }
}

TEST_CASE("Soft curves are refused, by name") {
  wsk_options options = plain_options();
  options.soft = 0.1;
  Result r = surface_of(cube(), options);
  CHECK(r.built == WSK_ERROR_BAD_ARGUMENT);
  CHECK(std::strstr(r.first.sentence, "soft") != nullptr);
  Curves net = cube();
  net.list();
  net.curves[5].soft = 0.1;
  r = surface_of(net);
  CHECK(r.built == WSK_ERROR_BAD_ARGUMENT);
  CHECK(r.first.curve == 5);
  options = plain_options();
  options.noise = 5.0;
  options.smoothing = WSK_SMOOTHING_GIVEN;
  CHECK(surface_of(without_normals(sphere()), options).built == WSK_ERROR_BAD_ARGUMENT);
}

TEST_CASE("Where normals would make the surface cross itself, it stays as remeshed") {
  // Drums: two circles with a disc each and a band between them. Normals at the rims that lean far
  // outward fold the narrow band, now and then over itself.
  const auto drum = [](double height, double lean) {
    Curves net;
    for (const double side : {-1.0, 1.0}) {
      std::vector<double> p, n;
      for (int i = 0; i < 64; ++i) {
        const double a = 2.0 * 3.14159265358979323846 * i / 64;
        const double q[3] = {std::cos(a), std::sin(a), 0.5 * side * height};
        const double m[3] = {std::sin(lean) * q[0], std::sin(lean) * q[1], std::cos(lean) * side};
        p.insert(p.end(), q, q + 3);
        n.insert(n.end(), m, m + 3);
      }
      net.add(p, true);
      net.normals.push_back(n);
    }
    return net;
  };
  wsk_options options = plain_options();
  options.spacing = 0.1;
  wsk_flow_options wish = flow_defaults();
  wish.voids = 1;
  int used = 0, crossing = 0;
#ifdef WIRESKIN_TESTS_SANITIZED
  constexpr int k_step = 3;
#else
  constexpr int k_step = 1;
#endif
  for (const double height : {0.2, 0.25, 0.3}) {
    for (int i = 0; i < 10; i += k_step) {
      CAPTURE(height);
      CAPTURE(i);
      const Result r = surface_of(drum(height, 0.7 + 0.05 * i), options, wish);
      if (r.view.normals == WSK_FLOW_NORMALS_USED) ++used;
      if (r.view.normals != WSK_FLOW_NORMALS_CROSSING) continue;
      ++crossing;
      CHECK(r.view.normals_places > 0);
      CHECK(std::strlen(r.view.normals_sentence) > 0);
      CHECK(r.view.smoothed == 0);
      CHECK(r.view.crossing_count == 0);
      // Remeshing leaves discs and band where the curves have them.
      for (size_t k = 0; k < r.positions.size(); k += 3) {
        const double across = std::hypot(r.positions[k], r.positions[k + 1]);
        CHECK(across <= 1.0 + 1e-9);
        CHECK(std::fabs(r.positions[k + 2]) <= 0.5 * height + 1e-9);
        if (across < 0.9) CHECK(std::fabs(r.positions[k + 2]) > 0.49 * height);
      }
    }
  }
  CHECK(used > 0);
  CHECK(crossing > 0);
}

TEST_CASE("Why normals were not used is said") {
  wsk_options options = plain_options();
  options.spacing = 0.1;
  Result r = surface_of(sphere(), options);
  CHECK(r.view.normals == WSK_FLOW_NORMALS_USED);
  CHECK(std::strlen(r.view.normals_sentence) == 0);
  r = surface_of(without_normals(sphere()), options);
  CHECK(r.view.normals == WSK_FLOW_NORMALS_NONE);
  CHECK(std::strlen(r.view.normals_sentence) == 0);

  Curves some = sphere();
  some.list();
  some.curves[1].sharp = 1;
  r = surface_of(some, options);
  CHECK(r.view.normals == WSK_FLOW_NORMALS_INCOMPLETE);
  CHECK(r.view.normals_places == 1);
  CHECK(std::strlen(r.view.normals_sentence) > 0);

  Curves contrary = sphere();  // every other normal inward
  for (std::vector<double>& n : contrary.normals) {
    for (size_t i = 0; i < n.size(); ++i) n[i] = (i / 3) % 2 == 0 ? n[i] : -n[i];
  }
  r = surface_of(contrary, options);
  CHECK(r.view.normals == WSK_FLOW_NORMALS_CONTRADICTING);
  CHECK(r.view.normals_places > 10);
  CHECK(r.view.smoothed == 0);
  CHECK(r.view.crossing_count == 0);
  CHECK(!r.triangles.empty());

  // Two cubes with a wall between: three patches meet at its curves.
  Curves walls = cube();
  for (const std::vector<double>& p : cube().positions) {
    if (p[0] == 1.0 && p[3] == 1.0) continue;
    std::vector<double> q = p;
    q[0] = 2.0 - q[0], q[3] = 2.0 - q[3];
    walls.add(q);
  }
  for (const std::vector<double>& p : walls.positions) {
    std::vector<double> n(p);
    for (size_t i = 0; i < n.size(); ++i) n[i] -= i % 3 == 0 ? 1.0 : 0.5;
    for (size_t i = 0; i < n.size(); i += 3) n[i] += n[i] == 0.0 ? 0.1 : 0.0;
    walls.normals.push_back(n);
  }
  r = surface_of(walls, options);
  REQUIRE(r.made == WSK_OK);
  CHECK(r.view.manifold == 0);
  CHECK(r.view.normals == WSK_FLOW_NORMALS_NOT_MANIFOLD);
  CHECK(r.view.normals_places >= 4);
}

TEST_CASE("A point may lack its normal where the curves have theirs") {
  Curves net = sphere();
  const double s = 1.0 / std::sqrt(3.0);
  net.add({s, s, s});
  net.list();
  wsk_options options = plain_options();
  options.spacing = 0.1;
  std::vector<wsk_curve> curves = net.curves;
  for (size_t c = 0; c < 3; ++c) {
    curves[c].positions = net.positions[c].data();
    curves[c].normals = net.normals[c].data();
  }
  curves[3].positions = net.positions[3].data();
  curves[3].normals = nullptr;
  wsk_flow* flow = nullptr;
  wsk_surface* surface = nullptr;
  REQUIRE(wsk_flow_build(curves.data(), 4, &options, nullptr, &flow, nullptr) == WSK_OK);
  REQUIRE(wsk_flow_surface(flow, &options, nullptr, &surface, nullptr) == WSK_OK);
  wsk_flow_view view;
  wsk_flow_get_view(flow, &view, sizeof view);
  CHECK(view.normals == WSK_FLOW_NORMALS_USED);
  wsk_surface_free(surface);
  wsk_flow_free(flow);
}

TEST_CASE("How many voids are caged is said") {
  wsk_flow_options wish = flow_defaults();
  CHECK(surface_of(cube()).view.caged_count == 1);
  wish.voids = 0;
  CHECK(surface_of(cube(), plain_options(), wish).view.caged_count == 0);
  wish.voids = 1;
  CHECK(surface_of(cube(), plain_options(), wish).view.caged_count == 1);
  wish.voids = 1000;
  const Result many = surface_of(cube(), plain_options(), wish);
  CHECK(many.view.caged_count < 1000);
  CHECK(many.view.betti[2] <= many.view.caged_count);
}

TEST_CASE("flow: what fails because the curves lie too far from the origin says so") {
  int failed = 0;
  for (const double offset : {1e3, 1e15, 1e16, 1e18}) {
    CAPTURE(offset);
    Curves net = sphere();
    for (std::vector<double>& p : net.positions) {
      for (size_t i = 0; i < p.size(); i += 3) p[i] += offset;
    }
    net.normals.clear();
    wsk_report report;
    wsk_report_init(&report, sizeof report);
    wsk_flow* flow = nullptr;
    const wsk_status status =
        wsk_flow_build(net.list().data(), net.curves.size(), nullptr, nullptr, &flow, &report);
    CHECK(report.status == status);
    wsk_flow_free(flow);
    if (status == WSK_OK) continue;
    ++failed;
    CHECK(std::string(report.sentence).find("move it to the origin") != std::string::npos);
  }
  CHECK(failed >= 1);
}

TEST_CASE("flow: a spacing that asks for too many vertices is refused at once, with the patch") {
  Curves net = sphere();
  net.normals.clear();
  wsk_options options;
  wsk_options_init(&options, sizeof options);
  wsk_report report;
  wsk_report_init(&report, sizeof report);
  wsk_flow* flow = nullptr;
  REQUIRE(wsk_flow_build(net.list().data(), net.curves.size(), &options, nullptr, &flow, &report) ==
          WSK_OK);
  wsk_surface* surface = nullptr;
  options.spacing = 1e-5;
  CHECK(wsk_flow_surface(flow, &options, nullptr, &surface, &report) == WSK_ERROR_TOO_LARGE);
  CHECK(report.patch < 8);
  CHECK(report.peak_bytes < 50000000);
  CHECK(surface == nullptr);
  // The samples that such a spacing would need are refused just so.
  wsk_flow* fine = nullptr;
  options.spacing = 1e-7;
  CHECK(wsk_flow_build(net.list().data(), net.curves.size(), &options, nullptr, &fine, &report) ==
        WSK_ERROR_TOO_LARGE);
  CHECK(report.peak_bytes < 50000000);
  wsk_flow_free(flow);
}
