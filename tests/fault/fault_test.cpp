// Whatever the caller's allocator, memory cap or cancel callback does, a call ends with its own
// status, leaves its outputs alone, gives everything back, and the same call works afterwards.
//
// Scenes of two calls (raw curves, sensors, flow) are swept through both. Which places are tried
// says support/fault_places.h; where that is all of them, copies of the process go on from each.
#include <doctest/doctest.h>

#include <cstdio>

#include "support/faulty_allocator.h"
#include "support/scenes.h"

using scenes::Copies;
using scenes::FaultPlace;
using scenes::FaultPlaces;
using scenes::FaultyAllocator;
using scenes::Scene;

// How many places of each scene are tried beside those that other calls lead to.
#ifdef WIRESKIN_TESTS_SANITIZED
static constexpr size_t k_sample = 3;
#else
static constexpr size_t k_sample = 10;
#endif

struct Cancel {
  size_t calls = 0;
  size_t at = SIZE_MAX;
  std::vector<uint64_t>* places = nullptr;  // as in FaultyAllocator
  Copies* copies = nullptr;                 // as there

  static int32_t ask(void* user) {
    Cancel& self = *static_cast<Cancel*>(user);
    if (self.places != nullptr) self.places->push_back(scenes::running_calls());
    if (self.copies != nullptr && !self.copies->is_copy) {
      self.copies->make();
      if (self.copies->is_copy) self.at = self.calls;
    }
    return self.calls++ == self.at;
  }
};

struct Run {
  FaultyAllocator allocator;
  Cancel cancel;
  size_t memory_cap = 0;
  wsk_report report;
  uint64_t hash = 0;  // of the result, where there is one

  wsk_status operator()(const Scene& scene) {
    const char* wrong = nullptr;
    const wsk_status status = attempt(scene, &wrong);
    CHECK(wrong == nullptr);
    return status;
  }

  // As above, but leaves it to the caller to complain.
  wsk_status attempt(const Scene& scene, const char** wrong) {
    wsk_options options = scenes::options_of(scene);
    allocator.install(&options);
    options.memory_cap = memory_cap;
    options.cancel = Cancel::ask;
    options.cancel_user = &cancel;
    wsk_report_init(&report, sizeof report);
    wsk_surface* const sentinel = reinterpret_cast<wsk_surface*>(&options);
    wsk_surface* surface = sentinel;
    const wsk_status status = scenes::run(scene, options, &surface, &report);
    if (status == WSK_OK) {
      hash = scenes::hash_of(scenes::copy_of(surface));
      wsk_surface_free(surface);
    } else if (surface != sentinel) {
      *wrong = "the output was touched";
    } else if (report.sentence[0] == '\0') {
      *wrong = "no sentence";
    }
    if (report.status != status) *wrong = "another status in the report";
    if (!allocator.clean()) *wrong = "not all memory came back";
    return status;
  }
};

static void fail_allocation(const Scene& scene, size_t which, bool from_then) {
  Run run;
  run.allocator.fail_at = which;
  run.allocator.fail_from_then = from_then;
  CHECK(run(scene) == WSK_ERROR_OUT_OF_MEMORY);
}

// The end of a copy: was the failure met as it should be, and, now and then, does the call succeed
// afterwards with the bits that it has without failures?
[[noreturn]] static void end_copy(const Scene& scene, Run* run, uint64_t hash, const char* wrong) {
  const bool cancelled = run->cancel.at != SIZE_MAX;
  const size_t place = cancelled ? run->cancel.at : run->allocator.fail_at;
  const bool more = !cancelled && run->allocator.calls > place + 1;
  const wsk_status expected = cancelled ? WSK_ERROR_CANCELLED : WSK_ERROR_OUT_OF_MEMORY;
  if (run->report.status != expected) wrong = "another status";
  if (cancelled && run->cancel.calls != place + 1) wrong = "asked again after the answer";
  if (place % 8 == 0 && wrong == nullptr) {
    Run again;
    if (again.attempt(scene, &wrong) != WSK_OK || again.hash != hash) wrong = "no second try";
  }
  if (wrong != nullptr) {
    std::printf("%s, place %zu: %s\n", scene.name.c_str(), place, wrong);
    std::fflush(stdout);
  }
  Copies::end(wrong != nullptr ? Copies::k_wrong
              : more           ? Copies::k_fine_after_more
                               : Copies::k_fine);
}

// Fails at every place of one run of the scene, in copies of the process: allocations, or
// checkpoints.
static void fail_everywhere(const Scene& scene, bool checkpoints) {
  CAPTURE(scene.name);
  Run whole;
  REQUIRE(whole(scene) == WSK_OK);
  Copies copies;
  Run run;
  (checkpoints ? run.cancel.copies : run.allocator.copies) = &copies;
  const char* wrong = nullptr;
  const wsk_status status = run.attempt(scene, &wrong);
  if (copies.is_copy) end_copy(scene, &run, whole.hash, wrong);
  CHECK(wrong == nullptr);
  CHECK(status == WSK_OK);
  CHECK(run.hash == whole.hash);
  CHECK(copies.made >= (checkpoints ? whole.cancel.calls : whole.allocator.calls));
  CHECK(copies.wrong == 0);
}

TEST_CASE("every allocation may fail, at all places") {
  if (!scenes::copies_at_all_places()) return;
  for (const Scene& scene : scenes::all()) fail_everywhere(scene, false);
}

TEST_CASE("every allocation may fail") {
  if (scenes::copies_at_all_places()) return;  // the case above
  FaultPlaces places(k_sample);
  for (const Scene& scene : scenes::all()) {
    CAPTURE(scene.name);
    std::vector<uint64_t> calls;
    Run whole;
    whole.allocator.places = &calls;
    REQUIRE(whole(scene) == WSK_OK);
    const size_t count = whole.allocator.calls;
    REQUIRE(count > 10);
    size_t tried = 0;
    for (const FaultPlace& place : places.choose(calls)) {
      CAPTURE(place.index);
      fail_allocation(scene, place.index, false);
      if (!place.sampled) continue;
      fail_allocation(scene, place.index, true);
      if (tried++ % 8 != 0) continue;
      Run again;
      CHECK(again(scene) == WSK_OK);
      CHECK(again.hash == whole.hash);
    }
    fail_allocation(scene, count - 1, false);
    Run spared;  // the allocation after the last is never asked for
    spared.allocator.fail_at = count;
    CHECK(spared(scene) == WSK_OK);
  }
}

TEST_CASE("the result does not depend on what fresh memory holds") {
  for (const Scene& scene : scenes::all()) {
    CAPTURE(scene.name);
    const uint64_t hash = scenes::hash_of(scenes::result_of(scene));  // on malloc
    for (const int pattern : {0x00, 0xff, FaultyAllocator::k_small_numbers}) {
      CAPTURE(pattern);
      Run run;
      run.allocator.pattern = pattern;
      CHECK(run(scene) == WSK_OK);
      CHECK(run.hash == hash);
    }
  }
}

TEST_CASE("the memory cap holds to the byte") {
  for (const Scene& scene : scenes::all()) {
    CAPTURE(scene.name);
    Run whole;
    REQUIRE(whole(scene) == WSK_OK);
    // Of two calls the first one's flow stands while the second has a cap of its own.
    const bool flow = scene.way == scenes::Way::flow;
    const size_t peak = flow ? whole.report.peak_bytes : whole.allocator.peak_bytes;
    CHECK(whole.report.peak_bytes == peak);

    std::vector<size_t> caps = {peak - 1, peak, peak + 1};
    const size_t part = scenes::tries_all_places() ? 16 : 1;
    for (size_t cap = 1; cap < 2 * peak; cap += 1 + cap / part) caps.push_back(cap);
    for (const size_t cap : caps) {
      CAPTURE(cap);
      Run run;
      run.memory_cap = cap;
      const wsk_status status = run(scene);
      // Below the peak of the direct solver the iterative one may still do.
      const bool iterative = status == WSK_OK && run.report.solver == WSK_SOLVER_ITERATIVE;
      if (cap < peak) {
        CHECK((iterative || status == WSK_ERROR_MEMORY_CAP));
      } else {
        CHECK(status == WSK_OK);
        CHECK(!iterative);
      }
      CHECK(run.allocator.peak_bytes <= (flow ? 2 * cap : cap));
      if (cap >= peak) CHECK(run.hash == whole.hash);
    }
  }
}

TEST_CASE("every checkpoint may cancel, at all places") {
  if (!scenes::copies_at_all_places()) return;
  for (const Scene& scene : scenes::all()) fail_everywhere(scene, true);
}

TEST_CASE("every checkpoint may cancel") {
  if (scenes::copies_at_all_places()) return;  // the case above
  FaultPlaces places(k_sample);
  for (const Scene& scene : scenes::all()) {
    CAPTURE(scene.name);
    std::vector<uint64_t> calls;
    Run whole;
    whole.cancel.places = &calls;
    REQUIRE(whole(scene) == WSK_OK);
    const size_t count = whole.cancel.calls;
    REQUIRE(count >=
            WSK_STAGE_COUNT - 3);  // a mesh of the caller's has no curves, network, patches
    for (const FaultPlace& place : places.choose(calls)) {
      CAPTURE(place.index);
      Run run;
      run.cancel.at = place.index;
      CHECK(run(scene) == WSK_ERROR_CANCELLED);
      CHECK(run.cancel.calls == place.index + 1);  // nobody asks again after the answer
    }
    Run again;
    CHECK(again(scene) == WSK_OK);
    CHECK(again.hash == whole.hash);
  }
}
