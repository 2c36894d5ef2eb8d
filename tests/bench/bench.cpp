// bench [--sizes 10000,100000] [--runs 3] [--threads N] [--methods stanko,fair] [--json FILE]
//       [--scene grid] [--write PREFIX]
//       [--matrices PREFIX,PREFIX...] [--which K] [--rig FOLDER] [--peers super-amd,eigen-ldlt]
//
// Times wsk_build and its stages on a network of about so many vertices (`grid`: five and five
// curves on a warped square, 16 patches; `ellipsoid`: three, 8 patches) and, given matrices of the
// peers' rig, the solver beside the rig's programs in turn, on one thread each. --write makes such
// a matrix of each size, of the bilaplacian on the surface: PREFIX.SIZE.K.csc, .xy.vec, .patch.vec.
// Prints medians and ratios, writes them as JSON. Times are processor time in milliseconds; with
// --threads, of the wall clock. OpenBLAS takes kernels for SSE3 on processors younger than itself,
// which makes ratios too good: see OPENBLAS_VERBOSE=2, and set OPENBLAS_CORETYPE.
#include <time.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <functional>
#include <map>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "mesh/operators.h"
#include "rig.h"
#include "sparse/cholesky.h"
#include "sparse/nested_dissection.h"
#include "sparse/product.h"
#include "support/scenes.h"

namespace {

using wireskin::Array;
using wireskin::Context;
using wireskin::Status;

struct Options {
  std::vector<std::string> sizes = {"10000", "100000"};
  std::vector<std::string> methods = {"stanko", "fair"};
  std::vector<std::string> matrices;
  std::vector<std::string> peers = {"super-amd", "eigen-ldlt"};
  std::string rig, json, which = "K", scene = "grid", write;
  int runs = 3;
  uint32_t threads = 1;
};

uint32_t thread_count = 1;

double now(void* = nullptr) {
  timespec t;
  clock_gettime(thread_count > 1 ? CLOCK_MONOTONIC : CLOCK_PROCESS_CPUTIME_ID, &t);
  return 1e3 * static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_nsec);
}

void on_threads(uint32_t count, void (*body)(uint32_t, void*), void* data, void*) {
  std::atomic<uint32_t> next{0};
  const auto work = [&] {
    for (uint32_t i = next++; i < count; i = next++) body(i, data);
  };
  std::vector<std::thread> others;
  for (uint32_t t = 1; t < thread_count; ++t) others.emplace_back(work);
  work();
  for (std::thread& thread : others) thread.join();
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values.empty() ? 0.0 : values[values.size() / 2];
}

void must(const Status& status) {
  if (!status.ok()) throw std::runtime_error(status.sentence);
}

// Medians of what several runs measured, by name in the order first met.
class Table {
 public:
  void add(const std::string& name, double value) {
    if (values_.find(name) == values_.end()) names_.push_back(name);
    values_[name].push_back(value);
  }
  double of(const std::string& name) const { return median(values_.at(name)); }
  const std::vector<std::string>& names() const { return names_; }

 private:
  std::vector<std::string> names_;
  std::map<std::string, std::vector<double>> values_;
};

class Json {
 public:
  void add(const std::string& title, const Table& table) {
    text_ += text_.empty() ? "{\n" : ",\n";
    text_ += "  \"" + title + "\": {";
    for (const std::string& name : table.names()) {
      char number[32];
      std::snprintf(number, sizeof number, "%.6g", table.of(name));
      text_ += (name == table.names()[0] ? "\"" : ", \"") + name + "\": " + number;
    }
    text_ += "}";
  }
  void write(const std::string& path) const {
    std::ofstream file(path);
    file << text_ << "\n}\n";
    if (!file) throw std::runtime_error("cannot write " + path);
  }

 private:
  std::string text_;
};

void print(const std::string& title, const Table& table) {
  std::printf("%s\n", title.c_str());
  for (const std::string& name : table.names()) {
    std::printf("  %-26s %12.4g\n", name.c_str(), table.of(name));
  }
  std::fflush(stdout);
}

// ---- The pipeline -------------------------------------------------------------------------------

// One of the rig's curves: a line x or y = fixed / 4 of the unit square, lifted.
scenes::Curve grid_line(bool along_x, uint32_t fixed) {
  constexpr uint32_t k_samples = 64;
  scenes::Curve curve;
  curve.boundary = fixed % 4 == 0;
  for (uint32_t i = 0; i <= k_samples; ++i) {
    const double moving = static_cast<double>(i) / k_samples, still = fixed / 4.0;
    const double x = along_x ? moving : still, y = along_x ? still : moving;
    const uint32_t at = i / (k_samples / 4);
    const bool crosses = i % (k_samples / 4) == 0;
    const double slope_x = 0.6 * x + 0.2 * y * y, slope_y = 0.4 * x * y - 0.3;
    curve.positions.insert(curve.positions.end(), {x, y, 0.3 * x * x + 0.2 * x * y * y - 0.3 * y});
    curve.normals.insert(curve.normals.end(), {-slope_x, -slope_y, 1.0});
    curve.nodes.push_back(!crosses ? WSK_NONE : along_x ? 5 * fixed + at : 5 * at + fixed);
  }
  return curve;
}

scenes::Scene scene_named(const std::string& name) {
  if (name == "ellipsoid") return scenes::ellipsoid();
  if (name != "grid") throw std::runtime_error("no scene " + name);
  scenes::Scene scene;
  scene.spacing = 0.05;
  for (uint32_t fixed = 0; fixed < 5; ++fixed) {
    scene.curves.push_back(grid_line(true, fixed));
    scene.curves.push_back(grid_line(false, fixed));
  }
  return scene;
}

wsk_report build(const scenes::Scene& scene, double spacing, wsk_method method,
                 scenes::Result* result = nullptr) {
  wsk_options options = scenes::options_of(scene);
  options.spacing = spacing;
  options.method = method;
  options.smoothing = WSK_SMOOTHING_NONE;
  options.now = &now;
  if (thread_count > 1) options.parallel_for = &on_threads;
  wsk_report report;
  wsk_report_init(&report, sizeof report);
  wsk_surface* surface = nullptr;
  if (scenes::run(scene, options, &surface, &report) != WSK_OK) {
    throw std::runtime_error(report.sentence);
  }
  if (result != nullptr) *result = scenes::copy_of(surface);
  wsk_surface_free(surface);
  return report;
}

// The vertices grow with the inverse square of the spacing.
double spacing_for(const scenes::Scene& scene, double size) {
  const wsk_report coarse = build(scene, scene.spacing / 4, WSK_METHOD_STANKO);
  return coarse.spacing * std::sqrt(coarse.vertices / size);
}

void time_pipeline(const Options& options, double size, const std::string& method, Json* json) {
  const char* const stages[] = {"input",     "curves", "network", "patches",
                                "operators", "factor", "solve",   "result"};
  const wsk_method number = method == "fair" ? WSK_METHOD_FAIR : WSK_METHOD_STANKO;
  const scenes::Scene scene = scene_named(options.scene);
  const double spacing = spacing_for(scene, size);
  Table table;
  for (int run = 0; run < options.runs; ++run) {
    const double start = now();
    const wsk_report report = build(scene, spacing, number);
    table.add("total", now() - start);
    for (int s = 0; s < WSK_STAGE_COUNT; ++s) table.add(stages[s], report.stage_ms[s]);
    table.add("vertices", report.vertices);
    table.add("peak MiB", static_cast<double>(report.peak_bytes) / 1048576.0);
    table.add("residual", report.residual);
    table.add("factorisations", report.factorisations);
    table.add("iterations", report.cg_iterations);
  }
  const std::string title = method + " " + std::to_string(static_cast<long>(size));
  print(title, table);
  json->add(title, table);
}

// ---- The solver beside its peers ----------------------------------------------------------------

void* plain_allocate(size_t bytes, void*) {
  return std::malloc(bytes);
}
void plain_release(void* memory, size_t, void*) {
  std::free(memory);
}

// K = L M^-1 L on the vertices between the curves of a finished surface.
void write_own_matrix(const Options& options, const std::string& size) {
  namespace mesh = wireskin::mesh;
  const scenes::Scene scene = scene_named(options.scene);
  scenes::Result result;
  build(scene, spacing_for(scene, std::stod(size)), WSK_METHOD_STANKO, &result);
  const wireskin::Span<const uint32_t> triangle = {result.triangles.data(),
                                                   result.triangles.size()};
  const uint32_t n = static_cast<uint32_t>(result.vertex_curve.size());
  std::vector<wireskin::Vec3> position(n);
  for (uint32_t v = 0; v < n; ++v) {
    const double* p = &result.positions[size_t{3} * v];
    position[v] = {p[0], p[1], p[2]};
  }
  std::vector<uint32_t> unknown(n, wireskin::k_none), vertex_patch(n);
  for (size_t h = 0; h < triangle.size(); ++h) {
    vertex_patch[triangle[h]] = result.triangle_patch[h / 3];
  }
  bench::Places places;
  for (uint32_t v = 0; v < n; ++v) {
    if (result.vertex_curve[v] != WSK_NONE) continue;
    unknown[v] = static_cast<uint32_t>(places.patch.size());
    places.position.push_back(position[v]);
    places.patch.push_back(vertex_patch[v]);
  }
  Context context({&plain_allocate, &plain_release, nullptr}, 0, {});
  Array<mesh::TriangleShape> shapes(context);
  wireskin::sparse::Csc laplacian(context), product(context);
  std::vector<double> weight(n);
  must(mesh::triangle_shapes({position.data(), n}, triangle, &shapes));
  must(mesh::cotangent_laplacian(n, triangle, shapes.span(), &laplacian));
  must(mesh::mixed_voronoi_areas(context, triangle, shapes.span(), {weight.data(), n}));
  for (double& w : weight) w = 1.0 / w;
  must(wireskin::sparse::weighted_product(
      laplacian, {weight.data(), n}, laplacian, {unknown.data(), n},
      static_cast<uint32_t>(places.patch.size()), wireskin::sparse::Part::lower, &product));
  bench::write_matrix(product, places, options.write + "." + size);
}

double relative_residual(const wireskin::sparse::Csc& a, const std::vector<double>& x,
                         const std::vector<double>& b) {
  std::vector<double> y(x.size());
  must(wireskin::sparse::multiply_symmetric(a, {x.data(), x.size()}, {y.data(), y.size()}, 9));
  double left = 0.0, whole = 0.0;
  for (size_t i = 0; i < b.size(); ++i) {
    left += (b[i] - y[i]) * (b[i] - y[i]);
    whole += b[i] * b[i];
  }
  return std::sqrt(left / whole);
}

void time_own_solver(const bench::RigMatrix& matrix, Context& context, Table* table) {
  using namespace wireskin::sparse;
  const uint32_t n = matrix.lower.cols;
  std::vector<double> b(size_t{9} * n);
  uint64_t state = 7;
  for (double& v : b) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    v = static_cast<double>(state >> 11) / 9007199254740992.0 - 0.5;
  }
  std::vector<double> x = b;
  Array<uint32_t> order(context);
  Cholesky factor(context);
  const double t0 = now();
  must(nested_dissection(matrix.lower,
                         {{},
                          {matrix.position.data(), matrix.position.size()},
                          {matrix.patch.data(), matrix.patch.size()}},
                         &order));
  const double t1 = now();
  must(factor.analyse(matrix.lower, order.span()));
  const double t2 = now();
  must(factor.factor(matrix.lower));
  const double t3 = now();
  must(factor.solve({x.data(), x.size()}, 9));
  const double t4 = now();
  must(factor.factor(matrix.lower));
  const double t5 = now();
  table->add("order", t1 - t0);
  table->add("analyse", t2 - t1);
  table->add("factor", t3 - t2);
  table->add("solve 9", t4 - t3);
  table->add("sum", t4 - t0);
  table->add("factor again", t5 - t4);
  table->add("nonzeros", static_cast<double>(factor.nonzeros()));
  table->add("residual", relative_residual(matrix.lower, x, b));
  // One step of refinement.
  std::vector<double> r(b.size());
  must(multiply_symmetric(matrix.lower, {x.data(), x.size()}, {r.data(), r.size()}, 9));
  for (size_t i = 0; i < b.size(); ++i) r[i] = b[i] - r[i];
  must(factor.solve({r.data(), r.size()}, 9));
  for (size_t i = 0; i < b.size(); ++i) x[i] += r[i];
  table->add("refined residual", relative_residual(matrix.lower, x, b));
}

void time_solver(const Options& options, const std::string& prefix, Json* json) {
  wireskin::Callbacks callbacks;
  if (thread_count > 1) callbacks.parallel_for = &on_threads;
  Context context({&plain_allocate, &plain_release, nullptr}, 0, callbacks);
  bench::RigMatrix matrix(context);
  bench::read_matrix(prefix, options.which, &matrix);
  Table table;
  // In turn, so that a busy moment of the machine meets all of them.
  for (int run = 0; run < options.runs; ++run) {
    time_own_solver(matrix, context, &table);
    if (options.rig.empty()) continue;
    for (const std::string& peer : options.peers) {
      const bench::PeerTimes times = bench::run_peer(options.rig, prefix, options.which, peer);
      if (times.analyse < 0) throw std::runtime_error("cannot run spsolve in " + options.rig);
      table.add(peer + " analyse", times.analyse);
      table.add(peer + " factor", times.factor);
      table.add(peer + " solve 9", times.solve);
      table.add(peer + " sum", times.sum());
      table.add(peer + " factor again", times.refactor);
      table.add(peer + " nonzeros", times.nonzeros);
    }
  }
  if (!options.rig.empty()) {
    for (const std::string& peer : options.peers) {
      table.add("sum / " + peer, table.of("sum") / table.of(peer + " sum"));
      table.add("order+analyse / " + peer,
                (table.of("order") + table.of("analyse")) / table.of(peer + " analyse"));
      table.add("again / " + peer, table.of("factor again") / table.of(peer + " factor again"));
      table.add("nonzeros / " + peer, table.of("nonzeros") / table.of(peer + " nonzeros"));
    }
  }
  const std::string title = prefix.substr(prefix.rfind('/') + 1) + "." + options.which;
  print(title, table);
  json->add(title, table);
}

std::vector<std::string> split(const std::string& list) {
  std::vector<std::string> parts;
  std::istringstream stream(list);
  for (std::string part; std::getline(stream, part, ',');) parts.push_back(part);
  return parts;
}

Options read_options(int argc, char** argv) {
  Options options;
  for (int i = 1; i + 1 < argc; i += 2) {
    const std::string name = argv[i], value = argv[i + 1];
    if (name == "--sizes") {
      options.sizes = split(value);
    } else if (name == "--methods") {
      options.methods = split(value);
    } else if (name == "--matrices") {
      options.matrices = split(value);
    } else if (name == "--which") {
      options.which = value;
    } else if (name == "--peers") {
      options.peers = split(value);
    } else if (name == "--rig") {
      options.rig = value;
    } else if (name == "--scene") {
      options.scene = value;
    } else if (name == "--write") {
      options.write = value;
    } else if (name == "--json") {
      options.json = value;
    } else if (name == "--runs") {
      options.runs = std::stoi(value);
    } else if (name == "--threads") {
      options.threads = static_cast<uint32_t>(std::stoul(value));
    } else {
      throw std::runtime_error("unknown option " + name);
    }
  }
  return options;
}

}  // namespace

int main(int argc, char** argv) try {
  const Options options = read_options(argc, argv);
  thread_count = options.threads;
  Json json;
  for (const std::string& prefix : options.matrices) time_solver(options, prefix, &json);
  for (const std::string& size : options.sizes) {
    if (!options.write.empty()) write_own_matrix(options, size);
    for (const std::string& method : options.methods) {
      time_pipeline(options, std::stod(size), method, &json);
    }
  }
  if (!options.json.empty()) json.write(options.json);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "bench: %s\n", error.what());
  return 1;
}
