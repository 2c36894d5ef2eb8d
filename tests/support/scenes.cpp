#include "support/scenes.h"

#include <algorithm>
#include <cinttypes>
#include <cstdio>
#include <cstring>
#include <utility>

#include "support/scene_parts.h"

namespace scenes {

Scene octants() {
  Scene scene;
  scene.name = "octants";
  scene.spacing = 0.157;
  const std::vector<Point2> points = circle(8);
  scene.curves.push_back(section(points, 0, 1, {1.0, 1.0, 1.0}));
  scene.curves.push_back(section(points, 1, 2, {1.0, 1.0, 1.0}));
  scene.curves.push_back(section(points, 2, 0, {1.0, 1.0, 1.0}));
  return scene;
}

Scene ellipsoid() {
  // Rational points (1 - t^2, 2t) / (1 + t^2): denser towards the end of each quarter.
  std::vector<Point2> points;
  for (int turn = 0; turn < 4; ++turn) {
    for (int i = 0; i < 9; ++i) {
      const double t = i / 9.0, w = 1.0 + t * t;
      Point2 p = {(1.0 - t * t) / w, 2.0 * t / w};
      for (int k = 0; k < turn; ++k) p = {-p.y, p.x};
      points.push_back(p);
    }
  }
  Scene scene;
  scene.name = "ellipsoid";
  scene.spacing = 0.19;
  const std::array<double, 3> radii = {1.0, 1.17, 0.83};
  scene.curves.push_back(section(points, 0, 1, radii));
  scene.curves.push_back(section(points, 1, 2, radii));
  scene.curves.push_back(section(points, 2, 0, radii));
  return scene;
}

static Curve saddle_line(bool along_x, int fixed) {
  Curve curve;
  curve.boundary = fixed != 0;
  for (int i = 0; i <= 8; ++i) {
    const double moving = -1.0 + i / 4.0;
    const double x = along_x ? moving : fixed, y = along_x ? fixed : moving;
    const int column = along_x ? i / 4 : fixed + 1, row = along_x ? fixed + 1 : i / 4;
    const uint32_t node = i % 4 == 0 ? static_cast<uint32_t>(3 * row + column) : WSK_NONE;
    add_sample(curve, {x, y, (x * x - y * y) / 2.0}, {-x, y, 1.0}, node);
  }
  return curve;
}

Scene saddle() {
  Scene scene;
  scene.name = "saddle";
  scene.spacing = 0.125;
  for (int fixed = -1; fixed <= 1; ++fixed) {
    scene.curves.push_back(saddle_line(true, fixed));
    scene.curves.push_back(saddle_line(false, fixed));
  }
  return scene;
}

Scene band() {
  constexpr uint32_t k_rows = 9;
  Scene scene;
  scene.name = "band";
  scene.way = Way::smooth_mesh;
  const std::vector<Point2> points = circle(8);
  const uint32_t around = static_cast<uint32_t>(points.size());
  for (uint32_t row = 0; row < k_rows; ++row) {
    const double z = -0.75 + 1.5 * row / (k_rows - 1);
    const double lean = row == 0 ? -0.5 : row == k_rows - 1 ? 0.5 : 0.0;
    for (const Point2& p : points) {
      scene.positions.insert(scene.positions.end(), {p.x, p.y, z});
      scene.normals.insert(scene.normals.end(), {p.x, p.y, lean});
      scene.constrained.push_back(row == 0 || row == k_rows - 1);
    }
  }
  for (uint32_t row = 0; row + 1 < k_rows; ++row) {
    for (uint32_t i = 0; i < around; ++i) {
      const uint32_t a = row * around + i, b = row * around + (i + 1) % around;
      const uint32_t c = b + around, d = a + around;
      scene.triangles.insert(scene.triangles.end(), {a, b, c, a, c, d});
    }
  }
  return scene;
}

Scene noisy() {
  Scene scene = ellipsoid();
  scene.name = "noisy";
  scene.method = WSK_METHOD_FAIR;
  scene.spacing = 0.3;
  uint32_t state = 1;  // a linear congruential generator: the same noise everywhere
  for (Curve& curve : scene.curves) {
    for (size_t i = 0; i < curve.size(); ++i) {
      if (curve.nodes[i] != WSK_NONE) continue;
      for (size_t k = 0; k < 3; ++k) {
        state = state * 1664525u + 1013904223u;
        curve.positions[3 * i + k] += 0.01 * (static_cast<double>(state >> 8) / 16777216.0 - 0.5);
      }
    }
  }
  return scene;
}

template <typename T>
static const T* data_or_null(const std::vector<T>& values) {
  return values.empty() ? nullptr : values.data();
}

std::vector<wsk_curve> curves_of(const Scene& scene) {
  std::vector<wsk_curve> curves;
  for (const Curve& from : scene.curves) {
    wsk_curve curve = {};
    curve.sample_count = from.size();
    curve.positions = from.positions.data();
    curve.normals = data_or_null(from.normals);
    curve.nodes = from.nodes.data();
    curve.closed = from.closed;
    curve.boundary = from.boundary;
    curve.soft = from.soft;
    curve.sharp = from.sharp;
    curve.normals_right = data_or_null(from.normals_right);
    curves.push_back(curve);
  }
  return curves;
}

wsk_mesh mesh_of(const Scene& scene) {
  wsk_mesh mesh = {};
  mesh.vertex_count = scene.constrained.size();
  mesh.positions = scene.positions.data();
  mesh.normals = scene.normals.data();
  mesh.constrained = scene.constrained.data();
  mesh.triangle_count = scene.triangles.size() / 3;
  mesh.triangles = scene.triangles.data();
  return mesh;
}

wsk_options options_of(const Scene& scene) {
  wsk_options options;
  wsk_options_init(&options, sizeof options);
  options.spacing = scene.spacing;
  options.method = scene.method;
  options.smoothing = scene.smoothing;
  options.noise = scene.noise;
  options.soft = scene.soft;
  options.partial = scene.partial;
  options.find_borders = scene.find_borders;
  return options;
}

template <typename T>
static std::vector<T> copied(const T* from, size_t count) {
  return from == nullptr ? std::vector<T>() : std::vector<T>(from, from + count);
}

static wsk_status connect_curves(const Scene& scene, const wsk_options& options,
                                 wsk_network** network, wsk_report* report) {
  wsk_connect_options how;
  wsk_connect_options_init(&how, sizeof how);
  how.orient = scene.orient;
  how.options = &options;
  const std::vector<wsk_curve> curves = curves_of(scene);
  return wsk_connect(curves.data(), curves.size(), &how, network, report);
}

static wsk_status integrate_curves(const Scene& scene, const wsk_options& options,
                                   wsk_network** network, wsk_report* report) {
  std::vector<wsk_sensor_curve> sensors;
  for (const SensorCurve& from : scene.sensors) {
    wsk_sensor_curve sensor = {};
    sensor.sample_count = from.arc_lengths.size();
    sensor.arc_lengths = from.arc_lengths.data();
    sensor.tangents = from.tangents.data();
    sensor.normals = from.rest.normals.data();
    sensor.nodes = from.rest.nodes.data();
    sensor.closed = from.rest.closed;
    sensor.boundary = from.rest.boundary;
    sensor.tangents_to_next = scene.tangents_to_next;
    sensors.push_back(sensor);
  }
  return wsk_integrate(sensors.data(), sensors.size(), &options, network, report);
}

// The network as curves of a scene, so that the library's own can be freed.
static std::vector<Curve> curves_of(const wsk_network* network) {
  wsk_network_view view;
  wsk_network_get_view(network, &view, sizeof view);
  std::vector<Curve> curves;
  for (uint32_t c = 0; c < view.curve_count; ++c) {
    const wsk_curve& from = view.curves[c];
    Curve curve;
    curve.positions = copied(from.positions, 3 * from.sample_count);
    curve.normals = copied(from.normals, 3 * from.sample_count);
    curve.nodes = copied(from.nodes, from.sample_count);
    curve.closed = from.closed != 0;
    curve.boundary = from.boundary != 0;
    curves.push_back(curve);
  }
  return curves;
}

static wsk_status run_network(const Scene& scene, const wsk_options& options, wsk_surface** surface,
                              wsk_report* report) {
  wsk_network* network = nullptr;
  const wsk_status status = scene.way == Way::connect
                                ? connect_curves(scene, options, &network, report)
                                : integrate_curves(scene, options, &network, report);
  if (status != WSK_OK) return status;
  Scene joined = scene;
  joined.way = Way::build;
  joined.curves = curves_of(network);
  wsk_network_free(network);
  const size_t peak = report != nullptr ? report->peak_bytes : 0;
  const wsk_status built = run(joined, options, surface, report);
  if (report != nullptr) report->peak_bytes = std::max(peak, report->peak_bytes);
  return built;
}

static wsk_status run_flow(const Scene& scene, const wsk_options& options, wsk_surface** surface,
                           wsk_report* report) {
  wsk_flow_options how;
  wsk_flow_options_init(&how, sizeof how);
  how.sampling = scene.spacing / 2;
  how.voids = scene.voids;
  how.raw = scene.raw;
  how.most_tetrahedra = scene.most_tetrahedra;
  const std::vector<wsk_curve> curves = curves_of(scene);
  wsk_flow* flow = nullptr;
  wsk_status status = wsk_flow_build(curves.data(), curves.size(), &options, &how, &flow, report);
  if (status != WSK_OK) return status;
  const size_t peak = report != nullptr ? report->peak_bytes : 0;
  status = wsk_flow_surface(flow, &options, &how, surface, report);
  if (report != nullptr) report->peak_bytes = std::max(peak, report->peak_bytes);
  wsk_flow_free(flow);
  return status;
}

wsk_status run(const Scene& scene, const wsk_options& options, wsk_surface** surface,
               wsk_report* report) {
  if (scene.way == Way::connect || scene.way == Way::integrate) {
    return run_network(scene, options, surface, report);
  }
  if (scene.way == Way::flow) return run_flow(scene, options, surface, report);
  if (scene.way == Way::smooth_mesh) {
    const wsk_mesh mesh = mesh_of(scene);
    return wsk_smooth_mesh(&mesh, &options, surface, report);
  }
  const std::vector<wsk_curve> curves = curves_of(scene);
  return wsk_build(curves.data(), curves.size(), &options, surface, report);
}

Result copy_of(const wsk_surface* surface) {
  wsk_surface_view view;
  wsk_surface_get_view(surface, &view, sizeof view);
  const size_t vertices = view.vertex_count, triangles = view.triangle_count;
  Result result;
  result.patch_count = view.patch_count;
  result.positions = copied(view.positions, 3 * vertices);
  result.normals = copied(view.normals, 3 * vertices);
  result.mean_curvature = copied(view.mean_curvature, vertices);
  result.constraint_normals = copied(view.constraint_normals, 3 * vertices);
  result.vertex_curve = copied(view.vertex_curve, vertices);
  result.triangles = copied(view.triangles, 3 * triangles);
  result.triangle_patch = copied(view.triangle_patch, triangles);
  result.curve_edges = copied(view.curve_edges, 2 * size_t{view.curve_edge_count});
  result.curve_edge_curve = copied(view.curve_edge_curve, view.curve_edge_count);
  result.crease_corners = copied(view.crease_corners, view.crease_corner_count);
  result.crease_normals = copied(view.crease_normals, 3 * size_t{view.crease_corner_count});
  if (view.patch_guarded != nullptr) {
    result.patch_guarded.assign(view.patch_guarded, view.patch_guarded + view.patch_count);
  }
  return result;
}

static void hash_bits(uint64_t* hash, uint64_t bits, int bytes) {
  for (int i = 0; i < bytes; ++i) {
    *hash ^= (bits >> (8 * i)) & 0xff;
    *hash *= 0x100000001b3u;
  }
}

static void hash_array(uint64_t* hash, const std::vector<double>& values) {
  hash_bits(hash, values.size(), 8);
  for (const double value : values) {
    uint64_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    hash_bits(hash, bits, 8);
  }
}

static void hash_array(uint64_t* hash, const std::vector<uint32_t>& values) {
  hash_bits(hash, values.size(), 8);
  for (const uint32_t value : values) hash_bits(hash, value, 4);
}

constexpr uint64_t k_hash_start = 0xcbf29ce484222325u;

uint64_t hash_of(const Result& result) {
  uint64_t hash = k_hash_start;
  hash_bits(&hash, result.patch_count, 4);
  hash_array(&hash, result.positions);
  hash_array(&hash, result.normals);
  hash_array(&hash, result.mean_curvature);
  hash_array(&hash, result.constraint_normals);
  hash_array(&hash, result.vertex_curve);
  hash_array(&hash, result.triangles);
  hash_array(&hash, result.triangle_patch);
  hash_array(&hash, result.curve_edges);
  hash_array(&hash, result.curve_edge_curve);
  hash_array(&hash, result.crease_corners);
  hash_array(&hash, result.crease_normals);
  return hash;
}

template <typename T>
static std::string named_hash(const char* name, const std::vector<T>& values) {
  uint64_t hash = k_hash_start;
  hash_array(&hash, values);
  char line[96];
  std::snprintf(line, sizeof line, "  %-18s %8zu %016" PRIx64 "\n", name, values.size(), hash);
  return line;
}

std::string hashes_by_array(const Result& result) {
  return named_hash("positions", result.positions) + named_hash("normals", result.normals) +
         named_hash("mean_curvature", result.mean_curvature) +
         named_hash("constraint_normals", result.constraint_normals) +
         named_hash("vertex_curve", result.vertex_curve) +
         named_hash("triangles", result.triangles) +
         named_hash("triangle_patch", result.triangle_patch) +
         named_hash("curve_edges", result.curve_edges) +
         named_hash("curve_edge_curve", result.curve_edge_curve) +
         named_hash("crease_corners", result.crease_corners) +
         named_hash("crease_normals", result.crease_normals);
}

const char* name_of_method(wsk_method method) {
  static const char* const k_names[WSK_METHOD_COUNT] = {"STANKO",  "BIHARMONIC", "TRIHARMONIC",
                                                        "CLAMPED", "ITERATED",   "FAIR"};
  return k_names[method];
}

Result result_of(const Scene& scene) {
  return result_of(scene, scene.method);
}

Result result_of(const Scene& scene, wsk_method method) {
  wsk_options options = options_of(scene);
  options.method = method;
  wsk_surface* surface = nullptr;
  if (run(scene, options, &surface, nullptr) != WSK_OK) return {};
  Result result = copy_of(surface);
  wsk_surface_free(surface);
  return result;
}

}  // namespace scenes
