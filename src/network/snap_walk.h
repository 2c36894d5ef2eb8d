// What it costs to look round from places on curves.
//
// In: curves and how far a walk goes along them. Out: how many samples it passes from each sample,
// both ways, not across the first one of a closed curve. Of what snapping takes: refused with
// bad_argument where its walks pass more than 2^26 samples, as with a tolerance of a thousand
// samples on curves that come near each other thousands of times. O(n).
#pragma once

#include "network/approach.h"

namespace wireskin::network {

Status count_walks(const Wires& wires, double reach, Array<uint32_t>* walk);

// `walk`: of each sample.
Status check_walks(Span<const Approach> approaches, Span<const uint32_t> walk, Context& context);

}  // namespace wireskin::network
