// Measures of a finished mesh: Gaussian curvature, how far its normals are from those given, and
// how sharply it bends across curves.
//
// The Gaussian curvature of an inner vertex is its angle defect over its mixed Voronoi area; a
// border vertex takes the mean of its neighbours inside. Angles are in degrees. O(triangles).
// Source: M. Meyer, M. Desbrun, P. Schroeder, A. Barr, "Discrete Differential-Geometry Operators
// for Triangulated 2-Manifolds", 2003.
#pragma once

#include "mesh/mesh.h"

namespace wireskin::mesh {

struct AngleStatistics {
  double mean = 0.0;
  double greatest = 0.0;
};

Status gaussian_curvature(Span<const Vec3> positions, Span<const uint32_t> triangles,
                          Span<const uint8_t> on_border, Array<double>* curvature);

// The angle between a normal and the one given, over the vertices where the latter is not zero.
Status normal_deviation(Context& context, Span<const Vec3> normals, Span<const Vec3> given,
                        AngleStatistics* deviation);

// The angle between the triangles on both sides of an edge, over the edges of curves: those whose
// ends are both on curves and, where `divided` says that curves divide patches, that do so.
Status dihedral_angles(Context& context, Span<const Vec3> positions, Span<const uint32_t> triangles,
                       Span<const uint32_t> patch, Span<const uint8_t> on_curve, bool divided,
                       AngleStatistics* dihedral);

}  // namespace wireskin::mesh
