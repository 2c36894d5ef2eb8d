// From cycles to one mesh: every cycle is projected to its plane, triangulated there, and the
// patches are joined along the curves.
//
// In: the vertices on the curves and the cycles. Out: triangles over the curve vertices (first) and
// the free vertices, each triangle with its shape in its patch's plane, the metric of the paper's
// method. The plane goes through the mean of the border's positions across the mean of its normals.
// A patch whose border has no plane, or folds in it, is meshed in space instead
// (network/patch_in_space.h), curves inside it too (mesh/inlay.h); its triangles have their shapes
// there.
// No vertex is ever added on a curve, so patches conform; a chord between curve vertices that would
// stand in two patches, or beside a curve, is split by a free vertex. O(n log n). Source: T. Stanko
// et al., "Surfacing Curve Networks with Normal Control", 2016, section 3.3.
#pragma once

#include "mesh/operators.h"
#include "network/resample.h"

namespace wireskin::network {

// How a patch got its triangles.
enum class PatchWay : uint8_t { plane, minimal_area };

struct PatchMesh {
  uint32_t vertices = 0;
  uint32_t curve_vertices = 0;
  uint32_t coarse_patches = 0, first_coarse_patch = k_none;  // at more than the spacing
  Array<uint32_t> triangle;                                  // three vertices each
  Array<uint32_t> patch;                                     // of each triangle
  Array<mesh::TriangleShape> shape;  // of each triangle, in its patch's plane or in space
  Array<PatchWay> way;               // of each patch
  Array<Status> status;              // of each patch: why it has no triangles
  Array<Vec3> start;                 // of each vertex: on its curve, in its plane or in space
  Array<uint8_t> placed;             // of each vertex: free, and where it starts in space matters

  explicit PatchMesh(Context& context)
      : triangle(context),
        patch(context),
        shape(context),
        way(context),
        status(context),
        start(context),
        placed(context) {}
};

// `least_facing`: a plane is taken only where the mean cosine between its normal and those of the
// border is at least this; -1 takes every plane that shows the border without folds. Fails, naming
// the patch and a curve of it, with patch_without_plane where the border runs clockwise, with
// patch_folded where it crosses itself or encloses nothing in space either, where its normals ask
// for a one-sided surface, or curves inside it cross. With `partial` such patches are left without
// triangles, their vertices maybe too; it fails only where no patch can be made. `faults`: of each
// segment why the patches at it are not to be made, as from find_patches; may be empty.
Status mesh_patches(const Network& network, const CurveVertices& vertices, double least_facing,
                    bool partial, PatchMesh* mesh, Span<const Status> faults = {});

}  // namespace wireskin::network
