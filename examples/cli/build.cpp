#include "build.h"

#include <chrono>
#include <vector>

namespace wireskin_cli {

// Copies of the samples of all curves, one after the other, because the library wants the samples
// of a curve in order.
struct Samples {
  std::vector<double> positions;
  std::vector<double> normals;
  std::vector<uint32_t> nodes;
};

static Samples gather_samples(const Network& network) {
  Samples samples;
  for (const NetworkCurve& curve : network.curves) {
    for (const uint32_t vertex : curve.vertices) {
      for (size_t k = 0; k < 3; ++k) {
        samples.positions.push_back(network.positions[3 * size_t{vertex} + k]);
        if (!network.normals.empty()) {
          samples.normals.push_back(network.normals[3 * size_t{vertex} + k]);
        }
      }
      samples.nodes.push_back(vertex);
    }
  }
  return samples;
}

static std::vector<wsk_curve> curves_of(const Network& network, const Samples& samples) {
  std::vector<wsk_curve> curves;
  size_t first = 0;
  for (const NetworkCurve& curve : network.curves) {
    wsk_curve c = {};
    c.sample_count = curve.vertices.size();
    c.positions = samples.positions.data() + 3 * first;
    if (!samples.normals.empty() && !curve.sharp) c.normals = samples.normals.data() + 3 * first;
    c.nodes = samples.nodes.data() + first;
    c.closed = curve.closed ? 1 : 0;
    c.boundary = curve.boundary ? 1 : 0;
    c.sharp = curve.sharp ? 1 : 0;
    curves.push_back(c);
    first += curve.vertices.size();
  }
  return curves;
}

static double milliseconds_now(void*) {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration<double, std::milli>(now).count();
}

static bool by_flow(const Network& network, const Arguments& arguments) {
  if (arguments.topology != TopologyChoice::automatic) {
    return arguments.topology == TopologyChoice::flow;
  }
  bool missing = false;
  for (const NetworkCurve& curve : network.curves) {
    missing = missing || (network.normals.empty() && !curve.sharp);
  }
  return missing;
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
  result->flow = std::make_unique<FlowSummary>();
  FlowSummary& summary = *result->flow;
  wsk_flow_get_view(flow.get(), &summary.view, sizeof summary.view);
  summary.voids.assign(summary.view.voids, summary.view.voids + summary.view.void_count);
  summary.patches.assign(summary.view.patches, summary.view.patches + summary.view.patch_count);
}

BuildResult build_surface(const Network& network, const Arguments& arguments,
                          const BuildCallbacks& callbacks) {
  wsk_options options;
  wsk_options_init(&options, sizeof options);
  options.method = arguments.method;
  options.spacing = arguments.spacing;
  options.smoothing = arguments.smoothing;
  options.noise = arguments.noise;
  options.soft = arguments.soft;
  options.cancel = callbacks.cancel;
  options.cancel_user = callbacks.user;
  options.progress = callbacks.progress;
  options.progress_user = callbacks.user;
  options.now = milliseconds_now;

  const Samples samples = gather_samples(network);
  const std::vector<wsk_curve> curves = curves_of(network, samples);
  BuildResult result;
  wsk_report_init(&result.report, sizeof result.report);
  if (by_flow(network, arguments)) {
    build_from_flow(curves, options, arguments, &result);
    return result;
  }
  wsk_surface* surface = nullptr;
  if (wsk_build(curves.data(), curves.size(), &options, &surface, &result.report) == WSK_OK) {
    result.surface.reset(surface);
  }
  return result;
}

// The line of the file that the place speaks of; 0 if there is none.
static size_t line_of(const Network& network, const wsk_report& report) {
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
