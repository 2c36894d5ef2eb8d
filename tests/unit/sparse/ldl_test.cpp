#include "sparse/ldl.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "matrices.h"
#include "sparse/ordering.h"

using namespace matrices;
using namespace wireskin::sparse;
using wireskin::Code;

namespace {

// A random graph Laplacian plus the identity.
Symmetric random_matrix(uint32_t n, uint32_t edges, uint32_t seed) {
  std::mt19937 engine(seed);
  Symmetric a(n);
  for (uint32_t i = 0; i < n; ++i) a.at(i, i) = 1.0;
  for (uint32_t e = 0; e < edges; ++e) {
    const uint32_t i = engine() % n, j = engine() % n;
    if (i != j) a.connect(i, j, (engine() % 1000 + 1) * 0.01);
  }
  return a;
}

// By Gauss and Jordan, without pivoting.
std::vector<double> dense_inverse(const Symmetric& a) {
  const uint32_t n = a.n;
  std::vector<double> m(n * n), inverse(n * n);
  for (uint32_t i = 0; i < n; ++i) {
    inverse[i * n + i] = 1.0;
    for (uint32_t j = 0; j < n; ++j) m[i * n + j] = a.get(i, j);
  }
  for (uint32_t k = 0; k < n; ++k) {
    const double pivot = m[k * n + k];
    for (uint32_t j = 0; j < n; ++j) m[k * n + j] /= pivot, inverse[k * n + j] /= pivot;
    for (uint32_t i = 0; i < n; ++i) {
      const double factor = m[i * n + k];
      for (uint32_t j = 0; i != k && j < n; ++j) {
        m[i * n + j] -= factor * m[k * n + j];
        inverse[i * n + j] -= factor * inverse[k * n + j];
      }
    }
  }
  return inverse;
}

Status prepare(const Csc& lower, Ldl* factor) {
  Array<uint32_t> order(lower.start.context());
  TRY(minimum_degree(lower, &order));
  TRY(factor->analyse(lower, order.span()));
  return factor->factor(lower);
}

}  // namespace

TEST_CASE("solutions and the diagonal of the inverse are those of the dense inverse") {
  for (uint32_t n : {1u, 2u, 3u, 10u, 60u, 150u}) {
    for (uint32_t density = 0; density < 5; ++density) {
      CAPTURE(n);
      CAPTURE(density);
      Heap heap;
      const Symmetric a = random_matrix(n, n * density, 17 * n + density);
      const std::vector<double> inverse = dense_inverse(a);
      const Csc lower = a.csc(heap.context);
      Ldl factor(heap.context);
      must(prepare(lower, &factor));
      std::vector<double> diagonal(n), x(2 * n);
      for (int repeat = 0; repeat < 2; ++repeat) {
        must(factor.inverse_diagonal(span(diagonal)));
        for (uint32_t i = 0; i < n; ++i) x[2 * i] = i + 1.0, x[2 * i + 1] = i % 3;
        must(factor.solve(span(x), 2));
        for (uint32_t i = 0; i < n; ++i) {
          double first = 0.0, second = 0.0;
          for (uint32_t j = 0; j < n; ++j) {
            first += inverse[i * n + j] * (j + 1.0);
            second += inverse[i * n + j] * (j % 3);
          }
          CHECK(diagonal[i] == doctest::Approx(inverse[i * n + i]).epsilon(1e-12));
          CHECK(std::fabs(x[2 * i] - first) < 1e-10 * n);
          CHECK(std::fabs(x[2 * i + 1] - second) < 1e-10 * n);
        }
        must(factor.factor(lower));
      }
    }
  }
}

TEST_CASE("new values with the old pattern, and bad ones") {
  Heap heap;
  Symmetric a = random_matrix(40, 80, 3);
  Csc lower = a.csc(heap.context);
  Ldl factor(heap.context), fresh(heap.context);
  must(prepare(lower, &factor));
  lower.value[lower.start[7]] = -5.0;
  const Status bad = factor.factor(lower);
  CHECK(bad.code == Code::not_positive_definite);
  std::vector<double> x(40, 1.0), y(40, 1.0);
  CHECK(factor.solve(span(x), 1).code == Code::bad_argument);
  CHECK(factor.inverse_diagonal(span(x)).code == Code::bad_argument);
  lower.value[lower.start[7]] = 5e3;
  must(factor.factor(lower));
  must(prepare(lower, &fresh));
  must(factor.solve(span(x), 1));
  must(fresh.solve(span(y), 1));
  CHECK(x == y);
  lower.value.pop();
  CHECK(factor.factor(lower).code == Code::bad_argument);
}

TEST_CASE("each allocation of the factor failed in turn") {
  const Symmetric a = random_matrix(50, 120, 8);
  bool done = false;
  for (size_t at = 0; !done; ++at) {
    Heap heap;
    {
      const Csc lower = a.csc(heap.context);
      Ldl factor(heap.context);
      std::vector<double> x(50, 1.0);
      heap.allocator.fail_at = heap.allocator.calls + at;
      Status status = prepare(lower, &factor);
      if (status.ok()) status = factor.solve(span(x), 1);
      done = status.ok();
      if (!done) CHECK(status.code == Code::out_of_memory);
      if (done) CHECK(at > 10);
    }
    CHECK(heap.allocator.clean());
  }
}
