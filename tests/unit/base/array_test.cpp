#include "base/array.h"

#include <doctest/doctest.h>

#include <utility>

#include "support/context.h"

using namespace unit;

TEST_CASE("array: push grows and keeps what is there") {
  Heap heap;
  {
    Array<uint32_t> a(heap.context);
    for (uint32_t i = 0; i < 10000; ++i) must(a.push(i * i));
    REQUIRE(a.size() == 10000);
    for (uint32_t i = 0; i < 10000; ++i) REQUIRE(a[i] == i * i);
    CHECK(a.back() == 9999u * 9999u);
    CHECK(heap.allocator.calls < 30);  // amortised, not one a push
  }
  CHECK(heap.allocator.clean());
  CHECK(heap.context.used_bytes() == 0);
}

TEST_CASE("array: an own element can be pushed and assigned across growth") {
  Heap heap;
  Array<uint64_t> a(heap.context);
  for (uint64_t i = 0; i < 8; ++i) must(a.push(i + 41));
  must(a.push(a[1]));  // 8 elements fill the first block, so this one moves
  CHECK(a.back() == 42);
  CHECK(a[0] == 41);
  must(a.assign(1000, a[1]));
  CHECK(a[0] == 42);
  CHECK(a[999] == 42);
}

TEST_CASE("array: a failed call leaves it as it was") {
  Heap heap;
  Array<double> a(heap.context);
  must(a.assign(8, 2.5));
  const double* before = a.data();
  heap.allocator.fail_at = heap.allocator.calls;
  heap.allocator.fail_from_then = true;
  CHECK(a.push(1.0).code == Code::out_of_memory);
  CHECK(a.reserve(9).code == Code::out_of_memory);
  CHECK(a.resize(9).code == Code::out_of_memory);
  CHECK(a.assign(9, 0.0).code == Code::out_of_memory);
  const std::vector<double> more(9, 1.0);
  CHECK(a.copy(view(more)).code == Code::out_of_memory);
  CHECK(a.resize(SIZE_MAX / 4).code == Code::too_large);
  CHECK(a.data() == before);
  CHECK(to_vector(a) == std::vector<double>(8, 2.5));
  CHECK(a.resize(5).ok());  // shrinking needs no memory
  CHECK(a.size() == 5);
}

TEST_CASE("array: moving hands the memory over") {
  Heap heap;
  {
    Array<int> a(heap.context), c(heap.context);
    must(a.assign(3, 7));
    must(c.assign(100, 1));
    const int* memory = a.data();
    Array<int> b(std::move(a));
    CHECK(b.data() == memory);
    CHECK(a.data() == nullptr);
    CHECK(a.empty());
    c = std::move(b);
    CHECK(c.data() == memory);
    CHECK(to_vector(c) == std::vector<int>{7, 7, 7});
    CHECK(heap.allocator.live_blocks == 1);  // what c had is given back
    Array<int>& same = c;
    c = std::move(same);
    CHECK(to_vector(c) == std::vector<int>{7, 7, 7});
    must(a.push(1));  // one moved from is empty, not dead
    CHECK(a.size() == 1);
  }
  CHECK(heap.allocator.clean());
}

TEST_CASE("array: clear and shrink keep the memory, free gives it back") {
  Heap heap;
  Array<int> a(heap.context);
  must(a.reserve(50));
  CHECK(a.empty());
  for (int i = 0; i < 50; ++i) a.push_reserved(i);
  const size_t calls = heap.allocator.calls;
  a.pop();
  CHECK(a.back() == 48);
  a.shrink(10);
  CHECK(a.size() == 10);
  CHECK(a.back() == 9);
  a.clear();
  must(a.assign(50, 3));
  CHECK(heap.allocator.calls == calls);
  a.free();
  CHECK(a.empty());
  CHECK(heap.allocator.live_blocks == 0);
}

TEST_CASE("array: copies, and parts of spans") {
  Heap heap;
  Array<int> a(heap.context);
  const std::vector<int> source = {1, 2, 3, 4, 5};
  must(a.copy(view(source)));
  CHECK(to_vector(a) == source);
  const Span<int> middle = a.span().part(1, 3);
  CHECK(middle.size() == 3);
  middle[2] = 9;
  CHECK(a[3] == 9);
  const Span<const int> constant = middle;
  CHECK(constant.data() == middle.data());
  CHECK(a.span().part(5, 0).empty());
  must(a.copy({}));
  CHECK(a.empty());
}

TEST_CASE("starts_from_counts: prefix sums with the total last") {
  std::vector<uint32_t> counts = {3, 0, 2, 1, 77};
  CHECK(wireskin::starts_from_counts(span(counts)) == 6);
  CHECK(counts == std::vector<uint32_t>{0, 3, 3, 5, 6});
  std::vector<uint32_t> none;
  CHECK(wireskin::starts_from_counts(span(none)) == 0);
  std::vector<uint32_t> only_end = {5};
  CHECK(wireskin::starts_from_counts(span(only_end)) == 0);
  CHECK(only_end[0] == 0);
}

TEST_CASE("shift_starts_back: groups that were filled by moving their starts have them again") {
  const std::vector<uint32_t> key = {2, 0, 2, 3, 0, 2};  // group 1 is empty
  std::vector<uint32_t> start(5, 0), item(key.size());
  for (uint32_t k : key) ++start[k];
  wireskin::starts_from_counts(span(start));
  for (uint32_t i = 0; i < key.size(); ++i) item[start[key[i]]++] = i;
  wireskin::shift_starts_back(span(start));
  CHECK(start == std::vector<uint32_t>{0, 2, 2, 5, 6});
  CHECK(item == std::vector<uint32_t>{1, 4, 0, 2, 5, 3});
  std::vector<uint32_t> none;
  wireskin::shift_starts_back(span(none));
  std::vector<uint32_t> only_end = {7};
  wireskin::shift_starts_back(span(only_end));
  CHECK(only_end[0] == 0);
}
