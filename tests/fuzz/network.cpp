// libFuzzer target: curves to nodes, splines, cycles and patches of one loop or several, without
// triangles; then the network again without some of its patches. Every side of every segment lies
// on one loop, inside a patch or beyond the border, and every loop closes.
#include "fuzz/curves.h"

#include "api/curves.h"
#include "network/group.h"
#include "network/partial.h"
#include "surface/fit.h"

using namespace wireskin;

static void check_lists(const network::Lists& lists, size_t bound) {
  for (uint32_t i = 0; i < lists.count(); ++i) {
    fuzz::require(lists.start[i] <= lists.start[i + 1]);
    for (const uint32_t item : lists[i]) fuzz::require(item < bound);
  }
}

// Of each half-segment, on how many loops it lies; each loop leads back to where it began.
static std::vector<uint32_t> count_loops(const network::Network& n) {
  std::vector<uint32_t> seen(2 * n.segment.size(), 0);
  for (uint32_t l = 0; l < n.loop.count(); ++l) {
    const Span<const uint32_t> loop = n.loop[l];
    fuzz::require(!loop.empty());
    for (size_t i = 0; i < loop.size(); ++i) {
      const uint32_t h = loop[i], next = loop[(i + 1) % loop.size()];
      ++seen[h];
      const network::Segment &s = n.segment[h / 2], &t = n.segment[next / 2];
      fuzz::require((h % 2 == 0 ? s.to : s.from) == (next % 2 == 0 ? t.from : t.to));
    }
  }
  return seen;
}

// `whole`: no segment has a fault. `grouped`: loose pieces lie inside patches.
static void check_network(const network::Network& n, size_t nodes, bool whole, bool grouped) {
  const size_t segments = n.segment.size();
  for (const network::Segment& s : n.segment) {
    fuzz::require(s.first_knot < s.last_knot);
    fuzz::require(s.from < nodes || (s.from == k_none && s.to == k_none));
    fuzz::require(s.to < nodes || s.to == k_none);
  }
  check_lists(n.loop, 2 * segments);
  check_lists(n.inner, segments);
  check_lists(n.point, nodes);
  for (uint32_t p = 0; p < n.patches(); ++p) {
    fuzz::require(n.patch_start[p] < n.patch_start[p + 1]);
  }
  if (n.patches() != 0) fuzz::require(n.patch_start[n.patches()] == n.loop.count());
  const std::vector<uint32_t> seen = count_loops(n);
  std::vector<uint32_t> inside(segments, 0);
  for (const uint32_t s : n.inner.item) ++inside[s];
  for (const uint32_t s : n.loose.item) {
    if (grouped) fuzz::require(inside[s] == 1);
    inside[s] = 1;
  }
  for (size_t s = 0; s < segments; ++s) {
    const uint32_t left = seen[2 * s], right = seen[2 * s + 1];
    fuzz::require(left <= 1 && right <= 1 && inside[s] <= 1);
    fuzz::require(inside[s] == 0 || left + right == 0);
    if (!whole || inside[s] != 0) continue;
    fuzz::require(left + right == (n.segment[s].boundary ? 1u : 2u));
  }
}

static void check_vertices(const network::Network& n, const network::CurveVertices& vertices) {
  for (uint32_t s = 0; s < n.segment.size(); ++s) {
    for (uint32_t k = 0; k <= vertices.edges[s]; ++k) {
      fuzz::require(segment_vertex(n, vertices, s, k) < vertices.position.size());
    }
  }
  for (const Vec3& p : vertices.position) {
    fuzz::require(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z));
  }
}

// The network without the patches that the bytes choose.
static Status drop(fuzz::Bytes& bytes, bool whole, Array<network::Node>* nodes,
                   network::Network* n) {
  const uint32_t before = n->patches();
  Array<uint32_t> original(nodes->context());
  std::vector<Status> status(before);
  uint32_t left = before;
  for (Status& s : status) {
    if (!bytes.one_in(3)) continue;
    s = fail(Code::patch_folded, "");
    --left;
  }
  TRY(network::drop_patches({status.data(), status.size()}, nodes, n, &original));
  fuzz::require(n->patches() == left && original.size() == left);
  check_network(*n, nodes->size(), whole, true);
  return {};
}

// As src/api.cpp and src/surface.cpp do it.
static Status build(Context& context, fuzz::Bytes& bytes, const std::vector<wsk_curve>& given) {
  const bool partial = bytes.one_in(3);
  const uint32_t parts = 1 + bytes.count(4, 10);
  api::CurveStorage storage(context);
  int exponent = 0;
  TRY(api::read_curves(given.data(), given.size(), &storage));
  TRY(api::find_scale(storage.position.span(), &exponent));
  const Scale scale(-exponent);
  for (Vec3& p : storage.position) p = scale(p);
  const CurveSet set = {storage.start.span(),  storage.position.span(), storage.normal.span(),
                        storage.number.span(), storage.closed.span(),   storage.boundary.span(),
                        storage.soft.span(),   storage.sharp.span(),    storage.right.span()};
  network::SmoothingOptions smoothing;  // which takes long: the targets of wsk_build do it
  smoothing.noise = network::Noise::none;

  Counts counts;
  Array<network::Node> nodes(context);
  Array<Status> faults(context);
  curves::Curves fitted(context);
  network::Network n(context);
  network::CurveVertices vertices(context);
  TRY(fit_curves(context, set, diagonal(set.position), smoothing, &nodes, &fitted, &counts));
  TRY(network::find_patches(fitted, set.boundary, nodes.span(), &n, partial ? &faults : nullptr));
  bool whole = true;
  for (const Status& fault : faults) whole = whole && fault.ok();
  check_network(n, nodes.size(), whole, false);
  TRY(network::resample(fitted, nodes.span(), n, 1.0 / parts, &vertices));
  check_vertices(n, vertices);
  network::Ambiguity ambiguity;
  TRY(network::group_patches(vertices, &n, &ambiguity));
  fuzz::require(ambiguity.patches <= n.patches());
  check_network(n, nodes.size(), whole, true);
  TRY(drop(bytes, whole, &nodes, &n));
  network::CurveVertices fresh(context);
  TRY(network::resample(fitted, nodes.span(), n, 1.0 / parts, &fresh));
  check_vertices(n, fresh);
  return {};
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  fuzz::Bytes bytes(data, size);
  fuzz::Limits limits;
  fuzz::Arena& heap = limits.allocator;
  scenes::Scene scene;
  scene.curves = fuzz::read_curves(bytes, true);
  {
    Context context({heap.allocate, heap.release, &heap}, size_t{1} << 26,
                    {fuzz::Limits::cancel, &limits});
    const Status status = build(context, bytes, scenes::curves_of(scene));
    fuzz::require(status.ok() || status.sentence[0] != '\0');
  }
  fuzz::require(heap.clean());
  return 0;
}
