// Scaling by exact powers of two: the C boundary brings every input to an extent of about one and
// undoes it at the end, so that no stage sees 1e-150 or 1e150. Multiplying by a power of two rounds
// nothing (short of underflow 300 orders of magnitude below the extent); a shift would, so there is
// none.
#pragma once

#include <cstring>

#include "num/vec.h"

namespace wireskin {

// The e with 2^(e-1) <= x < 2^e, for positive finite x.
inline int binary_exponent(double x) {
  constexpr double k_two_to_54 = 18014398509481984.0;
  constexpr double k_least_normal = 2.2250738585072014e-308;
  const bool subnormal = x < k_least_normal;
  if (subnormal) x *= k_two_to_54;
  uint64_t bits = 0;
  std::memcpy(&bits, &x, sizeof bits);
  const int exponent = static_cast<int>(bits >> 52 & 0x7ff) - 1022;
  return subnormal ? exponent - 54 : exponent;
}

// 2^e for -1022 <= e <= 1023.
inline double power_of_two(int e) {
  const uint64_t bits = static_cast<uint64_t>(e + 1023) << 52;
  double x = 0.0;
  std::memcpy(&x, &bits, sizeof x);
  return x;
}

// Multiplies by 2^e in two steps, because 2^e itself may not be representable.
class Scale {
 public:
  explicit Scale(int e) : first_(power_of_two(e / 2)), second_(power_of_two(e - e / 2)) {}
  double operator()(double x) const { return x * first_ * second_; }
  Vec3 operator()(const Vec3& a) const { return {(*this)(a.x), (*this)(a.y), (*this)(a.z)}; }

 private:
  double first_, second_;
};

}  // namespace wireskin
