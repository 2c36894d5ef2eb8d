// Raw curves to a network, as one readable page: weld, chain, snap, chain again, normals.
//
// In: curves as given, scaled so that their extent is about one. Out: the same struct as a network
// whose joints are points, and what was done. A network that needs nothing comes out unchanged: the
// same curves, samples and normals, bit for bit, in the same order. Cost: sorting the samples, and
// that of snapping; the rest is linear. Sources: the steps are our own; those of what they use
// stand in network/approach.h, bend.h and orient.h.
#pragma once

#include "network/chain.h"
#include "network/fill_normals.h"
#include "network/snap.h"

namespace wireskin::network {

struct ConnectOptions {
  bool snap = true;
  double tolerance = 0.0;  // zero: automatic
  Chaining chaining = Chaining::automatic;
  double corner = 0.0;  // radians; zero: automatic
  bool orient = false;
};

struct ConnectResult {
  SnapResult snapping;
  Array<Contradiction> contradictions;
  WireCounts before, after;
  double tolerance = 0.0;
  FillCounts normals;
  uint32_t turned = 0;  // samples whose normals changed sign

  explicit ConnectResult(Context& context) : snapping(context), contradictions(context) {}
};

Status connect_wires(Context& context, const ConnectOptions& options, double diagonal, Wires* wires,
                     ConnectResult* result);

}  // namespace wireskin::network
