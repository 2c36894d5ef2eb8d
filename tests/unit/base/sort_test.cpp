#include "base/sort.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include "support/context.h"
#include "support/killer_adversary.h"

using namespace unit;

namespace {

using Item = std::pair<uint32_t, uint32_t>;  // key, index: a total order

std::vector<Item> with_index(const std::vector<uint32_t>& keys) {
  std::vector<Item> items;
  for (uint32_t k : keys) items.push_back({k, static_cast<uint32_t>(items.size())});
  return items;
}

// Sorts, compares with std::sort and returns the number of comparisons.
size_t check_sort(std::vector<Item> items) {
  std::vector<Item> expected = items;
  std::sort(expected.begin(), expected.end());
  size_t comparisons = 0;
  struct Trivial {
    uint32_t key, index;
  };
  std::vector<Trivial> plain;
  for (const Item& i : items) plain.push_back({i.first, i.second});
  wireskin::sort(span(plain), [&](const Trivial& a, const Trivial& b) {
    ++comparisons;
    return a.key != b.key ? a.key < b.key : a.index < b.index;
  });
  for (size_t i = 0; i < items.size(); ++i) items[i] = {plain[i].key, plain[i].index};
  CHECK(items == expected);
  return comparisons;
}

double n_log_n(size_t n) {
  return static_cast<double>(n) * std::log2(static_cast<double>(n));
}

}  // namespace

TEST_CASE("sort: nothing, one and two elements") {
  wireskin::sort(Span<int>(), [](int a, int b) { return a < b; });
  CHECK(check_sort({}) == 0);
  CHECK(check_sort(with_index({5})) == 0);
  check_sort(with_index({5, 3}));
  check_sort(with_index({3, 5}));
}

TEST_CASE("sort: every permutation of seven and every short length") {
  std::vector<uint32_t> keys = {0, 1, 2, 3, 4, 5, 6};
  do {
    check_sort(with_index(keys));
  } while (std::next_permutation(keys.begin(), keys.end()));
  Random random(1);
  for (uint32_t n = 0; n < 100; ++n) {
    std::vector<uint32_t> some;
    for (uint32_t i = 0; i < n; ++i) some.push_back(random.below(n / 2 + 1));
    check_sort(with_index(some));
  }
}

TEST_CASE("sort: random, sorted, equal and organ-pipe input stays within n log n") {
  const uint32_t n = 50000;
  Random random(2);
  std::vector<uint32_t> shuffled, ascending, descending, equal, few, pipe;
  for (uint32_t i = 0; i < n; ++i) {
    shuffled.push_back(static_cast<uint32_t>(random.engine()));
    ascending.push_back(i);
    descending.push_back(n - i);
    equal.push_back(7);
    few.push_back(random.below(3));
    pipe.push_back(i < n / 2 ? i : n - i);
  }
  for (const auto& keys : {shuffled, ascending, descending, equal, few, pipe}) {
    CHECK(static_cast<double>(check_sort(with_index(keys))) < 4.0 * n_log_n(n));
  }
}

TEST_CASE("sort: equal elements, which a total order rules out, do no harm") {
  std::vector<int> same(1000, 4);
  wireskin::sort(span(same), [](int a, int b) { return a < b; });
  CHECK(same == std::vector<int>(1000, 4));
}

// Then the values that it made up are sorted again as they are.
TEST_CASE("sort: the killer adversary does not make it quadratic") {
  const uint32_t n = 20000;
  KillerAdversary adversary(n);
  std::vector<uint32_t> order(n);
  for (uint32_t i = 0; i < n; ++i) order[i] = i;
  wireskin::sort(span(order), [&](uint32_t a, uint32_t b) { return adversary.less(a, b); });
  MESSAGE("comparisons against the adversary: ", adversary.comparisons);
  CHECK(static_cast<double>(adversary.comparisons) < 8.0 * n_log_n(n));
  CHECK(static_cast<double>(check_sort(with_index(adversary.value))) < 8.0 * n_log_n(n));
}

TEST_CASE("sort: different numbers, few or many, are written in order") {
  std::mt19937 random(12);
  for (uint32_t count = 0; count < 70; ++count) {
    std::vector<uint32_t> values(count), sorted(count + 1, 7);
    for (uint32_t i = 0; i < count; ++i) values[i] = 5 * i;
    std::shuffle(values.begin(), values.end(), random);
    const std::vector<uint32_t> given = values;
    wireskin::sort_distinct(values.data(), count, sorted.data());
    CHECK(values == given);
    for (uint32_t i = 0; i < count; ++i) REQUIRE(sorted[i] == 5 * i);
    CHECK(sorted[count] == 7);
  }
}
