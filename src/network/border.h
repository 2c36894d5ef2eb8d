// The border of a patch as vertices: its loops one after the other, with the normals of the patch's
// own side, and what lies inside it.
//
// In: network and curve vertices. Out: the vertices of each loop in order with the patch on the
// left. A loop begins at its least point, nodes before others, whatever the order and the direction
// in which the curves were given. At a node the normal is the mean of those of the two segments
// that meet there. O(border).
#pragma once

#include "network/resample.h"

namespace wireskin::network {

struct Border {
  Array<uint32_t> start;   // loop i has the vertices start[i] .. start[i + 1)
  Array<uint32_t> vertex;  // a vertex that loops pass twice stands here twice
  Array<Vec3> position;
  Array<Vec3> normal;  // zero where not known

  explicit Border(Context& context)
      : start(context), vertex(context), position(context), normal(context) {}
  uint32_t loops() const { return static_cast<uint32_t>(start.size() - 1); }
  uint32_t size() const { return static_cast<uint32_t>(vertex.size()); }
};

Status border_of_patch(const Network& network, const CurveVertices& vertices, uint32_t patch,
                       Border* border);

// The position along its loop after i, and before it.
uint32_t next_on_border(const Border& border, uint32_t loop, uint32_t i);

// Twice the vector area of the loops together.
Vec3 vector_area(const Border& border);

// The mean of the unit normals known, and the length of all loops.
Vec3 mean_normal(const Border& border);
double border_length(const Border& border);

}  // namespace wireskin::network
