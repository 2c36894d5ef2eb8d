// The C boundary of raw curves: wsk_connect and wsk_integrate read the caller's arrays, run the
// work of src/network and lay the result out as curves for wsk_build.
#include "api/boundary.h"
#include "base/sort.h"
#include "network/connect.h"
#include "network/integrate.h"
#include "num/trig.h"

// One block of the caller's memory holds the handle and, behind it, all arrays of the view.
struct wsk_network {
  wireskin::Allocator allocator;
  size_t bytes;
  wsk_network_view view;
  uint32_t least_fresh, most_fresh;  // node numbers that are not the caller's
};

namespace wireskin::api {

static_assert(static_cast<int>(network::SnapKind::inside_inside) == WSK_SNAP_INSIDE_INSIDE);
static_assert(static_cast<int>(network::Chaining::all) == WSK_CHAIN_ALL);

static constexpr size_t k_connect_options_size =
    offsetof(wsk_connect_options, options) + sizeof(void*);

// ---- Input --------------------------------------------------------------------------------------

static Status read_connect_options(const wsk_connect_options* given, wsk_connect_options* options) {
  wsk_connect_options_init(options, sizeof *options);
  if (given == nullptr) return {};
  if (given->size < k_connect_options_size) {
    return fail(Code::bad_argument,
                "the options are not initialised: call wsk_connect_options_init first");
  }
  std::memcpy(options, given, least(given->size, sizeof *options));
  if (options->snap - options->snap != 0.0) {
    return fail(Code::bad_argument, "the snapping tolerance is not finite");
  }
  if (options->chain < 0 || options->chain >= WSK_CHAIN_COUNT) {
    return fail(Code::bad_argument, "the options name an unknown way of chaining");
  }
  if (!(options->corner_deg >= 0.0 && options->corner_deg <= 180.0)) {
    return fail(Code::bad_argument, "the angle of a corner is not between 0 and 180 degrees");
  }
  return {};
}

static Place sample_place(uint32_t curve, size_t sample) {
  Place place;
  place.curve = curve;
  place.sample = static_cast<uint32_t>(sample);
  return place;
}

// A unit normal, or zero where the caller has none.
static Status read_known_normal(const double* data, size_t stride, size_t i, const Place& place,
                                Vec3* normal) {
  *normal = Vec3{};
  if (data == nullptr) return {};
  const Rows rows = {data, stride};
  if (greatest_component(rows[i]) == 0.0) return {};
  return read_normal(rows, i, place, normal);
}

// The sum of the sample counts; `kind` is wsk_curve or wsk_sensor_curve.
template <typename Kind>
static Status count_raw_samples(const Kind* curves, size_t count, size_t* total) {
  *total = 0;
  if (count == 0) return fail(Code::empty, "there are no curves");
  if (curves == nullptr) return fail(Code::bad_argument, "the curves are null");
  if (count >= k_none / 2) return fail(Code::too_large, "too many curves for 32-bit indices");
  for (size_t c = 0; c < count; ++c) {
    Place place;
    place.curve = static_cast<uint32_t>(c);
    if (curves[c].sample_count == 0) {
      return fail(Code::too_few_samples, "the curve has no samples", place);
    }
    if (curves[c].sample_count >= k_none / 4 - *total) {
      return fail(Code::too_large, "too many samples for 32-bit indices", place);
    }
    *total += curves[c].sample_count;
  }
  return {};
}

static Status read_raw_curve(const wsk_curve& curve, uint32_t index, bool sharp,
                             network::Wires* wires) {
  for (uint32_t i = 0; i < curve.sample_count; ++i) {
    const Place place = sample_place(index, i);
    Vec3 position, normal, right;
    TRY(read_position({curve.positions, curve.position_stride}, i, place, &position));
    TRY(read_known_normal(curve.normals, curve.normal_stride, i, place, &normal));
    wires->position.push_reserved(position);
    wires->normal.push_reserved(normal);
    wires->number.push_reserved(curve.nodes == nullptr ? k_none : curve.nodes[i]);
    wires->origin.push_reserved({index, i, 0.0});
    wires->along.push_reserved({index, i, 0});
    if (!sharp) continue;
    const double* data = curve.sharp != 0 ? curve.normals_right : nullptr;
    TRY(read_known_normal(data, curve.normal_right_stride, i, place, &right));
    wires->right.push_reserved(right);
  }
  wires->closed.push_reserved(curve.closed != 0);
  wires->boundary.push_reserved(curve.boundary != 0);
  wires->sharp.push_reserved(curve.sharp != 0);
  wires->soft.push_reserved(curve.soft);
  wires->start.push_reserved(wires->samples());
  return {};
}

static Status read_raw_curves(const wsk_curve* curves, size_t count, network::Wires* wires) {
  size_t total = 0;
  bool sharp = false;
  TRY(count_raw_samples(curves, count, &total));
  for (uint32_t c = 0; c < count; ++c) {
    Place place;
    place.curve = c;
    sharp = sharp || curves[c].sharp != 0;
    if (curves[c].positions == nullptr) {
      return fail(Code::bad_argument, "the curve has no positions", place);
    }
    if (curves[c].soft - curves[c].soft != 0.0) {
      return fail(Code::bad_argument, "the cutoff length of the curve is not finite", place);
    }
  }
  TRY(network::reserve_wires(static_cast<uint32_t>(count), static_cast<uint32_t>(total), sharp,
                             wires));
  wires->start.push_reserved(0);
  for (uint32_t c = 0; c < count; ++c) TRY(read_raw_curve(curves[c], c, sharp, wires));
  return {};
}

static Status read_sensor_curve(const wsk_sensor_curve& curve, uint32_t index,
                                network::Wires* wires, Array<double>* arc, Array<Vec3>* tangent) {
  if (curve.sample_count < (curve.closed != 0 ? 4u : 2u)) {
    return fail(Code::too_few_samples, "the curve has too few samples",
                sample_place(index, k_none));
  }
  if (curve.arc_lengths == nullptr || curve.tangents == nullptr) {
    return fail(Code::bad_argument, "the curve has no arc lengths or no tangents",
                sample_place(index, k_none));
  }
  for (uint32_t i = 0; i < curve.sample_count; ++i) {
    const Place place = sample_place(index, i);
    const double s = curve.arc_lengths[i];
    Vec3 normal, direction;
    TRY(read_known_normal(curve.tangents, curve.tangent_stride, i, place, &direction));
    TRY(read_known_normal(curve.normals, curve.normal_stride, i, place, &normal));
    if (direction == Vec3{}) return fail(Code::bad_argument, "the tangent has zero length", place);
    if (s != s) return fail(Code::not_a_number, "the arc length is not a number", place);
    if (s - s != 0.0) return fail(Code::infinite, "the arc length is infinite", place);
    if (i > 0 && !(s > arc->back())) {
      return fail(Code::duplicate_samples, "the arc length does not increase", place);
    }
    arc->push_reserved(s);
    tangent->push_reserved(direction);
    wires->position.push_reserved(Vec3{});
    wires->normal.push_reserved(normal);
    wires->number.push_reserved(curve.nodes == nullptr ? k_none : curve.nodes[i]);
    wires->origin.push_reserved({index, i, 0.0});
  }
  wires->closed.push_reserved(curve.closed != 0);
  wires->boundary.push_reserved(curve.boundary != 0);
  wires->sharp.push_reserved(0);
  wires->soft.push_reserved(0.0);
  wires->start.push_reserved(wires->samples());
  return {};
}

// ---- Output -------------------------------------------------------------------------------------

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
  TRY(least_number.assign(wires.points, k_none));
  TRY(members.assign(wires.points, 0));
  TRY(used.reserve(wires.samples()));
  TRY(numbers->of_sample.resize(wires.samples()));
  for (uint32_t i = 0; i < wires.samples(); ++i) {
    uint32_t& number = least_number[wires.point[i]];
    number = wires.number[i] < number ? wires.number[i] : number;
    ++members[wires.point[i]];
    if (wires.number[i] != k_none) used.push_reserved(wires.number[i]);
  }
  sort(used.span(), [](uint32_t a, uint32_t b) { return a < b; });
  // Above all of the caller's where there is room, else in the gaps between them.
  const uint32_t most = used.empty() ? 0 : used.back();
  uint32_t next = used.empty() ? 0 : most < k_none - 1 - wires.points ? most + 1 : 0;
  size_t at = next > most ? used.size() : 0;
  for (uint32_t p = 0; p < wires.points; ++p) {
    if (members[p] < 2 || least_number[p] != k_none) continue;
    next = unused_number(used.span(), &at, next);
    numbers->least_fresh = next < numbers->least_fresh ? next : numbers->least_fresh;
    numbers->most_fresh = next;
    least_number[p] = next++;
  }
  for (uint32_t i = 0; i < wires.samples(); ++i) {
    const uint32_t p = wires.point[i];
    numbers->of_sample[i] = members[p] < 2 ? wires.number[i] : least_number[p];
  }
  return {};
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

static const double* normals_or_null(const double* normals, size_t first, size_t count) {
  for (size_t i = 3 * first; i < 3 * (first + count); ++i) {
    if (normals[i] != 0.0) return normals + 3 * first;
  }
  return nullptr;
}

// The curves of the view, which point into the arrays of the block.
static const wsk_curve* write_curves(const network::Wires& wires, const NetworkLayout& layout,
                                     unsigned char* block) {
  wsk_curve* curves = reinterpret_cast<wsk_curve*>(block + layout.curves);
  const double* positions = reinterpret_cast<const double*>(block + layout.positions);
  const double* normals = reinterpret_cast<const double*>(block + layout.normals);
  const double* right = reinterpret_cast<const double*>(block + layout.right);
  const uint32_t* nodes = reinterpret_cast<const uint32_t*>(block + layout.nodes);
  for (uint32_t c = 0; c < wires.curves(); ++c) {
    const uint32_t first = wires.start[c], count = wires.size(c);
    wsk_curve curve = {};
    curve.sample_count = count;
    curve.positions = positions + 3 * size_t{first};
    curve.normals = normals_or_null(normals, first, count);
    curve.nodes = nodes + first;
    curve.closed = wires.closed[c];
    curve.boundary = wires.boundary[c];
    curve.soft = wires.soft[c];
    curve.sharp = wires.sharp[c];
    if (curve.sharp != 0) curve.normals_right = normals_or_null(right, first, count);
    curves[c] = curve;
  }
  return curves;
}

static wsk_network_counts counts_of(const network::WireCounts& counts, uint32_t open_gaps) {
  return {counts.curves,   counts.samples,    counts.nodes,
          counts.dangling, counts.components, open_gaps};
}

static void write_events(const network::ConnectResult& result, const Scale& lengths,
                         const NetworkLayout& layout, unsigned char* block,
                         wsk_network_view* view) {
  wsk_snap* snaps = reinterpret_cast<wsk_snap*>(block + layout.snaps);
  for (size_t k = 0; k < result.snapping.snaps.size(); ++k) {
    const network::Snap& snap = result.snapping.snaps[k];
    snaps[k] = {place_of(snap.a, lengths(snap.at_a)), place_of(snap.b, lengths(snap.at_b)),
                lengths(snap.distance), static_cast<wsk_snap_kind>(snap.kind)};
  }
  wsk_contradiction* contradictions =
      reinterpret_cast<wsk_contradiction*>(block + layout.contradictions);
  for (size_t k = 0; k < result.contradictions.size(); ++k) {
    const network::Contradiction& c = result.contradictions[k];
    contradictions[k] = {place_of(c.a, {}), place_of(c.b, {}), c.angle * (180.0 / k_pi)};
  }
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
}

static Status make_network(Context& context, const network::Wires& wires,
                           const network::ConnectResult& result, int exponent,
                           const wsk_curve* given, wsk_network** out) {
  NodeNumbers numbers(context);
  TRY(context.enter(Stage::result));
  TRY(number_nodes(context, wires, &numbers));
  const NetworkLayout layout(wires, result.snapping.snaps.size(), result.contradictions.size());
  void* memory = nullptr;
  TRY(context.allocate(layout.bytes, 1, &memory));
  unsigned char* block = static_cast<unsigned char*>(memory);
  const Scale lengths(exponent), none(0);
  write_vectors(block, layout.positions, wires.position.span(), lengths);
  double* normals = reinterpret_cast<double*>(block + layout.normals);
  double* right = reinterpret_cast<double*>(block + layout.right);
  uint32_t* nodes = reinterpret_cast<uint32_t*>(block + layout.nodes);
  uint32_t* given_curve = reinterpret_cast<uint32_t*>(block + layout.given_curve);
  uint32_t* given_sample = reinterpret_cast<uint32_t*>(block + layout.given_sample);
  double* given_part = reinterpret_cast<double*>(block + layout.given_part);
  for (uint32_t i = 0; i < wires.samples(); ++i) {
    const network::Origin& origin = wires.origin[i];
    const Vec3 n = normal_as_given(given, origin, wires.normal[i]);
    normals[3 * i] = n.x, normals[3 * i + 1] = n.y, normals[3 * i + 2] = n.z;
    if (!wires.right.empty()) {
      const Vec3 r = normal_as_given(given, origin, wires.right[i]);
      right[3 * i] = r.x, right[3 * i + 1] = r.y, right[3 * i + 2] = r.z;
    }
    nodes[i] = numbers.of_sample[i];
    given_curve[i] = origin.curve;
    given_sample[i] = origin.sample;
    given_part[i] = origin.part;
  }
  uint32_t* first = reinterpret_cast<uint32_t*>(block + layout.first);
  for (size_t c = 0; c < wires.start.size(); ++c) first[c] = wires.start[c];

  wsk_network* handle = static_cast<wsk_network*>(memory);
  handle->allocator = context.allocator();
  handle->bytes = layout.bytes;
  handle->least_fresh = numbers.least_fresh;
  handle->most_fresh = numbers.most_fresh;
  wsk_network_view& view = handle->view;
  view = {};
  view.size = sizeof view;
  view.curve_count = wires.curves();
  view.sample_count = wires.samples();
  view.curves = write_curves(wires, layout, block);
  view.first_sample = first;
  view.given_curve = given_curve;
  view.given_sample = given_sample;
  view.given_part = given_part;
  write_events(result, lengths, layout, block, &view);
  *out = handle;
  return context.progress(1.0);
}

// ---- The two tasks ------------------------------------------------------------------------------

static double box_diagonal(Span<const Vec3> points) {
  Vec3 low = points[0], high = points[0];
  for (const Vec3& p : points) {
    low = {p.x < low.x ? p.x : low.x, p.y < low.y ? p.y : low.y, p.z < low.z ? p.z : low.z};
    high = {p.x > high.x ? p.x : high.x, p.y > high.y ? p.y : high.y, p.z > high.z ? p.z : high.z};
  }
  return length(high - low);
}

static void report_wires(const network::WireCounts& counts, wsk_report* report) {
  report->curves = counts.curves;
  report->nodes = counts.nodes;
  report->components = counts.components;
}

static Status connect(Context& context, const wsk_curve* curves, size_t count,
                      const wsk_connect_options& options, wsk_report* report, wsk_network** out) {
  network::Wires wires(context);
  network::ConnectResult result(context);
  int exponent = 0;
  TRY(context.enter(Stage::input));
  TRY(read_raw_curves(curves, count, &wires));
  TRY(find_scale(wires.position.span(), &exponent));
  const Scale scale(-exponent);
  for (Vec3& p : wires.position) p = scale(p);
  const double diagonal = box_diagonal(wires.position.span());
  network::ConnectOptions chosen;
  chosen.snap = options.snap >= 0.0;
  chosen.tolerance = chosen.snap ? scale(options.snap) : 0.0;
  chosen.chaining = static_cast<network::Chaining>(options.chain);
  chosen.corner = options.corner_deg * (k_pi / 180.0);
  chosen.orient = options.orient != 0;
  if (chosen.tolerance > 0.1 * diagonal) {
    return fail(Code::bad_argument, "the snapping tolerance is more than a tenth of the diagonal");
  }
  if (chosen.tolerance == 0.0 && options.snap > 0.0) chosen.snap = false;  // below every distance
  TRY(network::connect_wires(context, chosen, diagonal, &wires, &result));
  report_wires(result.after, report);
  return make_network(context, wires, result, exponent, curves, out);
}

// Takes the last sample of closed curves away again.
static void drop_repeated(network::Wires* wires) {
  uint32_t kept = 0, first = 0;
  for (uint32_t c = 0; c < wires->curves(); ++c) {
    const uint32_t end = wires->start[c + 1];
    for (uint32_t i = first; i < end - (wires->closed[c] ? 1 : 0); ++i, ++kept) {
      wires->position[kept] = wires->position[i];
      wires->normal[kept] = wires->normal[i];
      wires->number[kept] = wires->number[i];
      wires->origin[kept] = wires->origin[i];
      wires->point[kept] = wires->point[i];
    }
    first = end;
    wires->start[c + 1] = kept;
  }
  wires->position.shrink(kept), wires->normal.shrink(kept), wires->number.shrink(kept);
  wires->origin.shrink(kept), wires->point.shrink(kept);
}

// The points of sensor samples: by number, and the end of a closed curve is its beginning.
static Status weld_sensor(Context& context, network::Wires* wires) {
  Array<uint32_t> order(context), name(context);
  network::DisjointSets sets(context);
  const uint32_t n = wires->samples();
  TRY(order.reserve(n));
  TRY(name.assign(n, k_none));
  TRY(sets.reset(n));
  TRY(wires->point.resize(n));
  for (uint32_t c = 0; c < wires->curves(); ++c) {
    if (wires->closed[c]) sets.unite(wires->start[c], wires->start[c + 1] - 1);
  }
  for (uint32_t i = 0; i < n; ++i) {
    if (wires->number[i] != k_none) order.push_reserved(i);
  }
  const Span<const uint32_t> number = wires->number.span();
  sort(order.span(), [number](uint32_t a, uint32_t b) {
    return number[a] != number[b] ? number[a] < number[b] : a < b;
  });
  for (size_t k = 1; k < order.size(); ++k) {
    if (number[order[k]] == number[order[k - 1]]) sets.unite(order[k], order[k - 1]);
  }
  wires->points = 0;
  for (uint32_t i = 0; i < n; ++i) {
    const uint32_t root = sets.find(i);
    if (name[root] == k_none) name[root] = wires->points++;
    wires->point[i] = name[root];
  }
  return {};
}

static Status integrate(Context& context, const wsk_sensor_curve* curves, size_t count,
                        wsk_report* report, wsk_network** out) {
  network::Wires wires(context);
  network::ConnectResult result(context);
  Array<double> arc(context);
  Array<Vec3> tangent(context);
  Array<uint8_t> to_next(context);
  Array<uint32_t> component(context);
  size_t total = 0;
  TRY(context.enter(Stage::input));
  TRY(count_raw_samples(curves, count, &total));
  TRY(network::reserve_wires(static_cast<uint32_t>(count), static_cast<uint32_t>(total), false,
                             &wires));
  TRY(arc.reserve(total));
  TRY(tangent.reserve(total));
  TRY(to_next.reserve(count));
  wires.start.push_reserved(0);
  for (uint32_t c = 0; c < count; ++c) {
    TRY(read_sensor_curve(curves[c], c, &wires, &arc, &tangent));
    to_next.push_reserved(curves[c].tangents_to_next != 0);
  }
  double longest = 0.0;
  for (uint32_t c = 0; c < count; ++c) {
    const double size = arc[wires.start[c + 1] - 1] - arc[wires.start[c]];
    longest = size > longest ? size : longest;
  }
  if (longest - longest != 0.0) {
    return fail(Code::infinite, "the arc lengths span more than a double can hold");
  }
  const int exponent = binary_exponent(longest);
  const Scale scale(-exponent);
  for (double& s : arc) s = scale(s);
  TRY(weld_sensor(context, &wires));
  TRY(context.enter(Stage::operators));
  double residual = 0.0;
  TRY(network::integrate_tangents(context,
                                  {wires.start.span(), wires.point.span(), wires.points, arc.span(),
                                   tangent.span(), to_next.span()},
                                  wires.position.span(), &residual));
  drop_repeated(&wires);
  TRY(network::count_wires(wires, &component, &result.after));
  result.before = result.after;
  report_wires(result.after, report);
  TRY(make_network(context, wires, result, exponent, nullptr, out));
  (*out)->view.residual = Scale(exponent)(residual);
  return {};
}

// What both calls share: options, context, report; `task` does the work.
template <typename Task>
static wsk_status run_network(const wsk_options* given, const Status& earlier,
                              wsk_network** network, wsk_report* out, const Task& task) {
  wsk_report report;
  wsk_report_init(&report, sizeof report);
  if (out != nullptr && out->size < k_report_size) return WSK_ERROR_BAD_ARGUMENT;
  if (network == nullptr) {
    return finish(fail(Code::bad_argument, "there is no place for the network"), &report, out);
  }
  wsk_options options;
  Status status = earlier;
  if (status.ok()) status = read_options(given, &options);
  if (!status.ok()) return finish(status, &report, out);
  Context context(allocator_of(options), options.memory_cap, callbacks_of(options));
  wsk_network* made = nullptr;
  status = task(context, &report, &made);
  if (!status.ok() && made != nullptr) wsk_network_free(made);  // cancelled at the very end
  report_costs(context, &report);
  if (status.ok()) *network = made;
  return finish(status, &report, out);
}

// The first sample that carries the number; k_none if none does.
static uint32_t sample_of_number(const wsk_network_view& view, uint32_t number) {
  const uint32_t* nodes = view.curves[0].nodes;  // those of all curves, one after the other
  for (uint32_t i = 0; i < view.sample_count; ++i) {
    if (nodes[i] == number) return i;
  }
  return k_none;
}

}  // namespace wireskin::api

extern "C" {

void wsk_connect_options_init(wsk_connect_options* options, size_t size) {
  if (options == nullptr || size < wireskin::api::k_connect_options_size) return;
  std::memset(options, 0, size);
  options->size = size;
}

wsk_status wsk_connect(const wsk_curve* curves, size_t curve_count,
                       const wsk_connect_options* options, wsk_network** network,
                       wsk_report* report) {
  wsk_connect_options checked;
  const wireskin::Status status = wireskin::api::read_connect_options(options, &checked);
  return wireskin::api::run_network(
      status.ok() ? checked.options : nullptr, status, network, report,
      [&](wireskin::Context& context, wsk_report* filled, wsk_network** made) {
        return wireskin::api::connect(context, curves, curve_count, checked, filled, made);
      });
}

wsk_status wsk_integrate(const wsk_sensor_curve* curves, size_t curve_count,
                         const wsk_options* options, wsk_network** network, wsk_report* report) {
  return wireskin::api::run_network(
      options, {}, network, report,
      [&](wireskin::Context& context, wsk_report* filled, wsk_network** made) {
        return wireskin::api::integrate(context, curves, curve_count, filled, made);
      });
}

void wsk_network_get_view(const wsk_network* network, wsk_network_view* view, size_t size) {
  wireskin::api::fill_view(network, view, size);
}

void wsk_network_name_places(const wsk_network* network, wsk_report* report) {
  if (network == nullptr || report == nullptr) return;
  if (report->size < wireskin::api::k_report_size) return;
  const wsk_network_view& view = network->view;
  uint32_t sample = WSK_NONE;
  if (report->curve < view.curve_count) {
    const uint32_t first = view.first_sample[report->curve];
    const uint32_t count = view.first_sample[report->curve + 1] - first;
    sample = first + (report->sample < count ? report->sample : 0);
  } else if (report->node != WSK_NONE) {
    sample = wireskin::api::sample_of_number(view, report->node);
  }
  const bool fresh = report->node != WSK_NONE && report->node >= network->least_fresh &&
                     report->node <= network->most_fresh;
  if (sample != WSK_NONE) {
    const bool whole = report->curve < view.curve_count && report->sample == WSK_NONE;
    report->curve = view.given_curve[sample];
    report->sample = whole ? WSK_NONE : view.given_sample[sample];
  }
  if (fresh) report->node = WSK_NONE;
}

void wsk_network_free(wsk_network* network) {
  if (network == nullptr) return;
  const wireskin::Allocator allocator = network->allocator;
  allocator.release(network, network->bytes, allocator.user);
}

}  // extern "C"
