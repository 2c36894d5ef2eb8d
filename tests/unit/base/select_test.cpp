#include "base/select.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "support/context.h"
#include "support/killer_adversary.h"

using namespace unit;

namespace {

// Selects, compares with a sort, and returns the number of comparisons.
size_t check_select(const std::vector<uint32_t>& keys, size_t count) {
  Heap heap;
  size_t comparisons = 0;
  std::vector<uint32_t> order(keys.size());
  for (uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  const auto less = [&](uint32_t a, uint32_t b) {
    ++comparisons;
    return keys[a] != keys[b] ? keys[a] < keys[b] : a < b;
  };
  std::vector<uint32_t> expected = order;
  std::sort(expected.begin(), expected.end(), less);
  comparisons = 0;
  must(wireskin::select_least(heap.context, span(order), count, less));
  const size_t taken = comparisons;
  const auto cut = order.begin() + static_cast<ptrdiff_t>(count);
  std::sort(order.begin(), cut);
  std::sort(cut, order.end());
  const auto expected_cut = expected.begin() + static_cast<ptrdiff_t>(count);
  std::sort(expected.begin(), expected_cut);
  std::sort(expected_cut, expected.end());
  CHECK(order == expected);
  return taken;
}

}  // namespace

TEST_CASE("select: every count of short arrays, with equal keys") {
  Random random(1);
  for (uint32_t n = 0; n < 60; ++n) {
    std::vector<uint32_t> keys(n);
    for (uint32_t& k : keys) k = random.below(n / 2 + 1);
    for (size_t count = 0; count <= n; ++count) check_select(keys, count);
  }
}

TEST_CASE("select: the half, whatever the input, in linear time") {
  const uint32_t n = 40000;
  Random random(2);
  std::vector<uint32_t> shuffled, ascending, descending, equal;
  for (uint32_t i = 0; i < n; ++i) {
    shuffled.push_back(static_cast<uint32_t>(random.engine()));
    ascending.push_back(i);
    descending.push_back(n - i);
    equal.push_back(7);
  }
  for (const auto& keys : {shuffled, ascending, descending, equal}) {
    CHECK(check_select(keys, n / 2) < 8 * size_t{n});
    CHECK(check_select(keys, 3) < 8 * size_t{n});
  }
}

TEST_CASE("select: the killer adversary does not make it quadratic") {
  const uint32_t n = 100000;
  KillerAdversary adversary(n);
  std::vector<uint32_t> order(n);
  for (uint32_t i = 0; i < n; ++i) order[i] = i;
  Heap heap;
  const auto less = [&](uint32_t a, uint32_t b) { return adversary.less(a, b); };
  must(wireskin::select_least(heap.context, span(order), n / 2, less));
  CHECK(adversary.comparisons > 50 * size_t{n});  // it has met its match: all pivots were bad
  CHECK(adversary.comparisons < 200 * size_t{n});
  check_select(adversary.value, n / 2);
}

TEST_CASE("select: a long pass asks, and ends where the caller cancels without losing a value") {
  Heap heap;
  heap.cancel_at = 1;
  std::vector<uint64_t> values(1000000);
  for (uint32_t i = 0; i < values.size(); ++i) values[i] = i * uint64_t{7919} % 1000000;
  const auto less = [](uint64_t a, uint64_t b) { return a < b; };
  CHECK(wireskin::select_least(heap.context, span(values), 500000, less).code == Code::cancelled);
  std::sort(values.begin(), values.end());
  for (uint32_t i = 0; i < values.size(); ++i) REQUIRE(values[i] == i);
}
