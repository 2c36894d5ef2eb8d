// Which boxes meet a box: a balanced tree, in which each node has the box of all below it.
//
// In: boxes with edges along the axes, which the tree refers to. A node's boxes are halved at the
// median of their centres along the axis in which these spread most (J. L. Bentley,
// "Multidimensional binary search trees used for associative searching", 1975), so neither the
// sizes of the boxes nor one far out decide how good the tree is, as they would of a grid.
// O(n log n) to build; a search costs the depth and what is near.
#pragma once

#include "base/array.h"
#include "num/vec.h"

namespace wireskin::network {

struct Box {
  Vec3 low, high;
};

class BoxTree {
 public:
  explicit BoxTree(Context& context) : order_(context), node_(context) {}

  Status build(Span<const Box> boxes);

  // The boxes of a greater index than `after` that meet `box`, ascending.
  Status find(const Box& box, uint32_t after, Array<uint32_t>* found) const;

 private:
  Status bound(uint32_t first, uint32_t count, Box* box) const;
  Status halve(uint32_t first, uint32_t count);

  Span<const Box> boxes_;
  Array<uint32_t> order_;  // the boxes of a node are a range of this
  Array<Box> node_;        // the children of node k are 2 k + 1 and 2 k + 2
};

}  // namespace wireskin::network
