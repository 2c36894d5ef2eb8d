// Joins curves that almost meet: ends to ends, ends to the inside of curves, curves that pass each
// other.
//
// In: welded, chained curves and a tolerance. Local minima of the distance between curves are taken
// nearest first. One is left alone where the network connects its places already within four
// tolerances (a loose end: four times the distance, two loose ends: twice); where it lies near an
// end or a node of a curve that is no farther than the tolerance from the other place, that end or
// node takes part instead. Two insides are joined only if the curves were in different connected
// components to begin with, or cross: at a quarter of the tolerance, or at a hundredth in a network
// that is complete (one component, no dangling ends). A place between samples becomes a sample.
// Where a place was connected already it stays and the others come to it, else an end comes to the
// inside of a curve, else both meet in the middle. Out: the curves, bent (network/bend.h), with the
// points united; the list of joints. Cost: that of finding the approaches, and of a search over the
// samples within four tolerances for each.
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

// The median edge, which is about what
// strokes miss each other by, but at most 1/100 of the diagonal of the bounding box.
Status automatic_tolerance(const Wires& wires, double diagonal, double* tolerance);

struct SnapResult {
  Array<Snap> snaps;
  uint32_t open_before = 0;  // pairs of components nearer than the tolerance
  uint32_t open_after = 0;

  explicit SnapResult(Context& context) : snaps(context) {}
};

Status snap_wires(double tolerance, Wires* wires, SnapResult* result);

}  // namespace wireskin::network
