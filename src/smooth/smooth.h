// Positions of the free vertices from positions and normals on the curves: the method of the paper
// and those it is compared with, all by linear solves.
//
// In: a mesh with the shape of each triangle in the metric to smooth in (each patch's plane, or
// space), held vertices with positions and unit normals. Out: all positions, the propagated normals
// (unit, for the methods that use them) and the residual of the last solve. The paper's method
// propagates normals N and positions V biharmonically, takes from them the mean curvature h of
// formula (1), and finds the positions whose Laplacian fits -2 h N best: one matrix K = L M^-1 L,
// factored once, for all three. Source: T. Stanko et al., "Surfacing Curve Networks with Normal
// Control", 2016, sections 3.4 and 4.2.
#pragma once

#include "mesh/operators.h"
#include "smooth/soft.h"
#include "smooth/system.h"

namespace wireskin::smooth {

enum class Method {
  stanko = 0,
  biharmonic = 1,
  triharmonic = 2,
  clamped = 3,
  iterated = 4,
  fair = 5
};

enum class Metric { planes, space };

struct Domain {
  Span<const uint32_t> triangle;
  Span<const mesh::TriangleShape> shape;  // of each triangle
  Span<const uint8_t> on_curve;           // of each vertex; those of open borders are
  Span<const uint8_t> held;               // of each vertex: on a curve and not soft
  Span<const uint8_t> on_border;          // of each vertex
  Metric metric = Metric::planes;
  Soft soft = {};
  // Held vertices on open borders whose normal is not known (any value): that of the surface as far
  // as it is found stands for it. Empty: none.
  Span<const uint8_t> bare = {};
  Places places = {};  // for the order of elimination
  // Given back once `shape`, its view, has been read.
  Array<mesh::TriangleShape>* spent = nullptr;
};

// Position and normal of every vertex: in, those of the held ones; out, all.
struct Field {
  Span<Vec3> position;
  Span<Vec3> normal;
};

Status smooth(Context& context, const Domain& domain, Method method, const Field& field,
              double* residual);

}  // namespace wireskin::smooth
