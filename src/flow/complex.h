// The Delaunay complex of a point set with its radius function: tetrahedra, triangles and edges
// with all incidences, and on each the squared radius at which growing balls round the points
// swallow it. Everything that the reconstruction does later is combinatorics on these arrays.
//
// In: points; they are jittered first (jitter.h), so that exact ties, which plain doubles would
// decide at random, are rare. Out: `Complex`, the same for any order of the points but for their
// numbers. Values are monotone by construction for any rounding error (edge <= triangle <=
// tetrahedron): a simplex that is swallowed together with a larger one has a copy of its bits.
// Cost: that of Delaunay (delaunay.h), then linear; about 190 bytes a tetrahedron, twice that while
// it is built.
// Source: B. Sadri, K. Singh, "Flow-Complex-Based Shape Reconstruction from 3D Curves", 2014; U.
// Bauer, H. Edelsbrunner, "The Morse Theory of Cech and Delaunay Complexes", 2017.
#pragma once

#include "base/array.h"
#include "num/vec.h"

namespace wireskin::flow {

struct ComplexOptions {
  double jitter = 1e-7;          // of the diagonal of the bounding box; 0: the points as they are
  uint64_t seed = 0;             // another draw of the jitter
  uint32_t most_tets = 2000000;  // more is the status `too_large`
};

// Local numbering: neighbour, triangle and edge number i lie opposite to vertex number i. "Outside"
// is the side k_none, whose value is +infinity (see tet_value_of).
struct Complex {
  explicit Complex(Context& context)
      : point(context),
        same_as(context),
        tet(context),
        tet_neighbour(context),
        tet_triangle(context),
        triangle(context),
        triangle_side(context),
        triangle_edge(context),
        edge(context),
        edge_first(context),
        edge_triangle_first(context),
        edge_triangle(context),
        tet_value(context),
        triangle_value(context),
        edge_value(context),
        triangle_gabriel(context),
        edge_gabriel(context) {}

  double diagonal = 0.0;    // of the bounding box of the points as they came
  Array<Vec3> point;        // jittered; numbers are those of the input
  Array<uint32_t> same_as;  // for each point the least number of a point at the same place; only
                            // that one appears in the complex

  Array<uint32_t> tet;            // 4 vertices each; det(b - a, c - a, d - a) > 0
  Array<uint32_t> tet_neighbour;  // 4 each, across the face opposite to the vertex, or k_none
  Array<uint32_t> tet_triangle;   // 4 each, likewise

  Array<uint32_t> triangle;  // 3 vertices each, counter-clockwise seen from its second side
  Array<uint32_t>
      triangle_side;  // 2 tetrahedra each; the first is never k_none where there are any
  Array<uint32_t> triangle_edge;  // 3 each, opposite to the vertex

  Array<uint32_t> edge;                 // 2 vertices each, the lesser first; in lexicographic order
  Array<uint32_t> edge_first;           // for vertex v, its edges to greater vertices: [v] .. [v+1]
  Array<uint32_t> edge_triangle_first;  // for edge e, its triangles are edge_triangle[[e] .. [e+1]]
  Array<uint32_t> edge_triangle;

  Array<double> tet_value;       // squared circumradius: F
  Array<double> triangle_value;  // squared radius at which it is swallowed: f
  Array<double> edge_value;      // likewise
  // Gabriel: no point of the link lies inside the smallest circumscribed ball.
  Array<uint8_t> triangle_gabriel;
  Array<uint8_t> edge_gabriel;

  uint32_t tet_count() const { return static_cast<uint32_t>(tet_value.size()); }
  uint32_t triangle_count() const { return static_cast<uint32_t>(triangle_value.size()); }
  uint32_t edge_count() const { return static_cast<uint32_t>(edge_value.size()); }

  // F, infinite for the outside.
  double tet_value_of(uint32_t t) const;
  // The tetrahedron on one side of a triangle, or their number for the outside.
  uint32_t side_of(uint32_t t, uint32_t side) const {
    const uint32_t at = triangle_side[2 * size_t{t} + side];
    return at == k_none ? tet_count() : at;
  }
  Span<const uint32_t> triangles_of(uint32_t e) const {
    return edge_triangle.span().part(edge_triangle_first[e],
                                     edge_triangle_first[e + 1] - edge_triangle_first[e]);
  }
};

// Fewer than four different points give a complex without tetrahedra: three points one triangle
// with the outside on both sides, two an edge. Points that span no volume even after the jitter are
// the status `bad_argument`, as are coordinates that are not finite or beyond 2^150.
Status build_complex(Context& context, Span<const Vec3> points, const ComplexOptions& options,
                     Complex* complex);

// The edge between two points (by their numbers in same_as), or k_none.
uint32_t find_edge(const Complex& complex, uint32_t u, uint32_t v);

// Along the normal of a triangle, twice its area.
Vec3 cross_of_triangle(const Complex& complex, uint32_t t);

}  // namespace wireskin::flow
