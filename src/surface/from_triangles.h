// From a mesh of the caller's, some of its vertices held, to a smooth surface: the same triangles.
//
// In: positions, triangles, what is constrained. Out: a Surface of one patch. Fails, naming vertex
// or triangle, where the mesh is no manifold, a triangle has no area, a component or a vertex of an
// open border is held by nothing, or smoothing spoils the mesh (surface/spoilt.h). Cost: that of
// the method.
#pragma once

#include "surface.h"

namespace wireskin {

Status surface_triangles(Context& context, const TriangleSet& mesh, const Settings& settings,
                         Surface* surface);

}  // namespace wireskin
