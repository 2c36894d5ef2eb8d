// Network files: Stanko's .net and OBJ polylines, numbers in the shortest form that reads back to
// the same bits, whatever the locale.
//
// .net: number of vertices; a row x y z nx ny nz for each; number of curves; for each a line 0 or 1
// (boundary) and a line of zero-based vertex indices, closed when the last repeats the first.
// OBJ: v, vn (the i-th belongs to the i-th v) and one l a curve, boundary curves under g
// boundary_K.
#pragma once

#include <string>

#include "network.h"

namespace networks {

std::string to_net(const Network& network);
std::string to_obj(const Network& network);

// Reads back what the functions above write. Throw std::runtime_error.
Network from_net(const std::string& text);
Network from_obj(const std::string& text);

// By the ending of the path, .net or .obj. Throw std::runtime_error.
void write_network(const std::string& path, const Network& network);
Network read_network(const std::string& path);

}  // namespace networks
