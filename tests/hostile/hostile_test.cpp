// Whatever comes in, a valid surface or a documented status comes out, never NaN, never late; and
// the unit of length does not matter, from 1e-150 to 1e150.
//
// Each case runs at every scale, mirrored and with its axes and curves in another order, by a
// method that changes from run to run. WIRESKIN_FULL=1 runs all, without it a part.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <map>
#include <set>

#include "hostile/families.h"
#include "support/call.h"

using hostile::Case;
using scenes::Call;
using scenes::Curve;
using scenes::Result;
using scenes::Way;

namespace {

// Powers of two. Results are the same at each but for the scale, so sanitizers see the extremes.
#ifdef WIRESKIN_TESTS_SANITIZED
constexpr int k_scales[] = {0, -498, 498};
#else
constexpr int k_scales[] = {0, -498, -300, -151, -30, 10, 300, 498};
#endif

// Which turns of the axes are tried: every order of them, and two of the mirror images.
std::vector<int> turns(bool full) {
  return full ? std::vector<int>{0, 1, 2, 5} : std::vector<int>{0};
}

// x, y, z in another order, mirrored where `turn` is odd.
void turn_axes(std::vector<Curve>& curves, int turn) {
  const size_t shift = static_cast<size_t>(turn / 2);
  for (Curve& curve : curves) {
    for (std::vector<double>* values : {&curve.positions, &curve.normals}) {
      for (size_t i = 0; i + 2 < values->size(); i += 3) {
        const double v[3] = {(*values)[i], (*values)[i + 1], (*values)[i + 2]};
        for (size_t k = 0; k < 3; ++k) (*values)[i + k] = v[(k + shift) % 3];
        if (turn % 2 == 1) (*values)[i] = -(*values)[i];
      }
    }
  }
}

// Processor time, for the machine may have other things to do.
struct Watch {
  std::clock_t start = std::clock();
  bool late = false;

  double seconds() const { return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC; }
};

int32_t is_late(void* user) {
  Watch* watch = static_cast<Watch*>(user);
  watch->late = watch->late || watch->seconds() > 10.0;
  return watch->late ? 1 : 0;
}

struct Slowest {
  double seconds = 0.0;
  std::string name;
} slowest;

// A coarse surface: what is looked for hangs on the shape, not on the number of vertices.
double coarse_spacing(const std::vector<Curve>& curves) {
  double low[3], high[3];
  std::fill(low, low + 3, HUGE_VAL);
  std::fill(high, high + 3, -HUGE_VAL);
  for (const Curve& curve : curves) {
    for (size_t i = 0; i < curve.positions.size(); ++i) {
      low[i % 3] = std::min(low[i % 3], curve.positions[i]);
      high[i % 3] = std::max(high[i % 3], curve.positions[i]);
    }
  }
  const double extent = std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
  return extent > 0 && std::isfinite(extent) ? std::ldexp(1.0, std::ilogb(extent) - 4) : 0.0;
}

Call run(const Case& hostile_case, wsk_method method, int scale, Way way = Way::build) {
  scenes::Scene scene;
  scene.way = way;
  scene.curves = hostile_case.curves;
  for (Curve& curve : scene.curves) {
    for (double& x : curve.positions) x = std::ldexp(x, scale);
    if (way == Way::build) continue;
    // Raw curves: what coincides is joined, and flow needs no normals.
    std::fill(curve.nodes.begin(), curve.nodes.end(), WSK_NONE);
    if (way == Way::flow) curve.normals.clear();
  }
  scene.spacing = coarse_spacing(scene.curves) * (way == Way::flow ? 4 : 1);
  wsk_options options = scenes::options_of(scene);
  options.method = method;
  Watch watch;
  options.cancel = is_late;
  options.cancel_user = &watch;
  const Call call = scenes::watched_scene(scene, options);
  CHECK_FALSE(watch.late);
  if (watch.seconds() > slowest.seconds) slowest = {watch.seconds(), hostile_case.name};
  return call;
}

void check_surface(const Result& result, bool manifold = true) {
  for (const double x : result.positions) REQUIRE(std::isfinite(x));
  for (const double x : result.normals) REQUIRE(std::isfinite(x));
  for (const double x : result.mean_curvature) REQUIRE(std::isfinite(x));
  const size_t n = result.positions.size() / 3;
  REQUIRE((!result.triangles.empty() || !manifold));
  std::set<std::pair<uint32_t, uint32_t>> edges;
  for (size_t h = 0; h < result.triangles.size(); ++h) {
    const uint32_t a = result.triangles[h];
    const uint32_t b = result.triangles[h % 3 == 2 ? h - 2 : h + 1];
    REQUIRE(a < n);
    REQUIRE(a != b);
    // An oriented manifold passes each half-edge once. The surface of a flow may have walls between
    // rooms, or nothing at all.
    if (manifold) REQUIRE(edges.emplace(a, b).second);
  }
}

// The outcome at another unit of length. Only numbers that leave the doubles' range may end
// otherwise.
void check_scaled(Call call, int scale, const Call& reference) {
  if (call.status == WSK_OK && reference.status == WSK_OK) {
    for (double& x : call.result.positions) x = std::ldexp(x, -scale);
    for (double& x : call.result.mean_curvature) x = std::ldexp(x, scale);
    CHECK(hash_of(call.result) == hash_of(reference.result));
    return;
  }
  const bool at_edge = call.status == WSK_ERROR_INFINITE || reference.status == WSK_ERROR_INFINITE;
  CHECK((call.status == reference.status || at_edge));
}

}  // namespace

TEST_CASE("hostile networks end in a surface or a status, the same at every scale") {
  const bool full = std::getenv("WIRESKIN_FULL") != nullptr;
  std::map<std::string, int> outcomes;
  int runs = 0;
  for (const Case& base : hostile::all()) {
    CAPTURE(base.name);
    for (const int turn : turns(full)) {
      CAPTURE(turn);
      for (const bool backwards : {false, true}) {
        if (backwards && !full) continue;
        Case changed = base;
        turn_axes(changed.curves, turn);
        if (backwards) std::reverse(changed.curves.begin(), changed.curves.end());
        const wsk_method methods[] = {WSK_METHOD_FAIR, WSK_METHOD_STANKO, WSK_METHOD_ITERATED};
        const wsk_method method = methods[runs / 8 % 3];
        CAPTURE(method);
        Call reference = {};
        for (const int scale : k_scales) {
          CAPTURE(scale);
          Call call = run(changed, method, scale);
          ++runs;
          ++outcomes[wsk_status_name(call.status)];
          REQUIRE(std::string(wsk_status_name(call.status)) != "unknown");
          if (call.status == WSK_OK) check_surface(call.result);
          if (scale == 0) {
            reference = call;
          } else {
            check_scaled(call, scale, reference);
          }
        }
      }
    }
  }
  MESSAGE(runs << " runs; the longest took " << slowest.seconds << " s: " << slowest.name);
  for (const auto& [name, count] : outcomes) MESSAGE(name << ": " << count);
  CHECK(outcomes["ok"] > runs / 10);
  CHECK(outcomes.size() > 8);
}

// Fewer scales and methods than above: what differs is the way to the network.
TEST_CASE("hostile curves through wsk_connect and wsk_flow end in a surface or a status") {
  const bool full = std::getenv("WIRESKIN_FULL") != nullptr;
  std::map<std::string, int> outcomes;
  int runs = 0;
  for (const Way way : {Way::connect, Way::flow}) {
    CAPTURE(static_cast<int>(way));
    int number = 0;
    for (const Case& base : hostile::all()) {
      if (!full && way == Way::flow && ++number % 3 != 0) continue;
      CAPTURE(base.name);
      for (const int turn : turns(full)) {
        CAPTURE(turn);
        Case changed = base;
        turn_axes(changed.curves, turn);
        Call reference = {};
        for (const int scale : {0, -498, 30, 498}) {
          if (!full && scale != 0 && scale != (runs % 2 == 0 ? 30 : -498)) continue;
          CAPTURE(scale);
          Call call = run(changed, WSK_METHOD_ITERATED, scale, way);
          ++runs;
          ++outcomes[wsk_status_name(call.status)];
          REQUIRE(std::string(wsk_status_name(call.status)) != "unknown");
          if (call.status == WSK_OK) check_surface(call.result, way != Way::flow);
          if (scale == 0) {
            reference = call;
          } else {
            check_scaled(call, scale, reference);
          }
        }
      }
    }
  }
  MESSAGE(runs << " runs; the longest took " << slowest.seconds << " s: " << slowest.name);
  for (const auto& [name, count] : outcomes) MESSAGE(name << ": " << count);
  CHECK(outcomes["ok"] > runs / 10);
}
