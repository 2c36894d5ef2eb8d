// Exact dyadic rationals n * 2^e of any size, the slow truth against which floating-point geometry
// is tested. Magnitudes are little-endian words; schoolbook sums and products.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

namespace scenes {

class Dyadic {
 public:
  Dyadic() = default;
  explicit Dyadic(double value) {
    if (value == 0.0) return;
    int exponent = 0;
    const double mantissa = std::frexp(std::fabs(value), &exponent);
    uint64_t bits = static_cast<uint64_t>(std::ldexp(mantissa, 53));
    exponent_ = exponent - 53;
    negative_ = value < 0.0;
    for (; bits != 0; bits >>= 32) words_.push_back(static_cast<uint32_t>(bits));
  }

  int sign() const { return words_.empty() ? 0 : negative_ ? -1 : 1; }

  Dyadic operator-() const {
    Dyadic result = *this;
    result.negative_ = !result.negative_;
    return result;
  }

  friend Dyadic operator+(Dyadic a, Dyadic b) {
    if (a.words_.empty()) return b;
    if (b.words_.empty()) return a;
    if (a.exponent_ > b.exponent_) std::swap(a, b);
    b.shift_left(static_cast<unsigned>(b.exponent_ - a.exponent_));
    b.exponent_ = a.exponent_;
    if (a.negative_ == b.negative_) {
      a.words_ = sum(a.words_, b.words_);
      return a;
    }
    if (less(a.words_, b.words_)) std::swap(a, b);
    a.words_ = difference(a.words_, b.words_);
    return a;
  }
  friend Dyadic operator-(const Dyadic& a, const Dyadic& b) { return a + -b; }

  friend Dyadic operator*(const Dyadic& a, const Dyadic& b) {
    Dyadic result;
    result.exponent_ = a.exponent_ + b.exponent_;
    result.negative_ = a.negative_ != b.negative_;
    result.words_.assign(a.words_.size() + b.words_.size(), 0);
    for (size_t i = 0; i < a.words_.size(); ++i) {
      uint64_t carry = 0;
      for (size_t k = 0; k < b.words_.size() || carry != 0; ++k) {
        carry += result.words_[i + k];
        if (k < b.words_.size()) carry += uint64_t{a.words_[i]} * b.words_[k];
        result.words_[i + k] = static_cast<uint32_t>(carry);
        carry >>= 32;
      }
    }
    trim(&result.words_);
    return result;
  }

 private:
  using Words = std::vector<uint32_t>;

  static void trim(Words* words) {
    while (!words->empty() && words->back() == 0) words->pop_back();
  }
  static bool less(const Words& a, const Words& b) {
    if (a.size() != b.size()) return a.size() < b.size();
    for (size_t i = a.size(); i-- > 0;) {
      if (a[i] != b[i]) return a[i] < b[i];
    }
    return false;
  }
  static Words sum(const Words& a, const Words& b) {
    Words result;
    uint64_t carry = 0;
    for (size_t i = 0; i < a.size() || i < b.size() || carry != 0; ++i) {
      carry += uint64_t{i < a.size() ? a[i] : 0} + (i < b.size() ? b[i] : 0);
      result.push_back(static_cast<uint32_t>(carry));
      carry >>= 32;
    }
    return result;
  }
  // For a >= b.
  static Words difference(const Words& a, const Words& b) {
    Words result;
    int64_t borrow = 0;
    for (size_t i = 0; i < a.size(); ++i) {
      int64_t digit = int64_t{a[i]} - (i < b.size() ? b[i] : 0) + borrow;
      borrow = digit < 0 ? -1 : 0;
      if (digit < 0) digit += int64_t{1} << 32;
      result.push_back(static_cast<uint32_t>(digit));
    }
    trim(&result);
    return result;
  }
  void shift_left(unsigned bits) {
    words_.insert(words_.begin(), bits / 32, 0);
    if (bits % 32 == 0) return;
    uint32_t carry = 0;
    for (uint32_t& word : words_) {
      const uint32_t next = word >> (32 - bits % 32);
      word = word << (bits % 32) | carry;
      carry = next;
    }
    if (carry != 0) words_.push_back(carry);
  }

  Words words_;
  int exponent_ = 0;
  bool negative_ = false;
};

}  // namespace scenes
