// Sorting in place, without allocation or recursion: quicksort with the median of three, insertion
// sort on short runs, heapsort where the pivots turn out badly (Musser, "Introspective Sorting and
// Selection Algorithms", 1997).
//
// `less` must be a total order (no two different elements may compare equal): then the result is
// the same whatever the algorithm, which is why the library does not use std::sort. O(n log n).
#pragma once

#include "base/array.h"

namespace wireskin {

template <typename T>
void swap_values(T& a, T& b) {
  const T kept = a;
  a = b;
  b = kept;
}

template <typename T, typename Less>
void insertion_sort(T* first, T* last, const Less& less) {
  if (first == last) return;
  for (T* i = first + 1; i != last; ++i) {
    const T moving = *i;
    T* hole = i;
    for (; hole != first && less(moving, hole[-1]); --hole) *hole = hole[-1];
    *hole = moving;
  }
}

template <typename T, typename Less>
void sift_down(T* heap, size_t i, size_t size, const Less& less) {
  const T moving = heap[i];
  for (size_t child = 2 * i + 1; child < size; child = 2 * i + 1) {
    if (child + 1 < size && less(heap[child], heap[child + 1])) ++child;
    if (!less(moving, heap[child])) break;
    heap[i] = heap[child];
    i = child;
  }
  heap[i] = moving;
}

template <typename T, typename Less>
void heap_sort(T* first, T* last, const Less& less) {
  const size_t size = static_cast<size_t>(last - first);
  for (size_t i = size / 2; i-- > 0;) sift_down(first, i, size, less);
  for (size_t end = size; end-- > 1;) {
    swap_values(first[0], first[end]);
    sift_down(first, 0, end, less);
  }
}

// Splits [first, last) around the median of three; both parts are shorter than the whole.
template <typename T, typename Less>
T* partition(T* first, T* last, const Less& less) {
  T* middle = first + (last - first) / 2;
  if (less(*middle, *first)) swap_values(*middle, *first);
  if (less(last[-1], *first)) swap_values(last[-1], *first);
  if (less(last[-1], *middle)) swap_values(last[-1], *middle);
  const T pivot = *middle;
  T* left = first;
  T* right = last - 1;
  while (true) {
    while (less(*left, pivot)) ++left;
    while (less(pivot, *right)) --right;
    if (left >= right) return left == first ? left + 1 : left;
    swap_values(*left++, *right--);
  }
}

template <typename T, typename Less>
void sort(Span<T> values, const Less& less) {
  constexpr ptrdiff_t k_short = 16;
  if (values.end() - values.begin() <= k_short) {
    insertion_sort(values.begin(), values.end(), less);
    return;
  }
  struct Run {
    T* first;
    T* last;
    int budget;
  };
  Run stack[64];  // the longer part waits, so the depth is at most log2 of the size
  int depth = 0;
  int budget = 2;
  for (size_t n = values.size(); n > 1; n >>= 1) budget += 2;
  stack[depth++] = {values.begin(), values.end(), budget};
  while (depth > 0) {
    Run run = stack[--depth];
    while (run.last - run.first > k_short && run.budget > 0) {
      T* middle = partition(run.first, run.last, less);
      --run.budget;
      if (middle - run.first < run.last - middle) {
        stack[depth++] = {middle, run.last, run.budget};
        run.last = middle;
      } else {
        stack[depth++] = {run.first, middle, run.budget};
        run.first = middle;
      }
    }
    if (run.last - run.first > k_short) {
      heap_sort(run.first, run.last, less);
    } else {
      insertion_sort(run.first, run.last, less);
    }
  }
}

// Writes different numbers to `to`, ascending. The place of each of a few is the count of those
// less than it: nothing there that a processor could foresee wrongly.
inline void sort_distinct(const uint32_t* values, uint32_t count, uint32_t* to) {
  constexpr uint32_t k_few = 32;
  if (count > k_few) {
    std::memcpy(to, values, count * sizeof(uint32_t));
    sort(Span<uint32_t>{to, count}, [](uint32_t a, uint32_t b) { return a < b; });
    return;
  }
  for (uint32_t i = 0; i < count; ++i) {
    uint32_t place = 0;
    for (uint32_t k = 0; k < count; ++k) place += values[k] < values[i];
    to[place] = values[i];
  }
}

}  // namespace wireskin
