// Points on arcs, dense enough that nothing slips between them: the samples of which the flow
// complex is made.
//
// In: arcs and the greatest step. Out: the samples, those of each arc in order, with the place on
// it. Invariants: samples lie on the polylines; every node and every isolated point is a sample bit
// for bit, and no given point is farther than k_given_distance steps from the segments;
// at a node all arcs begin with steps of the same length; steps are at most half the distance to
// the nearest other arc (its directed Hausdorff distance) down to a floor, but for those beside a
// sample that moved to a given point; every segment is Gabriel, that is, no sample lies in the ball
// of which it is the diameter, but for those counted as too short: below k_least_segment, or below
// the floor where another curve all but coincides with it. Curves side by side get samples side by
// side, so their number does not grow with the narrowness of the gap; those within k_same_curve of
// each other are one as to steps, and the same samples where they coincide. Near-linear where arcs
// are not all near each other. Sources: B. Sadri, K. Singh, "Flow-Complex-Based Shape
// Reconstruction from 3D Curves", 2014, section 4.1; J. Ruppert, "A Delaunay Refinement Algorithm",
// 1995 (shells).
#pragma once

#include "flow/arcs.h"

namespace wireskin::flow {

inline constexpr double k_least_segment = 1e-5;   // of the diagonal
inline constexpr double k_same_curve = 1e-4;      // of the diagonal
inline constexpr double k_given_distance = 0.05;  // of the greatest step

struct Samples {
  Array<Vec3> position;
  Array<uint32_t> vertex;  // of Arcs, k_none inside of arcs
  Array<uint32_t> start;   // arc a has at[start[a]] .. at[start[a + 1] - 1]; closed: first again
  Array<uint32_t> at;      // samples
  Array<double> along;     // arc length, parallel to `at`
  Array<uint32_t> step;    // parallel: the arc's polyline segment (index in Arcs::path) it lies on
  uint32_t splits = 0;     // made to become Gabriel
  uint32_t too_short = 0;  // segments left that should have been split

  explicit Samples(Context& context)
      : position(context),
        vertex(context),
        start(context),
        at(context),
        along(context),
        step(context) {}
};

// `greatest_step` is a length.
Status sample_arcs(Context& context, const Arcs& arcs, double greatest_step, Samples* samples);

}  // namespace wireskin::flow
