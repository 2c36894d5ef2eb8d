// The kept samples of a network, one connected component after the other: curves that share a node
// are of one component, so that each can be looked at by itself.
//
// In: kept samples. Out: the same in an order of components (by their first curves), each a view
// like that of the whole network but with nodes counted within it. Positions and normals are not
// copied: what is written to a part is written to the network. O(samples).
#pragma once

#include "network/roughness.h"

namespace wireskin::network {

class KeptParts {
 public:
  explicit KeptParts(Context& context)
      : first_curve_(context),
        first_kept_(context),
        start_(context),
        kept_(context),
        kept_start_(context),
        node_(context),
        closed_(context) {}

  // `samples` must outlive the parts.
  Status split(const KeptSamples& samples);

  uint32_t count() const { return static_cast<uint32_t>(first_curve_.size() - 1); }
  KeptSamples part(uint32_t p) const;

 private:
  Status sort_curves(Array<uint32_t>* order);
  Status copy_curves(Span<const uint32_t> order);
  Status number_nodes();

  KeptSamples samples_ = {};
  Array<uint32_t> first_curve_, first_kept_;  // of each part, in the order of parts
  Array<uint32_t> start_, kept_;
  Array<uint32_t> kept_start_;  // counted from the part's first; one more for each part
  Array<uint32_t> node_;
  Array<uint8_t> closed_;
};

}  // namespace wireskin::network
