// The same for wsk_connect and wsk_integrate: whatever allocator, cap or cancel callback do, the
// call ends with its own status, leaves its outputs alone and gives everything back.
// Which places are tried says support/fault_places.h.
#include <doctest/doctest.h>

#include <algorithm>
#include <functional>

#include "support/faulty_allocator.h"
#include "support/scenes.h"

using scenes::FaultyAllocator;

namespace {

using Make = std::function<wsk_status(const wsk_options&, wsk_network**, wsk_report*)>;

struct Trial {
  FaultyAllocator allocator;
  size_t memory_cap = 0, cancel_at = SIZE_MAX, asked = 0;
  std::vector<uint64_t>* asked_in = nullptr;  // where given: running_calls() of each checkpoint
  std::vector<double> positions;              // of the result, where there is one
  std::vector<uint32_t> nodes;

  static int32_t ask(void* user) {
    Trial& self = *static_cast<Trial*>(user);
    if (self.asked_in != nullptr) self.asked_in->push_back(scenes::running_calls());
    return self.asked++ == self.cancel_at;
  }

  wsk_status operator()(const Make& make) {
    wsk_options options;
    wsk_options_init(&options, sizeof options);
    allocator.install(&options);
    options.memory_cap = memory_cap;
    options.cancel = ask;
    options.cancel_user = this;
    wsk_report report;
    wsk_report_init(&report, sizeof report);
    wsk_network* const sentinel = reinterpret_cast<wsk_network*>(&options);
    wsk_network* network = sentinel;
    const wsk_status status = make(options, &network, &report);
    if (status == WSK_OK) {
      take(network);
      wsk_network_free(network);
    } else {
      CHECK(network == sentinel);
      CHECK(report.sentence[0] != '\0');
    }
    CHECK(report.status == status);
    CHECK(allocator.clean());
    return status;
  }

 private:
  void take(const wsk_network* network) {
    wsk_network_view view;
    wsk_network_get_view(network, &view, sizeof view);
    for (uint32_t c = 0; c < view.curve_count; ++c) {
      const wsk_curve& curve = view.curves[c];
      positions.insert(positions.end(), curve.positions, curve.positions + 3 * curve.sample_count);
      nodes.insert(nodes.end(), curve.nodes, curve.nodes + curve.sample_count);
    }
  }
};

// Pieces of the ellipsoid's curves with gaps between them, without numbers, some normals missing
// and some turned round: all of wsk_connect has work.
std::vector<scenes::Curve> pieces() {
  std::vector<scenes::Curve> result;
  for (const scenes::Curve& curve : scenes::ellipsoid().curves) {
    const size_t n = curve.size();
    for (size_t first = 0; first < n; first += n / 3) {
      scenes::Curve piece;
      for (size_t i = first; i <= first + n / 3; ++i) {
        for (size_t k = 0; k < 3; ++k) {
          const double x = curve.positions[3 * (i % n) + k], m = curve.normals[3 * (i % n) + k];
          piece.positions.push_back(i == first ? 1.001 * x : x);
          piece.normals.push_back(i % 7 == 3 ? 0.0 : i % 11 == 5 ? -m : m);
        }
        piece.nodes.push_back(WSK_NONE);
      }
      result.push_back(piece);
    }
  }
  return result;
}

wsk_status connect_pieces(const wsk_options& options, wsk_network** network, wsk_report* report) {
  scenes::Scene scene;
  scene.curves = pieces();
  const std::vector<wsk_curve> curves = scenes::curves_of(scene);
  wsk_connect_options connect;
  wsk_connect_options_init(&connect, sizeof connect);
  connect.orient = 1;
  connect.options = &options;
  return wsk_connect(curves.data(), curves.size(), &connect, network, report);
}

// Polygons as a sensor would measure them: the edges of the ellipsoid's curves.
wsk_status integrate_edges(const wsk_options& options, wsk_network** network, wsk_report* report) {
  const scenes::Scene scene = scenes::ellipsoid();
  std::vector<std::vector<double>> arcs, tangents;
  std::vector<std::vector<uint32_t>> nodes;
  std::vector<wsk_sensor_curve> curves;
  for (const scenes::Curve& curve : scene.curves) {
    const size_t n = curve.size();
    arcs.emplace_back(n + 1, 0.0);
    tangents.emplace_back();
    nodes.push_back(curve.nodes);
    nodes.back().push_back(curve.nodes[0]);
    for (size_t i = 0; i <= n; ++i) {
      for (size_t k = 0; k < 3; ++k) {
        const size_t from = i % n, to = (i + 1) % n;
        tangents.back().push_back(curve.positions[3 * to + k] - curve.positions[3 * from + k]);
      }
      if (i < n) arcs.back()[i + 1] = arcs.back()[i] + 0.2;
    }
  }
  for (size_t c = 0; c < arcs.size(); ++c) {
    wsk_sensor_curve curve = {};
    curve.sample_count = arcs[c].size();
    curve.arc_lengths = arcs[c].data();
    curve.tangents = tangents[c].data();
    curve.nodes = nodes[c].data();
    curve.closed = 1;
    curve.tangents_to_next = 1;
    curves.push_back(curve);
  }
  return wsk_integrate(curves.data(), curves.size(), &options, network, report);
}

const Make k_makers[] = {connect_pieces, integrate_edges};

}  // namespace

TEST_CASE("networks: every allocation may fail") {
  scenes::FaultPlaces places(100);
  for (const Make& make : k_makers) {
    std::vector<uint64_t> calls;
    Trial whole;
    whole.allocator.places = &calls;
    REQUIRE(whole(make) == WSK_OK);
    REQUIRE(whole.positions.size() > 100);
    const size_t count = whole.allocator.calls;
    REQUIRE(count > 10);
    for (const scenes::FaultPlace& place : places.choose(calls)) {
      const size_t i = place.index;
      CAPTURE(i);
      for (const bool from_then : {false, true}) {
        Trial trial;
        trial.allocator.fail_at = i;
        trial.allocator.fail_from_then = from_then;
        CHECK(trial(make) == WSK_ERROR_OUT_OF_MEMORY);
      }
    }
    Trial spared;  // the allocation after the last is never asked for
    spared.allocator.fail_at = count;
    CHECK(spared(make) == WSK_OK);
    CHECK(spared.positions == whole.positions);
    CHECK(spared.nodes == whole.nodes);
  }
}

TEST_CASE("networks: the result does not depend on what fresh memory holds") {
  for (const Make& make : k_makers) {
    Trial whole;
    REQUIRE(whole(make) == WSK_OK);
    for (const int pattern : {0x00, 0xff, FaultyAllocator::k_small_numbers}) {
      CAPTURE(pattern);
      Trial trial;
      trial.allocator.pattern = pattern;
      CHECK(trial(make) == WSK_OK);
      CHECK(trial.positions == whole.positions);
      CHECK(trial.nodes == whole.nodes);
    }
  }
}

TEST_CASE("networks: the memory cap holds to the byte") {
  for (const Make& make : k_makers) {
    Trial whole;
    REQUIRE(whole(make) == WSK_OK);
    const size_t peak = whole.allocator.peak_bytes;
    for (const size_t cap : {size_t{1}, peak / 7, peak / 3, peak / 2, peak - 1, peak, peak + 1}) {
      CAPTURE(cap);
      Trial trial;
      trial.memory_cap = cap;
      CHECK(trial(make) == (cap < peak ? WSK_ERROR_MEMORY_CAP : WSK_OK));
      CHECK(trial.allocator.peak_bytes <= cap);
    }
  }
}

TEST_CASE("networks: every checkpoint may cancel") {
  scenes::FaultPlaces places(100);
  for (const Make& make : k_makers) {
    std::vector<uint64_t> calls;
    Trial whole;
    whole.asked_in = &calls;
    REQUIRE(whole(make) == WSK_OK);
    REQUIRE(whole.asked > 0);
    for (const scenes::FaultPlace& place : places.choose(calls)) {
      const size_t i = place.index;
      CAPTURE(i);
      Trial trial;
      trial.cancel_at = i;
      CHECK(trial(make) == WSK_ERROR_CANCELLED);
      CHECK(trial.asked == i + 1);
    }
  }
}
