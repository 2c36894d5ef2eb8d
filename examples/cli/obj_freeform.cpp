#include "obj_freeform.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "spline.h"

namespace wireskin_cli {

void FreeformReader::begin_curve(const LineScanner& scanner, NetworkCurve&& controls) {
  if (type_.empty()) scanner.fail("a curve (curv) without a kind (cstype) before it");
  if (type_ != "bspline" && type_ != "bezier") {
    scanner.fail("curves of the kind " + in_quotes(type_) +
                 " are not read: write them as bspline, bezier or polylines (l)");
  }
  if (degree_ == 0) scanner.fail("a curve (curv) without a degree (deg) before it");
  FreeformCurve curve;
  curve.controls = std::move(controls);
  curve.type = type_;
  curve.rational = rational_;
  curve.degree = degree_;
  curve.first = scanner.number(1);
  curve.last = scanner.number(2);
  if (!(curve.first < curve.last)) scanner.fail("the range of the curve (curv) is empty");
  curves_.push_back(std::move(curve));
  in_curve_ = true;
}

void FreeformReader::read_statement(const LineScanner& scanner) {
  const std::vector<std::string_view>& columns = scanner.columns();
  const std::string_view keyword = columns[0];
  if (keyword == "cstype") {
    rational_ = columns.size() > 2 && columns[1] == "rat";
    if (columns.size() < 2) scanner.fail("the kind of curves (cstype) is missing");
    type_ = lower_case(columns[rational_ ? 2 : 1]);
  } else if (keyword == "deg") {
    if (columns.size() < 2) scanner.fail("the degree (deg) is missing");
    const uint32_t degree = scanner.count(1, "a degree");
    if (degree == 0 || degree > k_max_degree) {
      scanner.fail("a degree of " + std::to_string(degree) + ", those from 1 to " +
                   std::to_string(k_max_degree) + " are read");
    }
    degree_ = degree;
  } else if (keyword == "parm") {
    if (!in_curve_ || columns.size() < 2 || columns[1] != "u") return;
    for (size_t k = 2; k < columns.size(); ++k) {
      curves_.back().parameters.push_back(scanner.number(k));
    }
  } else if (keyword == "end" || keyword == "surf" || keyword == "curv2") {
    in_curve_ = false;
  }
}

void FreeformReader::check(
    const std::function<void(const std::vector<NetworkCurve>&)>& check_indices) const {
  for (const FreeformCurve& curve : curves_) check_indices({curve.controls});
}

static std::vector<double> knots_of(const LineScanner& scanner, const FreeformCurve& curve) {
  const size_t p = curve.degree;
  const size_t n = curve.controls.vertices.size();
  const std::vector<double>& given = curve.parameters;
  const std::string counts = std::to_string(n) + " control points of degree " + std::to_string(p);
  if (curve.type == "bezier") {
    if ((n - 1) % p != 0) scanner.fail_at(curve.controls.line, counts + " make no Bezier curves");
    const size_t pieces = (n - 1) / p;
    std::vector<double> breaks = given;
    if (given.size() != pieces + 1) {
      if (!given.empty()) {
        scanner.fail_at(curve.controls.line, std::to_string(given.size()) +
                                                 " parameters (parm u) for " + counts + ", not " +
                                                 std::to_string(pieces + 1));
      }
      for (size_t i = 0; i <= pieces; ++i) breaks.push_back(static_cast<double>(i));
    }
    return bezier_knots(p, breaks);
  }
  std::vector<double> knots = given;
  if (n > p && given.size() == n + p - 1 && !given.empty()) {
    // Some modellers leave out the first and the last knot, which the curve does not depend on.
    knots.insert(knots.begin(), knots.front());
    knots.push_back(knots.back());
  }
  if (n <= p || knots.size() != n + p + 1) {
    scanner.fail_at(curve.controls.line, std::to_string(given.size()) + " knots (parm u) for " +
                                             counts + ", not " + std::to_string(n + p + 1));
  }
  return knots;
}

// Control points as (w x, w y, w z, w, nx, ny, nz).
static Spline spline_of(const LineScanner& scanner, const FreeformCurve& curve,
                        const Network& network, const std::vector<double>& weights) {
  Spline spline;
  spline.degree = curve.degree;
  spline.dimension = 7;
  for (const uint32_t v : curve.controls.vertices) {
    const double weight = curve.rational ? weights[v] : 1.0;
    if (!(weight > 0.0) || !std::isfinite(weight)) {
      scanner.fail_at(network.vertex_lines[v], "the weight of a control point is not above zero");
    }
    const double* p = &network.positions[3 * size_t{v}];
    const bool known = network.normal_known(v);
    const double* n = known ? &network.normals[3 * size_t{v}] : nullptr;
    for (size_t k = 0; k < 3; ++k) spline.controls.push_back(weight * p[k]);
    spline.controls.push_back(weight);
    for (size_t k = 0; k < 3; ++k) spline.controls.push_back(known ? n[k] : 0.0);
  }
  spline.knots = knots_of(scanner, curve);
  if (const char* fault = fault_of_knots(spline)) scanner.fail_at(curve.controls.line, fault);
  return spline;
}

static uint32_t add_sample(const Spline& spline, double parameter, size_t line, bool normal_known,
                           Network& network) {
  double values[7];
  spline_point(spline, parameter, values);
  const uint32_t vertex = static_cast<uint32_t>(network.vertex_count());
  for (size_t k = 0; k < 3; ++k) network.positions.push_back(values[k] / values[3]);
  network.vertex_lines.push_back(line);
  if (network.normals.empty()) return vertex;
  for (size_t k = 4; k < 7; ++k) network.normals.push_back(normal_known ? values[k] : 0.0);
  if (!network.has_normal.empty() || !normal_known) {
    network.has_normal.resize(vertex, 1);
    network.has_normal.push_back(normal_known ? 1 : 0);
  }
  return vertex;
}

// The ends of a periodic spline are the same point but for rounding.
static bool ends_meet(const std::vector<uint32_t>& vertices, const Network& network) {
  const double* first = &network.positions[3 * size_t{vertices.front()}];
  const double* last = &network.positions[3 * size_t{vertices.back()}];
  double gap = 0.0, extent = 0.0;
  for (size_t k = 0; k < 3; ++k) {
    gap = std::max(gap, std::fabs(first[k] - last[k]));
    for (const uint32_t v : vertices) {
      extent = std::max(extent, std::fabs(network.positions[3 * size_t{v} + k] - first[k]));
    }
  }
  return vertices.size() > 3 && gap <= 1e-9 * extent;
}

static NetworkCurve sample_curve(const LineScanner& scanner, const FreeformCurve& curve,
                                 const std::vector<double>& weights, Network& network) {
  const Spline spline = spline_of(scanner, curve, network, weights);
  NetworkCurve result = curve.controls;
  const std::vector<uint32_t>& controls = curve.controls.vertices;
  const bool normals_known = std::all_of(controls.begin(), controls.end(),
                                         [&](uint32_t v) { return network.normal_known(v); });
  // Where parameters were not given the range has no meaning.
  double first = curve.parameters.empty() ? spline.knots.front() : curve.first;
  double last = curve.parameters.empty() ? spline.knots.back() : curve.last;
  if (!(first < spline.knots[controls.size()]) || !(last > spline.knots[curve.degree])) {
    scanner.fail_at(curve.controls.line, "the range of the curve (curv) lies outside its knots");
  }
  result.vertices.clear();
  for (const SplineSample& sample : spline_samples(spline, first, last)) {
    result.vertices.push_back(
        sample.control != k_no_control
            ? controls[sample.control]
            : add_sample(spline, sample.parameter, curve.controls.line, normals_known, network));
  }
  close_if_first_is_last(result);
  if (!result.closed && ends_meet(result.vertices, network)) {
    result.vertices.pop_back();
    result.closed = true;
  }
  return result;
}

void FreeformReader::sample_all(const LineScanner& scanner, Network& network) const {
  for (const FreeformCurve& curve : curves_) {
    network.curves.push_back(sample_curve(scanner, curve, weights_, network));
  }
}

}  // namespace wireskin_cli
