// Lids: flat faces that only curved walls go on from, as the ends of cans and cones.
//
// In: the flat faces, their rims and states. Out: states that follow from the walls that curves
// show: a curve that leaves a face's rim to one side has a wall there. A curve is where two sheets
// meet: a face that would be the third all round its rim is a section of the body and goes; a disc
// that is the second all round is a lid and stays, if asked for. Straight curves that run on
// through the plane of a polygon need it, as nothing else is drawn there. O(curves at a node) for
// each arc of a rim. The rule is our own; curves as creases of two faces: G. Markowsky, M. A.
// Wesley, "Fleshing Out Wire Frames", 1980.
#pragma once

#include "flow/face_rims.h"

namespace wireskin::flow {

// Which lids stay: that of a net of curves that has no other, so that a cone is whole and a tube is
// as open as its balls make it; all; none.
enum class Lids : uint8_t { single, all, none };

// `lids`: the faces that are lids, whether they were to stay or not.
Status find_lids(Context& context, const Drawing& drawing, const FlatFaces& faces, Lids which,
                 FaceRims* rims, Array<uint32_t>* lids);

}  // namespace wireskin::flow
