// Floating-point expansions: exact numbers as unevaluated sums of doubles, with exact sum,
// difference, scaling and product, of a size fixed at compile time and wholly on the stack. compact
// writes a number in as few parts as its bits need, so that long sums of products fit small rooms.
//
// Invariants: the parts are non-zero, do not overlap and grow in magnitude, so the last one
// carries the sign; no part at all is zero. Exact while no product over- or underflows (see
// predicates.h for the range). Splitting is Dekker's, not fused multiply-add, so every target
// computes the same parts.
// Cost: sum m + n, scale m, product m n operations on the parts that are really there.
// Source: J. R. Shewchuk, "Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric
// Predicates", 1997; T. J. Dekker, "A Floating-Point Technique for Extending the Available
// Precision", 1971.
#pragma once

#include <cmath>

#include "base/platform.h"

namespace wireskin {

// A rounded result and what rounding took away: high + low is exact.
struct TwoParts {
  double high, low;
};

inline TwoParts two_sum(double a, double b) {
  const double sum = a + b;
  const double b_there = sum - a;
  const double a_there = sum - b_there;
  return {sum, (a - a_there) + (b - b_there)};
}

// As two_sum, for |a| >= |b|.
inline TwoParts fast_two_sum(double a, double b) {
  const double sum = a + b;
  return {sum, b - (sum - a)};
}

// Two halves of at most 26 bits each, so that products of halves are exact.
inline TwoParts split(double a) {
  constexpr double k_splitter = 134217729.0;  // 2^27 + 1
  const double c = k_splitter * a;
  const double high = c - (c - a);
  return {high, a - high};
}

inline TwoParts two_product(double a, double b) {
  const double product = a * b;
  const TwoParts as = split(a);
  const TwoParts bs = split(b);
  const double rest = ((product - as.high * bs.high) - as.low * bs.high) - as.high * bs.low;
  return {product, as.low * bs.low - rest};
}

template <int N>
struct Expansion {
  int size = 0;
  double part[N];

  void push(double value) {
    if (value != 0.0) part[size++] = value;
  }
  // Has the sign of the exact number and its order of magnitude.
  double leading() const { return size == 0 ? 0.0 : part[size - 1]; }
};

inline Expansion<2> exact_difference(double a, double b) {
  const TwoParts d = two_sum(a, -b);
  Expansion<2> e;
  e.push(d.low);
  e.push(d.high);
  return e;
}

inline Expansion<2> exact_product(double a, double b) {
  const TwoParts p = two_product(a, b);
  Expansion<2> e;
  e.push(p.low);
  e.push(p.high);
  return e;
}

// *sum = e + f: the parts of both, merged by magnitude, are added up from the smallest.
// The caller knows that *sum has room: never more parts than e and f have together.
template <int M, int N, int R>
void add_expansions(const Expansion<M>& e, const Expansion<N>& f, Expansion<R>* sum) {
  WIRESKIN_ASSERT(e.size + f.size <= R);
  sum->size = 0;
  int i = 0;
  int j = 0;
  double carry = 0.0;
  while (i < e.size || j < f.size) {
    const bool from_e = j == f.size || (i < e.size && std::fabs(e.part[i]) < std::fabs(f.part[j]));
    const TwoParts s = two_sum(carry, from_e ? e.part[i++] : f.part[j++]);
    sum->push(s.low);
    carry = s.high;
  }
  sum->push(carry);
}

template <int M, int N>
Expansion<M + N> operator+(const Expansion<M>& e, const Expansion<N>& f) {
  Expansion<M + N> sum;
  add_expansions(e, f, &sum);
  return sum;
}

template <int N>
Expansion<N> operator-(const Expansion<N>& e) {
  Expansion<N> negative;
  negative.size = e.size;
  for (int i = 0; i < e.size; ++i) negative.part[i] = -e.part[i];
  return negative;
}

template <int M, int N>
Expansion<M + N> operator-(const Expansion<M>& e, const Expansion<N>& f) {
  return e + -f;
}

template <int N>
Expansion<2 * N> scale(const Expansion<N>& e, double factor) {
  Expansion<2 * N> scaled;
  double carry = 0.0;
  for (int i = 0; i < e.size; ++i) {
    const TwoParts product = two_product(e.part[i], factor);
    const TwoParts low = two_sum(carry, product.low);
    const TwoParts high = fast_two_sum(product.high, low.high);
    scaled.push(low.low);
    scaled.push(high.low);
    carry = high.high;
  }
  scaled.push(carry);
  return scaled;
}

// The shorter factor should come second: the first is scaled once for each of its parts.
template <int M, int N>
Expansion<2 * M * N> operator*(const Expansion<M>& e, const Expansion<N>& f) {
  Expansion<2 * M * N> sums[2];
  for (int i = 0; i < f.size; ++i) {
    const Expansion<2 * M> term = scale(e, f.part[i]);
    add_expansions(sums[i & 1], term, &sums[(i + 1) & 1]);
  }
  return sums[f.size & 1];
}

// The same number in as few parts as its bits need. Downward, each part takes up what fits into it
// of the next: parts are at least 52 bits apart then. Upward, neighbours that touch are parted, so
// that sums and scalings take the result as they take any expansion.
template <int N>
void compact(Expansion<N>* e) {
  if (e->size < 2) return;
  int bottom = e->size;
  double high = e->part[e->size - 1];
  for (int i = e->size - 2; i >= 0; --i) {
    const TwoParts s = fast_two_sum(high, e->part[i]);
    high = s.high;
    if (s.low == 0.0) continue;
    e->part[--bottom] = s.high;
    high = s.low;
  }
  const int count = e->size;
  e->size = 0;
  for (int i = bottom; i < count; ++i) {
    const TwoParts s = fast_two_sum(e->part[i], high);
    e->push(s.low);
    high = s.high;
  }
  e->push(high);
}

// The most parts that compact leaves of a product of so many factors, a sum of a few such products
// or less, where each factor is a multiple of one power of two and below another, 2^bits apart.
constexpr int compact_parts(int factors, int bits) {
  return (factors * bits + 8) / 52 + 1;
}

// The number in a smaller room; the caller knows that compact makes it fit.
template <int R, int N>
Expansion<R> fitted(Expansion<N> e) {
  if (e.size > R) compact(&e);
  WIRESKIN_ASSERT(e.size <= R);
  Expansion<R> result;
  for (int i = 0; i < e.size; ++i) result.push(e.part[i]);
  return result;
}

// *sum += e * f. Room needed: what compact leaves of the greatest sum, and 2 M parts.
template <int M, int N, int R>
void add_product(const Expansion<M>& e, const Expansion<N>& f, Expansion<R>* sum) {
  Expansion<R> before;
  for (int i = 0; i < f.size; ++i) {
    const Expansion<2 * M> term = scale(e, f.part[i]);
    if (sum->size + term.size > R) compact(sum);
    before.size = 0;
    for (int k = 0; k < sum->size; ++k) before.push(sum->part[k]);
    add_expansions(before, term, sum);
  }
}

}  // namespace wireskin
