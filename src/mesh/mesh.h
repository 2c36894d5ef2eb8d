// Triangle meshes: the plain arrays that the whole pipeline fills, their edge neighbours and the
// check that every result passes.
//
// Triangles are three vertex indices, counter-clockwise from outside. Half-edge 3 t + k runs from
// corner k of triangle t to corner k + 1. Its twin is the half-edge that runs the other way, k_none
// on an open border. Everything is O(vertices + triangles), whatever the valences.
#pragma once

#include "base/array.h"
#include "num/vec.h"

namespace wireskin::mesh {

// Half-edge arithmetic.
inline uint32_t next_half_edge(uint32_t h) {
  return h % 3 == 2 ? h - 2 : h + 1;
}
inline uint32_t previous_half_edge(uint32_t h) {
  return h % 3 == 0 ? h + 2 : h - 1;
}

// Finds the twin of every half-edge. Fails with bad_mesh, naming the triangle, where an index is
// out of range, a triangle repeats a vertex, or two triangles have the same half-edge (an edge of
// three triangles, or neighbours of opposite orientation).
Status find_twins(uint32_t vertices, Span<const uint32_t> triangles, Array<uint32_t>* twins);

struct Topology {
  uint32_t edges = 0;
  uint32_t components = 0;  // of vertices joined by edges
  uint32_t boundary_loops = 0;
  int32_t euler_characteristic = 0;
  Array<uint8_t> on_border;   // per vertex
  Array<uint32_t> component;  // per vertex, numbered by least vertex

  explicit Topology(Context& context) : on_border(context), component(context) {}
};

// Counts, and checks that the mesh is an oriented manifold with border: the triangles round every
// vertex form one fan. Fails with bad_mesh and the vertex. A vertex without triangle fails too.
Status find_topology(uint32_t vertices, Span<const uint32_t> triangles, Span<const uint32_t> twins,
                     Topology* topology);

// Fails with bad_mesh and the triangle where one has no area.
Status check_areas(Context& context, Span<const Vec3> positions, Span<const uint32_t> triangles);

// The triangles round each vertex: those of v are corner[start[v] .. start[v + 1]), as half-edges
// that leave v, in ascending order.
Status find_corners(uint32_t vertices, Span<const uint32_t> triangles, Array<uint32_t>* start,
                    Array<uint32_t>* corner);

// The least angle of all triangles, in degrees.
Status least_angle(Context& context, Span<const Vec3> positions, Span<const uint32_t> triangles,
                   double* degrees);

// For each vertex the patch of one of its triangles, given the patch of each triangle.
Status patches_of_vertices(Context& context, Span<const uint32_t> triangles,
                           Span<const uint32_t> patch, Span<uint32_t> result);

}  // namespace wireskin::mesh
