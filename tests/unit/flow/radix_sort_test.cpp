#include "flow/radix_sort.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "support/context.h"

using namespace unit;
using wireskin::flow::BitsKey;

namespace {

void check_sorted(std::vector<BitsKey> keys) {
  Heap heap;
  Array<BitsKey> sorted(heap.context);
  must(sorted.copy(view(keys)));
  must(wireskin::flow::radix_sort(heap.context, &sorted));
  std::stable_sort(keys.begin(), keys.end(),
                   [](const BitsKey& a, const BitsKey& b) { return a.bits < b.bits; });
  REQUIRE(sorted.size() == keys.size());
  size_t wrong = 0;
  for (size_t i = 0; i < keys.size(); ++i) {
    wrong += sorted[i].bits != keys[i].bits || sorted[i].index != keys[i].index ? 1 : 0;
  }
  CHECK(wrong == 0);
}

}  // namespace

TEST_CASE("keys of all lengths, few and many, equal ones in their order") {
  std::mt19937_64 random(1);
  for (const int shift : {0, 1, 20, 53, 60, 63}) {
    for (const uint32_t count : {0u, 1u, 2u, 3u, 50u, 5000u}) {
      std::vector<BitsKey> low, high;
      for (uint32_t i = 0; i < count; ++i) {
        low.push_back({random() >> shift, i});
        high.push_back({random() << shift, i});
      }
      check_sorted(low);
      check_sorted(high);
    }
  }
}

TEST_CASE("a cancelled or memoryless sort loses nothing") {
  std::vector<BitsKey> keys;
  for (uint32_t i = 0; i < 100; ++i) keys.push_back({uint64_t{i} * 0x9e3779b97f4a7c15ull, i});
  Heap heap;
  {
    Array<BitsKey> sorted(heap.context);
    must(sorted.copy(view(keys)));
    heap.allocator.fail_at = heap.allocator.calls;
    CHECK(wireskin::flow::radix_sort(heap.context, &sorted).code == Code::out_of_memory);
    CHECK(sorted[1].index == 1);
    heap.cancel_at = heap.checkpoints + 2;
    CHECK(wireskin::flow::radix_sort(heap.context, &sorted).code == Code::cancelled);
    CHECK(sorted.size() == 100);
  }
  CHECK(heap.allocator.clean());
}
