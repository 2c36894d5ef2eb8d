// Every kind of bad input has its own status and names the place; outputs stay untouched and
// nothing leaks (watched_build and watched look after that).
#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "support/call.h"

using namespace scenes;

constexpr double k_nan = std::numeric_limits<double>::quiet_NaN();
constexpr double k_infinity = std::numeric_limits<double>::infinity();

// The octants after `change`.
template <typename Change>
static Call network_with(const Change& change) {
  Scene scene = octants();
  change(scene);
  return watched_scene(scene);
}

// A single curve through the given points, normals along z.
static Scene line_through(const std::vector<double>& positions, bool closed) {
  Scene scene;
  Curve curve;
  curve.positions = positions;
  for (size_t i = 0; i < positions.size() / 3; ++i) {
    curve.normals.insert(curve.normals.end(), {0.0, 0.0, 1.0});
    curve.nodes.push_back(WSK_NONE);
  }
  curve.closed = closed;
  scene.curves.push_back(curve);
  return scene;
}

static void place(std::vector<double>& values, size_t sample, double x, double y, double z) {
  values[3 * sample] = x;
  values[3 * sample + 1] = y;
  values[3 * sample + 2] = z;
}

TEST_CASE("no curve") {
  CHECK(watched_build({}, options_of(octants())).status == WSK_ERROR_EMPTY);
}

TEST_CASE("too few samples") {
  for (const bool closed : {false, true}) {
    for (size_t count = 0; count <= 3; ++count) {
      CAPTURE(closed);
      CAPTURE(count);
      std::vector<double> positions = {0, 0, 0, 1, 0, 0, 0, 1, 0};
      positions.resize(3 * count);
      const Call call = watched_scene(line_through(positions, closed));
      const bool few = count < (closed ? 3u : 1u);  // an open curve of one sample is a point
      CHECK((call.status == WSK_ERROR_TOO_FEW_SAMPLES) == few);
      if (few || count == 1) CHECK(call.report.curve == 0);
      if (count == 1 && !closed) CHECK(call.status == WSK_ERROR_OPEN_NETWORK);
    }
  }
}

TEST_CASE("coordinates and normals that are no numbers or infinite") {
  for (const bool normals : {false, true}) {
    for (const size_t which : {0, 1, 2}) {
      for (const double value : {k_nan, k_infinity, -k_infinity}) {
        const Call call = network_with([&](Scene& scene) {
          Curve& curve = scene.curves[1];
          (normals ? curve.normals : curve.positions)[3 * 5 + which] = value;
        });
        CHECK(call.status == (std::isnan(value) ? WSK_ERROR_NOT_A_NUMBER : WSK_ERROR_INFINITE));
        CHECK(call.report.stage == WSK_STAGE_INPUT);
        CHECK(call.report.curve == 1);
        CHECK(call.report.sample == 5);
      }
    }
  }
}

TEST_CASE("coordinates that span more than a double can hold") {
  const Call call =
      watched_scene(line_through({-1.7e308, 0, 0, 1.7e308, 0, 0, 0, 1.7e308, 0}, true));
  CHECK(call.status == WSK_ERROR_INFINITE);
}

TEST_CASE("a curve of zero length") {
  const Call open = watched_scene(line_through({1, 2, 3, 1, 2, 3}, false));
  CHECK(open.status == WSK_ERROR_ZERO_LENGTH_CURVE);
  CHECK(open.report.curve == 0);
  const Call among = network_with([](Scene& scene) {
    for (size_t i = 0; i < scene.curves[2].size(); ++i) {
      place(scene.curves[2].positions, i, 0.5, 0.5, 0.5);
      scene.curves[2].nodes[i] = WSK_NONE;
    }
  });
  CHECK(among.status == WSK_ERROR_ZERO_LENGTH_CURVE);
  CHECK(among.report.curve == 2);
}

TEST_CASE("duplicate samples") {
  const Call inside = network_with([](Scene& scene) {
    std::vector<double>& p = scene.curves[1].positions;
    place(p, 6, p[15], p[16], p[17]);
  });
  CHECK(inside.status == WSK_ERROR_DUPLICATE_SAMPLES);
  CHECK(inside.report.curve == 1);
  CHECK(inside.report.sample == 6);

  // A closed curve whose first sample is repeated at its end.
  const Call around = network_with([](Scene& scene) {
    Curve& curve = scene.curves[2];
    for (size_t i = 0; i < 3; ++i) {
      curve.positions.push_back(curve.positions[i]);
      curve.normals.push_back(curve.normals[i]);
    }
    curve.nodes.push_back(WSK_NONE);
  });
  CHECK(around.status == WSK_ERROR_DUPLICATE_SAMPLES);
  CHECK(around.report.curve == 2);
  CHECK((around.report.sample == 32 || around.report.sample == 0));
}

TEST_CASE("normals of zero length or missing") {
  const Call zero =
      network_with([](Scene& scene) { place(scene.curves[2].normals, 7, 0.0, -0.0, 0.0); });
  CHECK(zero.status == WSK_ERROR_ZERO_NORMAL);
  CHECK(zero.report.curve == 2);
  CHECK(zero.report.sample == 7);

  // Short normals have a direction all the same.
  const Call tiny = network_with([](Scene& scene) {
    for (double& n : scene.curves[0].normals) n *= 0x1p-1000;
    for (double& n : scene.curves[1].normals) n *= 0x1p+1000;
  });
  CHECK(tiny.status == WSK_OK);

  const Scene scene = octants();
  std::vector<wsk_curve> curves = curves_of(scene);
  curves[1].normals = nullptr;
  const Call missing = watched_build(curves, options_of(scene));
  CHECK(missing.status == WSK_ERROR_MISSING_NORMALS);
  CHECK(missing.report.curve == 1);
}

TEST_CASE("samples of one node that lie apart") {
  const auto moved = [](double distance) {
    return network_with([&](Scene& scene) { scene.curves[2].positions[3 * 8] += distance; });
  };
  const Call apart = moved(1e-6);
  CHECK(apart.status == WSK_ERROR_NODE_MISMATCH);
  CHECK(apart.report.node == 0);  // the sample of circle zx on the axis +x
  CHECK((apart.report.curve == 0 || apart.report.curve == 2));
  CHECK(moved(1e-12).status == WSK_OK);
}

TEST_CASE("a network that is not closed") {
  const Call alone = watched_scene(line_through({0, 0, 0, 1, 0, 0, 1, 1, 0}, false));
  CHECK(alone.status == WSK_ERROR_OPEN_NETWORK);
  CHECK(alone.report.curve == 0);

  // A spur that leaves a node and ends in the air lies inside a patch.
  const Call spur = network_with([](Scene& scene) {
    Scene line = line_through({1, 0, 0, 0.6, 0.6, 0.6, 0.5, 0.8, 0.6}, false);
    line.curves[0].normals = {1, 0, 0, 0.6, 0.6, 0.6, 0.5, 0.8, 0.6};
    line.curves[0].nodes[0] = 0;
    scene.curves.push_back(line.curves[0]);
  });
  CHECK(spur.status == WSK_OK);
  CHECK(spur.report.patches == 8);
  CHECK(spur.report.euler_characteristic == 2);
}

TEST_CASE("normals that contradict each other") {
  const Call flipped_curve = network_with([](Scene& scene) {
    for (double& n : scene.curves[0].normals) n = -n;
  });
  CHECK(flipped_curve.status == WSK_ERROR_INCONSISTENT_NORMALS);
  CHECK(flipped_curve.report.node != WSK_NONE);

  const Call flipped_sample = network_with([](Scene& scene) {
    std::vector<double>& n = scene.curves[0].normals;
    place(n, 3, -n[9], -n[10], -n[11]);
  });
  CHECK(flipped_sample.status == WSK_ERROR_INCONSISTENT_NORMALS);
  CHECK(flipped_sample.report.curve == 0);
  CHECK((flipped_sample.report.sample == 3 || flipped_sample.report.sample == 2));
}

TEST_CASE("smoothing does not hide normals that contradict each other") {
  // Round the node +x the normals of circle 0 are tilted towards its axis, until they oppose those
  // of the other circle or their neighbours. All are noisy, so that there is something to smooth.
  const double axis[3] = {0.0, 0.0, 1.0};
  int contradictions = 0;
  for (const int reach : {0, 1, 3}) {
    for (int tenths = 0; tenths <= 20; ++tenths) {  // of a right angle
      Scene scene = octants();
      uint32_t random = 7;
      for (Curve& curve : scene.curves) {
        for (double& n : curve.normals) {
          random = random * 1664525u + 1013904223u;
          n += 0.05 * (static_cast<double>(random >> 8) / 8388608.0 - 1.0);
        }
      }
      Curve& curve = scene.curves[0];
      const double angle = 0.1 * tenths * std::acos(0.0);
      for (int k = -reach; k <= reach; ++k) {
        const int i = (k < 0 ? static_cast<int>(curve.size()) : 0) + k;
        double* n = &curve.normals[3 * static_cast<size_t>(i)];
        for (int d = 0; d < 3; ++d) n[d] = std::cos(angle) * n[d] + std::sin(angle) * axis[d];
      }
      wsk_options options = options_of(scene);
      options.method = WSK_METHOD_FAIR;
      options.spacing = 0.2;
      options.smoothing = WSK_SMOOTHING_NONE;
      const Call as_given = watched_scene(scene, options);
      options.smoothing = WSK_SMOOTHING_AUTO;
      const Call smoothed = watched_scene(scene, options);
      CAPTURE(reach);
      CAPTURE(tenths);
      CHECK(smoothed.status == as_given.status);
      CHECK(smoothed.report.sample == as_given.report.sample);
      contradictions += as_given.status == WSK_ERROR_INCONSISTENT_NORMALS;
    }
  }
  CHECK(contradictions >= 3);
}

TEST_CASE("what fails because the network lies too far from the origin says so") {
  int failed = 0;
  for (const double offset : {1e13, 1e14, 1e15, 4e15}) {
    CAPTURE(offset);
    const Call call = network_with([&](Scene& scene) {
      for (Curve& curve : scene.curves) {
        for (double& x : curve.positions) x += offset;
      }
    });
    if (call.status == WSK_OK) continue;
    ++failed;
    CHECK(std::string(call.report.sentence).find("move it to the origin") != std::string::npos);
  }
  CHECK(failed >= 1);
}

TEST_CASE("so far from the origin that products would overflow") {
  // All in the plane x = offset, so that nothing is rounded away in the other directions.
  for (const double offset : {1e40, 1e230, -1e300}) {
    CAPTURE(offset);
    Scene scene = line_through({offset, 0, 0, offset, 1, 0, offset, 1, 1, offset, 0, 1}, true);
    scene.curves[0].boundary = true;
    for (size_t i = 0; i < 12; ++i) scene.curves[0].normals[i] = i % 3 == 0 ? 1.0 : 0.0;
    const std::vector<wsk_curve> curves = curves_of(scene);
    wsk_report report;
    wsk_report_init(&report, sizeof report);
    wsk_surface* surface = nullptr;
    CHECK(wsk_build(curves.data(), 1, nullptr, &surface, &report) == WSK_ERROR_INFINITE);
    CHECK(std::string(report.sentence).find("move it to the origin") != std::string::npos);
    wsk_network* network = nullptr;
    CHECK(wsk_connect(curves.data(), 1, nullptr, &network, &report) == WSK_ERROR_INFINITE);
    wsk_flow* flow = nullptr;
    CHECK(wsk_flow_build(curves.data(), 1, nullptr, nullptr, &flow, &report) == WSK_ERROR_INFINITE);
  }
}

TEST_CASE("a normal along a curve of its node") {
  const Call call = network_with([](Scene& scene) {
    // The node +x: circle 0 runs along y there, circle 2 along z.
    place(scene.curves[0].normals, 0, 0.0, 1.0, 0.0);
    place(scene.curves[2].normals, 8, 0.0, 1.0, 0.0);
  });
  CHECK(call.status == WSK_ERROR_TANGENT_NORMAL);
  CHECK(call.report.node == 0);
}

// Squares in the plane with normals along z: what is wrong with them is planar.
static Scene flat_loop(const std::vector<double>& xy) {
  std::vector<double> positions;
  for (size_t i = 0; i < xy.size(); i += 2) {
    positions.insert(positions.end(), {xy[i], xy[i + 1], 0.0});
  }
  Scene scene = line_through(positions, true);
  scene.curves[0].boundary = true;
  return scene;
}

TEST_CASE("a flat disc needs no node") {
  const Call call = watched_scene(
      flat_loop({1, 0, 0.7, 0.7, 0, 1, -0.7, 0.7, -1, 0, -0.7, -0.7, 0, -1, 0.7, -0.7}));
  REQUIRE(call.status == WSK_OK);
  CHECK(call.report.euler_characteristic == 1);
  CHECK(call.report.boundary_loops == 1);
  CHECK(call.result.patch_count == 1);
  for (size_t i = 2; i < call.result.positions.size(); i += 3) {
    CHECK(std::fabs(call.result.positions[i]) < 1e-12);
  }
}

TEST_CASE("a border that crosses itself") {
  // A figure eight, all normals up.
  const Call call =
      watched_scene(flat_loop({0, 0,    1,  0.5, 2,  1, 3,  0.5, 3,  -0.5, 2,  -1, 1,  -0.5,
                               0, 0.01, -1, 0.5, -2, 1, -3, 0.5, -3, -0.5, -2, -1, -1, -0.5}));
  CHECK(call.status == WSK_ERROR_PATCH_FOLDED);
  CHECK(call.report.patch == 0);
}

// Within rounding: the plane of the normals, where points are rounded, shows some of them with an
// area, and space none.
TEST_CASE("a closed curve that goes out and back along a line") {
  for (int slope = 0; slope < 60; ++slope) {
    const double from[3] = {13, -15.8751220703125, -16}, to[3] = {12.875, -16, 9.875 - slope};
    std::vector<double> positions;
    for (int i = 0; i <= 6; ++i) {
      for (size_t k = 0; k < 3; ++k) positions.push_back(from[k] + i / 6.0 * (to[k] - from[k]));
    }
    Scene scene = line_through(positions, true);
    scene.curves[0].boundary = true;
    for (const double spacing : {0.5, 4.0, 14.5}) {
      scene.spacing = spacing;
      const Call call = watched_scene(scene);
      CHECK(call.status == WSK_ERROR_PATCH_FOLDED);
      CHECK(call.report.patch == 0);
    }
  }
}

TEST_CASE("a border that runs clockwise") {
  Scene scene = flat_loop({1, 0, 0.7, 0.7, 0, 1, -0.7, 0.7, -1, 0, -0.7, -0.7, 0, -1, 0.7, -0.7});
  scene.curves[0].boundary = false;  // so the outside of the disc ought to be a patch too
  const Call call = watched_scene(scene);
  CHECK(call.status == WSK_ERROR_PATCH_WITHOUT_PLANE);
  CHECK(call.report.patch < 2);
  CHECK(call.report.curve == 0);
}

// ---- The caller's mesh --------------------------------------------------------------------------

template <typename Change>
static Call mesh_with(const Change& change) {
  Scene scene = band();
  change(scene);
  return watched_scene(scene);
}

TEST_CASE("an empty mesh") {
  const Scene scene = band();
  for (const bool no_vertices : {false, true}) {
    wsk_mesh mesh = mesh_of(scene);
    (no_vertices ? mesh.vertex_count : mesh.triangle_count) = 0;
    const Call call =
        watched(options_of(scene), [&](const wsk_options* o, wsk_surface** s, wsk_report* r) {
          return wsk_smooth_mesh(&mesh, o, s, r);
        });
    CHECK(call.status == WSK_ERROR_EMPTY);
  }
}

TEST_CASE("numbers of a mesh") {
  const Call nan = mesh_with([](Scene& scene) { scene.positions[3 * 40 + 1] = k_nan; });
  CHECK(nan.status == WSK_ERROR_NOT_A_NUMBER);
  CHECK(nan.report.vertex == 40);
  const Call infinite = mesh_with([](Scene& scene) { scene.positions[3 * 41] = -k_infinity; });
  CHECK(infinite.status == WSK_ERROR_INFINITE);
  CHECK(infinite.report.vertex == 41);
  const Call bad_normal = mesh_with([](Scene& scene) { scene.normals[3 * 4 + 2] = k_nan; });
  CHECK(bad_normal.status == WSK_ERROR_NOT_A_NUMBER);
  CHECK(bad_normal.report.vertex == 4);
  const Call zero = mesh_with([](Scene& scene) { place(scene.normals, 5, 0.0, 0.0, 0.0); });
  CHECK(zero.status == WSK_ERROR_ZERO_NORMAL);
  CHECK(zero.report.vertex == 5);
  // Normals of free vertices are not read.
  CHECK(mesh_with([](Scene& scene) { scene.normals[3 * 40] = k_nan; }).status == WSK_OK);
}

TEST_CASE("a mesh that is no oriented manifold with area") {
  const Call outside = mesh_with([](Scene& scene) { scene.triangles[3 * 17 + 1] = 288; });
  CHECK(outside.status == WSK_ERROR_INDEX_OUT_OF_RANGE);
  CHECK(outside.report.triangle == 17);
  const Call none = mesh_with([](Scene& scene) { scene.triangles[3 * 18] = WSK_NONE; });
  CHECK(none.status == WSK_ERROR_INDEX_OUT_OF_RANGE);

  const Call flipped =
      mesh_with([](Scene& scene) { std::swap(scene.triangles[60], scene.triangles[61]); });
  CHECK(flipped.status == WSK_ERROR_BAD_MESH);
  const Call twice = mesh_with([](Scene& scene) {
    const std::vector<uint32_t> first(scene.triangles.begin(), scene.triangles.begin() + 3);
    scene.triangles.insert(scene.triangles.end(), first.begin(), first.end());
  });
  CHECK(twice.status == WSK_ERROR_BAD_MESH);
  const Call degenerate =
      mesh_with([](Scene& scene) { scene.triangles[3 * 20] = scene.triangles[3 * 20 + 1]; });
  CHECK(degenerate.status == WSK_ERROR_BAD_MESH);
  const Call flat = mesh_with([](Scene& scene) {
    std::vector<double>& p = scene.positions;  // two corners of a triangle coincide
    place(p, 64, p[3 * 65], p[3 * 65 + 1], p[3 * 65 + 2]);
  });
  CHECK(flat.status == WSK_ERROR_BAD_MESH);
  const Call pinched = mesh_with([](Scene& scene) {
    // A second fan at a vertex of the lower border, which its first fan does not touch.
    const uint32_t first = static_cast<uint32_t>(scene.constrained.size());
    scene.positions.insert(scene.positions.end(), {2, 0, -2, 2, 1, -2});
    scene.normals.insert(scene.normals.end(), {1, 0, 0, 1, 0, 0});
    scene.constrained.insert(scene.constrained.end(), {1, 1});
    scene.triangles.insert(scene.triangles.end(), {0, first, first + 1});
  });
  CHECK(pinched.status == WSK_ERROR_BAD_MESH);
}

TEST_CASE("a mesh that nothing holds") {
  const Call border = mesh_with([](Scene& scene) { scene.constrained[3] = 0; });
  CHECK(border.status == WSK_ERROR_UNCONSTRAINED);
  CHECK(border.report.vertex == 3);

  // A second, closed component without a constrained vertex: a tetrahedron.
  const Call component = mesh_with([](Scene& scene) {
    const uint32_t a = static_cast<uint32_t>(scene.constrained.size());
    scene.positions.insert(scene.positions.end(), {5, 0, 0, 6, 0, 0, 5, 1, 0, 5, 0, 1});
    scene.normals.insert(scene.normals.end(), 12, 1.0);
    scene.constrained.insert(scene.constrained.end(), 4, 0);
    scene.triangles.insert(scene.triangles.end(), {a, a + 2, a + 1, a, a + 1, a + 3, a, a + 3,
                                                   a + 2, a + 1, a + 2, a + 3});
  });
  CHECK(component.status == WSK_ERROR_UNCONSTRAINED);
}

TEST_CASE("normals are needed only where the method reads them") {
  const Scene scene = band();
  for (wsk_method method = 0; method < WSK_METHOD_COUNT; ++method) {
    CAPTURE(method);
    wsk_options options = options_of(scene);
    options.method = method;
    wsk_mesh mesh = mesh_of(scene);
    mesh.normals = nullptr;
    const Call call = watched(options, [&](const wsk_options* o, wsk_surface** s, wsk_report* r) {
      return wsk_smooth_mesh(&mesh, o, s, r);
    });
    const bool reads = method != WSK_METHOD_BIHARMONIC && method != WSK_METHOD_TRIHARMONIC;
    CHECK(call.status == (reads ? WSK_ERROR_MISSING_NORMALS : WSK_OK));
  }
}
