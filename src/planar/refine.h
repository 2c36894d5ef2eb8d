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

// Where sizes grow inward, and where they shrink. Each row of a graded layer has fewer points than
// the row before, and irregular vertices make up for that: beside a fine border, where most of the
// triangles are, a growth of 0.25 leaves the median of their least angles under 50 degrees. From
// half the spacing on, sizes grow faster: the triangles there are few, and the accuracy of
// curvature prefers it.
inline constexpr double k_size_growth_fine = 0.2;
inline constexpr double k_size_growth = 0.25;
inline constexpr double k_fine_size = 0.5;  // in spacings
inline constexpr double k_size_descent = 0.25;

Status refine(Triangulation* t, Array<double>* sizes, double spacing, size_t most_vertices);

}  // namespace wireskin::planar
