#include "num/trig.h"

namespace wireskin {

namespace {

// An angle as the unevaluated sum of two doubles: the nearest one and what it leaves.
struct SplitAngle {
  double high, low;
};

}  // namespace

// arctan(t) for 0 <= t <= 1. The angle of k / 8 nearest to t comes from a table, the tangent of the
// rest is at most 1 / 16, where eight terms of the series suffice.
static SplitAngle arc_tangent_of_fraction(double t) {
  constexpr SplitAngle k_angle_of_eighths[] = {{0.0, 0.0},
                                               {0.12435499454676144, -3.1253241424539383e-18},
                                               {0.24497866312686414, 1.0698755618734451e-17},
                                               {0.35877067027057225, -2.4623815582638635e-17},
                                               {0.4636476090008061, 2.2698777452961687e-17},
                                               {0.5585993153435624, -5.4556305485916264e-18},
                                               {0.6435011087932844, 1.5834785051444286e-17},
                                               {0.7188299996216245, -2.1478388444456983e-17},
                                               {0.7853981633974483, 3.061616997868383e-17}};
  const int k = static_cast<int>(8.0 * t + 0.5);
  const double c = 0.125 * k;
  const double rest = (t - c) / (1.0 + t * c);
  const double square = rest * rest;
  double sum = 0.0;
  for (int term = 7; term >= 1; --term)
    sum = 1.0 / static_cast<double>(2 * term + 1) - square * sum;
  const SplitAngle& table = k_angle_of_eighths[k];
  return {table.high, table.low + (rest - rest * square * sum)};
}

double arc_tangent(double y, double x) {
  constexpr SplitAngle k_quarter = {0.5 * k_pi, 6.123233995736766e-17};
  constexpr SplitAngle k_half = {k_pi, 1.2246467991473532e-16};
  const double up = std::fabs(y), side = std::fabs(x);
  if (up == 0.0 && side == 0.0) return 0.0;
  const double fraction = up <= side ? up / side : side / up;
  if (!(fraction <= 1.0)) return fraction;
  SplitAngle angle = arc_tangent_of_fraction(fraction);
  if (up > side) angle = {k_quarter.high - angle.high, k_quarter.low - angle.low};
  if (x < 0.0) angle = {k_half.high - angle.high, k_half.low - angle.low};
  const double sum = angle.high + angle.low;
  return y < 0.0 ? -sum : sum;
}

}  // namespace wireskin
