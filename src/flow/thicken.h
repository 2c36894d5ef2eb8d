// Fills tight rooms along the walls and empties them again from their least feasible side, so that
// walls which cut corners move into them. The topology stays.
//
// In: the walls of the topological reconstruction. Out: the walls again, with every filled room
// opened on one side. Rooms are the voids of all ratios, cut out by the peeled complex of all of
// them; a room is filled if its greatest radius is below `reach` times that of the first chosen
// creator and all its walls are there or may be added. Emptying goes from the inside first: a room
// joins an inner void where it can. Feasibility of a patch is the mean of 3 - sum |n . t| with the
// curves' tangents t at its corners. Near-linear. Source: B. Sadri, K. Singh,
// "Flow-Complex-Based Shape Reconstruction from 3D Curves", 2014, sections 4.4, 4.5, figure 17.
#pragma once

#include "flow/topology.h"

namespace wireskin::flow {

struct ThickenOptions {
  double reach = 1.2;  // 0: nothing is filled
  bool inside_first = true;
};

// The directions of the segments at each sample; those of v are [start[v], start[v + 1]).
struct SampleTangents {
  Array<uint32_t> start;
  Array<Vec3> direction;

  explicit SampleTangents(Context& context) : start(context), direction(context) {}
};

Status find_tangents(const Samples& samples, SampleTangents* tangents);

// Updates topology->walls and ->label.
Status thicken_and_prune(Context& context, const Complex& complex, const CurveEdges& curves,
                         const FlatCells& flat, const Persistence& persistence,
                         const SampleTangents& tangents, const ThickenOptions& options,
                         Topology3* topology);

}  // namespace wireskin::flow
