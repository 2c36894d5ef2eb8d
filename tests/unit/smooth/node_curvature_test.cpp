// The curvature that nodes foretell on the arcs between them, against shapes whose curvature is
// known: a square grid laid on them, its rim and its two middle lines given.
#include "smooth/node_curvature.h"

#include <doctest/doctest.h>

#include <functional>

#include "support/meshes.h"

using namespace unit;
using namespace wireskin::smooth;

namespace {

constexpr uint32_t k_side = 49;  // vertices; the middle line is the 24th

struct Sheet {
  Mesh mesh = grid(k_side, k_side, 1.0 / (k_side - 1));
  std::vector<Vec3> normal = std::vector<Vec3>(mesh.position.size());
  std::vector<double> truth = std::vector<double>(mesh.position.size());
  std::vector<uint32_t> patch;
  std::vector<uint8_t> given;

  Sheet() {
    for (uint32_t v = 0; v < mesh.vertices(); ++v) {
      given.push_back(v % k_side % (k_side / 2) == 0 || v / k_side % (k_side / 2) == 0);
    }
    for (size_t t = 0; t < mesh.triangle.size(); t += 3) {
      uint32_t right = 0, above = 0;
      for (size_t k = 0; k < 3; ++k) {
        right += mesh.triangle[t + k] % k_side > k_side / 2;
        above += mesh.triangle[t + k] / k_side > k_side / 2;
      }
      patch.push_back((right > 0 ? 1 : 0) + (above > 0 ? 2 : 0));
    }
  }
};

// A torus about the z axis, or with R = 0 a sphere; u along it, v round it.
Sheet torus_sheet(double R, double r,
                  const std::function<std::array<double, 2>(double, double)>& uv) {
  Sheet sheet;
  for (size_t i = 0; i < sheet.mesh.position.size(); ++i) {
    Vec3& p = sheet.mesh.position[i];
    const auto [u, v] = uv(p.x, p.y);
    const Vec3 n = {std::cos(v) * std::cos(u), std::cos(v) * std::sin(u), std::sin(v)};
    p = r * n + R * Vec3{std::cos(u), std::sin(u), 0.0};
    sheet.normal[i] = n;
    sheet.truth[i] = 0.5 / r + 0.5 * std::cos(v) / (R + r * std::cos(v));
  }
  return sheet;
}

// The greatest error inside arcs, and the least weight over the share of its vertex.
std::array<double, 2> foretold(const Sheet& sheet) {
  Heap heap;
  Array<double> curvature(heap.context), weight(heap.context);
  must(foretell_curvature(heap.context,
                          {span(sheet.mesh.position), span(sheet.normal), span(sheet.mesh.triangle),
                           span(sheet.patch), span(sheet.given)},
                          &curvature, &weight));
  double error = 0.0, least = 1e300;
  for (uint32_t v = 0; v < sheet.mesh.vertices(); ++v) {
    const bool node = v % k_side % (k_side / 2) == 0 && v / k_side % (k_side / 2) == 0;
    CHECK((weight[v] > 0.0) == (sheet.given[v] && !node));
    if (weight[v] == 0.0) continue;
    error = std::fmax(error, std::fabs(curvature[v] - sheet.truth[v]));
    const uint32_t along = sheet.given[v + 1] && sheet.given[v - 1] ? 1 : k_side;
    const double share = 0.5 * (length(sheet.mesh.position[v + along] - sheet.mesh.position[v]) +
                                length(sheet.mesh.position[v - along] - sheet.mesh.position[v]));
    least = std::fmin(least, weight[v] / share);
  }
  return {error, least};
}

}  // namespace

TEST_CASE("a sphere, whatever curves lie on it") {
  const auto [error, trust] = foretold(torus_sheet(0.0, 2.0, [](double x, double y) {
    return std::array<double, 2>{x + 0.4 * y, 0.3 + 0.8 * y - 0.2 * x * x};
  }));
  CHECK(error < 2e-3 * 0.5);
  CHECK(trust > 1.0);
}

TEST_CASE("a torus by meridians and parallels") {
  const auto [error, trust] = foretold(torus_sheet(2.0, 1.0, [](double x, double y) {
    return std::array<double, 2>{x, 0.2 + 1.4 * y};
  }));
  CHECK(error < 5e-3);
  CHECK(trust > 1.0);
}

TEST_CASE("a torus by skew curves, which are no lines of curvature and no geodesics") {
  const auto [error, trust] = foretold(torus_sheet(2.0, 1.0, [](double x, double y) {
    return std::array<double, 2>{x - 0.2 * y + 0.3 * x * y, 0.2 + 0.5 * x + 0.9 * y};
  }));
  CHECK(error < 5e-3);
  CHECK(trust > 0.5);
}

TEST_CASE("the slopes count: without them the middle of the arcs would be far off") {
  // Half way between nodes the mean of the nodes' curvatures is off by more than the cubic.
  const Sheet sheet = torus_sheet(2.0, 1.0, [](double x, double y) {
    return std::array<double, 2>{x, 0.2 + 2.4 * y};
  });
  const uint32_t quarter = k_side / 4 * k_side, half = 2 * quarter;
  const double mean = 0.5 * (sheet.truth[0] + sheet.truth[half]);
  CHECK(foretold(sheet)[0] < 0.5 * std::fabs(mean - sheet.truth[quarter]));
}

TEST_CASE("curves without nodes tell nothing") {
  Heap heap;
  const Mesh band = tube(40, 9, 1.0, false);
  std::vector<uint8_t> given(band.vertices(), 0);
  for (uint32_t v = 0; v < 40; ++v) given[v] = given[band.vertices() - 1 - v] = 1;
  const std::vector<uint32_t> patch(band.triangle.size() / 3, 0);
  Array<double> curvature(heap.context), weight(heap.context);
  must(foretell_curvature(
      heap.context,
      {span(band.position), span(band.position), span(band.triangle), span(patch), span(given)},
      &curvature, &weight));
  for (double w : weight) CHECK(w == 0.0);
}
