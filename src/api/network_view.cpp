#include "api/network_view.h"

#include "api/input.h"
#include "base/sort_in_parts.h"
#include "num/trig.h"

namespace wireskin::api {

// Node numbers of the result: the least of the caller's at each point; at points with more than one
// sample and none of his, fresh ones.
struct NodeNumbers {
  Array<uint32_t> of_sample;
  uint32_t least_fresh = k_none, most_fresh = 0;

  explicit NodeNumbers(Context& context) : of_sample(context) {}
};

// The next number from `candidate` on that is not in the ascending list.
static uint32_t unused_number(Span<const uint32_t> used, size_t* at, uint32_t candidate) {
  while (*at < used.size() && used[*at] <= candidate) {
    if (used[(*at)++] == candidate) ++candidate;
  }
  return candidate;
}

static Status number_nodes(Context& context, const network::Wires& wires, NodeNumbers* numbers) {
  Array<uint32_t> least_number(context), members(context), used(context);
  TRY(assign_in_parts(wires.points, k_none, &least_number));
  TRY(assign_in_parts(wires.points, 0, &members));
  TRY(used.reserve(wires.samples()));
  TRY(numbers->of_sample.resize(wires.samples()));
  TRY(in_parts(context, wires.samples(), [&](size_t i) {
    uint32_t& number = least_number[wires.point[i]];
    number = wires.number[i] < number ? wires.number[i] : number;
    ++members[wires.point[i]];
    if (wires.number[i] != k_none) used.push_reserved(wires.number[i]);
  }));
  TRY(sort_in_parts(context, used.span(), [](uint32_t a, uint32_t b) { return a < b; }));
  // Above all of the caller's where there is room, else in the gaps between them.
  const uint32_t most = used.empty() ? 0 : used.back();
  uint32_t next = used.empty() ? 0 : most < k_none - 1 - wires.points ? most + 1 : 0;
  size_t at = next > most ? used.size() : 0;
  TRY(in_parts(context, wires.points, [&](size_t p) {
    if (members[p] < 2 || least_number[p] != k_none) return;
    next = unused_number(used.span(), &at, next);
    numbers->least_fresh = next < numbers->least_fresh ? next : numbers->least_fresh;
    numbers->most_fresh = next;
    least_number[p] = next++;
  }));
  return in_parts(context, wires.samples(), [&](size_t i) {
    const uint32_t p = wires.point[i];
    numbers->of_sample[i] = members[p] < 2 ? wires.number[i] : least_number[p];
  });
}

// Normals that did not change leave as they came: not made unit, or another call would make them
// unit once more and round again. `given` may be null (no curves to compare with).
static Vec3 normal_as_given(const wsk_curve* given, const network::Origin& origin,
                            const Vec3& normal) {
  if (given == nullptr || origin.part != 0.0 || normal == Vec3{}) return normal;
  const wsk_curve& curve = given[origin.curve];
  const Rows sides[2] = {{curve.normals, curve.normal_stride},
                         {curve.normals_right, curve.normal_right_stride}};
  for (int side = 0; side < (curve.sharp != 0 ? 2 : 1); ++side) {
    if (sides[side].data == nullptr) continue;
    Vec3 unit_given;
    const Vec3 raw = sides[side][origin.sample];
    if (greatest_component(raw) == 0.0) continue;
    if (!read_normal(sides[side], origin.sample, {}, &unit_given).ok()) continue;
    if (unit_given == normal) return raw;
    if (-unit_given == normal) return -raw;
  }
  return normal;
}

// Where the arrays of the view stand in the block.
struct NetworkLayout {
  size_t curves, first, positions, normals, right, nodes, given_curve, given_sample, given_part;
  size_t snaps, contradictions, bytes;

  NetworkLayout(const network::Wires& wires, size_t snap_count, size_t contradiction_count) {
    Layout layout(sizeof(wsk_network));
    const size_t n = wires.samples(), m = wires.curves();
    curves = layout.add_array<wsk_curve>(m);
    first = layout.add_array<uint32_t>(m + 1);
    positions = layout.add_array<double>(3 * n);
    normals = layout.add_array<double>(3 * n);
    right = layout.add_array<double>(3 * wires.right.size());
    nodes = layout.add_array<uint32_t>(n);
    given_curve = layout.add_array<uint32_t>(n);
    given_sample = layout.add_array<uint32_t>(n);
    given_part = layout.add_array<double>(n);
    snaps = layout.add_array<wsk_snap>(snap_count);
    contradictions = layout.add_array<wsk_contradiction>(contradiction_count);
    bytes = layout.bytes();
  }
};

static wsk_place place_of(const network::Origin& origin, const Vec3& position) {
  return {origin.curve, origin.sample, origin.part, {position.x, position.y, position.z}};
}

// Those of a curve, null where it has none.
static Status find_normals(const double* normals, size_t first, size_t count, Pace* pace,
                           const double** found) {
  *found = nullptr;
  for (size_t i = 3 * first; i < 3 * (first + count) && *found == nullptr; ++i) {
    TRY(pace->after());
    if (normals[i] != 0.0) *found = normals + 3 * first;
  }
  return {};
}

// The curves of the view, which point into the arrays of the block.
static Status write_curves(const network::Wires& wires, const NetworkLayout& layout,
                           unsigned char* block, wsk_network_view* view) {
  wsk_curve* curves = reinterpret_cast<wsk_curve*>(block + layout.curves);
  const double* positions = reinterpret_cast<const double*>(block + layout.positions);
  const double* normals = reinterpret_cast<const double*>(block + layout.normals);
  const double* right = reinterpret_cast<const double*>(block + layout.right);
  const uint32_t* nodes = reinterpret_cast<const uint32_t*>(block + layout.nodes);
  Pace pace(wires.position.context());
  for (uint32_t c = 0; c < wires.curves(); ++c) {
    const uint32_t first = wires.start[c], count = wires.size(c);
    TRY(pace.after());
    wsk_curve curve = {};
    curve.sample_count = count;
    curve.positions = positions + 3 * size_t{first};
    TRY(find_normals(normals, first, count, &pace, &curve.normals));
    curve.nodes = nodes + first;
    curve.closed = wires.closed[c];
    curve.boundary = wires.boundary[c];
    curve.soft = wires.soft[c];
    curve.sharp = wires.sharp[c];
    if (curve.sharp != 0) TRY(find_normals(right, first, count, &pace, &curve.normals_right));
    curves[c] = curve;
  }
  view->curves = curves;
  return {};
}

static wsk_network_counts counts_of(const network::WireCounts& counts, uint32_t open_gaps) {
  return {counts.curves,   counts.samples,    counts.nodes,
          counts.dangling, counts.components, open_gaps};
}

static Status write_events(const network::ConnectResult& result, const Scale& lengths,
                           const NetworkLayout& layout, unsigned char* block,
                           wsk_network_view* view) {
  Context& context = result.contradictions.context();
  wsk_snap* snaps = reinterpret_cast<wsk_snap*>(block + layout.snaps);
  TRY(in_parts(context, result.snapping.snaps.size(), [&](size_t k) {
    const network::Snap& snap = result.snapping.snaps[k];
    snaps[k] = {place_of(snap.a, lengths(snap.at_a)), place_of(snap.b, lengths(snap.at_b)),
                lengths(snap.distance), static_cast<wsk_snap_kind>(snap.kind)};
  }));
  wsk_contradiction* contradictions =
      reinterpret_cast<wsk_contradiction*>(block + layout.contradictions);
  TRY(in_parts(context, result.contradictions.size(), [&](size_t k) {
    const network::Contradiction& c = result.contradictions[k];
    contradictions[k] = {place_of(c.a, {}), place_of(c.b, {}), c.angle * (180.0 / k_pi)};
  }));
  view->snaps = snaps;
  view->contradictions = contradictions;
  view->snap_count = static_cast<uint32_t>(result.snapping.snaps.size());
  view->contradiction_count = static_cast<uint32_t>(result.contradictions.size());
  view->before = counts_of(result.before, result.snapping.open_before);
  view->after = counts_of(result.after, result.snapping.open_after);
  view->tolerance = lengths(result.tolerance);
  view->filled_normals = result.normals.filled;
  view->turned_normals = result.turned;
  view->curves_without_normals = result.normals.missing;
  return {};
}

// The normals of sample i on both sides, as far as there are two.
static void write_normals(const network::Wires& wires, const NetworkLayout& layout,
                          const wsk_curve* given, uint32_t i, unsigned char* block) {
  double* normals = reinterpret_cast<double*>(block + layout.normals);
  double* right = reinterpret_cast<double*>(block + layout.right);
  const Vec3 n = normal_as_given(given, wires.origin[i], wires.normal[i]);
  normals[3 * i] = n.x, normals[3 * i + 1] = n.y, normals[3 * i + 2] = n.z;
  if (wires.right.empty()) return;
  const Vec3 r = normal_as_given(given, wires.origin[i], wires.right[i]);
  right[3 * i] = r.x, right[3 * i + 1] = r.y, right[3 * i + 2] = r.z;
}

static Status write_samples(const network::Wires& wires, const NodeNumbers& numbers,
                            const NetworkLayout& layout, const wsk_curve* given,
                            unsigned char* block, wsk_network_view* view) {
  uint32_t* nodes = reinterpret_cast<uint32_t*>(block + layout.nodes);
  uint32_t* given_curve = reinterpret_cast<uint32_t*>(block + layout.given_curve);
  uint32_t* given_sample = reinterpret_cast<uint32_t*>(block + layout.given_sample);
  double* given_part = reinterpret_cast<double*>(block + layout.given_part);
  uint32_t* first = reinterpret_cast<uint32_t*>(block + layout.first);
  view->first_sample = first;
  view->given_curve = given_curve;
  view->given_sample = given_sample;
  view->given_part = given_part;
  for (size_t c = 0; c < wires.start.size(); ++c) first[c] = wires.start[c];
  return in_parts(wires.origin.context(), wires.samples(), [&](size_t i) {
    const network::Origin& origin = wires.origin[i];
    write_normals(wires, layout, given, static_cast<uint32_t>(i), block);
    nodes[i] = numbers.of_sample[i];
    given_curve[i] = origin.curve;
    given_sample[i] = origin.sample;
    given_part[i] = origin.part;
  });
}

Status make_network(Context& context, const network::Wires& wires,
                    const network::ConnectResult& result, int exponent, const wsk_curve* given,
                    wsk_network** out) {
  NodeNumbers numbers(context);
  TRY(context.enter(Stage::result));
  TRY(number_nodes(context, wires, &numbers));
  const NetworkLayout layout(wires, result.snapping.snaps.size(), result.contradictions.size());
  void* memory = nullptr;
  TRY(context.allocate(layout.bytes, 1, &memory));
  unsigned char* block = static_cast<unsigned char*>(memory);
  const Scale lengths(exponent);
  wsk_network* handle = static_cast<wsk_network*>(memory);
  handle->allocator = context.allocator();
  handle->bytes = layout.bytes;
  handle->least_fresh = numbers.least_fresh;
  handle->most_fresh = numbers.most_fresh;
  *out = handle;
  wsk_network_view& view = handle->view;
  view = {};
  view.size = sizeof view;
  view.curve_count = wires.curves();
  view.sample_count = wires.samples();
  const double* positions = nullptr;  // the curves point into them
  TRY(write_vectors(context, wires.position.span(), lengths, block + layout.positions, &positions));
  TRY(write_samples(wires, numbers, layout, given, block, &view));
  TRY(write_curves(wires, layout, block, &view));
  TRY(write_events(result, lengths, layout, block, &view));
  return context.progress(1.0);
}

}  // namespace wireskin::api
