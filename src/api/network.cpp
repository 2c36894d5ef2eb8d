// The C boundary of raw curves: wsk_connect and wsk_integrate read the caller's arrays, run the
// work of src/network and lay the result out as curves for wsk_build.
#include "api/boundary.h"
#include "api/network_view.h"
#include "api/raw_curves.h"
#include "network/integrate.h"
#include "num/trig.h"

namespace wireskin::api {

static_assert(static_cast<int>(network::SnapKind::inside_inside) == WSK_SNAP_INSIDE_INSIDE);
static_assert(static_cast<int>(network::Chaining::all) == WSK_CHAIN_ALL);

static constexpr size_t k_connect_options_size =
    offsetof(wsk_connect_options, options) + sizeof(void*);

static Status read_connect_options(const wsk_connect_options* given, wsk_connect_options* options) {
  wsk_connect_options_init(options, sizeof *options);
  TRY(read_struct(given, k_connect_options_size,
                  "the options are not initialised: call wsk_connect_options_init first", options));
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

static double box_diagonal(Span<const Vec3> points) {
  Vec3 low = points[0], high = points[0];
  for (const Vec3& p : points) {
    low = {p.x < low.x ? p.x : low.x, p.y < low.y ? p.y : low.y, p.z < low.z ? p.z : low.z};
    high = {p.x > high.x ? p.x : high.x, p.y > high.y ? p.y : high.y, p.z > high.z ? p.z : high.z};
  }
  return length(high - low);
}

// Where a whole curve is a point beside the size of the network, squares of its lengths underflow
// and all places of it would be taken for one.
static Status check_extents(const network::Wires& wires) {
  for (uint32_t c = 0; c < wires.curves(); ++c) {
    const Vec3 first = wires.position[wires.start[c]];
    bool differs = false, moves = false;
    for (uint32_t i = wires.start[c]; i < wires.start[c + 1] && !moves; ++i) {
      differs = differs || wires.position[i] != first;
      moves = length(wires.position[i] - first) > 0.0;
    }
    if (moves || !differs) continue;
    return fail(
        Code::zero_length_curve,
        "the curve is but a point beside the size of the network: does a position of another "
        "one lie far out?",
        curve_place(c));
  }
  return {};
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
  TRY(in_parts(context, wires.samples(),
               [&](size_t i) { wires.position[i] = scale(wires.position[i]); }));
  TRY(check_extents(wires));
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
  network::DisjointSets sets(context);
  TRY(sets.reset(wires->samples()));
  for (uint32_t c = 0; c < wires->curves(); ++c) {
    if (wires->closed[c]) sets.unite(wires->start[c], wires->start[c + 1] - 1);
  }
  TRY(network::unite_numbers(*wires, &sets));
  return network::number_points(&sets, wires);
}

// The power of two that brings the longest curve to one half up to one.
static Status find_scale_of_arcs(const SensorCurves& sensor, int* exponent) {
  double longest = 0.0;
  for (uint32_t c = 0; c < sensor.wires.curves(); ++c) {
    const Array<uint32_t>& start = sensor.wires.start;
    const double size = sensor.arc[start[c + 1] - 1] - sensor.arc[start[c]];
    longest = size > longest ? size : longest;
  }
  if (longest - longest != 0.0) {
    return fail(Code::infinite, "the arc lengths span more than a double can hold");
  }
  *exponent = binary_exponent(longest);
  return {};
}

static Status integrate(Context& context, const wsk_sensor_curve* curves, size_t count,
                        wsk_report* report, wsk_network** out) {
  SensorCurves sensor(context);
  network::ConnectResult result(context);
  Array<uint32_t> component(context);
  int exponent = 0;
  TRY(context.enter(Stage::input));
  TRY(read_sensor_curves(curves, count, &sensor));
  TRY(find_scale_of_arcs(sensor, &exponent));
  const Scale scale(-exponent);
  for (double& s : sensor.arc) s = scale(s);
  network::Wires& wires = sensor.wires;
  TRY(weld_sensor(context, &wires));
  TRY(context.enter(Stage::operators));
  double residual = 0.0;
  TRY(network::integrate_tangents(context,
                                  {wires.start.span(), wires.point.span(), wires.points,
                                   sensor.arc.span(), sensor.tangent.span(), sensor.to_next.span()},
                                  wires.position.span(), &residual));
  drop_repeated(&wires);
  TRY(network::count_wires(wires, &component, &result.after));
  result.before = result.after;
  report_wires(result.after, report);
  TRY(make_network(context, wires, result, exponent, nullptr, out));
  (*out)->view.residual = Scale(exponent)(residual);
  return {};
}

static Destination<wsk_network> to_network(wsk_network** network) {
  return {network, "there is no place for the network", wsk_network_free};
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
  using namespace wireskin;
  wsk_connect_options checked;
  const Status status = api::read_connect_options(options, &checked);
  return api::run_call(
      status, status.ok() ? checked.options : nullptr, api::to_network(network), report,
      [&](Context& context, const wsk_options&, wsk_report* filled, wsk_network** made) {
        return api::connect(context, curves, curve_count, checked, filled, made);
      });
}

wsk_status wsk_integrate(const wsk_sensor_curve* curves, size_t curve_count,
                         const wsk_options* options, wsk_network** network, wsk_report* report) {
  using namespace wireskin;
  return api::run_call(
      {}, options, api::to_network(network), report,
      [&](Context& context, const wsk_options&, wsk_report* filled, wsk_network** made) {
        return api::integrate(context, curves, curve_count, filled, made);
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
