// On which patch's surface a piece of the network lies that no patch encloses in a plane: the
// surface is guessed from the border alone, coarsely (network/patch_in_space.h).
//
// In: borders, then pieces as vertices. Out: for each piece the patch that it is nearest to, if it
// lies beside that surface nowhere: each vertex projects to its inside, no farther off than a share
// of the root of its area, and normals agree in the mean. O(patches + pieces times triangles of
// patches whose boxes they meet). Source: the rule is our own.
#pragma once

#include "network/border.h"

namespace wireskin::network {

// A guess of one patch; `number` is twice the patch's, or one more for the other side of a ring.
struct PatchGuess {
  uint32_t number;
  uint32_t first_vertex, first_triangle, triangles;
  uint32_t rim;  // vertices on the border
  double size;   // the square root of the area
  Vec3 low, high;
};

struct PatchGuesses {
  Array<PatchGuess> patch;
  Array<Vec3> position;
  Array<uint32_t> triangle;  // within the patch's own vertices

  explicit PatchGuesses(Context& context) : patch(context), position(context), triangle(context) {}
};

// A border without a surface in space adds nothing.
Status add_guess(const Border& border, uint32_t number, PatchGuesses* guesses);

struct Piece {
  Span<const uint32_t> vertex;
  double farthest;      // as a share of the patch's size
  double least_facing;  // mean cosine, where normals are known
  uint32_t but;         // patches 2 p and 2 p + 1 do not count, p being this; or k_none
};

// The place of the nearest patch in guesses->patch, k_none where there is none.
uint32_t nearest_patch(const CurveVertices& vertices, const Piece& piece,
                       const PatchGuesses& guesses);

}  // namespace wireskin::network
