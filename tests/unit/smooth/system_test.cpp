#include "smooth/system.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "mesh/operators.h"
#include "support/meshes.h"

using namespace unit;
using namespace wireskin::smooth;
using wireskin::length;
using wireskin::sparse::Csc;

namespace {

using Dense = std::vector<std::vector<double>>;

Dense dense(const Csc& a) {
  Dense d(a.rows, std::vector<double>(a.cols, 0.0));
  for (uint32_t j = 0; j < a.cols; ++j) {
    for (uint32_t p = a.start[j]; p < a.start[j + 1]; ++p) d[a.row[p]][j] = a.value[p];
  }
  return d;
}

Dense product(const Dense& a, const std::vector<double>& w, const Dense& b) {
  const size_t n = a.size();
  Dense c(n, std::vector<double>(n, 0.0));
  for (size_t i = 0; i < n; ++i) {
    for (size_t k = 0; k < n; ++k) {
      for (size_t j = 0; j < n; ++j) c[i][j] += a[i][k] * w[k] * b[k][j];
    }
  }
  return c;
}

// Gaussian elimination with pivoting.
std::vector<Vec3> solve_dense(Dense a, std::vector<Vec3> b) {
  const size_t n = b.size();
  for (size_t k = 0; k < n; ++k) {
    size_t pivot = k;
    for (size_t i = k; i < n; ++i) {
      if (std::fabs(a[i][k]) > std::fabs(a[pivot][k])) pivot = i;
    }
    std::swap(a[k], a[pivot]);
    std::swap(b[k], b[pivot]);
    for (size_t i = k + 1; i < n; ++i) {
      const double f = a[i][k] / a[k][k];
      for (size_t j = k; j < n; ++j) a[i][j] -= f * a[k][j];
      b[i] -= f * b[k];
    }
  }
  for (size_t k = n; k-- > 0;) {
    for (size_t j = k + 1; j < n; ++j) b[k] -= a[k][j] * b[j];
    b[k] = (1.0 / a[k][k]) * b[k];
  }
  return b;
}

// A mesh with its Laplacian, inverse areas as weights, and held vertices.
struct Problem {
  Heap heap;
  Csc laplacian{heap.context};
  std::vector<double> weight;
  std::vector<uint8_t> held;
  System system{heap.context};

  Problem(const Mesh& mesh, std::vector<uint8_t> fixed) : held(std::move(fixed)) {
    Array<wireskin::mesh::TriangleShape> shapes(heap.context);
    must(triangle_shapes(view(mesh.position), view(mesh.triangle), &shapes));
    must(cotangent_laplacian(mesh.vertices(), view(mesh.triangle), shapes.span(), &laplacian));
    weight.resize(mesh.vertices());
    must(mixed_voronoi_areas(heap.context, view(mesh.triangle), shapes.span(), span(weight)));
    for (double& w : weight) w = 1.0 / w;
  }
  double run(Order order, const std::vector<Vec3>& target, std::vector<Vec3>* value) {
    double residual = -1.0;
    must(system.prepare(laplacian, view(held), order));
    must(system.factor(view(weight), {}));
    must(system.solve(view(target), {}, span(*value), &residual));
    return residual;
  }
  // The free values that make the gradient of the energy zero: P_ff v_f = (L W T)_f - P_fc v_c.
  std::vector<Vec3> expected(Order order, const std::vector<Vec3>& target,
                             std::vector<Vec3> value) const {
    const Dense l = dense(laplacian);
    Dense p = product(l, weight, l);
    if (order == Order::three) p = product(p, weight, l);
    std::vector<uint32_t> free;
    for (uint32_t v = 0; v < held.size(); ++v) {
      if (!held[v]) free.push_back(v);
    }
    Dense a(free.size(), std::vector<double>(free.size()));
    std::vector<Vec3> b(free.size());
    for (size_t i = 0; i < free.size(); ++i) {
      for (size_t j = 0; j < free.size(); ++j) a[i][j] = p[free[i]][free[j]];
      for (uint32_t v = 0; v < held.size(); ++v) {
        if (held[v]) b[i] -= p[free[i]][v] * value[v];
        if (!target.empty()) b[i] += l[free[i]][v] * weight[v] * target[v];
      }
    }
    const std::vector<Vec3> x = solve_dense(a, b);
    for (size_t i = 0; i < free.size(); ++i) value[free[i]] = x[i];
    return value;
  }
};

std::vector<uint8_t> some_held(uint32_t n, Random& random) {
  std::vector<uint8_t> held(n);
  for (uint8_t& h : held) h = random.below(3) == 0;
  held[0] = 1;
  return held;
}

std::vector<Vec3> random_vectors(size_t n, Random& random) {
  std::vector<Vec3> v(n);
  for (Vec3& x : v) x = {random(), random(), random()};
  return v;
}

double distance(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double worst = 0.0;
  for (size_t i = 0; i < a.size(); ++i) worst = std::fmax(worst, length(a[i] - b[i]));
  return worst;
}

}  // namespace

TEST_CASE("system: order two and three agree with a dense solve") {
  Random random(1);
  const Mesh mesh = sphere(1, 0.1, random);
  for (Order order : {Order::two, Order::three}) {
    Problem p(mesh, some_held(mesh.vertices(), random));
    p.weight[3] = p.weight[17] = 0.0;  // rows left out
    p.held[3] = p.held[17] = 1;
    std::vector<Vec3> value = random_vectors(mesh.vertices(), random);
    const std::vector<Vec3> expected = p.expected(order, {}, value);
    const double residual = p.run(order, {}, &value);
    CHECK(residual < 1e-11);
    CHECK(residual >= 0.0);
    CHECK(distance(value, expected) < 1e-10);
  }
}

TEST_CASE("system: targets, new weights and several solves with one analysis") {
  Random random(2);
  const Mesh mesh = sphere(1, 0.1, random);
  Problem p(mesh, some_held(mesh.vertices(), random));
  for (int round = 0; round < 3; ++round) {
    const std::vector<Vec3> target = random_vectors(mesh.vertices(), random);
    std::vector<Vec3> value = random_vectors(mesh.vertices(), random);
    const std::vector<Vec3> expected = p.expected(Order::two, target, value);
    double residual = -1.0;
    if (round == 0) must(p.system.prepare(p.laplacian, view(p.held), Order::two));
    must(p.system.factor(view(p.weight), {}));
    must(p.system.solve(view(target), {}, span(value), &residual));
    CHECK(distance(value, expected) < 1e-10);
    // The same factor again, with other values.
    std::vector<Vec3> again = random_vectors(mesh.vertices(), random);
    const std::vector<Vec3> expected_again = p.expected(Order::two, {}, again);
    must(p.system.solve({}, {}, span(again), &residual));
    CHECK(distance(again, expected_again) < 1e-10);
    for (double& w : p.weight) w *= 1.0 + 0.9 * random();
  }
}

TEST_CASE("system: held values do not move, free ones do not matter") {
  Random random(3);
  const Mesh mesh = sphere(1, 0.1, random);
  Problem p(mesh, some_held(mesh.vertices(), random));
  const std::vector<Vec3> given = random_vectors(mesh.vertices(), random);
  std::vector<Vec3> first = given, second = given;
  for (size_t v = 0; v < given.size(); ++v) {
    if (!p.held[v]) second[v] = {1e9, 0, 0};
  }
  p.run(Order::two, {}, &first);
  p.run(Order::two, {}, &second);
  for (size_t v = 0; v < given.size(); ++v) {
    CHECK(first[v] == second[v]);
    CHECK((first[v] == given[v]) == (p.held[v] != 0));
  }
}

TEST_CASE("system: linear positions on a plane are reproduced") {
  Random random(4);
  const uint32_t w = 12, h = 10;
  Mesh mesh = grid(w, h, 0.1, &random);
  jitter_grid(&mesh, w, h, 0.03, random);
  std::vector<uint8_t> rim;
  for (uint32_t v = 0; v < w * h; ++v) {
    rim.push_back(v % w == 0 || v % w == w - 1 || v / w == 0 || v / w == h - 1);
  }
  for (Order order : {Order::two, Order::three}) {
    Problem p(mesh, rim);
    std::vector<Vec3> value(w * h), exact;
    for (uint32_t v = 0; v < w * h; ++v) {
      const Vec3& x = mesh.position[v];
      exact.push_back({1 + x.x - 2 * x.y, 3 * x.y, -x.x});
      if (rim[v]) {
        value[v] = exact[v];
        p.weight[v] = 0.0;
      }
    }
    p.run(order, {}, &value);
    CHECK(distance(value, exact) < 1e-11);
  }
}

TEST_CASE("system: the residual is small on bad triangles too") {
  Random random(5);
  Mesh mesh = grid(40, 40, 0.025, &random);
  jitter_grid(&mesh, 40, 40, 0.011, random);
  std::vector<uint8_t> held(1600, 0);
  for (uint32_t v = 0; v < 1600; ++v) held[v] = v < 40 || v % 397 == 0;
  Problem p(mesh, held);
  std::vector<Vec3> value = random_vectors(1600, random);
  const double residual = p.run(Order::two, {}, &value);
  MESSAGE("residual after refinement: ", residual);
  CHECK(residual < 1e-9);
}

TEST_CASE("system: nothing free, nothing to do") {
  const Mesh mesh = tetrahedron();
  Problem p(mesh, std::vector<uint8_t>(4, 1));
  std::vector<Vec3> value = mesh.position;
  CHECK(p.run(Order::two, {}, &value) == 0.0);
  CHECK(value == mesh.position);
}

TEST_CASE("system: nothing held is not positive definite, or nearly so") {
  const Mesh mesh = icosahedron();
  Problem p(mesh, std::vector<uint8_t>(12, 0));
  for (double& w : p.weight) w = 0.0;
  must(p.system.prepare(p.laplacian, view(p.held), Order::two));
  CHECK(p.system.factor(view(p.weight), {}).code == Code::not_positive_definite);
}
