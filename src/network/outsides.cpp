#include "network/outsides.h"

#include "network/border_check.h"
#include "network/partial.h"

namespace wireskin::network {

// Whether every curve of the patch keeps one that is not dropped on its other side.
static bool bounds_others(const Network& network, Span<const uint32_t> patch_of,
                          Span<const Status> status, uint32_t p) {
  for (uint32_t h : network.cycle(p)) {
    const uint32_t other = patch_of[opposite(h)];
    if (other == k_none || other == p || !status[other].ok()) return false;
  }
  return true;
}

static Status name_leading_out(const curves::Curves& fitted, const Network& network, uint32_t p) {
  const Segment& segment = network.segment[network.inner[p][0]];
  return fail_at_sample(Code::open_network,
                        "this curve leads away from a border, out to where there is no surface",
                        segment.curve, fitted[segment.curve].sample[segment.first_knot]);
}

Status drop_outsides(const curves::Curves& fitted, const CurveVertices& vertices,
                     Array<Node>* nodes, Network* network, Array<Status>* faults,
                     Array<uint32_t>* original) {
  Context& context = nodes->context();
  Array<uint32_t> patch_of(context);  // of each half-segment
  Array<Status> status(context);
  Border border(context);
  const uint32_t patches = network->patches();
  TRY(patch_of.assign(2 * network->segment.size(), k_none));
  TRY(status.assign(patches, Status{}));
  for (uint32_t p = 0; p < patches; ++p) {
    for (uint32_t h : network->cycle(p)) patch_of[h] = p;
  }
  uint32_t outsides = 0;
  for (uint32_t p = 0; p < patches; ++p) {
    if (!bounds_others(*network, patch_of.span(), status.span(), p)) continue;
    TRY(border_of_patch(*network, vertices, p, &border));
    if (!runs_clockwise(border)) continue;
    if (!network->inner[p].empty() && faults->empty()) return name_leading_out(fitted, *network, p);
    if (!network->inner[p].empty() || !network->point[p].empty()) continue;
    status[p] = fail(Code::patch_without_plane, "outside");
    ++outsides;
    if (p % 1024 == 1023) TRY(context.checkpoint());
  }
  original->clear();
  if (outsides == 0) return {};
  return drop_patches(status.span(), nodes, network, original, faults);
}

}  // namespace wireskin::network
