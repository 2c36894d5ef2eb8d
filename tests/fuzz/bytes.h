// Bytes of a fuzzer as numbers, and what all targets ask of a call: any bytes mean something, and
// when they run out zeros follow.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <vector>

#include "fuzz/arena.h"
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
  // A count from 1 on: below `usual` seven times in eight, for small cases run by the thousand a
  // second and find most; now and then up to `most`.
  uint32_t count(uint32_t usual, uint32_t most) { return 1 + below(one_in(8) ? most : usual); }

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

// A call is cut short after some work: what is looked for are crashes, not long runs.
struct Limits {
  Arena allocator;
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
    options.cancel = cancel;
    return options;
  }

  static int32_t cancel(void* user) {
    Limits& self = *static_cast<Limits*>(user);
    return ++self.checkpoints > self.most_checkpoints || self.stage > self.last_stage;
  }
};

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
