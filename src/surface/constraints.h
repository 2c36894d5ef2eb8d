// Which vertices hold, which pull, and how hard.
//
// Curve vertices hold, or pull where their curve is soft; where curves meet, one that holds wins,
// else the shortest cutoff. O(vertices).
#pragma once

#include "surface.h"

namespace wireskin {

struct Constraints {
  Array<uint8_t> on_curve, held;
  Array<double> cutoff, share;  // empty: nothing is soft

  explicit Constraints(Context& context)
      : on_curve(context), held(context), cutoff(context), share(context) {}
};

// Fails with bad_argument where a cutoff is a large part of the size of everything: springs that
// weak hold nothing.
Status check_cutoff(double cutoff, double size, uint32_t curve);

// The first `curve_vertices` vertices of the surface are those on curves.
Status constrain_curves(const CurveSet& set, uint32_t curve_vertices, const Surface& surface,
                        Constraints* constraints);

// Where constrained vertices form no edges, a vertex stands for the mean length of its edges.
Status constrain_vertices(const TriangleSet& set, double spacing, Constraints* constraints);

}  // namespace wireskin
