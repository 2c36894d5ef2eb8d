// In which order approaches of curves are to be joined.
//
// In: the curves, their approaches, nearest first, the tolerance. Out: which approaches are of
// curves side by side (network/crossing.h), whose insides are not meant to meet; how exact the
// curves are (of those drawn on a surface at least three quarters of the gaps are next to nothing);
// and the pass of each approach. Of exact curves, ends that clearly meet a curve are settled first,
// or crossings near them would take them away, and curves side by side come last. Of others what is
// nearest is what is likeliest: one pass. O(approaches and the samples within reach of each).
#pragma once

#include "network/crossing.h"

namespace wireskin::network {

// Within one component insides are joined only this much nearer than the tolerance: where curves
// cross, and not where they pass each other. So is a corner to the curve that it points to.
inline constexpr double k_crossing = 0.25;
// A gap of exact curves is no wider than this part of the tolerance; and curves that are as near as
// that touch, in whatever direction they go on.
inline constexpr double k_exact = 0.05;

enum class SnapPass : uint8_t { settled, crosses, beside };

struct SnapPlan {
  Array<SnapPass> pass;   // of each approach
  Array<uint8_t> beside;  // of each approach: only an end there is to be joined
  bool exact = false;

  explicit SnapPlan(Context& context) : pass(context), beside(context) {}
};

// `complete`: nothing dangles, all is one component; such curves are never taken as exact.
// `walk`: of each sample (network/snap_walk.h).
Status plan_snaps(const Beads& beads, double tolerance, bool complete,
                  Span<const Approach> approaches, Span<const uint32_t> walk, SnapPlan* plan);

}  // namespace wireskin::network
