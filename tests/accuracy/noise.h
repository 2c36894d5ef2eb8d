// Deterministic Gaussian noise on a network, for samples as a scanner would give them.
//
// Every vertex is moved by three normal deviates times `position`, and its normal turned by two
// times `degrees` about the tangents. Vertices are shared by the curves of a node, so these move
// together. The generator is splitmix64 (Steele, Lea, Flood, "Fast splittable pseudorandom number
// generators", 2014) with the Box-Muller transform.
#pragma once

#include "network.h"

namespace accuracy {

networks::Network with_noise(networks::Network network, double position, double degrees,
                             uint64_t seed = 1);

// Of the bounding box of all samples.
double diagonal(const networks::Network& network);

}  // namespace accuracy
