// Bends curves smoothly so that their joints come to given places.
//
// In: the samples of a curve in order with their arc length, and for some of them (pins) the
// displacement. Out: the displacement of all: that of each pin, faded out to both sides by a
// polynomial with two vanishing derivatives at both ends, over 16 times its length or as far as the
// next pin. So directions turn by less than 7 degrees where pins leave room, samples beyond keep
// their bits, and no kink arises at a joint. O(samples).
#pragma once

#include "base/in_parts.h"
#include "num/vec.h"

namespace wireskin::network {

struct Bend {
  Span<const double> arc;  // ascending
  double length = 0.0;     // of the whole curve, closing edge included
  bool closed = false;
  Span<const uint8_t> pinned;
  Span<Vec3> displacement;  // of pins on entry, of all on exit; that of others is zero on entry
};

Status bend_curve(const Bend& bend, Pace* pace);

}  // namespace wireskin::network
