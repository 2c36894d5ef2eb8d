// Arcs joined again to the curves that a hand drew, for whoever looks at curves as a whole: through
// points where two arcs end, and through junctions along the straightest way on of the same curve.
//
// In: arcs. Out: chains as paths over their vertices, every arc in one of them; and the places
// where a chain has a corner, which no smoothing may round. A corner turns by more than 35 degrees,
// and by more than noise explains: by 4.7 standard deviations, of the noise stated or of that which
// the quietest quarter of the samples shows, seen from its neighbours or from three samples away. A
// chain of which three quarters of the samples turn so sharply is a polygon, all corners, unless
// the noise is stated or the chain leaves its plane all the time. O(samples log samples). Source:
// B. Sadri, K. Singh, "Flow-Complex-Based Shape Reconstruction from 3D Curves", 2014, section 4.1
// (arcs end at corners); the rule is our own.
#pragma once

#include "flow/arcs.h"

namespace wireskin::flow {

struct Chains {
  Array<uint32_t> start;   // chain c has the places start[c] .. start[c + 1)
  Array<uint32_t> vertex;  // of Arcs, of each place; a closed chain does not repeat its first
  Array<uint8_t> corner;   // of each place
  Array<uint8_t> closed;   // of each chain
  // Where the path of each arc begins among the places, or ends if the chain runs against it.
  Array<uint32_t> arc_place;
  Array<uint8_t> arc_backward;

  explicit Chains(Context& context)
      : start(context),
        vertex(context),
        corner(context),
        closed(context),
        arc_place(context),
        arc_backward(context) {}
  uint32_t size() const { return start.empty() ? 0 : static_cast<uint32_t>(start.size() - 1); }
};

// `noise`: the standard deviation of a coordinate; 0: not known.
Status find_chains(Context& context, const Arcs& arcs, double noise, Chains* chains);

}  // namespace wireskin::flow
