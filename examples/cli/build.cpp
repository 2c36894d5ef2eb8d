#include "build.h"

#include <chrono>
#include <vector>

#include "scan.h"

namespace wireskin_cli {

wsk_network_view BuildResult::prepared_view() const {
  wsk_network_view view;
  wsk_network_get_view(prepared.get(), &view, sizeof view);
  return view;
}

// ---- What the file gives ------------------------------------------------------------------------

// The library wants the samples of a curve in order: a copy of each.
static void add_sample(const Network& network, uint32_t vertex, GivenCurves& given) {
  for (size_t k = 0; k < 3; ++k) {
    const size_t at = 3 * size_t{vertex} + k;
    given.positions.push_back(network.positions[at]);
    given.normals.push_back(network.normals.empty() ? 0.0 : network.normals[at]);
  }
  given.nodes.push_back(network.nodes.empty() ? vertex : network.nodes[vertex]);
}

static bool any_normal(const Network& network, const std::vector<uint32_t>& vertices) {
  for (const uint32_t vertex : vertices) {
    if (network.normal_known(vertex)) return true;
  }
  return false;
}

static GivenCurves gather_curves(const Network& network) {
  GivenCurves given;
  for (const NetworkCurve& curve : network.curves) {
    for (const uint32_t vertex : curve.vertices) add_sample(network, vertex, given);
  }
  for (const uint32_t vertex : network.points) add_sample(network, vertex, given);
  given.point_count = network.points.size();

  // The arrays have their places now.
  size_t first = 0;
  const auto add = [&](size_t count, bool normals) {
    wsk_curve c = {};
    c.sample_count = count;
    c.positions = given.positions.data() + 3 * first;
    if (normals) c.normals = given.normals.data() + 3 * first;
    c.nodes = given.nodes.data() + first;
    given.curves.push_back(c);
    first += count;
  };
  for (const NetworkCurve& curve : network.curves) {
    add(curve.vertices.size(), !curve.sharp && any_normal(network, curve.vertices));
    given.curves.back().closed = curve.closed ? 1 : 0;
    given.curves.back().boundary = curve.boundary ? 1 : 0;
    given.curves.back().sharp = curve.sharp ? 1 : 0;
  }
  for (const uint32_t vertex : network.points) add(1, network.normal_known(vertex));
  return given;
}

// ---- Preparation --------------------------------------------------------------------------------

using PreparedNetwork = std::unique_ptr<wsk_network, FreeNetwork>;

// Joins what almost meets; null, with the report, where the curves cannot be read.
static PreparedNetwork connect_curves(const GivenCurves& given, const Arguments& arguments,
                                      const wsk_options& options, wsk_report* report) {
  wsk_connect_options connect;
  wsk_connect_options_init(&connect, sizeof connect);
  connect.snap = arguments.snap;
  connect.orient = arguments.orient ? 1 : 0;
  connect.options = &options;
  wsk_network* network = nullptr;
  wsk_connect(given.curves.data(), given.curves.size() - given.point_count, &connect, &network,
              report);
  return PreparedNetwork(network);
}

// Positions from measured tangents.
static PreparedNetwork integrate_curves(const std::vector<RawCurve>& raw,
                                        const wsk_options& options, wsk_report* report) {
  std::vector<std::vector<uint32_t>> nodes;
  for (const RawCurve& curve : raw) {
    std::vector<uint32_t> numbers(curve.arc_lengths.size(), WSK_NONE);
    for (size_t i = 0; i < curve.nodes.size(); ++i) {
      numbers[curve.nodes[i]] = curve.global_nodes[i];
    }
    nodes.push_back(numbers);
  }
  std::vector<wsk_sensor_curve> curves;
  for (size_t c = 0; c < raw.size(); ++c) {
    wsk_sensor_curve curve = {};
    curve.sample_count = raw[c].arc_lengths.size();
    curve.arc_lengths = raw[c].arc_lengths.data();
    curve.tangents = raw[c].tangents.data();
    curve.normals = raw[c].normals.empty() ? nullptr : raw[c].normals.data();
    curve.nodes = nodes[c].data();
    curve.closed = raw[c].closed ? 1 : 0;
    curve.boundary = raw[c].boundary ? 1 : 0;
    curve.tangents_to_next = 1;
    curves.push_back(curve);
  }
  wsk_network* network = nullptr;
  wsk_integrate(curves.data(), curves.size(), &options, &network, report);
  return PreparedNetwork(network);
}

// ---- Surfaces -----------------------------------------------------------------------------------

static double milliseconds_now(void*) {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration<double, std::milli>(now).count();
}

static bool by_flow(const std::vector<wsk_curve>& curves, TopologyChoice topology) {
  if (topology != TopologyChoice::automatic) return topology == TopologyChoice::flow;
  bool all_points = true, missing = false;
  for (const wsk_curve& curve : curves) {
    if (curve.sample_count < 2) continue;
    all_points = false;
    missing = missing || (curve.normals == nullptr && curve.sharp == 0);
  }
  return missing || all_points;
}

struct FreeFlow {
  void operator()(wsk_flow* flow) const { wsk_flow_free(flow); }
};

// The times of the two calls together.
static void add_times(const wsk_report& first, wsk_report* report) {
  for (int s = 0; s < WSK_STAGE_COUNT; ++s) report->stage_ms[s] += first.stage_ms[s];
  report->total_ms += first.total_ms;
  report->curves = first.curves;
  if (first.peak_bytes > report->peak_bytes) report->peak_bytes = first.peak_bytes;
}

static void build_from_flow(const std::vector<wsk_curve>& curves, const wsk_options& options,
                            const Arguments& arguments, BuildResult* result) {
  wsk_flow_options flow_options;
  wsk_flow_options_init(&flow_options, sizeof flow_options);
  flow_options.voids = arguments.voids;
  flow_options.open_walls = arguments.open_walls ? 1 : 0;
  flow_options.lids = arguments.lids;
  wsk_flow* made = nullptr;
  wsk_report first;
  wsk_report_init(&first, sizeof first);
  if (wsk_flow_build(curves.data(), curves.size(), &options, &flow_options, &made, &first) !=
      WSK_OK) {
    result->report = first;
    return;
  }
  const std::unique_ptr<wsk_flow, FreeFlow> flow(made);
  wsk_surface* surface = nullptr;
  const wsk_status status =
      wsk_flow_surface(flow.get(), &options, &flow_options, &surface, &result->report);
  add_times(first, &result->report);
  if (status != WSK_OK) return;
  result->surface.reset(surface);
  wsk_surface_view view;
  wsk_surface_get_view(surface, &view, sizeof view);
  if (view.triangle_count == 0) {
    // To the library that is an answer; to whoever asked for a surface it is none.
    bool only_points = true;
    for (const wsk_curve& curve : curves) only_points = only_points && curve.sample_count < 2;
    result->surface.reset();
    result->report.status = WSK_ERROR_OPEN_NETWORK;
    result->report.sentence = only_points ? "points alone span no surface, curves are needed"
                                          : "no surface spans between these curves: none of them "
                                            "closes a loop with others or by itself";
    return;
  }
  result->flow = std::make_unique<FlowSummary>();
  FlowSummary& summary = *result->flow;
  wsk_flow_get_view(flow.get(), &summary.view, sizeof summary.view);
  summary.voids.assign(summary.view.voids, summary.view.voids + summary.view.void_count);
  summary.patches.assign(summary.view.patches, summary.view.patches + summary.view.patch_count);
}

static wsk_options options_of(const Arguments& arguments, const BuildCallbacks& callbacks) {
  wsk_options options;
  wsk_options_init(&options, sizeof options);
  options.method = arguments.method;
  options.spacing = arguments.spacing;
  options.smoothing = arguments.smoothing;
  options.noise = arguments.noise;
  options.soft = arguments.soft;
  options.partial = arguments.partial ? 1 : 0;
  options.find_borders = arguments.find_borders ? 1 : 0;
  options.cancel = callbacks.cancel;
  options.cancel_user = callbacks.user;
  options.progress = callbacks.progress;
  options.progress_user = callbacks.user;
  options.now = milliseconds_now;
  return options;
}

BuildResult build_surface(const Network& network, const Arguments& arguments,
                          const BuildCallbacks& callbacks) {
  const wsk_options options = options_of(arguments, callbacks);
  BuildResult result;
  wsk_report_init(&result.report, sizeof result.report);
  std::vector<wsk_curve> curves;
  if (!network.raw_curves.empty()) {
    result.prepared = integrate_curves(network.raw_curves, options, &result.report);
  } else {
    result.given = gather_curves(network);
    if (result.given.point_count < result.given.curves.size()) {
      result.prepared = connect_curves(result.given, arguments, options, &result.report);
    }
  }
  if (result.report.status != WSK_OK) return result;
  const wsk_network_view prepared = result.prepared_view();
  curves.assign(prepared.curves, prepared.curves + prepared.curve_count);
  curves.insert(curves.end(),
                result.given.curves.end() - static_cast<std::ptrdiff_t>(result.given.point_count),
                result.given.curves.end());
  wsk_report_init(&result.report, sizeof result.report);
  if (by_flow(curves, arguments.topology)) {
    build_from_flow(curves, options, arguments, &result);
  } else {
    wsk_surface* surface = nullptr;
    wsk_build(curves.data(), curves.size(), &options, &surface, &result.report);
    result.surface.reset(surface);
  }
  wsk_network_name_places(result.prepared.get(), &result.report);
  return result;
}

size_t line_of(const Network& network, const wsk_report& report) {
  if (report.curve < network.raw_curves.size()) {
    const RawCurve& curve = network.raw_curves[report.curve];
    return report.sample < curve.sample_lines.size() ? curve.sample_lines[report.sample]
                                                     : curve.line;
  }
  if (report.curve < network.curves.size()) {
    const NetworkCurve& curve = network.curves[report.curve];
    if (report.sample >= curve.vertices.size()) return curve.line;
    return network.vertex_lines[curve.vertices[report.sample]];
  }
  if (report.node < network.vertex_lines.size()) return network.vertex_lines[report.node];
  return 0;
}

std::string failure_line(const std::string& file, const Network& network,
                         const wsk_report& report) {
  if (report.status == WSK_ERROR_CANCELLED) return file + ": cancelled";
  std::string place;
  const auto add_place = [&place](const char* thing, uint32_t index) {
    if (index == WSK_NONE) return;
    place += (place.empty() ? "" : ", ") + std::string(thing) + " " + std::to_string(index);
  };
  add_place("curve", report.curve);
  if (report.curve < network.curves.size() && !network.curves[report.curve].name.empty()) {
    place += " (" + in_quotes(network.curves[report.curve].name) + ")";
  }
  add_place("sample", report.sample);
  add_place("node", report.node);
  add_place("patch", report.patch);
  if (!place.empty()) place += ": ";

  std::string sentence = report.sentence;
  if (sentence.empty()) sentence = wsk_status_name(report.status);
  const size_t line = line_of(network, report);
  if (line != 0) sentence += " (line " + std::to_string(line) + ")";
  return file + ": " + place + sentence;
}

}  // namespace wireskin_cli
