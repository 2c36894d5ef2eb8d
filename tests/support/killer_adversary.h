// An order of values that makes any quicksort choose bad pivots.
//
// The values are made up while they are compared: all are "gas" at first, above everything, and one
// is made solid, the least above those that are, only where two of gas meet. The one that was
// compared last, likely the pivot, is made solid first, so that every pivot turns out to be next to
// the least. What was answered stays true: sorted again, `value` asks for the same comparisons of
// whoever compares in a fixed way.
//
// Source: M. D. McIlroy, "A Killer Adversary for Quicksort", 1999.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace unit {

struct KillerAdversary {
  std::vector<uint32_t> value;
  size_t comparisons = 0;

  explicit KillerAdversary(uint32_t count) : value(count, count), gas_(count) {}

  bool less(uint32_t a, uint32_t b) {
    ++comparisons;
    if (value[a] == gas_ && value[b] == gas_) value[a == candidate_ ? a : b] = solid_++;
    if (value[a] == gas_) candidate_ = a;
    if (value[b] == gas_) candidate_ = b;
    return value[a] < value[b];
  }

 private:
  uint32_t gas_, solid_ = 0, candidate_ = 0;
};

}  // namespace unit
