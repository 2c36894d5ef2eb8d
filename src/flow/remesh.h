// One mesh of all patches, each remeshed to the wished spacing with its rim fixed, and still free
// of crossings.
//
// In: a reconstruction. Out: vertices, first all samples, then inner ones; triangles with their
// patches. Patches are cut at curves and wherever other than two triangles meet, refined by
// mesh/loop_refine.h, and tested against each other exactly (crossings.h); patches that run into
// each other take a smaller effort next time: no relaxation, at last no refinement, which is the
// embedded complex itself; triangles of it that cross all the same, because curves all but touch,
// get the complex's own, jittered points. Without spacing all patches are left as they are. Every
// triangle of the walls occurs once, ears and tails in their first patch; but flat ones that
// several sheets end at are left out, and each sheet goes on to the curve, unless that makes
// triangles cross. Near-linear in the result. Source of the remeshing to fair patches: B. Sadri, K.
// Singh, "Flow-Complex-Based Shape Reconstruction from 3D Curves", 2014, section 5.
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
