// In which order approaches of curves are to be joined.
//
// In: the curves, their approaches, nearest first, the tolerance. Out: how exact the curves are (of
// those drawn on a surface at least three quarters of the gaps are next to nothing) and the pass of
// each approach. Of exact curves, ends that clearly meet a curve are settled first, or crossings
// near them would take them away; curves side by side come last, when all is joined that crosses.
// Of others what is nearest is what is likeliest: one pass. O(approaches).
#pragma once

#include "network/beads.h"

namespace wireskin::network {

// Within one component insides are joined only this much nearer than the tolerance: where curves
// cross, and not where they pass each other.
inline constexpr double k_crossing = 0.25;
// A gap of exact curves is no wider than this part of the tolerance.
inline constexpr double k_exact = 0.05;

enum class SnapPass : uint8_t { settled, crosses, beside };

struct SnapPlan {
  Array<SnapPass> pass;  // of each approach
  bool exact = false;

  explicit SnapPlan(Context& context) : pass(context) {}
};

// `complete`: nothing dangles, all is one component; such curves are never taken as exact.
Status plan_snaps(const Beads& beads, double tolerance, bool complete,
                  Span<const Approach> approaches, SnapPlan* plan);

// Whether curves with these unit directions run along each other, either way.
bool run_along(const Vec3& a, const Vec3& b);

}  // namespace wireskin::network
