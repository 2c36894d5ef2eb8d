// A network without some of its patches, for callers who want the others all the same.
//
// In: nodes, network, and of each patch whether it could be made. Out: both without the patches
// that could not, without the segments and nodes that bounded or held nothing else; a segment with
// a patch left on one side only is boundary. A node at which patches are left that share no curve
// there becomes several, at the same point. O(segments).
#pragma once

#include "network/network.h"

namespace wireskin::network {

// `original`: of each patch that is left, its number before. `faults`, if given: of each segment,
// cut down with the segments; may be empty.
Status drop_patches(Span<const Status> status, Array<Node>* nodes, Network* network,
                    Array<uint32_t>* original, Array<Status>* faults = nullptr);

}  // namespace wireskin::network
