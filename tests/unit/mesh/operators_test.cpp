#include "mesh/operators.h"

#include <doctest/doctest.h>

#include <ctime>
#include <numeric>

#include "support/meshes.h"

using namespace unit;
using namespace wireskin::mesh;
using wireskin::sparse::Csc;

namespace {

struct Operators {
  Heap heap;
  Array<TriangleShape> shapes{heap.context};
  Csc laplacian{heap.context};
  std::vector<double> mixed, barycentric;

  explicit Operators(const Mesh& mesh) : mixed(mesh.vertices()), barycentric(mesh.vertices()) {
    must(triangle_shapes(view(mesh.position), view(mesh.triangle), &shapes));
    must(cotangent_laplacian(mesh.vertices(), view(mesh.triangle), shapes.span(), &laplacian));
    must(mixed_voronoi_areas(heap.context, view(mesh.triangle), shapes.span(), span(mixed)));
    barycentric_areas(view(mesh.triangle), shapes.span(), span(barycentric));
  }
  double apply(uint32_t v, const std::vector<double>& f) const {  // by symmetry, column v
    double sum = 0.0;
    for (uint32_t p = laplacian.start[v]; p < laplacian.start[v + 1]; ++p) {
      sum += laplacian.value[p] * f[laplacian.row[p]];
    }
    return sum;
  }
  double area() const {
    double sum = 0.0;
    for (const TriangleShape& s : shapes) sum += s.area;
    return sum;
  }
};

double total(const std::vector<double>& v) {
  return std::accumulate(v.begin(), v.end(), 0.0);
}

std::vector<double> values(const Mesh& mesh, double (*f)(const Vec3&)) {
  std::vector<double> result;
  for (const Vec3& p : mesh.position) result.push_back(f(p));
  return result;
}

bool inner(uint32_t v, uint32_t w, uint32_t h) {
  return v % w > 0 && v % w < w - 1 && v / w > 0 && v / w < h - 1;
}

}  // namespace

TEST_CASE("operators: shapes of known triangles, in the plane and in space") {
  const TriangleShape right = triangle_shape(Vec2{0, 0}, Vec2{2, 0}, Vec2{0, 2});
  CHECK(right.area == 2.0);
  CHECK(right.cotangent[0] == 0.0);
  CHECK(right.cotangent[1] == 1.0);
  CHECK(right.cotangent[2] == 1.0);
  const double root = std::sqrt(3.0);
  const TriangleShape third = triangle_shape(Vec2{0, 0}, Vec2{1, 0}, Vec2{.5, .5 * root});
  for (double c : third.cotangent) CHECK(c == doctest::Approx(1.0 / root).epsilon(1e-15));
  const TriangleShape wide = triangle_shape(Vec2{0, 0}, Vec2{1, 0}, Vec2{-1, 1});
  CHECK(wide.cotangent[0] == doctest::Approx(-1.0));
  Random random(1);
  for (int i = 0; i < 100; ++i) {
    const Vec2 a = {random(), random()}, b = {random(), random()};
    const double noise = 0.3 * wireskin::length(b - a);
    const Vec2 c = a + Vec2{a.y - b.y + noise * random(), b.x - a.x + noise * random()};
    const TriangleShape flat = triangle_shape(a, b, c);
    const TriangleShape space = triangle_shape(Vec3{3, a.x, a.y}, Vec3{3, b.x, b.y}, {3, c.x, c.y});
    CHECK(space.area == doctest::Approx(flat.area).epsilon(1e-14));
    for (int k = 0; k < 3; ++k) {
      CHECK(std::fabs(space.cotangent[k] - flat.cotangent[k]) < 1e-12);
    }
  }
}

TEST_CASE("operators: areas are positive and add up, obtuse triangles or not") {
  Random random(2);
  for (double jitter : {0.0, 0.1, 0.35}) {
    Mesh mesh = grid(12, 9, 1.0, &random);
    jitter_grid(&mesh, 12, 9, jitter, random);
    const Operators o(mesh);
    CHECK(o.area() == doctest::Approx(88.0).epsilon(1e-14));
    CHECK(total(o.mixed) == doctest::Approx(88.0).epsilon(1e-14));
    CHECK(total(o.barycentric) == doctest::Approx(88.0).epsilon(1e-14));
    for (double a : o.mixed) CHECK(a > 0.05);
    bool obtuse = false;
    for (const TriangleShape& s : o.shapes) {
      for (double c : s.cotangent) obtuse = obtuse || c < -0.05;
    }
    CHECK(obtuse == (jitter > 0.0));
  }
}

TEST_CASE("operators: mixed areas of single triangles") {
  const auto mixed = [](Vec2 a, Vec2 b, Vec2 c) {
    const std::vector<TriangleShape> shapes = {triangle_shape(a, b, c)};
    const std::vector<uint32_t> triangle = {0, 1, 2};
    std::vector<double> areas(3);
    Heap heap;
    must(mixed_voronoi_areas(heap.context, view(triangle), view(shapes), span(areas)));
    return areas;
  };
  // The circumcentre of (0,0), (4,0), (1,3) is (2, 1): Voronoi parts by hand.
  const std::vector<double> acute = mixed({0, 0}, {4, 0}, {1, 3});
  CHECK(acute[0] == doctest::Approx(2.25));
  CHECK(acute[1] == doctest::Approx(1.75));
  CHECK(acute[2] == doctest::Approx(2.0));
  const std::vector<double> scalene = mixed({0, 0}, {6, 0}, {2, 4});  // circumcentre (3, 1)
  CHECK(scalene[0] == doctest::Approx(0.5 * (3 * 1 + 2 * std::sqrt(5.0) / 2 * std::sqrt(5.0))));
  CHECK(scalene[0] + scalene[1] + scalene[2] == doctest::Approx(12.0));
  const std::vector<double> obtuse = mixed({0, 0}, {4, 0}, {-1, 1});
  CHECK(obtuse[0] == doctest::Approx(1.0));
  CHECK(obtuse[1] == doctest::Approx(0.5));
  CHECK(obtuse[2] == doctest::Approx(0.5));
  const std::vector<double> right = mixed({0, 0}, {4, 0}, {0, 2});
  CHECK(right[0] == doctest::Approx(2.0));
  CHECK(right[1] == doctest::Approx(1.0));
}

TEST_CASE("operators: the Laplacian is symmetric, sorted, and its rows add up to zero") {
  Random random(3);
  for (const Mesh& mesh : {sphere(2, 0.05, random), tube(12, 6, 2.0, false)}) {
    const Operators o(mesh);
    const uint32_t n = mesh.vertices();
    std::map<std::pair<uint32_t, uint32_t>, double> entry;
    for (uint32_t j = 0; j < n; ++j) {
      double sum = 0.0;
      for (uint32_t p = o.laplacian.start[j]; p < o.laplacian.start[j + 1]; ++p) {
        if (p > o.laplacian.start[j]) REQUIRE(o.laplacian.row[p] > o.laplacian.row[p - 1]);
        entry[{o.laplacian.row[p], j}] = o.laplacian.value[p];
        sum += o.laplacian.value[p];
      }
      CHECK(std::fabs(sum) < 1e-13);
    }
    CHECK(entry.size() == o.laplacian.value.size());
    for (const auto& [place, value] : entry) {
      REQUIRE(entry.count({place.second, place.first}) == 1);
      CHECK(std::fabs(entry[{place.second, place.first}] - value) < 1e-14);
      if (place.first == place.second) CHECK(value < 0.0);
    }
  }
}

TEST_CASE("operators: a square by hand") {
  const Operators o(grid(2, 2, 1.0));  // cut from 0 to 3: that edge has right angles opposite
  const std::vector<double> at0 = {1, 0, 0, 0};
  CHECK(o.apply(0, at0) == doctest::Approx(-1.0));
  CHECK(o.apply(1, at0) == doctest::Approx(0.5));
  CHECK(o.apply(2, at0) == doctest::Approx(0.5));
  CHECK(std::fabs(o.apply(3, at0)) < 1e-15);
}

TEST_CASE("operators: linear functions have no Laplacian inside a planar mesh") {
  Random random(4);
  const uint32_t w = 15, h = 11;
  Mesh mesh = grid(w, h, 0.3, &random);
  jitter_grid(&mesh, w, h, 0.1, random);
  const Operators o(mesh);
  const auto linear = values(mesh, [](const Vec3& p) { return 3.0 * p.x - 2.0 * p.y + 5.0; });
  const auto square = values(mesh, [](const Vec3& p) { return p.x * p.x; });
  double greatest = 0.0;
  for (uint32_t v = 0; v < mesh.vertices(); ++v) {
    if (!inner(v, w, h)) continue;
    CHECK(std::fabs(o.apply(v, linear)) < 1e-12);
    greatest = std::fmax(greatest, o.apply(v, square));
  }
  CHECK(greatest > 0.01);  // the matrix is not just zero
}

TEST_CASE("operators: |x|^2 has the Laplacian 4 on a regular grid") {
  const uint32_t w = 10, h = 10;
  const Mesh mesh = grid(w, h, 0.25);
  const Operators o(mesh);
  const auto square = values(mesh, [](const Vec3& p) { return wireskin::dot(p, p); });
  for (uint32_t v = 0; v < mesh.vertices(); ++v) {
    if (!inner(v, w, h)) continue;
    CHECK(o.mixed[v] == doctest::Approx(0.0625).epsilon(1e-14));
    CHECK(o.apply(v, square) == doctest::Approx(4.0 * o.mixed[v]).epsilon(1e-12));
  }
}

TEST_CASE("operators: a vertex of any valence costs n log n") {
  const uint32_t n = 200000;
  Random random(5);
  Mesh mesh;
  mesh.position.push_back({});
  std::vector<uint32_t> rim(n);
  for (uint32_t i = 0; i < n; ++i) rim[i] = i + 1;
  for (uint32_t i = n; i > 1; --i) std::swap(rim[i - 1], rim[random.below(i)]);
  mesh.position.resize(n + 1);
  for (uint32_t i = 0; i < n; ++i) {
    mesh.position[rim[i]] = {std::cos(2 * k_pi * i / n), std::sin(2 * k_pi * i / n), 0};
    mesh.add(0, rim[i], rim[(i + 1) % n]);
  }
  const std::clock_t begin = std::clock();
  const Operators o(mesh);
  const double seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  CHECK(seconds < 5.0);
  CHECK(o.laplacian.start[1] == n + 1);
  CHECK(o.laplacian.row[n] == n);
}
