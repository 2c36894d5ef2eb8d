// Fills the inside of a triangulated polygon with points, front by front from the border: a
// triangle that is too large gets a point at the ideal place above one of its edges that is
// finished, limited to that edge's Voronoi edge, so no other visible vertex is nearer to the point
// than the edge's ends.
//
// In: a triangulation with closed constraints and its outside marked; `sizes`, the wished edge
// length at each vertex. Out: more vertices, each with its size, which drifts from that of the
// border to `spacing` by a part of the length of each step inward. Constraints are
// never split; a point too near to one is left out. Ends after at most `most_vertices`,
// or when too much work was in vain.
// Cost: O(1) a point on average, a queue entry a triangle.
// Source: S. Rebay, "Efficient Unstructured Mesh Generation by Means of Delaunay Triangulation and
// Bowyer-Watson Algorithm", 1993; L. P. Chew, "Guaranteed-Quality Mesh Generation for Curved
// Surfaces", 1993 (protecting the border by lenses).
#pragma once

#include "planar/constrained_delaunay.h"

namespace wireskin::planar {

// Where sizes grow inward, and where they shrink. A growth of 0.18 gives better angles beside very
// fine borders, but the coarser insides cost accuracy of curvature.
inline constexpr double k_size_growth = 0.25;
inline constexpr double k_size_descent = 0.25;

Status refine(Triangulation* t, Array<double>* sizes, double spacing, size_t most_vertices);

}  // namespace wireskin::planar
