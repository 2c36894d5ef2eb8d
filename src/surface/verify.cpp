#include "surface/verify.h"

#include "mesh/check.h"

namespace wireskin {

#ifdef WIRESKIN_DEBUG

// Nodes less segments of the patches' borders, and of each patch its inside: a disc, or with
// several loops a sphere with that many holes, whatever curves lie in it.
static Status predict_euler_characteristic(Context& context, const network::Network& network,
                                           int32_t* expected) {
  Array<uint8_t> on_border(context), used(context);
  TRY(on_border.assign(network.segment.size(), 0));
  for (uint32_t h : network.loop.item) on_border[h / 2] = 1;
  uint32_t nodes = 0;
  for (const network::Segment& s : network.segment) {
    if (s.from == k_none) continue;
    nodes = nodes > s.from ? nodes : s.from + 1;
    nodes = nodes > s.to ? nodes : s.to + 1;
  }
  TRY(used.assign(nodes, 0));
  *expected = 0;
  for (size_t s = 0; s < on_border.size(); ++s) {
    const network::Segment& segment = network.segment[s];
    if (!on_border[s] || segment.from == k_none) continue;  // a closed curve comes to nought
    used[segment.from] = used[segment.to] = 1;
    --*expected;
  }
  for (uint8_t node : used) *expected += node;
  for (uint32_t p = 0; p < network.patches(); ++p) {
    *expected += 2 - static_cast<int32_t>(network.patch_start[p + 1] - network.patch_start[p]);
  }
  return {};
}

static Status stop_on_fault(const Status& status) {
  const bool stopped = status.code == Code::out_of_memory || status.code == Code::memory_cap ||
                       status.code == Code::cancelled;
  WIRESKIN_ASSERT(status.ok() || stopped);
  return stopped ? status : Status{};
}

#endif

Status verify_surface(Context& context, const network::Network& network, Span<const Vec3> position,
                      const Surface& surface) {
#ifdef WIRESKIN_DEBUG
  int32_t expected = 0;
  TRY(predict_euler_characteristic(context, network, &expected));
  mesh::Expectations expectations;
  expectations.position = position;
  expectations.triangle = surface.triangle.span();
  expectations.edge = surface.curve_edge.span();
  expectations.patch = surface.patch.span();
  expectations.euler_characteristic = &expected;
  expectations.may_fold = true;
  return stop_on_fault(mesh::check(context, expectations));
#else
  (void)context, (void)network, (void)position, (void)surface;
  return {};
#endif
}

Status verify_triangles(Context& context, const Surface& surface) {
#ifdef WIRESKIN_DEBUG
  mesh::Expectations expectations;
  expectations.position = surface.position.span();
  expectations.triangle = surface.triangle.span();
  expectations.may_fold = true;
  return stop_on_fault(mesh::check(context, expectations));
#else
  (void)context, (void)surface;
  return {};
#endif
}

}  // namespace wireskin
