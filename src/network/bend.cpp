#include "network/bend.h"

namespace wireskin::network {

static constexpr double k_support = 16.0;

// 1 at 0, 0 from 1 on, with vanishing first and second derivatives there.
static double fade(double t) {
  if (!(t < 1.0)) return 0.0;
  return 1.0 - t * t * t * (10.0 - t * (15.0 - 6.0 * t));
}

// Spreads the displacement of pin `i` one way, until the next pin; `step` is 1 or -1.
static Status spread_pin(const Bend& bend, size_t i, bool forward, Pace* pace) {
  const size_t n = bend.arc.size();
  const Vec3 shift = bend.displacement[i];
  const double support = k_support * length(shift);
  const auto walk = [&](const auto& visit) -> Status {
    double wrapped = 0.0;
    for (size_t k = i, steps = 0; steps < n; ++steps) {
      TRY(pace->after());
      const bool over = forward ? k + 1 == n : k == 0;
      if (over && !bend.closed) return {};
      if (over) wrapped = bend.length;
      k = forward ? (over ? 0 : k + 1) : (over ? n - 1 : k - 1);
      const double away =
          forward ? bend.arc[k] + wrapped - bend.arc[i] : bend.arc[i] + wrapped - bend.arc[k];
      if (!visit(k, away)) return {};
    }
    return {};
  };
  double reach = support;
  TRY(walk([&](size_t k, double away) {
    if (bend.pinned[k] && away < reach) reach = away;
    return !bend.pinned[k] && away < support;
  }));
  return walk([&](size_t k, double away) {
    if (bend.pinned[k] || !(away < reach)) return false;
    bend.displacement[k] += fade(away / reach) * shift;
    return true;
  });
}

Status bend_curve(const Bend& bend, Pace* pace) {
  for (size_t i = 0; i < bend.arc.size(); ++i) {
    TRY(pace->after());
    if (!bend.pinned[i] || bend.displacement[i] == Vec3{}) continue;
    TRY(spread_pin(bend, i, true, pace));
    TRY(spread_pin(bend, i, false, pace));
  }
  return {};
}

}  // namespace wireskin::network
