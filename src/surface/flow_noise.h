// Noise taken out of curves before a flow samples them.
//
// In: polylines as flow::build_flow takes them, their normals or none, and what is known of the
// noise. Out, in place: positions and normals by the smoothing splines of network/smoothing.h over
// the chains that the curves form (flow/chains.h), so that fragments are smoothed as what they are
// fragments of; samples that are one point stay one, junctions move with their curves, corners,
// ends and isolated points keep what they are. Where noise is to be found and no sample would move
// by more than k_no_noise of the diagonal, which is the rounding of files, nothing moves at all.
// Cost: that of the splines. Sources: see there.
#pragma once

#include "flow/arcs.h"
#include "network/smoothing.h"

namespace wireskin {

inline constexpr double k_no_noise = 1e-5;
inline constexpr double k_no_noise_of_normals = 1e-4;

// `polylines.position` views the same samples as `position`; `normal` is empty or has one for each.
Status smooth_polylines(Context& context, const flow::Polylines& polylines,
                        const network::SmoothingOptions& options, Span<Vec3> position,
                        Span<Vec3> normal, network::SmoothingReport* report);

}  // namespace wireskin
