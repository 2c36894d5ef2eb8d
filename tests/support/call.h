// One call of the C API with everything watched: the outputs start as sentinels, memory is counted,
// and what must hold after any call is checked at once.
#pragma once

#include <doctest/doctest.h>

#include <cstring>

#include "support/faulty_allocator.h"
#include "support/scenes.h"

namespace scenes {

struct Call {
  wsk_status status;
  wsk_report report;
  Result result;  // empty after a failure
};

// `run` takes (const wsk_options*, wsk_surface**, wsk_report*) and makes the call.
template <typename Run>
Call watched(wsk_options options, const Run& run) {
  FaultyAllocator allocator;
  if (options.allocate == nullptr && options.release == nullptr) allocator.install(&options);
  Call call = {};
  wsk_report_init(&call.report, sizeof call.report);
  wsk_surface* const sentinel = reinterpret_cast<wsk_surface*>(&options);
  wsk_surface* surface = sentinel;
  call.status = run(&options, &surface, &call.report);
  CHECK(call.report.status == call.status);
  if (call.status == WSK_OK) {
    call.result = copy_of(surface);
    wsk_surface_free(surface);
  } else {
    CHECK(surface == sentinel);
    const size_t length = std::strlen(call.report.sentence);
    CHECK(length > 0);
    CHECK(call.report.sentence[length > 0 ? length - 1 : 0] != '.');
  }
  CHECK(allocator.clean());
  return call;
}

inline Call watched_build(const std::vector<wsk_curve>& curves, const wsk_options& options) {
  return watched(options, [&](const wsk_options* o, wsk_surface** surface, wsk_report* report) {
    return wsk_build(curves.data(), curves.size(), o, surface, report);
  });
}

inline Call watched_scene(const Scene& scene, const wsk_options& options) {
  return watched(options, [&](const wsk_options* o, wsk_surface** surface, wsk_report* report) {
    return run(scene, *o, surface, report);
  });
}

inline Call watched_scene(const Scene& scene) {
  return watched_scene(scene, options_of(scene));
}

}  // namespace scenes
