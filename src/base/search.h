// Binary search in [first, end) by a question that is answered yes up to some index and no from
// there on.
#pragma once

namespace wireskin {

// The first index for which `holds` is false; `end` if there is none.
template <typename Index, typename Holds>
Index first_failing(Index first, Index end, const Holds& holds) {
  while (first < end) {
    const Index middle = first + (end - first) / 2;
    if (holds(middle)) {
      first = middle + 1;
    } else {
      end = middle;
    }
  }
  return first;
}

// The last index for which `holds` is true, as it is for `first`, which is not asked.
template <typename Index, typename Holds>
Index last_holding(Index first, Index end, const Holds& holds) {
  while (end - first > 1) {
    const Index middle = first + (end - first) / 2;
    (holds(middle) ? first : end) = middle;
  }
  return first;
}

}  // namespace wireskin
