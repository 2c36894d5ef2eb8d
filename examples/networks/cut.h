// Cuts a triangle mesh by planes into a curve network: a model of measured data, with samples where
// the planes cross mesh edges and normals interpolated from the vertices.
//
// Where two planes' curves cross inside a triangle there is a node, one vertex of both. Curves are
// closed, or end on the border of an open mesh; border loops become boundary curves, split where
// they turn by more than 40 degrees. Which points a curve separates is decided once per mesh edge,
// so all triangles agree whatever the rounding. A vertex within 1e-9 of the diagonal of a plane
// counts as that far above it. Cost: O(planes * triangles * log).
#pragma once

#include <string>

#include "network.h"

namespace networks {

struct Mesh {
  std::vector<Point> positions;
  std::vector<std::array<uint32_t, 3>> triangles;
};

// The points with dot(normal, p) = offset.
struct Plane {
  Point normal;
  double offset;
};

// `v` and `f` lines of an OBJ file; polygons become fans. Throws std::runtime_error.
Mesh read_obj(const std::string& path);

// An OFF file without comments; polygons become fans. Throws std::runtime_error.
Mesh read_off(const std::string& path);

// Angle-weighted (Thuermer, Wuethrich, "Computing vertex normals from polygonal facets", 1998).
std::vector<Point> vertex_normals(const Mesh& mesh);

// Samples nearer than thin * (mean spacing of their curve) to the last one kept, or to the next
// node, are left out; nodes stay. Throws std::runtime_error where the mesh is no oriented manifold.
Network cut(const Mesh& mesh, const std::vector<Plane>& planes, double thin = 0.25);

}  // namespace networks
