// The mesh of a patch that no plane shows: little area inside its loops (mesh/loop_mesh.h), and
// where its normals agree too little with the axis of the border for a flat start, raised from it
// along them: a band between two loops at once (mesh/band.h), else mesh/dome.h.
//
// In: a border that passes no vertex twice, the wished spacing. Out: points, those of the border
// first, and triangles. A dome begins on a mesh that is coarser inside, so that most of its systems
// are small; one last is solved at the wished spacing. A mesh that raising would make needles of
// stays as it was. Cost and sources: those of mesh/loop_mesh.h, mesh/dome.h and mesh/band.h.
#pragma once

#include "mesh/loop_refine.h"
#include "network/patch_domain.h"

namespace wireskin::network {

struct SpaceMesh {
  Array<Vec3> position;
  Array<uint32_t> triangle;
  bool raised = false;  // from little area
  bool band = false;    // by mesh/band.h
  bool coarse = false;  // at more than the spacing, as nothing finer was sound

  explicit SpaceMesh(Context& context) : position(context), triangle(context) {}
};

// Failures are those of mesh/loop_mesh.h.
Status mesh_border_in_space(const Border& border, double spacing, SpaceMesh* mesh);

// With the curves and points inside the patch as well (mesh/inlay.h), the domain's vertices first.
// Fails with patch_folded, naming a curve, where these cross or the border passes a point twice.
Status mesh_in_space(const PatchDomain& domain, const CurveVertices& vertices, double spacing,
                     SpaceMesh* mesh);

}  // namespace wireskin::network
