// The mesh of a patch that its plane shows without folds.
//
// In: the patch's domain, its plane, the wished spacing. Out: points of the plane, those of the
// domain first, and triangles, none inverted, with the loops' left inside. Cost: that of
// planar/polygon_mesh.h. Source: T. Stanko et al., "Surfacing Curve Networks with Normal Control",
// 2016, section 3.3.
#pragma once

#include "network/patch_domain.h"
#include "network/plane.h"
#include "planar/polygon_mesh.h"

namespace wireskin::network {

// `least_facing` as in mesh_patches. Fails with patch_without_plane or patch_folded (no place)
// where the plane does not serve.
Status mesh_in_plane(const PatchDomain& domain, const Plane& plane, double spacing,
                     double least_facing, planar::PolygonMesh* mesh);

}  // namespace wireskin::network
