// The smaller and the larger of two numbers, without the calls into libm that fmin and fmax are on
// some targets. Neither number may be NaN.
#pragma once

namespace wireskin {

inline double smaller(double a, double b) {
  return b < a ? b : a;
}
inline double larger(double a, double b) {
  return a < b ? b : a;
}

}  // namespace wireskin
