// How far samples of a curve lie from a polyline that follows the same curve.
//
// In: the samples in order, the polyline in the same direction (a closed one repeats its first
// point), whose beginning need not be that of the samples. Out: the greatest distance and the sum
// of squares. The nearest edge of a sample is sought near that of the sample before it, so that the
// cost is linear and other passes of the curve nearby do not count.
#pragma once

#include "base/in_parts.h"
#include "num/vec.h"

namespace wireskin::curves {

struct LineDistance {
  double greatest = 0.0;
  double sum_of_squares = 0.0;
};

Status distance_to_line(Span<const Vec3> samples, Span<const Vec3> line, bool closed, Pace* pace,
                        LineDistance* result);

}  // namespace wireskin::curves
