// One mesh of all patches, each remeshed to the wished spacing, its rim fixed, free of crossings.
//
// In: a reconstruction. Out: vertices, first all samples, then inner ones; triangles with their
// patches. Patches are cut at curves and at edges of other than two triangles, refined by
// mesh/loop_refine.h, and tested exactly (crossings.h); those that run into each other take a
// smaller effort next time: no relaxation, at last the embedded complex itself, and where curves
// all but touch its own, jittered points. Without spacing all are left as they are. Every triangle
// of the walls occurs once; but flat ears and tails that several sheets end at are left out, unless
// that makes triangles cross. Near-linear in the result. Source: B. Sadri, K. Singh,
// "Flow-Complex-Based Shape Reconstruction from 3D Curves", 2014, section 5.
#pragma once

#include "flow/flow.h"

namespace wireskin::flow {

struct FlowMesh {
  Array<Vec3> position;
  Array<uint32_t> sample;  // of each vertex, k_none inside of patches
  Array<uint32_t> triangle;
  Array<uint32_t> patch;   // of each triangle
  uint32_t held_back = 0;  // patches refined with less than full effort
  uint32_t crossings = 0;  // pairs of triangles left that cross

  explicit FlowMesh(Context& context)
      : position(context), sample(context), triangle(context), patch(context) {}
};

Status mesh_patches(Context& context, const Flow& flow, const Reconstruction& reconstruction,
                    double spacing, FlowMesh* mesh);

}  // namespace wireskin::flow
