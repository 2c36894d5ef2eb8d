#include "network/snap_walk.h"

#include "base/in_parts.h"

namespace wireskin::network {

Status count_walks(const Wires& wires, double reach, Array<uint32_t>* walk) {
  TRY(assign_in_parts(wires.samples(), 0, walk));
  Pace pace(wires.position.context());
  for (uint32_t c = 0; c < wires.curves(); ++c) {
    const uint32_t end = wires.start[c + 1];
    uint32_t first = wires.start[c];  // within reach of i
    double arc = 0.0;                 // from there to i
    for (uint32_t i = first; i < end; ++i) {
      TRY(pace.after());
      if (i > first) arc += length(wires.position[i] - wires.position[i - 1]);
      for (; arc > reach && first < i; ++first) {
        arc -= length(wires.position[first + 1] - wires.position[first]);
        (*walk)[first] += i - 1 - first;
      }
      (*walk)[i] = i - first;
    }
    for (; first < end; ++first) (*walk)[first] += end - 1 - first;
  }
  return {};
}

Status check_walks(Span<const Approach> approaches, Span<const uint32_t> walk, Context& context) {
  constexpr uint64_t k_most = 1u << 26;
  uint64_t sum = 0;
  TRY(in_parts(context, approaches.size(), [&](size_t k) {
    sum += uint64_t{walk[approaches[k].a.edge]} + walk[approaches[k].b.edge];
  }));
  if (sum <= k_most) return {};
  return fail(Code::bad_argument,
              "the snapping tolerance covers too many samples: give a smaller one");
}

}  // namespace wireskin::network
