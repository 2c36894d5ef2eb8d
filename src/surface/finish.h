// From an initial mesh to the finished surface: smoothing by the chosen method, on the mesh itself
// or on the one cut open along creases, and the measures that the report gives of the result.
//
// In: a surface with triangles and the positions of its constrained vertices. Out: all positions,
// normals, curvatures, counts. Cost: that of the method.
#pragma once

#include "network/crease.h"
#include "surface/constraints.h"

namespace wireskin {

// Where smoothing starts: the metric, as the shapes of the triangles in planes or in space.
struct Start {
  Span<const mesh::TriangleShape> shape;
  smooth::Metric metric;
  Span<const uint8_t> on_border;
  // Of each vertex where it starts: placed ones do; for the others it is roughly where they will
  // stand (for the order of elimination), and where their patch goes back to if need be.
  Span<const Vec3> position = {};
  Span<const uint8_t> placed = {};       // free vertices; empty: none
  Span<const uint32_t> inner_edge = {};  // of curves inside patches, two vertices each
  // What `shape` views, if it may be given back.
  Array<mesh::TriangleShape>* spent = nullptr;
};

// Neighbours, the check of the mesh, and the counts that follow from them.
Status count_topology(uint32_t vertices, Span<const uint32_t> triangles, mesh::Topology* topology,
                      Counts* counts);

// Counts the triangles that lie upside down (mesh/inverted.h).
Status count_inverted(Context& context, Surface* surface);

Status smooth_surface(Context& context, const Start& start, const Constraints& constraints,
                      smooth::Method method, Surface* surface);

// The same for a mesh with creases; `creased` is that mesh cut open.
Status smooth_creased(Context& context, const Start& start, const Constraints& constraints,
                      smooth::Method method, network::CreasedMesh* creased, Surface* surface);

// How far the caller's samples, as `given`, lie from the curves of the result.
Status measure_constraints(const CurveSet& set, Span<const Vec3> given, Surface* surface);

}  // namespace wireskin
