// Sorts numbered 64-bit keys without comparisons, eleven bits at a time from the lowest.
//
// Stable: equal keys stay in the order in which they came. Cost: at most six linear passes, a
// checkpoint before each, 16 bytes a key of scratch.
// Source: H. Hollerith's sorting machine, 1901; D. E. Knuth, "The Art of Computer Programming 3",
// 1973, section 5.2.5.
#pragma once

#include "base/array.h"

namespace wireskin::flow {

struct BitsKey {
  uint64_t bits;
  uint32_t index;
};

Status radix_sort(Context& context, Array<BitsKey>* keys);

}  // namespace wireskin::flow
