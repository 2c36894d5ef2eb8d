// Bytes of a fuzzer as numbers and curves: any bytes mean something, most of them something that is
// nearly sound, and when they run out zeros follow.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <vector>

#include "support/faulty_allocator.h"
#include "support/scenes.h"

namespace fuzz {

// A finding.
inline void require(bool condition) {
  if (!condition) std::abort();
}

class Bytes {
 public:
  Bytes(const uint8_t* data, size_t size) : at_(data), left_(size) {}

  bool empty() const { return left_ == 0; }
  uint8_t byte() {
    if (left_ == 0) return 0;
    --left_;
    return *at_++;
  }
  uint32_t below(uint32_t n) { return byte() % n; }
  bool one_in(uint32_t n) { return below(n) == n - 1; }

  // Eighths between -16 and 16, so that points coincide and lie in line; now and then something
  // finer, any bits at all, or one of the numbers that break things.
  double number() {
    const uint8_t kind = byte();
    if (kind < 208) return (static_cast<int>(byte()) - 128) / 8.0;
    if (kind < 232) return (byte() - 128) / 8.0 + (byte() - 128) * 0x1p-20;
    if (kind < 248) return (byte() - 128) * std::ldexp(1.0, -(static_cast<int>(byte()) % 60));
    if (kind < 252) return special();
    uint64_t bits = 0;
    for (int i = 0; i < 8; ++i) bits = bits << 8 | byte();
    double value;
    std::memcpy(&value, &bits, sizeof value);
    return value;
  }

 private:
  double special() {
    const double k_special[] = {0.0,
                                -0.0,
                                1e-300,
                                5e-324,
                                1e150,
                                -1e308,
                                1.0 / 3,
                                0x1p-52,
                                1e300,
                                1e-12,
                                std::numeric_limits<double>::infinity(),
                                std::numeric_limits<double>::quiet_NaN()};
    return k_special[below(12)];
  }

  const uint8_t* at_;
  size_t left_;
};

// Curves between a few nodes, with samples near the straight line between them.
inline std::vector<scenes::Curve> read_curves(Bytes& bytes, bool always_nodes) {
  const uint32_t node_count = 2 + bytes.below(8);
  std::vector<double> nodes;
  for (uint32_t i = 0; i < 3 * node_count; ++i) nodes.push_back(bytes.number());
  std::vector<scenes::Curve> curves(1 + bytes.below(12));
  for (scenes::Curve& curve : curves) {
    const uint8_t flags = bytes.byte();
    const uint32_t from = bytes.below(node_count), to = bytes.below(node_count);
    const uint32_t segments = 1 + bytes.below(6);
    const bool straight = (flags & 1) != 0, numbered = always_nodes || (flags & 2) != 0;
    curve.closed = (flags & 12) == 12;
    curve.boundary = (flags & 16) != 0;
    curve.sharp = (flags & 0xe0) == 0x40;
    if ((flags & 0xe0) == 0x60) curve.soft = bytes.number();
    double normal[3] = {0, 0, 1};
    for (uint32_t i = 0; i <= segments; ++i) {
      const double t = static_cast<double>(i) / segments;
      const bool inside = i > 0 && i < segments;
      for (size_t k = 0; k < 3; ++k) {
        double x = nodes[3 * from + k] + t * (nodes[3 * to + k] - nodes[3 * from + k]);
        if (i == segments) x = nodes[3 * to + k];
        if (inside && !straight) x += bytes.number() / 4;
        curve.positions.push_back(x);
      }
      if (!straight && bytes.one_in(4)) {
        for (double& n : normal) n = bytes.number();
      }
      curve.normals.insert(curve.normals.end(), normal, normal + 3);
      const uint32_t node = i == 0 ? from : to;
      curve.nodes.push_back(inside || !numbered ? WSK_NONE : node);
    }
    if ((flags & 0xe0) == 0x80) curve.normals.clear();
  }
  return curves;
}

// A call is cut short after some work: what is looked for are crashes, not long runs.
struct Limits {
  scenes::FaultyAllocator allocator;
  wsk_stage last_stage = WSK_STAGE_COUNT;
  size_t checkpoints = 0;
  size_t most_checkpoints = 3000;
  wsk_stage stage = WSK_STAGE_INPUT;

  wsk_options options() {
    wsk_options options;
    wsk_options_init(&options, sizeof options);
    allocator.install(&options);
    options.memory_cap = size_t{1} << 26;
    options.cancel_user = options.progress_user = this;
    options.progress = [](wsk_stage stage, double, void* user) {
      static_cast<Limits*>(user)->stage = stage;
    };
    options.cancel = [](void* user) -> int32_t {
      Limits& self = *static_cast<Limits*>(user);
      return ++self.checkpoints > self.most_checkpoints || self.stage > self.last_stage;
    };
    return options;
  }
};

// Of the finite coordinates, at least the least number that is no zero.
inline double extent_of(const std::vector<scenes::Curve>& curves) {
  double low = 0.0, high = 0.0;
  bool any = false;
  for (const scenes::Curve& curve : curves) {
    for (const double x : curve.positions) {
      if (!std::isfinite(x)) continue;
      low = any ? std::fmin(low, x) : x;
      high = any ? std::fmax(high, x) : x;
      any = true;
    }
  }
  return high - low;
}

// A valid surface or a documented status; of a flow the surface may have no triangles.
inline void check_outcome(wsk_status status, wsk_surface* surface, bool flow = false) {
  if (status != WSK_OK) {
    require(std::strcmp(wsk_status_name(status), "unknown") != 0);
    return;
  }
  wsk_surface_view view;
  wsk_surface_get_view(surface, &view, sizeof view);
  require(view.triangle_count > 0 || flow);
  for (size_t i = 0; i < 3 * size_t{view.vertex_count}; ++i) {
    require(std::isfinite(view.positions[i]) && std::isfinite(view.normals[i]));
  }
  for (size_t i = 0; i < 3 * size_t{view.triangle_count}; ++i) {
    require(view.triangles[i] < view.vertex_count);
    require(view.triangles[i] != view.triangles[i % 3 == 2 ? i - 2 : i + 1]);
  }
  wsk_surface_free(surface);
}

}  // namespace fuzz
