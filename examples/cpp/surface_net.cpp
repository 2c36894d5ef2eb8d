// Surfaces a network in T. Stanko's format (.net) with the single header and writes the mesh as
// OBJ.
//
//     c++ -std=c++17 -O2 -ffp-contract=off -I../../single_include surface_net.cpp -o surface_net
//     ./surface_net ../data/sphere.net sphere.obj
#define WIRESKIN_IMPLEMENTATION
#include "wireskin.h"

#include <cstdio>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

struct Curve {
  std::vector<double> positions, normals;
  std::vector<uint32_t> nodes;  // the vertex of each sample: equal ones are where curves meet
  bool closed = false, boundary = false;
};

// The number of vertices, rows x y z nx ny nz, the number of curves, and for each a line 0 or 1 (1:
// boundary) and a line of indices, of which the last repeats the first if the curve is closed.
static std::vector<Curve> read_net(const char* name) {
  std::ifstream file(name);
  size_t vertex_count = 0, curve_count = 0;
  std::vector<double> vertices;
  file >> vertex_count;
  for (double x; vertices.size() < 6 * vertex_count && file >> x;) vertices.push_back(x);
  file >> curve_count;
  std::vector<Curve> curves;
  for (Curve curve; curves.size() < curve_count && file >> curve.boundary; curve = Curve()) {
    std::string line;
    std::getline(file >> std::ws, line);
    std::istringstream indices(line);
    for (uint32_t i; indices >> i;) curve.nodes.push_back(i);
    curve.closed = curve.nodes.size() > 1 && curve.nodes.front() == curve.nodes.back();
    if (curve.closed) curve.nodes.pop_back();
    for (const uint32_t i : curve.nodes) {
      if (6 * size_t{i} + 6 > vertices.size()) return {};
      const double* v = &vertices[6 * size_t{i}];
      curve.positions.insert(curve.positions.end(), v, v + 3);
      curve.normals.insert(curve.normals.end(), v + 3, v + 6);
    }
    curves.push_back(curve);
  }
  return curves;
}

static bool write_obj(const char* name, const wsk_surface* surface) {
  wsk_surface_view view;
  wsk_surface_get_view(surface, &view, sizeof view);
  std::ofstream file(name);
  file.precision(17);
  for (size_t i = 0; i < view.vertex_count; ++i) {
    const double* p = view.positions + 3 * i;
    file << "v " << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
  }
  for (size_t i = 0; i < view.triangle_count; ++i) {
    const uint32_t* t = view.triangles + 3 * i;
    file << "f " << t[0] + 1 << ' ' << t[1] + 1 << ' ' << t[2] + 1 << '\n';
  }
  return bool(file.flush());
}

int main(int argc, char** argv) {
  if (argc != 3) return std::fprintf(stderr, "usage: surface_net INPUT.net OUTPUT.obj\n"), 2;
  const std::vector<Curve> network = read_net(argv[1]);
  std::vector<wsk_curve> curves;
  for (const Curve& curve : network) {
    wsk_curve c = {};
    c.sample_count = curve.nodes.size();
    c.positions = curve.positions.data();
    c.normals = curve.normals.data();
    c.nodes = curve.nodes.data();
    c.closed = curve.closed;
    c.boundary = curve.boundary;
    curves.push_back(c);
  }
  wsk_report report;
  wsk_report_init(&report, sizeof report);
  wsk_surface* raw = nullptr;
  if (wsk_build(curves.data(), curves.size(), nullptr, &raw, &report) != WSK_OK) {
    std::fprintf(stderr, "surface_net: %s\n", report.sentence);
    return 1;
  }
  const std::unique_ptr<wsk_surface, decltype(&wsk_surface_free)> surface(raw, wsk_surface_free);
  if (!write_obj(argv[2], surface.get())) return std::fprintf(stderr, "cannot write\n"), 1;
  std::printf("%u vertices, %u triangles, %u patches\n", report.vertices, report.triangles,
              report.patches);
  return 0;
}
