// Straight pieces of the network: arcs that are, and lines that several of them make in a row.
//
// In: the samples and their complex. Out: for each arc its line, if it is straight; for each line
// its arcs, for each vertex its lines. Arcs that meet at a node are in one line if they go on there
// without a bend that could be seen. With these the complex's edges that run along a line over
// several samples are known, and triangles that all of whose corners lie on one: where everything
// is flat, as on the hull, there are such. Near-linear; quadratic in the straight arcs of a node.
#pragma once

#include "flow/curve_edges.h"

namespace wireskin::flow {

struct StraightLines {
  Array<uint32_t> line_of;         // of each arc, or k_none
  Array<uint32_t> arc_start, arc;  // of each line
  Array<uint32_t> start, line;     // of each vertex of the complex; some more than once

  explicit StraightLines(Context& context)
      : line_of(context), arc_start(context), arc(context), start(context), line(context) {}
  bool is_straight(uint32_t a) const { return line_of[a] != k_none; }
  // A line through all of them, or k_none.
  uint32_t common(uint32_t u, uint32_t v) const;
  uint32_t common(uint32_t u, uint32_t v, uint32_t w) const;
};

// The complex with what is known in it of the curves.
struct Drawing {
  const Complex& complex;
  const Samples& samples;
  const CurveEdges& curves;
  const StraightLines& lines;
};

Status find_straight_lines(const Complex& complex, const Samples& samples, StraightLines* lines);

}  // namespace wireskin::flow
