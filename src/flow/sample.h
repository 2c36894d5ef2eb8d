// Points on arcs, dense enough that nothing slips between them: the samples of the flow complex.
//
// In: arcs and the greatest step. Out: samples on the polylines, in order along each arc. Every
// node and isolated point is one, bit for bit; no given point is farther than k_given_distance
// steps from the segments; at a node all arcs begin with equal steps; steps are at most half the
// distance to the nearest other arc (directed Hausdorff) down to a floor, but at given points;
// every segment is Gabriel (no sample in the ball on it) but for those counted as too short. Curves
// side by side get samples side by side; within k_same_curve they count as one for steps, and share
// samples where they coincide. Near-linear where arcs are not all near each other. Sources: B.
// Sadri, K. Singh, "Flow-Complex-Based Shape Reconstruction from 3D Curves", 2014, section 4.1; J.
// Ruppert, "A Delaunay Refinement Algorithm", 1995 (shells).
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
