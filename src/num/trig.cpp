#include "num/trig.h"

namespace wireskin {

// arctan(t) for 0 <= t <= 1. Halving the angle three times brings t below 0.0985, where eleven
// terms of the series suffice.
static double arc_tangent_of_fraction(double t) {
  double factor = 1.0;
  for (int halving = 0; halving < 3; ++halving) {
    t = t / (1.0 + std::sqrt(1.0 + t * t));
    factor *= 2.0;
  }
  const double square = t * t;
  double sum = 0.0;
  for (int term = 10; term >= 0; --term) {
    const double coefficient = 1.0 / static_cast<double>(2 * term + 1);
    sum = coefficient - square * sum;
  }
  return factor * t * sum;
}

double arc_tangent(double y, double x) {
  const double up = std::fabs(y), side = std::fabs(x);
  if (up == 0.0 && side == 0.0) return 0.0;
  double angle = up <= side ? arc_tangent_of_fraction(up / side)
                            : 0.5 * k_pi - arc_tangent_of_fraction(side / up);
  if (x < 0.0) angle = k_pi - angle;
  return y < 0.0 ? -angle : angle;
}

}  // namespace wireskin
