// Curves drawn on surfaces, which pass each other without a shared point (stability-networks):
// snapped, with the normals of the surface and its border, they are surfaced, and the distance to
// the surface is reported. The files are found in the folder that WIRESKIN_TEST_DATA names.
#include <doctest/doctest.h>

#include <cstdio>
#include <fstream>
#include <sstream>
#include <string>

#include "cuts/shapes.h"
#include "networks/raw.h"

using namespace accuracy;
using namespace networks;

namespace {

// shell_100 and roof_75 are dozens of curves that run along each other, touch and meet in about one
// point.
struct Drawn {
  const char *curves, *mesh;
};

const Drawn k_drawn[] = {
    {"hill_3.txt", "hill.obj"},      {"shell_3.txt", "shell.obj"},
    {"shell_arcs.txt", "shell.obj"}, {"shell_100.txt", "shell.obj"},
    {"roof_75.txt", "roof.obj"},     {"tent_3_regular_curves.txt", "tent.obj"}};

// "CURVE k" and rows x y z.
std::vector<std::vector<Point>> read_curves(const std::string& path) {
  std::ifstream file(path);
  std::vector<std::vector<Point>> curves;
  for (std::string line; std::getline(file, line);) {
    if (line.rfind("CURVE", 0) == 0) curves.emplace_back();
    std::istringstream words(line);
    Point p;
    if (words >> p[0] >> p[1] >> p[2]) curves.back().push_back(p);
  }
  return curves;
}

// The mesh's normal at its point nearest to p, interpolated from the vertices: `weight` by the
// areas that p makes with the edges.
Point normal_near(const Mesh& mesh, const std::vector<Point>& normals, const MeshDistance& distance,
                  const Point& p) {
  const auto& t = mesh.triangles[distance.nearest(p).triangle];
  Point sum = {0.0, 0.0, 0.0};
  for (size_t i = 0; i < 3; ++i) {
    const Point &b = mesh.positions[t[(i + 1) % 3]], &c = mesh.positions[t[(i + 2) % 3]];
    sum = sum + length(cross(b - p, c - p)) * normals[t[i]];
  }
  return unit(sum);
}

void append(const Point& p, const Point& n, raw::Curve* curve) {
  curve->positions.insert(curve->positions.end(), p.begin(), p.end());
  curve->normals.insert(curve->normals.end(), n.begin(), n.end());
  curve->nodes.push_back(WSK_NONE);
}

raw::Curves with_normals(const std::vector<std::vector<Point>>& lines, const Mesh& mesh,
                         const MeshDistance& distance) {
  const std::vector<Point> normals = vertex_normals(mesh);
  raw::Curves curves;
  for (const auto& line : lines) {
    raw::Curve curve;
    curve.closed = line.size() > 3 && line.front() == line.back();
    for (size_t i = 0; i + (curve.closed ? 1 : 0) < line.size(); ++i) {
      if (i > 0 && line[i] == line[i - 1]) continue;
      append(line[i], normal_near(mesh, normals, distance, line[i]), &curve);
    }
    if (curve.size() > 1) curves.push_back(curve);
  }
  const Network border = cut(mesh, {});
  for (raw::Curve& curve : raw::curves_of(border)) curves.push_back(curve);
  return curves;
}

}  // namespace

TEST_CASE("curves drawn on surfaces are snapped and surfaced") {
  std::printf("%-28s %6s %6s %6s %6s %6s %8s %6s %9s %9s\n", "curves", "curves", "snaps", "nodes",
              "ends", "gaps", "patches", "failed", "RMS/1000", "max/1000");
  size_t found = 0;
  for (const Drawn& drawn : k_drawn) {
    const std::string curve_file = data_file(std::string("stability-networks/") + drawn.curves);
    const std::string mesh_file = data_file(std::string("stability-networks/") + drawn.mesh);
    if (curve_file.empty() || mesh_file.empty()) continue;
    ++found;
    CAPTURE(std::string(drawn.curves));
    const Mesh mesh = cuts::read_mesh(mesh_file);
    RealCase c;
    c.truth = std::make_shared<MeshDistance>(mesh);
    const raw::Curves curves = with_normals(read_curves(curve_file), mesh, *c.truth);
    const raw::Network network = raw::connect(curves);
    REQUIRE(network != nullptr);
    const wsk_network_view view = raw::view_of(network);
    wsk_options options = options_for(WSK_METHOD_FAIR, c.truth->diagonal() / 60.0);
    options.partial = 1;
    const Result result = build(view.curves, view.curve_count, options);
    std::printf("%-28s %6zu %6u %6u %6u %6u", drawn.curves, curves.size(), view.snap_count,
                view.after.nodes, view.after.dangling_ends, view.after.open_gaps);
    CAPTURE(std::string(result.report.sentence));
    CHECK(result.status == WSK_OK);
    if (result.status != WSK_OK) {
      std::printf(" %s (curve %u)\n", result.report.sentence, result.report.curve);
      continue;
    }
    const RealError error = real_error(result, c);
    std::printf(" %8u %6u %9.2f %9.1f\n", result.report.patches, result.report.failed_patches,
                1000.0 * error.rms / c.truth->diagonal(), 1000.0 * error.max / c.truth->diagonal());
    CHECK(result.report.failed_patches == 0);
    CHECK(result.report.euler_characteristic == cuts::euler_characteristic(mesh));
    CHECK(error.rms < 0.03 * c.truth->diagonal());
  }
  if (found == 0) std::printf("skipped: WIRESKIN_TEST_DATA is not set\n");
}
