#include "mesh/curvature.h"

#include <doctest/doctest.h>

#include <cfloat>

#include "support/meshes.h"

using namespace unit;
using namespace wireskin::mesh;

namespace {

std::vector<double> curvature(const Mesh& mesh, const std::vector<Vec3>& normals,
                              const std::vector<uint8_t>& on_border) {
  Heap heap;
  Array<double> result(heap.context);
  must(mean_curvature(view(mesh.position), view(normals), view(mesh.triangle), view(on_border),
                      &result));
  return to_vector(result);
}

std::vector<uint8_t> border_of_grid(uint32_t w, uint32_t h) {
  std::vector<uint8_t> border;
  for (uint32_t v = 0; v < w * h; ++v) {
    border.push_back(v % w == 0 || v % w == w - 1 || v / w == 0 || v / w == h - 1);
  }
  return border;
}

std::vector<Vec3> normals_of(const Mesh& mesh) {
  Heap heap;
  std::vector<Vec3> normals(mesh.vertices());
  must(vertex_normals(heap.context, view(mesh.position), view(mesh.triangle), span(normals)));
  return normals;
}

// z = (a x^2 + b y^2) / 2 over [-1, 1]^2 with exact normals, up.
struct Quadric {
  static constexpr uint32_t n = 41;
  Mesh mesh;
  std::vector<Vec3> normals;
  std::vector<uint8_t> border = border_of_grid(n, n);

  Quadric(double a, double b, double jitter) {
    Random random(6);
    mesh = grid(n, n, 0.05, &random);
    jitter_grid(&mesh, n, n, jitter * 0.05, random);
    for (Vec3& p : mesh.position) {
      const double x = p.x - 1.0, y = p.y - 1.0;
      p = {x, y, 0.5 * (a * x * x + b * y * y)};
      normals.push_back(wireskin::unit({-a * x, -b * y, 1.0}));
    }
  }
};

}  // namespace

TEST_CASE("curvature: one on a jittered unit sphere with exact normals") {
  Random random(7);
  const Mesh mesh = sphere(4, 0.02, random);
  const std::vector<uint8_t> none(mesh.vertices(), 0);
  double sum = 0.0, least = 2.0, most = 0.0;
  for (double h : curvature(mesh, mesh.position, none)) {
    sum += h;
    least = std::fmin(least, h);
    most = std::fmax(most, h);
  }
  const double mean = sum / mesh.vertices();
  MESSAGE("H on the sphere: ", least, " to ", most, ", mean ", mean);
  CHECK(least > 1.0 - 2e-3);
  CHECK(most < 1.0 + 2e-3);
  CHECK(std::fabs(mean - 1.0) < 1e-4);
}

TEST_CASE("curvature: its sign follows the side, its size the inverse radius") {
  Random random(8);
  Mesh mesh = sphere(3, 0.02, random);
  const std::vector<uint8_t> none(mesh.vertices(), 0);
  std::vector<Vec3> inward;
  for (const Vec3& p : mesh.position) inward.push_back(-p);
  std::vector<Vec3> outward = mesh.position;
  Mesh inside_out = mesh;
  for (size_t t = 0; t < mesh.triangle.size(); t += 3) {
    std::swap(inside_out.triangle[t], inside_out.triangle[t + 1]);
  }
  for (double h : curvature(inside_out, inward, none)) {
    CHECK(h == doctest::Approx(-1.0).epsilon(5e-3));
  }
  for (Vec3& p : mesh.position) p = 4.0 * p;
  for (double h : curvature(mesh, outward, none)) CHECK(h == doctest::Approx(0.25).epsilon(5e-3));
}

TEST_CASE("curvature: mesh normals are exact on a sphere, and so is H") {
  Random random(9);
  const Mesh mesh = sphere(3, 0.03, random);
  const std::vector<Vec3> normals = normals_of(mesh);
  for (uint32_t v = 0; v < mesh.vertices(); ++v) {
    CHECK(wireskin::length(normals[v] - mesh.position[v]) < 1e-13);
  }
  for (double h : curvature(mesh, normals, std::vector<uint8_t>(mesh.vertices(), 0))) {
    CHECK(h == doctest::Approx(1.0).epsilon(5e-3));
  }
}

TEST_CASE("curvature: half on a cylinder, its borders included") {
  const uint32_t around = 60, rows = 30;
  const Mesh mesh = tube(around, rows, 2.0, false);
  std::vector<Vec3> normals;
  std::vector<uint8_t> border;
  for (uint32_t v = 0; v < mesh.vertices(); ++v) {
    normals.push_back({mesh.position[v].x, mesh.position[v].y, 0.0});
    border.push_back(v < around || v >= around * (rows - 1));
  }
  for (double h : curvature(mesh, normals, border)) CHECK(std::fabs(h - 0.5) < 1e-3);
}

TEST_CASE("curvature: none in a plane") {
  Quadric plane(0.0, 0.0, 0.3);
  for (double h : curvature(plane.mesh, plane.normals, plane.border)) CHECK(std::fabs(h) < 1e-13);
}

// H = -((1 + z_y^2) z_xx + (1 + z_x^2) z_yy) / (2 (1 + z_x^2 + z_y^2)^1.5) for normals up, so zero
// in the middle of the saddle and on its diagonals, of both signs elsewhere.
TEST_CASE("curvature: the saddle has both signs") {
  Quadric saddle(1.0, -1.0, 0.2);
  const std::vector<double> h = curvature(saddle.mesh, saddle.normals, saddle.border);
  bool positive = false, negative = false;
  double worst = 0.0;
  for (uint32_t v = 0; v < saddle.mesh.vertices(); ++v) {
    if (saddle.border[v]) continue;
    const Vec3& p = saddle.mesh.position[v];
    const double w = 1.0 + p.x * p.x + p.y * p.y;
    const double exact = -(p.y * p.y - p.x * p.x) / (2.0 * std::sqrt(w * w * w));
    worst = std::fmax(worst, std::fabs(h[v] - exact));
    positive = positive || h[v] > 0.05;
    negative = negative || h[v] < -0.05;
  }
  CHECK(worst < 1e-2);
  CHECK(positive);
  CHECK(negative);
  const uint32_t middle = Quadric::n / 2 * Quadric::n + Quadric::n / 2;
  CHECK(std::fabs(h[middle]) < 5e-3);
}

TEST_CASE("curvature: a bowl seen from inside is negative") {
  Quadric bowl(1.0, 1.0, 0.2);
  const std::vector<double> h = curvature(bowl.mesh, bowl.normals, bowl.border);
  CHECK(h[Quadric::n / 2 * Quadric::n + Quadric::n / 2] == doctest::Approx(-1.0).epsilon(5e-3));
}

TEST_CASE("curvature: border vertices take the mean of their neighbours, near or far") {
  Quadric bowl(1.0, 1.0, 0.0);
  const std::vector<double> h = curvature(bowl.mesh, bowl.normals, bowl.border);
  const Mesh& mesh = bowl.mesh;
  const uint32_t n = Quadric::n;
  for (uint32_t v = 1; v + 1 < n; ++v) {  // the lowest row, corners left out
    std::map<uint32_t, double> inside;
    for (uint32_t e = 0; e < mesh.triangle.size(); ++e) {
      const uint32_t a = mesh.triangle[e], b = mesh.triangle[next_half_edge(e)];
      if (a == v && !bowl.border[b]) inside[b] = h[b];
      if (b == v && !bowl.border[a]) inside[a] = h[a];
    }
    if (inside.empty()) continue;
    double sum = 0.0;
    for (const auto& [w, value] : inside) sum += value;
    CHECK(h[v] == doctest::Approx(sum / static_cast<double>(inside.size())).epsilon(1e-14));
  }
  for (double value : h) CHECK(value < -0.1);  // corners too, which have no neighbour inside
}

TEST_CASE("curvature: a mesh that is all border has none") {
  const Mesh mesh = grid(2, 2, 1.0);
  const std::vector<Vec3> up(4, Vec3{0, 0, 1});
  for (double h : curvature(mesh, up, std::vector<uint8_t>(4, 1))) CHECK(h == 0.0);
}

TEST_CASE("curvature: normals of meshes with triangles without area stay finite") {
  const std::vector<Vec3> position = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}};
  const std::vector<uint32_t> triangle = {0, 1, 2, 0, 3, 1};
  Heap heap;
  std::vector<Vec3> normals(4);
  must(vertex_normals(heap.context, view(position), view(triangle), span(normals)));
  CHECK(normals[0] == Vec3{0, 0, 1});
  CHECK(normals[3] == Vec3{0, 0, 0});
}
