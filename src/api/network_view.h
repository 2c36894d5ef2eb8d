// Networks as the caller sees them: one block of his memory with the curves as wsk_build takes
// them, where each sample came from, and what was joined. Joints without a number of his get fresh
// ones.
#pragma once

#include "api/view.h"
#include "network/connect.h"

struct wsk_network {
  wireskin::Allocator allocator;
  size_t bytes;
  wsk_network_view view;
  uint32_t least_fresh, most_fresh;  // node numbers that are not the caller's
};

namespace wireskin::api {

// `given`: the caller's curves, to which normals that did not change go back; null where there are
// none to compare with.
Status make_network(Context& context, const network::Wires& wires,
                    const network::ConnectResult& result, int exponent, const wsk_curve* given,
                    wsk_network** out);

}  // namespace wireskin::api
