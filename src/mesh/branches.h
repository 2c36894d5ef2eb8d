// A first mesh of a patch whose loops are the ends of tubes that meet: legs of a body, branches.
//
// In: loops as for mesh/loop_mesh.h. Out: the same as there. A surface of little area between ends
// that are far apart is lids with threads between them. So every loop whose conormals agree is
// first moved along their mean, all by the same part of the way to the middle of the others, as far
// as they keep a distance of about their radius; straight tubes lead there, and only what is left
// between their ends is taken with little area. Loops whose conormals do not agree stay where they
// are, and all do where what is left between the ends cannot be meshed. Cost: that of mesh_loops(),
// twice then, and for each pair of loops 2^10 distances at each of up to 18 steps.
#pragma once

#include "mesh/loop_mesh.h"

namespace wireskin::mesh {

// Fails as mesh_loops() does.
Status mesh_branches(Context& context, const Loops& loops, double spacing, LoopMesh* mesh);

}  // namespace wireskin::mesh
