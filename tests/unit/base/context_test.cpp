#include "base/context.h"

#include <doctest/doctest.h>

#include "support/context.h"

using namespace unit;
using wireskin::Context;
using wireskin::Stage;

TEST_CASE("context: the cap holds to the byte") {
  Heap heap(100);
  void *a = nullptr, *b = nullptr, *c = nullptr;
  must(heap.context.allocate(15, 4, &a));
  CHECK(heap.context.allocate(41, 1, &b).code == Code::memory_cap);
  CHECK(b == nullptr);
  CHECK(heap.context.used_bytes() == 60);
  must(heap.context.allocate(40, 1, &b));
  CHECK(heap.context.allocate(1, 1, &c).code == Code::memory_cap);
  CHECK(heap.context.peak_bytes() == 100);
  heap.context.release(a, 15, 4);
  CHECK(heap.context.used_bytes() == 40);
  must(heap.context.allocate(60, 1, &a));
  heap.context.release(a, 60, 1);
  heap.context.release(b, 40, 1);
  CHECK(heap.context.peak_bytes() == 100);
  CHECK(heap.context.used_bytes() == 0);
  CHECK(heap.allocator.peak_bytes == 100);
  CHECK(heap.allocator.clean());
}

TEST_CASE("context: sizes that do not fit the address space") {
  Heap heap;
  void* memory = &heap;
  CHECK(heap.context.allocate(SIZE_MAX / 2, 8, &memory).code == Code::too_large);
  CHECK(memory == nullptr);
  CHECK(heap.context.allocate(SIZE_MAX, 1, &memory).code == Code::too_large);
  CHECK(heap.context.allocate(size_t{1} << 63, 2, &memory).code == Code::too_large);
  CHECK(heap.allocator.calls == 0);
  // Within the address space, but above the cap, where a sum with what is used could overflow.
  Heap capped(1000);
  void* first = nullptr;
  must(capped.context.allocate(999, 1, &first));
  CHECK(capped.context.allocate(SIZE_MAX / 2, 1, &memory).code == Code::memory_cap);
  capped.context.release(first, 999, 1);
}

TEST_CASE("context: nothing asked, nothing given") {
  Heap heap;
  void* memory = &heap;
  CHECK(heap.context.allocate(0, 8, &memory).ok());
  CHECK(memory == nullptr);
  heap.context.release(nullptr, 0, 8);
  CHECK(heap.allocator.calls == 0);
  CHECK(heap.allocator.clean());
}

TEST_CASE("context: a failing allocator costs nothing") {
  Heap heap;
  heap.allocator.fail_at = 0;
  void* memory = nullptr;
  CHECK(heap.context.allocate(8, 8, &memory).code == Code::out_of_memory);
  CHECK(heap.context.used_bytes() == 0);
  CHECK(heap.context.peak_bytes() == 0);
  must(heap.context.allocate(8, 8, &memory));
  heap.context.release(memory, 8, 8);
}

TEST_CASE("context: checkpoints ask the caller") {
  Heap heap;
  heap.cancel_at = 2;
  CHECK(heap.context.checkpoint().ok());
  CHECK(heap.context.progress(0.5).ok());
  CHECK(heap.context.checkpoint().code == Code::cancelled);
  CHECK(heap.checkpoints == 3);
  Context deaf({}, 0, {});
  CHECK(deaf.checkpoint().ok());
  CHECK(deaf.enter(Stage::solve).ok());
}

TEST_CASE("context: progress names the stage") {
  struct Seen {
    int32_t stage = -1;
    double fraction = -1.0;
    int calls = 0;
  } seen;
  wireskin::Callbacks callbacks;
  callbacks.progress_user = &seen;
  callbacks.progress = [](int32_t stage, double fraction, void* user) {
    Seen& s = *static_cast<Seen*>(user);
    s.stage = stage;
    s.fraction = fraction;
    ++s.calls;
  };
  Context context({}, 0, callbacks);
  must(context.enter(Stage::patches));
  CHECK(seen.stage == 3);
  CHECK(seen.fraction == 0.0);
  must(context.progress(0.75));
  CHECK(seen.fraction == 0.75);
  CHECK(seen.calls == 2);
  CHECK(context.stage() == Stage::patches);
}

TEST_CASE("context: the clock is charged to the stage that runs") {
  double time = 1000.0;
  wireskin::Callbacks callbacks;
  callbacks.now = [](void* user) { return *static_cast<double*>(user); };
  callbacks.now_user = &time;
  Context context({}, 0, callbacks);
  time += 100.0;  // before the first stage
  must(context.enter(Stage::input));
  time += 1.0;
  must(context.enter(Stage::factor));
  time += 2.0;
  must(context.enter(Stage::solve));
  time += 4.0;
  must(context.enter(Stage::factor));
  time += 8.0;
  context.stop_clock();
  time += 1000.0;
  context.stop_clock();
  CHECK(context.milliseconds(0) == 1.0);
  CHECK(context.milliseconds(5) == 10.0);
  CHECK(context.milliseconds(6) == 4.0);
  CHECK(context.milliseconds(1) == 0.0);
}
