#include "base/sort_in_parts.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "support/context.h"
#include "support/killer_adversary.h"

using namespace unit;

namespace {

// Sorts, compares with std::sort and returns the number of checkpoints.
size_t check_sort(std::vector<uint32_t> keys) {
  Heap heap;
  std::vector<uint32_t> order(keys.size());
  for (uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  const auto less = [&](uint32_t a, uint32_t b) {
    return keys[a] != keys[b] ? keys[a] < keys[b] : a < b;
  };
  std::vector<uint32_t> expected = order;
  std::sort(expected.begin(), expected.end(), less);
  must(wireskin::sort_in_parts(heap.context, span(order), less));
  CHECK(order == expected);
  return heap.checkpoints;
}

}  // namespace

TEST_CASE("sort in parts: in order whatever the input, and a caller is asked by the way") {
  const uint32_t n = 100000;
  Random random(2);
  std::vector<uint32_t> shuffled, ascending, descending, equal, pipe;
  for (uint32_t i = 0; i < n; ++i) {
    shuffled.push_back(static_cast<uint32_t>(random.engine()));
    ascending.push_back(i);
    descending.push_back(n - i);
    equal.push_back(7);
    pipe.push_back(i < n / 2 ? i : n - i);
  }
  for (const auto& keys : {shuffled, ascending, descending, equal, pipe}) {
    const size_t asked = check_sort(keys);
    CHECK(asked >= n / 8192);  // however short a part is, bad pivots end the asking
    CHECK(asked < 8 * n / wireskin::k_steps_per_checkpoint);
  }
}

TEST_CASE("sort in parts: a few values are sorted without asking") {
  Random random(3);
  const uint32_t most = wireskin::k_steps_per_checkpoint;
  for (const uint32_t n : {0u, 1u, 2u, 17u, most}) {
    std::vector<uint32_t> keys(n);
    for (uint32_t& k : keys) k = random.below(n);
    CHECK(check_sort(keys) == 0);
  }
}

TEST_CASE("sort in parts: the killer adversary does not make it quadratic") {
  const uint32_t n = 100000;
  KillerAdversary adversary(n);
  std::vector<uint32_t> order(n);
  for (uint32_t i = 0; i < n; ++i) order[i] = i;
  Heap heap;
  const auto less = [&](uint32_t a, uint32_t b) { return adversary.less(a, b); };
  must(wireskin::sort_in_parts(heap.context, span(order), less));
  CHECK(adversary.comparisons < 12 * 17 * size_t{n});
  check_sort(adversary.value);
}

TEST_CASE("sort in parts: ends where the caller cancels, and no value is lost") {
  Heap heap;
  heap.cancel_at = 3;
  std::vector<uint32_t> values(50000);
  for (uint32_t i = 0; i < values.size(); ++i) values[i] = i * 7919 % 50000;
  const auto less = [](uint32_t a, uint32_t b) { return a < b; };
  CHECK(wireskin::sort_in_parts(heap.context, span(values), less).code == Code::cancelled);
  CHECK(!std::is_sorted(values.begin(), values.end()));
  std::sort(values.begin(), values.end());
  for (uint32_t i = 0; i < values.size(); ++i) REQUIRE(values[i] == i);
}
