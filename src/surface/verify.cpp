#include "surface/verify.h"

#include "base/search.h"
#include "base/sort.h"
#include "mesh/check.h"

namespace wireskin {

#ifdef WIRESKIN_DEBUG

static bool is_stopped(const Status& status) {
  return status.code == Code::out_of_memory || status.code == Code::memory_cap ||
         status.code == Code::cancelled;
}

static Status stop_on_fault(const Status& status) {
  WIRESKIN_ASSERT(status.ok() || is_stopped(status));
  return is_stopped(status) ? status : Status{};
}

static uint64_t key_of_edge(uint32_t a, uint32_t b) {
  return a < b ? uint64_t{a} << 32 | b : uint64_t{b} << 32 | a;
}

static bool holds_key(Span<const uint64_t> sorted, uint64_t key) {
  const size_t i =
      first_failing(size_t{0}, sorted.size(), [&](size_t k) { return sorted[k] < key; });
  return i < sorted.size() && sorted[i] == key;
}

// Patches with a node that their border passes twice, like an eight.
static Status find_pinched(const network::Network& network, uint32_t nodes,
                           Array<uint8_t>* pinched) {
  Array<uint32_t> passed_by(pinched->context());
  TRY(pinched->assign(network.patches(), 0));
  TRY(passed_by.assign(nodes, k_none));
  for (uint32_t p = 0; p < network.patches(); ++p) {
    for (const uint32_t h : network.cycle(p)) {
      const network::Segment& segment = network.segment[h / 2];
      const uint32_t from = h % 2 == 0 ? segment.from : segment.to;
      if (from == k_none) continue;
      if (passed_by[from] == p) (*pinched)[p] = 1;
      passed_by[from] = p;
    }
  }
  return {};
}

// The pieces that curves cut the triangles of pinched patches into.
static Status count_pieces(Context& context, const Surface& surface, Span<const uint8_t> pinched,
                           int32_t* pieces) {
  Array<uint64_t> curve_edge(context);
  Array<uint32_t> twin(context), stack(context);
  Array<uint8_t> seen(context);
  const Span<const uint32_t> corner = surface.triangle.span();
  TRY(curve_edge.reserve(surface.curve_edge.size() / 2));
  const uint32_t vertices = static_cast<uint32_t>(surface.position.size());
  TRY(stop_on_fault(mesh::find_twins(vertices, corner, &twin)));
  TRY(stack.reserve(corner.size() / 3));
  TRY(seen.assign(corner.size() / 3, 0));
  for (size_t e = 0; e < surface.curve_edge.size(); e += 2) {
    curve_edge.push_reserved(key_of_edge(surface.curve_edge[e], surface.curve_edge[e + 1]));
  }
  sort(curve_edge.span(), [](uint64_t a, uint64_t b) { return a < b; });
  *pieces = 0;
  for (uint32_t first = 0; first < seen.size(); ++first) {
    if (seen[first] || !pinched[surface.patch[first]]) continue;
    ++*pieces;
    seen[first] = 1;
    stack.push_reserved(first);
    while (!stack.empty()) {
      const uint32_t t = stack.back();
      stack.pop();
      for (uint32_t h = 3 * t; h < 3 * t + 3; ++h) {
        if (twin[h] == k_none || seen[twin[h] / 3]) continue;
        const uint64_t key = key_of_edge(corner[h], corner[mesh::next_half_edge(h)]);
        if (holds_key(curve_edge.span(), key)) continue;
        seen[twin[h] / 3] = 1;
        stack.push_reserved(twin[h] / 3);
      }
    }
  }
  return {};
}

// Nodes less segments of the patches' borders, and of each patch its inside: a disc, or with
// several loops a sphere with that many holes, whatever curves lie in it. The inside of a pinched
// patch may be one disc or several, which the network does not tell: there its pieces are counted.
static Status predict_euler_characteristic(Context& context, const network::Network& network,
                                           const Surface& surface, int32_t* expected) {
  Array<uint8_t> on_border(context), used(context), pinched(context);
  TRY(on_border.assign(network.segment.size(), 0));
  for (uint32_t h : network.loop.item) on_border[h / 2] = 1;
  uint32_t nodes = 0;
  for (const network::Segment& s : network.segment) {
    if (s.from == k_none) continue;
    nodes = nodes > s.from ? nodes : s.from + 1;
    nodes = nodes > s.to ? nodes : s.to + 1;
  }
  TRY(used.assign(nodes, 0));
  TRY(find_pinched(network, nodes, &pinched));
  TRY(count_pieces(context, surface, pinched.span(), expected));
  for (size_t s = 0; s < on_border.size(); ++s) {
    const network::Segment& segment = network.segment[s];
    if (!on_border[s] || segment.from == k_none) continue;  // a closed curve comes to nought
    used[segment.from] = used[segment.to] = 1;
    --*expected;
  }
  for (uint8_t node : used) *expected += node;
  for (uint32_t p = 0; p < network.patches(); ++p) {
    *expected += (pinched[p] ? 1 : 2) -
                 static_cast<int32_t>(network.patch_start[p + 1] - network.patch_start[p]);
  }
  return {};
}

#endif

Status verify_surface(Context& context, const network::Network& network, Span<const Vec3> position,
                      const Surface& surface) {
#ifdef WIRESKIN_DEBUG
  int32_t expected = 0;
  TRY(predict_euler_characteristic(context, network, surface, &expected));
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

Status verify_triangles(Context& context, const TriangleSet& given, const Surface& surface) {
#ifdef WIRESKIN_DEBUG
  mesh::Expectations expectations;
  expectations.may_fold = true;
  expectations.position = given.position;
  expectations.triangle = given.triangle;
  // It is a finite manifold whose triangles have some area, so that is all that may be found.
  const Status status = mesh::check(context, expectations);
  if (is_stopped(status)) return status;
  expectations.may_be_flat = !status.ok();
  expectations.position = surface.position.span();
  expectations.triangle = surface.triangle.span();
  return stop_on_fault(mesh::check(context, expectations));
#else
  (void)context, (void)given, (void)surface;
  return {};
#endif
}

}  // namespace wireskin
