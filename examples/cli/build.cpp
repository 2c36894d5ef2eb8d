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

BuildResult build_surface(const Network& network, const Arguments& arguments,
                          const BuildCallbacks& callbacks) {
  wsk_options options;
  wsk_options_init(&options, sizeof options);
  options.method = arguments.method;
  options.spacing = arguments.spacing;
  options.smoothing = arguments.smoothing;
  options.noise = arguments.noise;
  options.soft = arguments.soft;
  options.partial = arguments.partial ? 1 : 0;
  options.cancel = callbacks.cancel;
  options.cancel_user = callbacks.user;
  options.progress = callbacks.progress;
  options.progress_user = callbacks.user;
  options.now = milliseconds_now;

  const Samples samples = gather_samples(network);
  const std::vector<wsk_curve> curves = curves_of(network, samples);
  BuildResult result;
  wsk_report_init(&result.report, sizeof result.report);
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
