// What noise on the samples does to the surface: the paper's figure 7. Lilium joins where its files
// are.
#include <algorithm>

#include "accuracy/cases.h"
#include "accuracy/noise.h"
#include "accuracy/real.h"
#include "accuracy/tables.h"

namespace accuracy {

namespace {

struct Level {
  const char* name;
  double position;  // of the diagonal
  double degrees;
};
const Level k_levels[] = {
    {"none", 0.0, 0.0},
    {".05 %", 0.0005, 0.0},
    {".2 %", 0.002, 0.0},
    {".5 %", 0.005, 0.0},
    {"2 degrees", 0.0, 2.0},
    {"5 degrees", 0.0, 5.0},
    {".2 %, 5 degrees", 0.002, 5.0},
};

// Curves as given, smoothed by cross validation, and soft with a cutoff in spacings.
struct Treatment {
  const char* name;
  wsk_method method;
  wsk_smoothing smoothing;
  double soft;
};
const Treatment k_treatments[] = {
    {"stanko", WSK_METHOD_STANKO, WSK_SMOOTHING_NONE, 0.0},
    {"stanko, soft", WSK_METHOD_STANKO, WSK_SMOOTHING_NONE, 4.0},
    {"fair, not smoothed", WSK_METHOD_FAIR, WSK_SMOOTHING_NONE, 0.0},
    {"fair", WSK_METHOD_FAIR, WSK_SMOOTHING_AUTO, 0.0},
    {"fair, soft", WSK_METHOD_FAIR, WSK_SMOOTHING_NONE, 4.0},
};

bool is_held(const Treatment& m) { return m.smoothing == WSK_SMOOTHING_AUTO; }

struct Shape {
  std::string name;
  networks::Network network;
  double spacing;
  std::function<double(const Result&)> rms;
  bool held;  // to the bound on ripples
};

std::vector<Shape> shapes() {
  std::vector<Shape> result;
  const std::vector<Case> cases = cases_with_bounds();
  const std::pair<size_t, double> chosen[] = {{0, 0.05}, {3, 0.24}, {4, 0.05}};
  for (const auto& [index, spacing] : chosen) {
    const Case c = cases[index];
    result.push_back({c.name, c.network(spacing), spacing,
                      [c](const Result& r) { return distance_error(r, c.truth).rms; }, false});
  }
  for (const RealCase& c : lilium()) {
    result.push_back({c.name, c.network, c.spacing,
                      [c](const Result& r) { return real_error(r, c).rms; }, true});
  }
  return result;
}

// Angles against the normals before the noise: of the mesh on the curves, through the nearest
// sample of the clean network.
Deviation against_clean(const Result& result, const networks::Network& clean) {
  Deviation deviation;
  size_t count = 0;
  for (size_t v = 0; v < result.positions.size(); ++v) {
    if (result.is_free(v)) continue;
    size_t best = 0;
    double least = 1e300;
    for (size_t i = 0; i < clean.positions.size(); ++i) {
      const double d = networks::distance(result.positions[v], clean.positions[i]);
      if (d < least) {
        least = d;
        best = i;
      }
    }
    const double cosine = networks::dot(result.normals[v], networks::unit(clean.normals[best]));
    const double angle = std::acos(std::clamp(cosine, -1.0, 1.0)) * 180.0 / 3.14159265358979;
    deviation.mean += angle;
    deviation.max = std::max(deviation.max, angle);
    ++count;
  }
  if (count > 0) deviation.mean /= static_cast<double>(count);
  return deviation;
}

void noise_rows(Page& page, Bounds& bounds, const Shape& shape, const Treatment& m) {
  const double size = diagonal(shape.network);
  double clean_ripples = 0.0;
  for (const Level& level : k_levels) {
    const networks::Network noisy = with_noise(shape.network, level.position * size, level.degrees);
    wsk_options options = options_for(m.method, shape.spacing);
    options.smoothing = m.smoothing;
    options.soft = m.soft * shape.spacing;
    const Result result = build(noisy, options);
    const std::string what = shape.name + ", " + m.name + ", noise " + level.name;
    const bool held = is_held(m);
    if (held) bounds.built(what, result);
    if (result.status != WSK_OK) {
      page.row({shape.name, m.name, level.name, wsk_status_name(result.status), "", "", "", ""});
      continue;
    }
    const double ripples = ripple_energy(result);
    if (clean_ripples == 0.0) clean_ripples = ripples;
    const Deviation given = curve_normal_deviation(result);
    const Deviation clean = against_clean(result, shape.network);
    page.row({shape.name, m.name, level.name, text("%.2e", shape.rms(result)),
              text("%.2f / %.2f", given.mean, given.max),
              text("%.2f / %.2f", clean.mean, clean.max), text("%.3g", ripples),
              clean_ripples > 10.0 ? text("%.2f", ripples / clean_ripples) : ""});
    if (held && shape.held && level.position <= 0.002) {
      bounds.at_most(what + ", ripples", ripples / clean_ripples, 1.3);
    }
  }
}

}  // namespace

void noise_table(Page& page, Bounds& bounds) {
  page.heading("Noise");
  page.paragraph(
      "Gaussian noise on every sample: positions in percent of the diagonal (each coordinate), "
      "normals in degrees (each tangent). Samples are as far apart as the vertices of the mesh. "
      "Curve normals against those that the method used and, through the nearest sample, those "
      "before the noise. Soft: a cutoff of four spacings. Ripples: area times the integral of "
      "|grad H|^2, and that over its value "
      "without noise where that is not nearly 0.");
  page.header({"shape", "method", "noise", "RMS", "curve normals, used", "curve normals, clean",
               "ripples", "over clean"});
  for (const Shape& shape : shapes()) {
    for (const Treatment& m : k_treatments) {
      if (bounds.alone() && !is_held(m)) continue;
      noise_rows(page, bounds, shape, m);
    }
  }
  page.end_table();
}

}  // namespace accuracy
