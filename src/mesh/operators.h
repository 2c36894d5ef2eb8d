// Discrete differential operators on triangle meshes, planar or spatial: cotangent Laplacian, mixed
// Voronoi and barycentric vertex areas.
//
// All of them depend on the mesh only through the shape of each triangle, so they take one
// TriangleShape a triangle, made from plane coordinates (a patch's projection; a curve vertex then
// has another place in each patch) or from space. O(triangles). Sources: U. Pinkall, K. Polthier,
// "Computing Discrete Minimal Surfaces and Their Conjugates", 1993; M. Meyer, M. Desbrun, P.
// Schroeder, A. Barr, "Discrete Differential-Geometry Operators for Triangulated 2-Manifolds",
// 2003.
#pragma once

#include "mesh/mesh.h"
#include "sparse/csc.h"

namespace wireskin::mesh {

struct TriangleShape {
  double cotangent[3];  // of the angle at each corner
  double area;
};

TriangleShape triangle_shape(const Vec2& a, const Vec2& b, const Vec2& c);
TriangleShape triangle_shape(const Vec3& a, const Vec3& b, const Vec3& c);

Status triangle_shapes(Span<const Vec3> positions, Span<const uint32_t> triangles,
                       Array<TriangleShape>* shapes);

// A third of the area of the triangles round each vertex.
void barycentric_areas(Span<const uint32_t> triangles, Span<const TriangleShape> shapes,
                       Span<double> areas);

// Voronoi areas, with those of obtuse triangles replaced by halves and quarters so that they stay
// positive and add up to the area of the mesh.
Status mixed_voronoi_areas(Context& context, Span<const uint32_t> triangles,
                           Span<const TriangleShape> shapes, Span<double> areas);

// What each corner of a triangle adds to those.
struct CornerAreas {
  double at[3];
};
CornerAreas mixed_voronoi_shares(const TriangleShape& shape);

// The symmetric matrix Ls of integrated Laplacians, both halves stored: (Ls f)_i is the sum over
// the neighbours of (cot a + cot b) / 2 (f_j - f_i); negative semidefinite where the angles
// opposite to every edge add up to less than pi.
Status cotangent_laplacian(uint32_t vertices, Span<const uint32_t> triangles,
                           Span<const TriangleShape> shapes, sparse::Csc* laplacian);

}  // namespace wireskin::mesh
