// Writes groups of cycles as the patches of a network.
//
// In: which cycles are one patch, which rings are turned over, and what lies inside. Out: the
// network with patches of several loops, in the order of the least old patch of each, with inner
// segments and points; segments and loose pieces stay as they are. O(n log n).
#pragma once

#include "network/grouping.h"

namespace wireskin::network {

// `number`: of each old patch the new one; `ambiguous`: of each new patch.
Status rebuild(Grouping* g, Array<uint32_t>* number, Array<uint8_t>* ambiguous);

}  // namespace wireskin::network
