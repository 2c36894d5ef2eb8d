// Faces of wireframes: where curves in one plane close a polygon or a ring, with nothing in it.
//
// In: the complex, the samples, the curves' edges, the walls of all rooms. Out: for each triangle
// whether it lies in such a face, and whether the face is a polygon: at least half of its border is
// straight, and has corners rather than bends. Found by flooding coplanar triangles of the walls
// from the largest one on; a set counts if at each of its edges off the curves it lies on both
// sides. O(triangles log triangles). Source: the rule is our own.
#pragma once

#include "flow/sheet.h"

namespace wireskin::flow {

enum class Flatness : uint8_t { none, plane, polygon };

Status find_flat_faces(Context& context, const Complex& complex, const Samples& samples,
                       const CurveEdges& curves, const Sheet& sheet, Array<Flatness>* flatness);

}  // namespace wireskin::flow
