// Raw curves as owned arrays, what wsk_connect makes of them, and the sketches' reader.
#pragma once

#include <doctest/doctest.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "network.h"
#include "wireskin.h"

namespace raw {

struct Curve {
  std::vector<double> positions, normals;  // normals may be empty
  std::vector<uint32_t> nodes;
  bool closed = false, boundary = false;

  size_t size() const { return nodes.size(); }
};
using Curves = std::vector<Curve>;

// They point into `curves`.
std::vector<wsk_curve> views_of(const Curves& curves);

struct Free {
  void operator()(wsk_network* network) const { wsk_network_free(network); }
};
using Network = std::unique_ptr<wsk_network, Free>;

// Null, with a failed check, where it fails.
Network connect(const Curves& curves, double snap = 0.0, wsk_chain chain = WSK_CHAIN_AUTO,
                bool orient = false);
wsk_network_view view_of(const Network& network);

// The curves of an OBJ file (v and l only) without normals; node numbers are vertex indices.
Curves read_obj_curves(const std::string& path);

// The curves of a network of examples/networks with vertex indices as numbers.
Curves curves_of(const networks::Network& network);

// Whether the view has the same curves bit for bit: positions, and normals where there are any.
bool same_curves(const Curves& curves, const wsk_network_view& view);

}  // namespace raw
