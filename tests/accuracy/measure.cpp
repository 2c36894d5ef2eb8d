#include "accuracy/measure.h"

#include <chrono>
#include <cmath>
#include <map>
#include <utility>

namespace accuracy {

using namespace networks;  // its operators on points are not found otherwise

Mesh mesh_of(const Result& result) {
  Mesh mesh;
  mesh.positions = result.positions;
  for (size_t t = 0; t < result.triangles.size(); t += 3) {
    mesh.triangles.push_back(
        {result.triangles[t], result.triangles[t + 1], result.triangles[t + 2]});
  }
  return mesh;
}

static double milliseconds(void*) {
  using namespace std::chrono;
  return duration<double, std::milli>(steady_clock::now().time_since_epoch()).count();
}

wsk_options options_for(wsk_method method, double spacing) {
  wsk_options options;
  wsk_options_init(&options, sizeof options);
  options.method = method;
  options.spacing = spacing;
  options.now = milliseconds;
  return options;
}

static std::vector<Point> points(const double* data, size_t count) {
  std::vector<Point> result(count);
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
  for (uint32_t p = 0; view.patch_guarded != nullptr && p < view.patch_count; ++p) {
    if (view.patch_guarded[p]) result->guarded.push_back(p);
  }
  wsk_surface_free(surface);
}

Result build(const wsk_curve* curves, size_t count, const wsk_options& options) {
  Result result;
  wsk_surface* surface = nullptr;
  wsk_report_init(&result.report, sizeof result.report);
  result.status = wsk_build(curves, count, &options, &surface, &result.report);
  if (result.status == WSK_OK) take(surface, &result);
  return result;
}

Result build(const Network& network, const wsk_options& options) {
  std::vector<std::vector<Point>> positions, normals;
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
    wsk_curve given = {};
    given.sample_count = curve.vertices.size();
    given.positions = positions[c][0].data();
    given.normals = normals[c][0].data();
    given.nodes = curve.vertices.data();
    given.closed = curve.closed;
    given.boundary = curve.boundary;
    curves.push_back(given);
  }
  return build(curves.data(), curves.size(), options);
}

Result build(const Network& network, wsk_method method, double spacing) {
  return build(network, options_for(method, spacing));
}

Result smooth(const BandMesh& band, wsk_method method) {
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

Error distance_error(const Result& result, const Surface& surface) {
  Error error;
  double sum = 0.0;
  size_t count = 0;
  for (size_t v = 0; v < result.positions.size(); ++v) {
    if (!result.is_free(v)) continue;
    const double distance = std::fabs(signed_distance(surface, result.positions[v]));
    sum += distance * distance;
    error.max = std::fmax(error.max, distance);
    ++count;
  }
  error.rms = count > 0 ? std::sqrt(sum / static_cast<double>(count)) : 0.0;
  return error;
}

static double angle_between(const Point& a, const Point& b) {
  return std::atan2(length(cross(a, b)), dot(a, b)) * 180.0 / 3.14159265358979323846;
}

// Over the vertices that are free, or those that are not, against the normals that `wanted` gives.
template <typename Wanted>
static Deviation deviation_of(const Result& result, bool free, const Wanted& wanted) {
  Deviation deviation;
  size_t count = 0;
  for (size_t v = 0; v < result.normals.size(); ++v) {
    if (result.is_free(v) != free) continue;
    const double angle = angle_between(result.normals[v], wanted(v));
    deviation.mean += angle;
    deviation.max = std::fmax(deviation.max, angle);
    ++count;
  }
  if (count > 0) deviation.mean /= static_cast<double>(count);
  return deviation;
}

Deviation curve_normal_deviation(const Result& result) {
  return deviation_of(result, false, [&](size_t v) { return result.constraint_normals[v]; });
}

Deviation normal_deviation(const Result& result, const Surface& surface) {
  return deviation_of(result, true, [&](size_t v) {
    return normal_at(surface, closest_point(surface, result.positions[v]));
  });
}

double unavoidable_deviation(const Result& result, const Surface& surface) {
  Mesh mesh = mesh_of(result);
  for (Point& p : mesh.positions) p = closest_point(surface, p);
  const std::vector<Point> normals = vertex_normals(mesh);
  double greatest = 0.0;
  for (size_t v = 0; v < normals.size(); ++v) {
    if (result.is_free(v)) continue;
    greatest = std::fmax(greatest, angle_between(normals[v], result.constraint_normals[v]));
  }
  return greatest;
}

// Vertices at which edges with a single triangle end.
static std::vector<bool> on_border(const Result& result) {
  std::map<std::pair<uint32_t, uint32_t>, int> uses;
  for (size_t t = 0; t < result.triangles.size(); t += 3) {
    for (size_t i = 0; i < 3; ++i) {
      ++uses[std::minmax(result.triangles[t + i], result.triangles[t + (i + 1) % 3])];
    }
  }
  std::vector<bool> border(result.positions.size(), false);
  for (const auto& [edge, count] : uses) {
    if (count == 1) border[edge.first] = border[edge.second] = true;
  }
  return border;
}

double ripple_energy(const Result& result) {
  const std::vector<bool> border = on_border(result);
  double area = 0.0, energy = 0.0;
  for (size_t t = 0; t < result.triangles.size(); t += 3) {
    const uint32_t* v = &result.triangles[t];
    const Point& a = result.positions[v[0]];
    const Point normal = cross(result.positions[v[1]] - a, result.positions[v[2]] - a);
    const double twice_area = length(normal);
    area += 0.5 * twice_area;
    if (border[v[0]] || border[v[1]] || border[v[2]]) continue;
    // The gradient, turned by a right angle and times twice the area, is the sum of H times the
    // opposite edge.
    Point turned = {0.0, 0.0, 0.0};
    for (size_t i = 0; i < 3; ++i) {
      const Point edge = result.positions[v[(i + 2) % 3]] - result.positions[v[(i + 1) % 3]];
      turned = turned + result.mean_curvature[v[i]] * edge;
    }
    energy += 0.5 * dot(turned, turned) / twice_area;
  }
  return area * energy;
}

}  // namespace accuracy
