// A constrained Delaunay triangulation that grows: points and constraint edges are added one at a
// time, and after each call every triangle's circumcircle is empty of the points visible from it.
//
// The triangulated region is a box wider than all points, so there is no special case at a hull;
// its corners are the vertices 0 to 3. A constraint that would cross another one or touch a point,
// and a point on a constraint, are refused with patch_folded and leave the triangulation as it
// was; after any other failure it is of no more use. All decisions are exact. Edges are named by
// half-edges: 4 * triangle + corner, from that corner to the next one counter-clockwise.
// Cost: a point costs its walk and its cavity, both O(1) on average for points in the order of
// insertion_order.h; a constraint costs about k log k for k crossed triangles (cavity_side.h) and
// the smaller of the degrees of its ends.
// Sources: A. Bowyer, "Computing Dirichlet Tessellations", 1981, D. F. Watson, "Computing the
// n-Dimensional Delaunay Tessellation", 1981 (insertion); M. V. Anglada, "An Improved Incremental
// Algorithm for Constructing Restricted Delaunay Triangulations", 1997 (constraints).
#pragma once

#include "base/array.h"
#include "num/vec.h"

namespace wireskin::planar {

inline constexpr uint32_t k_box_corners = 4;
inline constexpr uint32_t k_most_vertices = 1u << 28;

// Bits of Triangle::flags beside the three constraint bits.
inline constexpr uint32_t k_outside = 8;
inline constexpr uint32_t k_coarse = 16;  // refine: larger than wished
inline constexpr uint32_t k_queued = 32;  // refine: this slot waits in the queue
inline constexpr uint32_t k_border = 64;  // shifted by i: edge i divides inside from outside

struct Triangle {
  uint32_t vertex[3];  // counter-clockwise
  uint32_t twin[3];    // the half-edge on the other side of edge i; k_none at the rim of the box
  uint32_t flags;      // bit i: edge i is a constraint; the others see above
  uint32_t mark;       // scratch of recover_edge
};

// One edge of a cavity's outline, as seen from inside: the vertex it starts from and what lies
// beyond.
struct CavityEdge {
  uint32_t vertex;
  uint32_t beyond;
  uint32_t bits;  // of Triangle::flags, as if it were edge 0: 1 and k_border
};

inline constexpr uint32_t k_edge_bits = 1 | k_border;

struct Triangulation {
  explicit Triangulation(Context& context)
      : points(context),
        triangles(context),
        leaving(context),
        outline(context),
        cavity(context),
        stack(context),
        chain(context) {}

  Array<Vec2> points;
  Array<Triangle> triangles;
  Array<uint32_t> leaving;  // of each vertex, one half-edge that starts there
  uint32_t hint = 0;        // a triangle near the last change, where walks begin
  uint32_t dice = 1;        // keeps walks from running in circles, the same in every run

  // Why recover_edge refused: the vertex in the way, or else the constraint.
  uint32_t touched = k_none;
  uint32_t crossed = k_none;

  // Scratch: the outline and triangles of the present cavity, a stack, the two sides of a
  // constraint.
  Array<CavityEdge> outline;
  Array<uint32_t> cavity;
  Array<uint32_t> stack;
  Array<CavityEdge> chain;

  uint32_t start(uint32_t h) const { return triangles[h >> 2].vertex[h & 3]; }
  uint32_t end(uint32_t h) const { return start(next(h)); }
  uint32_t apex(uint32_t h) const { return start(previous(h)); }
  uint32_t twin(uint32_t h) const { return triangles[h >> 2].twin[h & 3]; }
  bool constrained(uint32_t h) const { return (triangles[h >> 2].flags >> (h & 3) & 1) != 0; }
  uint32_t edge_bits(uint32_t h) const { return triangles[h >> 2].flags >> (h & 3) & k_edge_bits; }
  static uint32_t next(uint32_t h) { return (h & 3) == 2 ? h - 2 : h + 1; }
  static uint32_t previous(uint32_t h) { return (h & 3) == 0 ? h + 2 : h - 1; }
  // The next half-edge counter-clockwise round the start of h; k_none beyond the rim.
  uint32_t turn(uint32_t h) const { return twin(previous(h)); }
};

enum class Where : uint8_t { inside, on_edge, on_vertex, hidden };

// For `inside` any half-edge of the triangle, for `on_edge` that edge, for `on_vertex` one from the
// vertex, for `hidden` the constraint in the way.
struct Location {
  Where where;
  uint32_t edge;
};

// Two triangles that fill a box well beyond `points`, whose coordinates are finite and in the range
// of predicates.h. Later points must lie in the points' own bounding box.
Status begin_box(Span<const Vec2> points, Triangulation* t);

// Finds p by walking from `triangle`. With stop_at_constraints, walks only through what the first
// triangle can reach without crossing a constraint, and may report a reachable point as hidden.
Location locate(Triangulation* t, const Vec2& p, uint32_t triangle, bool stop_at_constraints);

// Collects in t->cavity and t->outline the triangles that p would replace, without changing any.
Status collect_cavity(Triangulation* t, const Vec2& p, uint32_t triangle);

// Replaces the collected cavity by the triangles round the new vertex p, which share one vertex.
Status fill_cavity(Triangulation* t, const Vec2& p);

// Makes h and g, or h and the rim, each other's twins.
inline void link(Triangulation* t, uint32_t h, uint32_t g) {
  t->triangles[h >> 2].twin[h & 3] = g;
  if (g != k_none) t->triangles[g >> 2].twin[g & 3] = h;
}

// Adds p as the next vertex.
Status insert_point(Triangulation* t, const Vec2& p);

// Makes the segment between different vertices a and b an edge and a constraint. Neither is a box
// corner. An edge that is called `border` an odd number of times divides inside from outside.
Status recover_edge(Triangulation* t, uint32_t a, uint32_t b, bool border = true);

// Turns edge h, whose two triangles form a convex quadrilateral, into the other diagonal.
void flip(Triangulation* t, uint32_t h);

// Sets k_outside on every triangle between which and the rim lies an even number of border edges.
// The border is closed: every vertex has an even number of edges that divide.
Status mark_outside(Triangulation* t);

}  // namespace wireskin::planar
