// Moves the least values of an array to its front, in no order: C. A. R. Hoare, "Algorithm 65:
// Find", 1961, with the median of three. A run of bad pivots ends in a sort, so O(n log n) at worst
// and O(n) as a rule. `less` must be a total order, as for sort().
#pragma once

#include "base/sort.h"

namespace wireskin {

template <typename T, typename Less>
Status select_least(Context& context, Span<T> values, size_t count, const Less& less) {
  constexpr ptrdiff_t k_short = 16, k_long = 1 << 16;
  T* first = values.begin();
  T* end = values.end();
  T* const cut = first + count;
  for (int budget = 96; end - first > k_short && budget > 0; --budget) {
    if (end - first > k_long) TRY(context.checkpoint());
    T* middle = partition(first, end, less);
    if (cut < middle) {
      end = middle;
    } else {
      first = middle;
    }
  }
  if (cut > first && cut < end) sort(Span<T>{first, static_cast<size_t>(end - first)}, less);
  return {};
}

}  // namespace wireskin
