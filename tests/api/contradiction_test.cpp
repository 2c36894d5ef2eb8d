// Normals whose signs contradict each other are refused, with the place and a word of the remedy;
// normals that are only rough are not.
#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <random>

#include "support/call.h"
#include "support/scenes.h"

using namespace scenes;

namespace {

// The edges of the unit cube, two samples each, with normals from the middle of the cube.
Scene cube() {
  Scene scene;
  scene.name = "cube";
  for (uint32_t a = 0; a < 8; ++a) {
    for (uint32_t bit : {1u, 2u, 4u}) {
      const uint32_t b = a | bit;
      if (a == b) continue;
      Curve edge;
      for (uint32_t v : {a, b}) {
        for (uint32_t axis : {1u, 2u, 4u}) {
          edge.positions.push_back((v & axis) != 0 ? 1.0 : 0.0);
          edge.normals.push_back((v & axis) != 0 ? 1.0 : -1.0);
        }
        edge.nodes.push_back(v);
      }
      scene.curves.push_back(edge);
    }
  }
  return scene;
}

Call quickly(const Scene& scene) {
  wsk_options options = options_of(scene);
  options.method = WSK_METHOD_STANKO;
  options.smoothing = WSK_SMOOTHING_NONE;
  options.spacing = 0.2;
  return watched_scene(scene, options);
}

void flip(Curve& curve, size_t sample) {
  for (size_t k = 0; k < 3; ++k) curve.normals[3 * sample + k] *= -1.0;
}

void flip(Curve& curve) {
  for (size_t i = 0; i < curve.size(); ++i) flip(curve, i);
}

void check_refused(const Call& call) {
  CHECK(call.status == WSK_ERROR_INCONSISTENT_NORMALS);
  CHECK(call.report.curve != WSK_NONE);
  CHECK(call.report.sample != WSK_NONE);
  CHECK(std::strstr(call.report.sentence, "orient") != nullptr);
}

// Up to `degrees` of noise, evenly over the cap; the samples of a node keep their own.
void roughen(Scene& scene, double degrees, std::mt19937& random) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> part(0.0, 1.0);
  for (Curve& curve : scene.curves) {
    for (size_t i = 0; i < curve.size(); ++i) {
      double* n = &curve.normals[3 * i];
      double across[3], along = 0.0, size = 0.0, length = 0.0;
      for (int k = 0; k < 3; ++k) length += n[k] * n[k];
      for (int k = 0; k < 3; ++k) across[k] = normal(random);
      for (int k = 0; k < 3; ++k) along += across[k] * n[k] / length;
      for (int k = 0; k < 3; ++k) across[k] -= along * n[k];
      for (int k = 0; k < 3; ++k) size += across[k] * across[k];
      const double angle = degrees * std::acos(-1.0) / 180.0 * std::sqrt(part(random));
      for (int k = 0; k < 3; ++k) {
        n[k] = std::cos(angle) * n[k] / std::sqrt(length) +
               std::sin(angle) * across[k] / std::sqrt(size);
      }
    }
  }
}

}  // namespace

TEST_CASE("every way of giving the corners of a cube other signs is refused, but for all at once") {
  CHECK(quickly(cube()).status == WSK_OK);
  for (uint32_t flipped = 1; flipped < 255; flipped += 6) {
    CAPTURE(flipped);
    Scene scene = cube();
    for (Curve& edge : scene.curves) {
      for (size_t i = 0; i < 2; ++i) {
        if ((flipped >> edge.nodes[i] & 1) != 0) flip(edge, i);
      }
    }
    check_refused(quickly(scene));
  }
}

TEST_CASE("one curve turned inside out is named, where two curves meet and where three do") {
  for (size_t c = 0; c < 12; ++c) {
    CAPTURE(c);
    Scene scene = cube();
    flip(scene.curves[c]);
    const Call call = quickly(scene);
    check_refused(call);
    CHECK(call.report.curve == c);
    CHECK(call.report.node != WSK_NONE);
  }
  for (size_t c = 0; c < 3; ++c) {
    Scene scene = octants();
    flip(scene.curves[c]);
    // Not opposite to the last bit, which no measured normals are.
    std::mt19937 random(static_cast<unsigned>(c));
    roughen(scene, 1.0, random);
    check_refused(quickly(scene));
  }
}

TEST_CASE("random signs are refused; 30 degrees of noise are not, and do not hide them") {
  std::mt19937 random(11);
  for (int round = 0; round < 20; ++round) {
    CAPTURE(round);
    for (Scene scene : {octants(), cube(), saddle(), ellipsoid()}) {
      CAPTURE(scene.name);
      // From one corner of the cube to the next normals turn by 70 degrees without any noise.
      roughen(scene, scene.name == "cube" ? 24.0 : 30.0, random);
      const Call rough = quickly(scene);
      CAPTURE(std::string(rough.report.sentence));
      CHECK(rough.status != WSK_ERROR_INCONSISTENT_NORMALS);
      Scene mixed = scene;
      for (Curve& curve : mixed.curves) {
        for (size_t i = 0; i < curve.size(); ++i) {
          if (random() % 2 == 0) flip(curve, i);
        }
      }
      check_refused(quickly(mixed));
      Scene turned = scene;
      flip(turned.curves[random() % turned.curves.size()]);
      check_refused(quickly(turned));
    }
  }
}

TEST_CASE("curves with opposite normals that almost meet are joined, and the build complains") {
  Scene scene = octants();
  for (Curve& curve : scene.curves) curve.nodes.assign(curve.size(), WSK_NONE);
  for (size_t i = 0; i < scene.curves[1].size(); ++i) {
    for (size_t k = 0; k < 3; ++k) scene.curves[1].positions[3 * i + k] *= 1.001;
  }
  std::mt19937 random(2);
  roughen(scene, 3.0, random);
  for (const bool orient : {false, true}) {
    CAPTURE(orient);
    Scene given = scene;
    flip(given.curves[1]);
    const std::vector<wsk_curve> curves = curves_of(given);
    wsk_connect_options options;
    wsk_connect_options_init(&options, sizeof options);
    options.snap = 0.01;
    options.orient = orient;
    wsk_network* network = nullptr;
    REQUIRE(wsk_connect(curves.data(), curves.size(), &options, &network, nullptr) == WSK_OK);
    wsk_network_view view;
    wsk_network_get_view(network, &view, sizeof view);
    const std::vector<wsk_curve> joined(view.curves, view.curves + view.curve_count);
    wsk_options build = options_of(scene);
    build.spacing = 0.2;
    const Call call = watched_build(joined, build);
    wsk_network_free(network);
    if (orient) {
      CHECK(call.status == WSK_OK);
    } else {
      check_refused(call);
    }
  }
}
