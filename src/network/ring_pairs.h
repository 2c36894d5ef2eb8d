// Which sides of closed curves are best joined in pairs by bands, and which are closed alone.
//
// In: sides (network/ring_bands.h). Out: of each side its partner or k_none, and whether another
// choice has hardly more area. Bands whose sides see each other come first, the least cost first;
// then partners are exchanged as long as that saves something: one more band is chosen, then the
// best ones for the sides that it leaves over, a few deep. What is left over after that may bend
// back to another side, as a rim does; there a side that looks across itself rather has a lid. Of a
// ring of boundary curves one side has a partner at most. Cost: O(n^2) in the distances of sides,
// about O(n) bands. Source: S. Lin, B. Kernighan, "An Effective Heuristic Algorithm for the
// Traveling-Salesman Problem", 1973, for the exchanges.
#pragma once

#include "network/ring_bands.h"

namespace wireskin::network {

Status pair_sides(RingBands* bands, Array<uint32_t>* partner, Array<uint8_t>* doubtful);

}  // namespace wireskin::network
