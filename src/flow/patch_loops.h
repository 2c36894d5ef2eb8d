// The boundary loops of a patch, as runs along arcs.
//
// In: the patch's triangles. Out: its loops, each beginning where a run does, the patch on their
// left; its Euler characteristic; whether an edge of the border is off the curves. Where loops
// touch at a vertex the walk turns round it through the patch, so they stay apart. Linear. Source
// of patches by their loops: B. Sadri, K. Singh, "Flow-Complex-Based Shape Reconstruction from 3D
// Curves", 2014, section 4.4.
#pragma once

#include "flow/patches.h"

namespace wireskin::flow {

struct PatchLoops {
  Array<uint32_t> run_start;
  Array<LoopRun> run;
  int32_t euler_characteristic = 0;
  bool open = false;
  // Scratch, clear between patches: the patch's triangles at each edge (count, and two of them);
  // the border's edges at each vertex (likewise, one more than their number, 0 for no vertex of
  // the patch).
  Array<uint32_t> count, first, second;
  Array<uint32_t> seen, border_first, border_second;
  Array<uint8_t> passed;
  Array<LoopRun> step;

  explicit PatchLoops(Context& context)
      : run_start(context),
        run(context),
        count(context),
        first(context),
        second(context),
        seen(context),
        border_first(context),
        border_second(context),
        passed(context),
        step(context) {}
};

Status start_loops(const Complex& complex, PatchLoops* loops);

Status find_loops(const Complex& complex, const CurveEdges& curves, const Samples& samples,
                  Span<const uint32_t> patch, Span<const uint8_t> turned, PatchLoops* loops);

}  // namespace wireskin::flow
