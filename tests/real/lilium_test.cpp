// The paper author's own network with measured normals. The file may not be shipped: the test runs
// where WIRESKIN_TEST_DATA names a folder that holds it.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdio>

#include "accuracy/noise.h"
#include "accuracy/real.h"
#include "curves/curve.h"
#include "network/nodes.h"
#include "support/context.h"

namespace {

using namespace networks;  // its operators on points are not found otherwise

wireskin::Vec3 vec(const Point& p) {
  return {p[0], p[1], p[2]};
}

// The splines of all curves, made from the library's own parts.
struct Fitted {
  wireskin::Context& context;
  wireskin::Array<wireskin::network::Node> nodes{context};
  wireskin::curves::Curves curves{context};

  explicit Fitted(wireskin::Context& c) : context(c) {}
  void fit(const networks::Network& network) {
    std::vector<uint32_t> start = {0}, number;
    std::vector<wireskin::Vec3> positions, normals;
    for (const auto& curve : network.curves) {
      for (uint32_t v : curve.vertices) {
        positions.push_back(vec(network.positions[v]));
        normals.push_back(wireskin::unit(vec(network.normals[v])));
        number.push_back(v);
      }
      start.push_back(static_cast<uint32_t>(positions.size()));
    }
    wireskin::Array<uint32_t> node(context);
    REQUIRE(wireskin::network::find_nodes({{start.data(), start.size()},
                                           {number.data(), number.size()},
                                           {positions.data(), positions.size()},
                                           {normals.data(), normals.size()}},
                                          1e-9, &nodes, &node)
                .ok());
    for (size_t c = 0; c + 1 < start.size(); ++c) {
      const size_t first = start[c], count = start[c + 1] - first;
      for (size_t i = first; i < first + count; ++i) {
        if (node[i] != wireskin::k_none) normals[i] = nodes[node[i]].normal;
      }
      REQUIRE(wireskin::curves::add_curve({{positions.data() + first, count},
                                           {normals.data() + first, count},
                                           node.span().part(first, count),
                                           network.curves[c].closed},
                                          &curves)
                  .ok());
    }
  }
};

// The distance from p to a spline: the nearest of a dense sampling, then ternary search around it.
double distance_to_spline(const wireskin::curves::Spline& spline, const Point& p) {
  constexpr int k_pieces = 8;
  const auto at = [&](size_t i, double part) {
    const double t = spline.knot[i] + part * (spline.knot[i + 1] - spline.knot[i]);
    return wireskin::length(wireskin::curves::spline_value(spline, i, t) - vec(p));
  };
  double best = 1e300;
  size_t nearest = 0;
  for (size_t i = 0; i < spline.intervals(); ++i) {
    for (int k = 0; k <= k_pieces; ++k) {
      const double distance = at(i, static_cast<double>(k) / k_pieces);
      if (distance < best) best = distance, nearest = i;
    }
  }
  for (size_t i = nearest - (nearest > 0); i <= nearest + 1 && i < spline.intervals(); ++i) {
    double low = 0.0, high = 1.0;
    for (int step = 0; step < 100; ++step) {
      const double a = low + (high - low) / 3.0, b = high - (high - low) / 3.0;
      if (at(i, a) < at(i, b)) {
        high = b;
      } else {
        low = a;
      }
    }
    best = std::fmin(best, at(i, 0.5 * (low + high)));
  }
  return best;
}

// |x' x x''| / |x'|^3, the greatest on the stretch of a curve within `reach` of arc length s.
double greatest_curvature(const wireskin::curves::Curve& curve, double s, double reach) {
  const wireskin::curves::Spline& spline = curve.position;
  double greatest = 0.0;
  for (size_t i = 0; i < spline.intervals(); ++i) {
    if (curve.arc[i + 1] < s - reach || curve.arc[i] > s + reach) continue;
    for (int k = 0; k <= 8; ++k) {
      const double part = k / 8.0;
      const double t = spline.knot[i] + part * (spline.knot[i + 1] - spline.knot[i]);
      const wireskin::Vec3 first = wireskin::curves::spline_derivative(spline, i, t);
      const wireskin::Vec3 second = (1.0 - part) * spline.moment[i] + part * spline.moment[i + 1];
      const double speed = wireskin::length(first);
      greatest = std::fmax(
          greatest, wireskin::length(wireskin::cross(first, second)) / (speed * speed * speed));
    }
  }
  return greatest;
}

}  // namespace

TEST_CASE("lilium, measured curves and normals") {
  const std::vector<accuracy::RealCase> cases = accuracy::lilium();
  if (cases.empty()) {
    std::printf("skipped: lilium is not in WIRESKIN_TEST_DATA\n");
    return;
  }
  const accuracy::RealCase& c = cases[0];
  const networks::Network& network = c.network;
  const double diagonal = 2.86;
  const accuracy::Result result = accuracy::build(network, WSK_METHOD_STANKO, 0.035);
  REQUIRE_MESSAGE(result.status == WSK_OK, result.report.sentence);
  CHECK(result.report.components == 1);
  CHECK(result.report.boundary_loops == 1);
  CHECK(result.report.euler_characteristic == 1);
  CHECK(result.report.patches == 4);
  CHECK(result.report.nodes == 5);
  CHECK(result.report.segments == 8);

  unit::Heap heap;
  Fitted fitted(heap.context);
  fitted.fit(network);

  // Nodes bit for bit; all other curve vertices on the spline.
  REQUIRE(fitted.nodes.size() == 5);
  for (size_t i = 0; i < fitted.nodes.size(); ++i) {
    CHECK(vec(result.positions[i]) == fitted.nodes[i].position);
  }
  double off_spline = 0.0;
  for (size_t v = 0; v < result.positions.size(); ++v) {
    if (result.is_free(v)) continue;
    const auto spline = fitted.curves[result.vertex_curve[v]].position;
    off_spline = std::fmax(off_spline, distance_to_spline(spline, result.positions[v]));
  }
  CHECK(off_spline <= 1e-9 * diagonal);

  // Kept samples lie no farther from the mesh than the sagitta of its edges, length^2 curvature / 8
  // with the greatest curvature within an edge's length (and rounding).
  const double edge = 0.0365;  // the longest after dividing each segment evenly
  double off_mesh = 0.0, worst_ratio = 0.0;
  const accuracy::MeshDistance distance(accuracy::mesh_of(result));
  for (size_t i = 0; i < fitted.curves.size(); ++i) {
    const auto curve = fitted.curves[i];
    for (size_t k = 0; k < curve.arc.size(); ++k) {
      const wireskin::Vec3& kept = curve.position.value[k];
      const double best = distance.nearest({kept.x, kept.y, kept.z}).distance;
      const double sagitta = edge * edge * greatest_curvature(curve, curve.arc[k], edge) / 8.0;
      off_mesh = std::fmax(off_mesh, best);
      worst_ratio = std::fmax(worst_ratio, best / (sagitta + 1e-12));
    }
  }
  CHECK(worst_ratio <= 1.0);

  const double rms = accuracy::real_error(result, c).rms;
  const accuracy::Deviation deviation = accuracy::curve_normal_deviation(result);
  std::printf(
      "lilium: free %u curve %u rms %.4f, curve normals %.1f/%.1f deg, vertices off the "
      "spline %.1e, samples off the mesh %.1e (%.2f of the sagitta)\n",
      result.report.free_vertices, result.report.vertices - result.report.free_vertices, rms,
      deviation.mean, deviation.max, off_spline, off_mesh, worst_ratio);
  CHECK(rms < 0.085);
}

TEST_CASE("lilium, the method fair, with and without noise") {
  for (const accuracy::RealCase& c : accuracy::lilium()) {
    const accuracy::Result clean = accuracy::build(c.network, WSK_METHOD_FAIR, c.spacing);
    REQUIRE_MESSAGE(clean.status == WSK_OK, clean.report.sentence);
    const accuracy::RealError error = accuracy::real_error(clean, c);
    CHECK(error.rms <= 0.023);
    CHECK(error.opposing.empty());
    CHECK(error.sharp_edges == 0);
    CHECK(accuracy::curve_normal_deviation(clean).mean <= 1.5);

    // No ripples along the curves.
    const double size = accuracy::diagonal(c.network);
    const accuracy::Result noisy = accuracy::build(
        accuracy::with_noise(c.network, 0.002 * size, 5.0), WSK_METHOD_FAIR, c.spacing);
    REQUIRE_MESSAGE(noisy.status == WSK_OK, noisy.report.sentence);
    CHECK(accuracy::real_error(noisy, c).rms <= 0.025);
    CHECK(accuracy::ripple_energy(noisy) <= 1.3 * accuracy::ripple_energy(clean));
  }
}
