// How systems are solved is the library's choice: by threads of the caller's, by conjugate
// gradients where the memory cap forbids a factor. The result is the same, or as good.
#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <thread>
#include <vector>

#include "support/call.h"

using namespace scenes;

namespace {

void on_two_threads(uint32_t count, void (*body)(uint32_t, void*), void* data, void* calls) {
  ++*static_cast<size_t*>(calls);
  std::thread second([=] {
    for (uint32_t i = 1; i < count; i += 2) body(i, data);
  });
  for (uint32_t i = 0; i < count; i += 2) body(i, data);
  second.join();
}

Scene fine_octants(double fineness) {
  Scene scene = octants();
  scene.spacing /= fineness;
  return scene;
}

double greatest_difference(const Result& a, const Result& b) {
  REQUIRE(a.positions.size() == b.positions.size());
  double worst = 0.0;
  for (size_t i = 0; i < a.positions.size(); ++i) {
    worst = std::fmax(worst, std::fabs(a.positions[i] - b.positions[i]));
  }
  return worst;
}

}  // namespace

TEST_CASE("solver: the caller's threads change no bit") {
  const Scene scene = fine_octants(12.0);
  wsk_options options = options_of(scene);
  const Call alone = watched_scene(scene, options);
  REQUIRE(alone.status == WSK_OK);
  CHECK(alone.report.solver == WSK_SOLVER_DIRECT);
  size_t calls = 0;
  options.parallel_for = &on_two_threads;
  options.parallel_for_user = &calls;
  const Call together = watched_scene(scene, options);
  REQUIRE(together.status == WSK_OK);
  CHECK(calls > 5);
  CHECK(hash_of(together.result) == hash_of(alone.result));
}

TEST_CASE("solver: under a memory cap iterations take the place of the factor, and say so") {
  struct Case {
    wsk_method method;
    double fineness, soft;
    uint32_t share;  // of the peak without a cap, in hundredths
    double residual, distance;
  };
  // Order two, with curves held and with curves that pull; order three; the fairing's systems.
  for (const Case& c : {Case{WSK_METHOD_STANKO, 6.0, 0.0, 85, 1e-10, 1e-7},
                        Case{WSK_METHOD_STANKO, 3.0, 0.05, 85, 1e-10, 1e-7},
                        Case{WSK_METHOD_TRIHARMONIC, 2.0, 0.0, 85, 1e-10, 1e-6},
                        Case{WSK_METHOD_FAIR, 3.0, 0.0, 50, 1e-10, 1e-7}}) {
    CAPTURE(c.method);
    CAPTURE(c.soft);
    Scene scene = fine_octants(c.fineness);
    for (Curve& curve : scene.curves) curve.soft = c.soft;
    wsk_options options = options_of(scene);
    options.method = c.method;
    const Call direct = watched_scene(scene, options);
    REQUIRE(direct.status == WSK_OK);
    CHECK(direct.report.solver == WSK_SOLVER_DIRECT);
    options.memory_cap = direct.report.peak_bytes / 100 * c.share;
    const Call capped = watched_scene(scene, options);
    REQUIRE(capped.status == WSK_OK);
    CHECK(capped.report.peak_bytes <= options.memory_cap);
    CHECK(capped.report.solver == WSK_SOLVER_ITERATIVE);
    CHECK(capped.report.cg_iterations > 10);
    CHECK(capped.report.residual <= c.residual);
    CHECK(greatest_difference(capped.result, direct.result) <= c.distance);
  }
}

TEST_CASE("solver: a cap that allows no iteration either is a status") {
  const Scene scene = fine_octants(2.0);
  for (const wsk_method method :
       {WSK_METHOD_STANKO, WSK_METHOD_TRIHARMONIC, WSK_METHOD_ITERATED, WSK_METHOD_FAIR}) {
    CAPTURE(method);
    wsk_options options = options_of(scene);
    options.method = method;
    const Call direct = watched_scene(scene, options);
    REQUIRE(direct.status == WSK_OK);
    bool refused = false;
    for (const uint32_t share : {85u, 60u, 35u, 10u}) {
      options.memory_cap = direct.report.peak_bytes / 100 * share;
      const Call capped = watched_scene(scene, options);
      CHECK(capped.report.peak_bytes <= options.memory_cap);
      if (capped.status != WSK_OK) {
        CHECK(capped.status == WSK_ERROR_MEMORY_CAP);
        CHECK(std::string(capped.report.sentence).find("memory cap") != std::string::npos);
        refused = true;
        continue;
      }
      CHECK(capped.report.residual <= 1e-6);
    }
    CHECK(refused);
  }
}

// Where every curve is soft nothing is fixed, and the factor that iterations lean on does not
// exist.
TEST_CASE("solver: a memory cap is a cap, also where no vertex is held") {
  for (const Scene& scene : all()) {
    if (scene.name != "soft") continue;
    wsk_options options = options_of(scene);
    const Call direct = watched_scene(scene, options);
    REQUIRE(direct.status == WSK_OK);
    const size_t peak = direct.report.peak_bytes;
    size_t capped = 0;
    for (size_t k = 32; k < 64; ++k) {
      CAPTURE(k);
      options.memory_cap = peak / 64 * k;
      const Call call = watched_scene(scene, options);
      const bool iterative = call.status == WSK_OK && call.report.solver == WSK_SOLVER_ITERATIVE;
      CHECK((iterative || call.status == WSK_ERROR_MEMORY_CAP));
      CHECK(call.report.peak_bytes <= options.memory_cap);
      capped += call.status == WSK_ERROR_MEMORY_CAP;
    }
    CHECK(capped > 0);
    return;
  }
  FAIL("the scene is gone");
}
