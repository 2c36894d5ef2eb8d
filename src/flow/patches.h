// Cuts the walls into patches bounded by curves.
//
// In: the walls, their voids, curves' edges. Out: for each patch its triangles, turned to one side,
// its boundary loops as runs along arcs, and what lies on both sides. The walls are cut at curves,
// at chords (curve_edges.h) and where other than two triangles meet. A chord in a border stands for
// the path along the curve; a class of triangles whose border cancels out by that is an ear and
// belongs to every patch at its chord. Where sheets merge short of a curve, the rest of the way (a
// tail) belongs to each of them. So ears and tails occur in several patches. A patch whose border
// still has an edge off the curves is open. Near-linear. Source: B. Sadri, K. Singh,
// "Flow-Complex-Based Shape Reconstruction from 3D Curves", 2014; chords and tails are our own.
#pragma once

#include "flow/topology.h"

namespace wireskin::flow {

// A stretch of a boundary loop: the samples of an arc from one to another, backward if from > to;
// places in Samples::at. Off the curves arc is k_none and the ends are samples.
struct LoopRun {
  uint32_t arc, from, to;
};

struct PatchFacts {
  uint32_t loops = 0;
  int32_t euler_characteristic = 0;
  double area = 0.0;
  double greatest = 0.0;  // radius at which its last triangle is swallowed
  // Voids before and behind it: 0 is the outside, 1 the first chosen. Its triangles are
  // counter-clockwise seen from the front.
  uint32_t front = 0, back = 0;
  bool open = false;
};

struct Patches {
  Array<uint32_t> start, triangle;  // triangles of the complex; first those of no other patch
  Array<PatchFacts> facts;
  Array<uint32_t> loop_start;  // loops of patch p: loop_start[p] .. loop_start[p + 1]
  Array<uint32_t> run_start;   // runs of loop l
  Array<LoopRun> run;
  Array<uint32_t> owner;  // of each triangle of the complex: its first patch, or k_none
  Array<uint8_t> turned;  // of each triangle: to be read backward

  explicit Patches(Context& context)
      : start(context),
        triangle(context),
        facts(context),
        loop_start(context),
        run_start(context),
        run(context),
        owner(context),
        turned(context) {}
  uint32_t size() const { return static_cast<uint32_t>(facts.size()); }
};

Status cut_patches(Context& context, const Complex& complex, const CurveEdges& curves,
                   const Samples& samples, const FlatCells& cells, const Persistence& persistence,
                   const Topology3& topology, Patches* patches);

}  // namespace wireskin::flow
