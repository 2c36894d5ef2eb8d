// From the caller's curves to arcs: stretches of polyline without a junction or corner inside.
//
// In: curves as polylines, open or closed, that meet where samples carry the same node number or
// coincide (within k_coincidence of the extent); a curve of one sample is a point. Out: the
// vertices (each point once), the arcs as paths over them, which of them are nodes (arcs end
// there), the caller's curve of every segment. A segment given twice counts once, for the first
// curve. Nodes are vertices of degree other than two, or where the polyline turns by more than 35
// degrees; a closed curve without node is one closed arc. O(samples log samples). Source: B. Sadri,
// K. Singh, "Flow-Complex-Based Shape Reconstruction from 3D Curves", 2014, section 4.1.
#pragma once

#include "base/array.h"
#include "num/vec.h"

namespace wireskin::flow {

inline constexpr double k_coincidence = 1e-9;
// Polylines have a corner where they turn by more than this: 35 degrees.
inline constexpr double k_cos_corner = 0.8191520442889918;

// All curves one after the other; curve c has the samples start[c] .. start[c + 1).
struct Polylines {
  Span<const uint32_t> start;
  Span<const Vec3> position;
  Span<const uint32_t> number;  // node numbers, k_none for ordinary samples
  Span<const uint8_t> closed;   // of each curve
};

struct Arcs {
  double diagonal = 0.0;          // of the bounding box
  uint32_t given = 0;             // vertices that are samples; bend_arcs adds others behind them
  Array<Vec3> vertex;             // the points
  Array<uint32_t> sample_vertex;  // of each of the caller's samples
  Array<uint32_t> start;        // arc a is path[start[a] .. start[a + 1]), closed: first again last
  Array<uint32_t> path;         // vertices
  Array<uint32_t> curve;        // caller's curve of the segment from path[i] to path[i + 1]
  Array<double> along;          // arc length from the arc's begin to path[i]
  Array<uint8_t> closed;        // of each arc: without node
  Array<uint8_t> is_node;       // of each vertex
  Array<uint32_t> point;        // vertices without segment
  Array<uint32_t> point_curve;  // their curves

  explicit Arcs(Context& context)
      : vertex(context),
        sample_vertex(context),
        start(context),
        path(context),
        curve(context),
        along(context),
        closed(context),
        is_node(context),
        point(context),
        point_curve(context) {}
  uint32_t size() const { return start.empty() ? 0 : static_cast<uint32_t>(start.size() - 1); }
  double length_of(uint32_t arc) const { return along[start[arc + 1] - 1]; }
};

// Fails with node_mismatch where samples of one node lie apart.
Status find_arcs(Context& context, const Polylines& curves, Arcs* arcs);

}  // namespace wireskin::flow
