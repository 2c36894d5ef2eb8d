// The cycles round the outside of an open surface whose border no one tagged: taken for patches,
// they run clockwise round their own normals.
//
// In: fitted curves, nodes, network and vertices. Out: nodes and network without such patches, the
// curves there being boundary. A patch without which a curve would bound nothing is kept, and so is
// one that holds points: they fail later, with their place. One that holds curves fails here with
// open_network and names the first of them, but where faults are collected it fails later. Which
// side of a closed curve has the surface cannot be told for tubes and domes, whose normals stand
// across the vector area of their ends: those have to be tagged. O(border).
#pragma once

#include "network/resample.h"

namespace wireskin::network {

// `original`: of each patch that is left, its number before; empty where all are left. `faults`: of
// each segment, as from find_patches; cut down with the segments; may be empty.
Status drop_outsides(const curves::Curves& fitted, const CurveVertices& vertices,
                     Array<Node>* nodes, Network* network, Array<Status>* faults,
                     Array<uint32_t>* original);

}  // namespace wireskin::network
