// Turns the triangles of the walls so that neighbours agree: towards the outside where they bound
// a void, as their neighbours across edges of two triangles elsewhere.
//
// Linear. A wall that is one-sided (a Moebius band) keeps a seam. Source of the voids on the sides:
// B. Sadri, K. Singh, "Flow-Complex-Based Shape Reconstruction from 3D Curves", 2014, section 4.3.
#pragma once

#include "flow/topology.h"

namespace wireskin::flow {

// Two a triangle: what lies on its first and second side, 0 for the outside, i + 1 for the chosen
// void i.
Status find_sides(const Complex& complex, const Persistence& persistence, const Topology3& topology,
                  Array<uint32_t>* side);

// `turned` is 1 where a triangle must be read backward to be counter-clockwise seen from its front.
Status orient_walls(Context& context, const Complex& complex, const Sheet& walls,
                    Span<const uint32_t> side, Array<uint8_t>* turned);

}  // namespace wireskin::flow
