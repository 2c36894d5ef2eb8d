#include "spline.h"

#include <algorithm>
#include <cmath>

namespace wireskin_cli {

std::vector<double> bezier_knots(size_t degree, const std::vector<double>& breaks) {
  std::vector<double> knots;
  for (const double value : breaks) knots.insert(knots.end(), degree, value);
  if (!knots.empty()) {
    knots.insert(knots.begin(), knots.front());
    knots.push_back(knots.back());
  }
  return knots;
}

const char* fault_of_knots(const Spline& spline) {
  const size_t p = spline.degree;
  const size_t n = spline.control_count();
  const std::vector<double>& t = spline.knots;
  for (size_t i = 0; i < t.size(); ++i) {
    if (!std::isfinite(t[i])) return "a knot is not finite";
    if (i > 0 && t[i] < t[i - 1]) return "the knots decrease";
  }
  if (!(t[p] < t[n]) || !std::isfinite(t[n] - t[p])) return "the knots span no range";
  // Inside, a knot more multiple than the degree tears the curve apart.
  for (size_t i = p + 1; i + p < n; ++i) {
    if (t[i] == t[i + p]) return "a knot inside is repeated more often than the degree";
  }
  return nullptr;
}

// The control point at the knots equal to `u`, which lies in the range of the curve.
static uint32_t control_at(const Spline& spline, double u) {
  const std::vector<double>& t = spline.knots;
  const size_t p = spline.degree;
  const auto range = std::equal_range(t.begin(), t.end(), u);
  if (range.second - range.first < static_cast<std::ptrdiff_t>(p)) return k_no_control;
  const size_t first = static_cast<size_t>(range.first - t.begin());
  const size_t last = static_cast<size_t>(range.second - t.begin()) - 1;
  // The start counts its knots from the back: it may have more of them than the degree.
  const size_t control = u == t[p] ? last - p : first - 1;
  return static_cast<uint32_t>(control);
}

std::vector<SplineSample> spline_samples(const Spline& spline, double first, double last) {
  const std::vector<double>& t = spline.knots;
  const size_t p = spline.degree;
  const size_t n = spline.control_count();
  first = std::max(first, t[p]);
  last = std::min(last, t[n]);
  std::vector<double> breaks = {first};
  for (size_t i = p + 1; i < n; ++i) {
    if (t[i] > breaks.back() && t[i] < last) breaks.push_back(t[i]);
  }
  breaks.push_back(last);
  // Between knots the curve is a polynomial: a few samples determine it, more draw a single one.
  constexpr size_t k_least = 8, k_all = 32;
  const size_t steps = p == 1 ? 1 : std::max(k_least, k_all / (breaks.size() - 1));
  std::vector<SplineSample> samples;
  for (size_t i = 0; i + 1 < breaks.size(); ++i) {
    samples.push_back({breaks[i], control_at(spline, breaks[i])});
    for (size_t k = 1; k < steps; ++k) {
      const double part = static_cast<double>(k) / static_cast<double>(steps);
      const double u = breaks[i] + part * (breaks[i + 1] - breaks[i]);
      // Between two neighbouring doubles there is no room.
      if (u > samples.back().parameter && u < breaks[i + 1]) samples.push_back({u, k_no_control});
    }
  }
  samples.push_back({last, control_at(spline, last)});
  return samples;
}

void spline_point(const Spline& spline, double parameter, double* point) {
  const std::vector<double>& t = spline.knots;
  const size_t p = spline.degree;
  const size_t n = spline.control_count();
  // The span with t[span] <= parameter < t[span + 1]; the end belongs to the last one.
  const auto begin = t.begin() + static_cast<std::ptrdiff_t>(p);
  const auto end = t.begin() + static_cast<std::ptrdiff_t>(n);
  auto above = std::upper_bound(begin, end, parameter);
  if (above == end) above = std::lower_bound(begin, end, t[n]);
  const size_t span = static_cast<size_t>(above - t.begin()) - 1;
  const size_t d = spline.dimension;
  const auto first = spline.controls.begin() + static_cast<std::ptrdiff_t>((span - p) * d);
  std::vector<double> work(first, first + static_cast<std::ptrdiff_t>((p + 1) * d));
  for (size_t level = 1; level <= p; ++level) {
    for (size_t j = p; j >= level; --j) {
      const double low = t[span + j - p];
      const double part = (parameter - low) / (t[span + j - level + 1] - low);
      for (size_t k = 0; k < d; ++k) {
        work[j * d + k] = (1.0 - part) * work[(j - 1) * d + k] + part * work[j * d + k];
      }
    }
  }
  std::copy_n(work.begin() + static_cast<std::ptrdiff_t>(p * d), d, point);
}

}  // namespace wireskin_cli
