// Reads curve networks from files. Each reader takes the whole text and the file's name for
// messages, and throws a Failure that names the line of whatever is wrong.
//
// .net  T. Stanko's format: the number of vertices, a row x y z nx ny nz for each, the number of
//       curves, then for each a line 0 or 1 (1: the surface ends here) and a line of indices from
//       0.
// .obj  Wavefront: v, vn (the i-th belongs to the i-th v), l of any length; everything else is
//       passed over. Curves that stand under a g or o whose name contains "boundary" are boundary
//       curves, under one with "sharp" creases.
// In both a curve is closed if its last index repeats its first.
#pragma once

#include <string>
#include <string_view>

#include "network.h"

namespace wireskin_cli {

// The format follows from the extension, in upper or lower case.
Network read_network(const std::string& path);

Network read_net(const std::string& file, std::string_view text);
Network read_obj(const std::string& file, std::string_view text);

}  // namespace wireskin_cli
