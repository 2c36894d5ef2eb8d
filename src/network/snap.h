// Joins curves that almost meet: ends to ends, ends to the inside of curves, curves that pass each
// other.
//
// In: welded, chained curves and a tolerance. Local minima of the distance between curves are taken
// in the order of network/snap_order.h and left alone where the network connects their places
// already within four tolerances (a loose end: four times the distance, two: twice); an end or a
// node no farther than the tolerance takes part instead of a place near it. Insides are joined only
// where the curves were in different components, or cross: at a quarter of the tolerance, or at a
// hundredth in a network that is complete; of exact curves every crossing gets its point, and those
// side by side are joined only where nothing else joins their components. Out: the curves, bent
// (network/write_beads.h); the joints. Cost: the approaches',
// and for each a search within four tolerances; fails with bad_argument where that is too much.
#pragma once

#include "network/approach.h"

namespace wireskin::network {

enum class SnapKind { end_end, end_inside, inside_inside };

struct Snap {
  Origin a, b;
  Vec3 at_a, at_b;  // as they were
  double distance = 0.0;
  SnapKind kind = SnapKind::end_end;
};

struct SnapResult {
  Array<Snap> snaps;
  uint32_t open_before = 0;  // pairs of components nearer than the tolerance
  uint32_t open_after = 0;

  explicit SnapResult(Context& context) : snaps(context) {}
};

Status snap_wires(double tolerance, Wires* wires, SnapResult* result);

}  // namespace wireskin::network
