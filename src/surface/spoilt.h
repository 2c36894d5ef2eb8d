// Patches that smoothing spoilt, of meshes that were sound before: they go back to what they were.
//
// What spreads linearly from the ends of a long tube falls off exponentially. The first four
// methods draw such a tube to a line, on which triangles end as needles that only rounding keeps
// apart; and the curvature that the paper's method takes from what is left of its radius blows it
// up to a million times its size. So a patch is spoilt where a triangle's height over its longest
// edge is less than k_least_height of that edge, and less than any was in the patch before, or
// where a vertex has gone farther than the diagonal of the whole. In and out: the mesh as smoothed;
// patches that are not spoilt keep it, bit for bit, but for soft curves that they share with one
// that went back. One pass where nothing is spoilt; else O(triangles) a round, mostly two.
#pragma once

#include "base/array.h"
#include "num/vec.h"

namespace wireskin {

struct SmoothedMesh {
  Span<Vec3> position;
  Span<uint32_t> triangle;
  Span<const uint32_t> patch;        // of each triangle
  Span<const Vec3> start;            // of each vertex, before the smoothing
  Span<const uint32_t> unturned;     // the triangles before; edges were flipped inside patches only
  Span<const uint32_t> origin = {};  // of each vertex, the same on all sides of a crease; or empty
};

struct Spoilt {
  Array<uint8_t> patch;     // of each patch; empty where none is spoilt
  uint32_t first = k_none;  // triangle that spoils one

  explicit Spoilt(Context& context) : patch(context) {}
};

Status find_spoilt(Context& context, const SmoothedMesh& mesh, uint32_t patches, Spoilt* spoilt);

// Of each of so many patches, whether it went back; empty where none had to.
Status put_back_spoilt(Context& context, const SmoothedMesh& mesh, uint32_t patches,
                       Array<uint8_t>* back);

}  // namespace wireskin
