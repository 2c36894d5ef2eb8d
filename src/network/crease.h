// Creases: the mesh of the patches cut open along the sharp curves for the smoothing, and put
// together again.
//
// In: the network with the normals on both sides of its curves, and the mesh of its patches. Out: a
// mesh in which sharp curves are open borders, each copy of a vertex with the normal of its own
// sector: the mean of the sides of the sharp curves that bound it and of the curves inside it.
// Where none of these is known the copy is bare. Held vertices do not move, so copies stay
// together. O(triangles).
#pragma once

#include "mesh/crease_normals.h"
#include "mesh/measure.h"
#include "network/patch_mesh.h"

namespace wireskin::network {

struct CreasedMesh {
  mesh::Cut cut;
  Array<Vec3> position, normal;
  Array<uint8_t> held, bare, on_border;

  explicit CreasedMesh(Context& context)
      : cut(context),
        position(context),
        normal(context),
        held(context),
        bare(context),
        on_border(context) {}
};

// Whether any curve is sharp; if not, nothing below is needed.
inline bool has_creases(const CurveVertices& vertices) {
  return !vertices.side_start.empty();
}

// `sharp`: of each curve; `position`: of each vertex of the mesh. Fails with inconsistent_normals,
// naming node and curve, where the normals of one sector oppose each other.
Status cut_along_creases(const Network& network, const CurveVertices& vertices,
                         Span<const uint8_t> sharp, Span<const Node> nodes, const PatchMesh& mesh,
                         Span<const Vec3> position, CreasedMesh* creased);

// Brings positions and triangles back to the vertices of the uncut mesh.
Status merge_creases(Context& context, const CreasedMesh& creased, Span<Vec3> position,
                     Span<uint32_t> triangle);

// Of each vertex of the uncut mesh.
struct VertexMeasures {
  Span<Vec3> normal;
  Span<double> mean_curvature;
  Span<Vec3> constraint_normal;  // zero where free, or not known
  mesh::CornerNormals* crease_normals;
  // Over the sides, and over the edges of the curves that are no creases.
  mesh::AngleStatistics* normal_deviation;
  mesh::AngleStatistics* dihedral;
};

// At creases all of these are those of the sides, each measured by itself, in the mean.
// `patch`: of each triangle.
Status measure_sides(Context& context, const CreasedMesh& creased, Span<const Vec3> given_normal,
                     Span<const uint32_t> patch, const VertexMeasures& measures);

}  // namespace wireskin::network
