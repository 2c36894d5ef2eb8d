// The sensor's own data becomes positions: circles to the last bits, and the paper author's lilium
// against the positions that he made of the same measurements.
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "io.h"
#include "raw.h"

namespace {

using namespace networks;  // its operators on points are not found otherwise

struct SensorCurve {
  std::vector<double> arc, tangents, normals;
  std::vector<uint32_t> nodes;
  bool closed = false, boundary = false, to_next = false;
};

std::vector<wsk_sensor_curve> views_of(const std::vector<SensorCurve>& curves) {
  std::vector<wsk_sensor_curve> views;
  for (const SensorCurve& curve : curves) {
    wsk_sensor_curve view = {};
    view.sample_count = curve.arc.size();
    view.arc_lengths = curve.arc.data();
    view.tangents = curve.tangents.data();
    view.normals = curve.normals.empty() ? nullptr : curve.normals.data();
    view.nodes = curve.nodes.data();
    view.closed = curve.closed;
    view.boundary = curve.boundary;
    view.tangents_to_next = curve.to_next;
    views.push_back(view);
  }
  return views;
}

raw::Network integrate(const std::vector<SensorCurve>& curves, wsk_status* status,
                       wsk_report* report) {
  wsk_network* network = nullptr;
  wsk_report_init(report, sizeof *report);
  const std::vector<wsk_sensor_curve> views = views_of(curves);
  *status = wsk_integrate(views.data(), views.size(), nullptr, &network, report);
  return raw::Network(network);
}

// A circle of the given radius round `axis` (0 to 2), `n` steps; nodes at the quarters.
SensorCurve circle(int axis, double radius, int n, const uint32_t (&quarters)[4]) {
  SensorCurve curve;
  curve.closed = true;
  const auto u = static_cast<size_t>((axis + 1) % 3), v = static_cast<size_t>((axis + 2) % 3);
  for (int i = 0; i <= n; ++i) {
    const double a = 2.0 * std::acos(-1.0) * i / n;
    double t[3] = {}, m[3] = {};
    t[u] = -std::sin(a), t[v] = std::cos(a);
    m[u] = std::cos(a), m[v] = std::sin(a);
    curve.arc.push_back(radius * a);
    curve.tangents.insert(curve.tangents.end(), t, t + 3);
    curve.normals.insert(curve.normals.end(), m, m + 3);
    curve.nodes.push_back(4 * i % n == 0 ? quarters[4 * i / n % 4] : WSK_NONE);
  }
  return curve;
}

// Three great circles; nodes +x -x +y -y +z -z.
std::vector<SensorCurve> great_circles(double radius, int n) {
  return {circle(0, radius, n, {2, 4, 3, 5}), circle(1, radius, n, {4, 0, 5, 1}),
          circle(2, radius, n, {0, 2, 1, 3})};
}

Point at(const wsk_curve& curve, size_t i) {
  return {curve.positions[3 * i], curve.positions[3 * i + 1], curve.positions[3 * i + 2]};
}

// Stanko's .rawnet, see USERS: numbers only, so a stream reads it.
std::vector<SensorCurve> read_rawnet(const std::string& path) {
  std::ifstream file(path);
  REQUIRE(file.good());
  size_t count = 0;
  file >> count;
  std::vector<SensorCurve> curves(count);
  for (SensorCurve& curve : curves) {
    curve.to_next = true;
    size_t node_count = 0, samples = 0;
    file >> curve.boundary >> curve.closed >> node_count;
    std::vector<size_t> local(node_count);
    std::vector<uint32_t> global(node_count);
    for (size_t& i : local) file >> i;
    for (uint32_t& g : global) file >> g;
    file >> samples;
    curve.nodes.assign(samples, WSK_NONE);
    for (size_t k = 0; k < node_count; ++k) curve.nodes.at(local[k] - 1) = global[k];
    for (size_t i = 0; i < samples; ++i) {
      double row[7];
      for (double& x : row) file >> x;
      curve.arc.push_back(row[0]);
      curve.tangents.insert(curve.tangents.end(), row + 1, row + 4);
      curve.normals.insert(curve.normals.end(), row + 4, row + 7);
    }
  }
  REQUIRE(file.good());
  return curves;
}

}  // namespace

TEST_CASE("great circles from arc lengths and tangents") {
  wsk_status status;
  wsk_report report;
  const raw::Network network = integrate(great_circles(2.5, 48), &status, &report);
  REQUIRE(status == WSK_OK);
  const wsk_network_view view = raw::view_of(network);
  REQUIRE(view.curve_count == 3);
  CHECK(view.residual < 1e-14);
  CHECK(view.after.nodes == 6);
  CHECK(view.after.components == 1);
  // The first sample, +y, lies at the origin.
  for (uint32_t c = 0; c < 3; ++c) {
    REQUIRE(view.curves[c].sample_count == 48);
    for (size_t i = 0; i < 48; ++i) {
      const Point p = at(view.curves[c], i) + Point{0, 2.5, 0};
      const Point n = {view.curves[c].normals[3 * i], view.curves[c].normals[3 * i + 1],
                       view.curves[c].normals[3 * i + 2]};
      CHECK(networks::distance(p, 2.5 * n) < 1e-13);
    }
  }
  // Samples of a node coincide exactly, so the network can be surfaced as it is.
  wsk_surface* surface = nullptr;
  CHECK(wsk_build(view.curves, view.curve_count, nullptr, &surface, &report) == WSK_OK);
  CHECK(report.patches == 8);
  CHECK(report.euler_characteristic == 2);
  wsk_surface_free(surface);
}

TEST_CASE("powers of two scale the positions exactly") {
  wsk_status status;
  wsk_report report;
  const raw::Network one = integrate(great_circles(1.0, 40), &status, &report);
  const raw::Network big = integrate(great_circles(std::ldexp(1.0, 40), 40), &status, &report);
  const wsk_network_view a = raw::view_of(one), b = raw::view_of(big);
  for (uint32_t c = 0; c < 3; ++c) {
    for (size_t k = 0; k < 3 * a.curves[c].sample_count; ++k) {
      CHECK(std::ldexp(a.curves[c].positions[k], 40) == b.curves[c].positions[k]);
    }
  }
}

TEST_CASE("what the sensor cannot have measured is named") {
  wsk_status status;
  wsk_report report;
  std::vector<SensorCurve> curves = great_circles(1.0, 16);
  curves[1].arc[5] = curves[1].arc[4];
  CHECK(integrate(curves, &status, &report) == nullptr);
  CHECK(status == WSK_ERROR_DUPLICATE_SAMPLES);
  CHECK(report.curve == 1);
  CHECK(report.sample == 5);
  curves = great_circles(1.0, 16);
  for (size_t x = 0; x < 3; ++x) curves[2].tangents[3 * 7 + x] = 0.0;
  CHECK(integrate(curves, &status, &report) == nullptr);
  CHECK(status == WSK_ERROR_BAD_ARGUMENT);
  CHECK(report.sample == 7);
  curves = great_circles(1.0, 16);
  curves[0].arc[3] = std::nan("");
  CHECK(integrate(curves, &status, &report) == nullptr);
  CHECK(status == WSK_ERROR_NOT_A_NUMBER);
}

TEST_CASE("lilium as acquired") {
  const std::string folder = std::string(WIRESKIN_TEST_DATA) + "/stanko-blendernet/";
  if (!std::filesystem::exists(folder + "lilium.rawnet")) {
    MESSAGE("skipped: no stanko-blendernet under WIRESKIN_TEST_DATA");
    return;
  }
  const std::vector<SensorCurve> sensor = read_rawnet(folder + "lilium.rawnet");
  const raw::Curves truth = raw::curves_of(networks::read_network(folder + "lilium.net"));
  wsk_status status;
  wsk_report report;
  const raw::Network network = integrate(sensor, &status, &report);
  REQUIRE(status == WSK_OK);
  const wsk_network_view view = raw::view_of(network);
  REQUIRE(view.curve_count == truth.size());
  Point shift = {}, low = {1e9, 1e9, 1e9}, high = {-1e9, -1e9, -1e9};
  double count = 0.0;
  for (int pass = 0; pass < 2; ++pass) {
    double sum = 0.0, worst = 0.0;
    for (uint32_t c = 0; c < view.curve_count; ++c) {
      REQUIRE(view.curves[c].sample_count == truth[c].size());
      for (size_t i = 0; i < truth[c].size(); ++i) {
        const Point p = {truth[c].positions[3 * i], truth[c].positions[3 * i + 1],
                         truth[c].positions[3 * i + 2]};
        for (size_t x = 0; x < 3; ++x) {
          low[x] = std::fmin(low[x], p[x]);
          high[x] = std::fmax(high[x], p[x]);
        }
        const Point d = p - at(view.curves[c], i);
        if (pass == 0) {
          shift = shift + d;
          count += 1.0;
        } else {
          const double distance = networks::length(d - (1.0 / count) * shift);
          sum += distance * distance;
          worst = std::fmax(worst, distance);
        }
      }
    }
    if (pass == 0) continue;
    const double diagonal = networks::distance(low, high), rms = std::sqrt(sum / count);
    std::printf(
        "lilium.rawnet against lilium.net: rms %.1e, greatest %.1e of the diagonal; "
        "residual %.1e\n",
        rms / diagonal, worst / diagonal, view.residual / diagonal);
    CHECK(rms < 5e-5 * diagonal);
    CHECK(worst < 1e-4 * diagonal);
  }
  wsk_surface* surface = nullptr;
  CHECK(wsk_build(view.curves, view.curve_count, nullptr, &surface, &report) == WSK_OK);
  std::printf("lilium surfaced: %u patches, Euler characteristic %d\n", report.patches,
              report.euler_characteristic);
  wsk_surface_free(surface);
}
