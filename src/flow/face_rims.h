// Which flat faces lie at each arc of the curves, and what is wrong with that.
//
// In: the flat faces. Out: for each arc its places in the faces' rims; for a set of the faces how
// many of them an arc has, and whether they are two in one plane, where nothing is left to draw a
// curve for. Linear. Source: a curve as the crease of two faces: G. Markowsky, M. A. Wesley,
// "Fleshing Out Wire Frames", 1980.
#pragma once

#include "flow/flat_faces.h"

namespace wireskin::flow {

// Inner: of no use; parting: two cells lie on its sides; dangling: not two, as a wall is missing;
// hole: in a face, open to a wall.
enum class FaceState : uint8_t { inner, parting, dangling, hole };

struct FaceRims {
  Array<uint32_t> start, rim;  // arc a: places rim[start[a]] .. rim[start[a + 1] - 1]
  Array<uint32_t> face;        // of each place
  Array<FaceState> state;      // of each face

  explicit FaceRims(Context& context)
      : start(context), rim(context), face(context), state(context) {}
  bool stays(uint32_t f) const {
    return state[f] == FaceState::parting || state[f] == FaceState::dangling;
  }
  uint32_t arc_count() const { return static_cast<uint32_t>(start.size() - 1); }
};

Status link_rims(const FlatFaces& faces, uint32_t arcs, FaceRims* rims);

struct CurveFault {
  uint32_t faces;
  bool flat;  // the two faces there are
};

// Two faces at a curve, by their places, that lie in one plane on both sides of it.
bool continue_flat(const FlatFaces& faces, const StraightLines& lines, const FaceRims& rims,
                   uint32_t i, uint32_t k);

// How many of the first faces of an arc count, and whether they are two that are flat.
template <typename Counts>
CurveFault fault_of(const FlatFaces& faces, const StraightLines& lines, const FaceRims& rims,
                    uint32_t arc, uint32_t first_faces, const Counts& counts) {
  CurveFault fault = {0, false};
  uint32_t at[2] = {};
  for (uint32_t i = rims.start[arc]; i < rims.start[arc] + first_faces; ++i) {
    const uint32_t rim = rims.rim[i];
    if (!counts(rims.face[rim])) continue;
    if (fault.faces < 2) at[fault.faces] = rim;
    ++fault.faces;
  }
  fault.flat = fault.faces == 2 && continue_flat(faces, lines, rims, at[0], at[1]);
  return fault;
}

template <typename Counts>
CurveFault fault_of(const FlatFaces& faces, const StraightLines& lines, const FaceRims& rims,
                    uint32_t arc, const Counts& counts) {
  return fault_of(faces, lines, rims, arc, rims.start[arc + 1] - rims.start[arc], counts);
}

}  // namespace wireskin::flow
