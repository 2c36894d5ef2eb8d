// Walls that no curve holds: they cross a room in mid-air, where growing balls happen to meet, and
// end on other walls. A person sees the room go on, however narrow it is there.
//
// In: the complex, the samples, the curves' edges. Out: the flat faces; the persistence of the
// complex with the loose walls passed before all others (persistence.h), which joins the rooms that
// they part; for each triangle whether it lies in one. All rooms are cut out. A wall is loose if it
// ends in the middle of flat faces along a quarter of its border, or, with rooms on both sides or
// none, on walls of any shape along nearly all of it; where three or more meet off the curves, the
// two that continue each other most evenly do not end. What is passed first changes what closes the
// other rooms, so this repeats, eight rounds at most. Near-linear a round. The rule is our own.
#pragma once

#include "flow/flat_faces.h"
#include "flow/persistence.h"
#include "flow/sheet.h"

namespace wireskin::flow {

Status find_persistence_of_faces(Context& context, const Complex& complex, const Samples& samples,
                                 const CurveEdges& curves, Array<Flatness>* flatness,
                                 Persistence* persistence, Array<uint8_t>* loose);

}  // namespace wireskin::flow
