// Normals for the samples that have none, and one normal for every new joint.
//
// A sample without a normal at a point where other curves have some takes their mean. Between two
// samples that have one, both are carried along the curve by reflection (network/orient.h; exact on
// spheres) and mixed by arc length; beyond the last one it is carried on alone. A curve without any
// normal of its own is filled only where the points at both its ends gave it one (closed: any two),
// else it stays without. Sharp curves are left alone. O(samples).
#pragma once

#include "network/orient.h"

namespace wireskin::network {

struct FillCounts {
  uint32_t filled = 0;   // samples that got a normal
  uint32_t missing = 0;  // curves without normals still, sharp ones apart
};

// Within curves that have some normals of their own.
Status fill_along(Wires* wires, FillCounts* counts);

// From the points that curves share.
Status fill_from_nodes(Wires* wires, FillCounts* counts);

// Gives the samples of each point in `joined` (of each point: whether it is new) their mean normal,
// unless one of them is more than 60 degrees from it: the mean of normals that contradict each
// other would hide that. Lists, at every point, the normals more than 45 degrees from the mean.
Status reconcile_normals(Span<const uint8_t> joined, Wires* wires,
                         Array<Contradiction>* contradictions);

}  // namespace wireskin::network
