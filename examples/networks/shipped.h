// The networks of examples/data: what make_networks writes and the tests compare with the files.
#pragma once

#include <string>

#include "cut.h"
#include "network.h"

namespace networks {

struct Shipped {
  std::string file;
  Network network;
};

// Those on surfaces of closed form.
std::vector<Shipped> shipped_closed_forms();

// Keenan Crane's cow `spot`, cut by the planes chosen in the source.
Shipped shipped_spot(const Mesh& spot);

}  // namespace networks
