// Faces in one plane that curves close, with no curve across them: polygons and discs.
//
// In: the complex, the samples, the curves' edges. Out: the faces, each with its triangles and the
// arcs that bound it. A polygon's border is straight for at least half of its length and has
// corners rather than bends. Found by flooding coplanar triangles of the complex from those at the
// curves, the largest first, not across curves; what has a border elsewhere is dropped. Where four
// samples lie on a circle the complex has flat tetrahedra, and a face all their triangles: several
// layers. Any cycle of curves counts, a face of the solid or a section of it (flat_cells.h tells).
// O(triangles log triangles), and for each in a face its lines and bends; past a bound on these
// there are no faces. The rule is our own; faces as cycles of a wireframe: G. Markowsky, M. A.
// Wesley, "Fleshing Out Wire Frames", 1980.
#pragma once

#include "flow/straight_lines.h"

namespace wireskin::flow {

inline constexpr double k_flat = 1e-3;         // of the diagonal, off the plane
inline constexpr double k_same_line = 0.9985;  // cosine of the angle that is none: 3 degrees

enum class FlatPart : uint8_t { none, disc, polygon, line };

// An arc that bounds a face, and the direction from it into the face.
struct FaceRim {
  uint32_t arc;
  Vec3 into;
};

struct FlatFaces {
  Array<uint32_t> start, triangle;  // of face f: triangle[start[f]] .. triangle[start[f + 1] - 1]
  Array<Vec3> normal;               // of each face
  Array<uint8_t> polygon;           // of each face: 0 for a disc
  Array<uint32_t> rim_start;
  Array<FaceRim> rim;     // of each face, an arc once
  Array<FlatPart> part;   // of each triangle; a line: its corners lie on one, so in no plane
  double flat = 0.0;      // a length: what was taken to lie in a plane
  bool given_up = false;  // too much to look at: there are none

  explicit FlatFaces(Context& context)
      : start(context),
        triangle(context),
        normal(context),
        polygon(context),
        rim_start(context),
        rim(context),
        part(context) {}
  uint32_t size() const { return static_cast<uint32_t>(normal.size()); }
};

// Of lines and samples looked at; who draws faces as dense as that gets none.
inline constexpr size_t k_most_face_work = size_t{1} << 26;

// `noise`: the standard deviation of the samples that was taken out, as corners have theirs still.
Status find_flat_faces(Context& context, const Drawing& drawing, double noise, FlatFaces* faces,
                       size_t most_work = k_most_face_work);

}  // namespace wireskin::flow
