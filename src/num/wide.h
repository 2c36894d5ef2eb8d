// Arithmetic in unevaluated pairs of doubles, about 105 bits: not exact, but wide enough to decide
// what only just escapes one double.
//
// Invariants: |low| is at most half a unit in the last place of high. Sum, difference and product
// have a relative error below 2^-100 of the true result.
// Source: M. Joldes, J.-M. Muller, V. Popescu, "Tight and Rigorous Error Bounds for Basic Building
// Blocks of Double-Word Arithmetic", 2017 (AccurateDWPlusDW; DWTimesDW without the product of the
// low parts).
#pragma once

#include "num/expansion.h"

namespace wireskin {

// Operands go by reference and the functions are inline for a reason: gcc 12 at -O1 and above takes
// pairs that are passed by value to an outlined function for zero (its ipa-modref pass).
inline TwoParts wide_sum(const TwoParts& a, const TwoParts& b) {
  const TwoParts high = two_sum(a.high, b.high);
  const TwoParts low = two_sum(a.low, b.low);
  const TwoParts sum = fast_two_sum(high.high, high.low + low.high);
  return fast_two_sum(sum.high, sum.low + low.low);
}

inline TwoParts wide_difference(const TwoParts& a, const TwoParts& b) {
  const TwoParts negative = {-b.high, -b.low};
  return wide_sum(a, negative);
}

inline TwoParts wide_product(const TwoParts& a, const TwoParts& b) {
  const TwoParts product = two_product(a.high, b.high);
  return fast_two_sum(product.high, product.low + (a.high * b.low + a.low * b.high));
}

}  // namespace wireskin
