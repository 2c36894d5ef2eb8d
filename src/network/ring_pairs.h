// Which sides of closed curves are best joined in pairs by bands, and which are closed alone.
//
// In: sides (network/ring_bands.h). Out: of each side its partner or k_none, and whether another
// choice has hardly more area; the bands are listed. Bands whose sides see each other come first,
// the least cost first; then partners are exchanged as long as that saves something: one more band
// is chosen, then the best ones for the sides that it leaves over, a few deep. What is left over
// may bend back to another side, as a rim does; there a side that looks across itself rather has a
// lid: its `alone` is lessened. Of a ring of boundary curves one side has a partner at most. Cost:
// that of the lists in network/ring_bands.h, and O(1) exchanges for each band. Source: S. Lin, B.
// Kernighan, "An Effective Heuristic Algorithm for the Traveling-Salesman Problem", 1973.
#pragma once

#include "network/ring_bands.h"

namespace wireskin::network {

// Lists bands->band and changes RingSide::alone.
Status pair_sides(RingBands* bands, Array<uint32_t>* partner, Array<uint8_t>* doubtful);

}  // namespace wireskin::network
