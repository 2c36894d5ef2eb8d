// What every failable function of the library promises: whichever allocation fails and at whichever
// checkpoint the caller cancels, it returns just that and gives all its memory back.
#pragma once

#include <doctest/doctest.h>

#include "support/context.h"

namespace unit {

// `call` takes a Context& and returns a Status; it must succeed where nothing is in its way. Tries
// every `stride`-th place.
template <typename Call>
void fails_cleanly(const Call& call, size_t stride = 1) {
  size_t allocations = 0, checkpoints = 0;
  {
    Heap heap;
    must(call(heap.context));
    allocations = heap.allocator.calls;
    checkpoints = heap.checkpoints;
    CHECK(heap.allocator.clean());
  }
  REQUIRE(allocations > 0);
  for (size_t i = 0; i < allocations; i += stride) {
    Heap heap;
    heap.allocator.fail_at = i;
    CAPTURE(i);
    CHECK(call(heap.context).code == Code::out_of_memory);
    CHECK(heap.allocator.clean());
  }
  for (size_t i = 0; i < checkpoints; i += stride) {
    Heap heap;
    heap.cancel_at = i;
    CAPTURE(i);
    CHECK(call(heap.context).code == Code::cancelled);
    CHECK(heap.checkpoints == i + 1);
    CHECK(heap.allocator.clean());
  }
}

}  // namespace unit
