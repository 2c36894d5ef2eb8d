#include "accuracy/measure.h"

#include <chrono>
#include <cmath>

namespace accuracy {

static double milliseconds(void*) {
  using namespace std::chrono;
  return duration<double, std::milli>(steady_clock::now().time_since_epoch()).count();
}

static wsk_options options_for(wsk_method method, double spacing) {
  wsk_options options;
  wsk_options_init(&options, sizeof options);
  options.method = method;
  options.spacing = spacing;
  options.now = milliseconds;
  return options;
}

static std::vector<networks::Point> points(const double* data, size_t count) {
  std::vector<networks::Point> result(count);
  for (size_t i = 0; i < count; ++i) result[i] = {data[3 * i], data[3 * i + 1], data[3 * i + 2]};
  return result;
}

// Copies the arrays and frees the handle.
static void take(wsk_surface* surface, Result* result) {
  wsk_surface_view view;
  wsk_surface_get_view(surface, &view, sizeof view);
  result->positions = points(view.positions, view.vertex_count);
  result->normals = points(view.normals, view.vertex_count);
  result->constraint_normals = points(view.constraint_normals, view.vertex_count);
  result->mean_curvature.assign(view.mean_curvature, view.mean_curvature + view.vertex_count);
  result->vertex_curve.assign(view.vertex_curve, view.vertex_curve + view.vertex_count);
  result->triangles.assign(view.triangles, view.triangles + 3 * view.triangle_count);
  result->patches.assign(view.triangle_patch, view.triangle_patch + view.triangle_count);
  wsk_surface_free(surface);
}

Result build(const networks::Network& network, wsk_method method, double spacing) {
  std::vector<std::vector<networks::Point>> positions, normals;
  for (const auto& curve : network.curves) {
    positions.emplace_back();
    normals.emplace_back();
    for (uint32_t v : curve.vertices) {
      positions.back().push_back(network.positions[v]);
      normals.back().push_back(network.normals[v]);
    }
  }
  std::vector<wsk_curve> curves;
  for (size_t c = 0; c < network.curves.size(); ++c) {
    const auto& curve = network.curves[c];
    wsk_curve one = {};
    one.sample_count = curve.vertices.size();
    one.positions = positions[c][0].data();
    one.normals = normals[c][0].data();
    one.nodes = curve.vertices.data();
    one.closed = curve.closed;
    one.boundary = curve.boundary;
    curves.push_back(one);
  }
  const wsk_options options = options_for(method, spacing);
  Result result;
  wsk_surface* surface = nullptr;
  wsk_report_init(&result.report, sizeof result.report);
  result.status = wsk_build(curves.data(), curves.size(), &options, &surface, &result.report);
  if (result.status == WSK_OK) take(surface, &result);
  return result;
}

Result smooth(const networks::BandMesh& band, wsk_method method) {
  const wsk_mesh mesh = {band.positions.size(),
                         band.positions[0].data(),
                         0,
                         band.normals[0].data(),
                         0,
                         band.constrained.data(),
                         band.triangles.size(),
                         band.triangles[0].data()};
  const wsk_options options = options_for(method, 0.0);
  Result result;
  wsk_surface* surface = nullptr;
  wsk_report_init(&result.report, sizeof result.report);
  result.status = wsk_smooth_mesh(&mesh, &options, &surface, &result.report);
  if (result.status == WSK_OK) take(surface, &result);
  return result;
}

Error distance_error(const Result& result, const networks::Surface& surface) {
  Error error;
  double sum = 0.0;
  size_t count = 0;
  for (size_t v = 0; v < result.positions.size(); ++v) {
    if (!result.is_free(v)) continue;
    const double distance = std::fabs(networks::signed_distance(surface, result.positions[v]));
    sum += distance * distance;
    error.max = std::fmax(error.max, distance);
    ++count;
  }
  error.rms = count > 0 ? std::sqrt(sum / static_cast<double>(count)) : 0.0;
  return error;
}

Deviation curve_normal_deviation(const Result& result) {
  Deviation deviation;
  size_t count = 0;
  for (size_t v = 0; v < result.normals.size(); ++v) {
    if (result.is_free(v)) continue;
    const networks::Point& a = result.normals[v];
    const networks::Point& b = result.constraint_normals[v];
    const double angle =
        std::atan2(networks::length(networks::cross(a, b)), networks::dot(a, b)) * 180.0 / M_PI;
    deviation.mean += angle;
    deviation.max = std::fmax(deviation.max, angle);
    ++count;
  }
  if (count > 0) deviation.mean /= static_cast<double>(count);
  return deviation;
}

}  // namespace accuracy
