// Raw curves strung as beads, for tests of what snapping is made of.
#pragma once

#include "network/beads.h"
#include "support/wire_nets.h"

namespace unit {

struct StrungBeads : WireNet {
  wireskin::network::Beads beads{wires};

  void string(size_t joints) {
    weld();
    must(curve_of_samples(wires, &beads.curve));
    must(beads.string_samples(joints));
  }
};

}  // namespace unit
