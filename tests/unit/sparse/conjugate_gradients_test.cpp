#include "sparse/conjugate_gradients.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <limits>

#include "matrices.h"
#include "sparse/ordering.h"

using namespace matrices;
using namespace wireskin::sparse;
using wireskin::Code;

namespace {

void factorise(const Csc& lower, Cholesky* factor) {
  Array<uint32_t> order(lower.start.context());
  must(minimum_degree(lower, &order));
  must(factor->analyse(lower, order.span()));
  must(factor->factor(lower));
}

double relative_residual(const Csc& a, const std::vector<double>& x, const std::vector<double>& b) {
  std::vector<double> r(b.size());
  must(multiply_symmetric(a, span(x), span(r), 1));
  double above = 0.0, below = 0.0;
  for (size_t i = 0; i < b.size(); ++i) {
    above += (b[i] - r[i]) * (b[i] - r[i]);
    below += b[i] * b[i];
  }
  return std::sqrt(above / below);
}

// The matrix with another, nearby metric: what a factor grows old by.
Symmetric aged(const Symmetric& a, double change, std::mt19937& random) {
  std::uniform_real_distribution<double> factor(1.0, 1.0 + change);
  Symmetric b = a;
  std::vector<double> d(a.n);
  for (double& v : d) v = factor(random);
  for (auto& [place, value] : b.entries) value *= d[place.first] * d[place.second];
  return b;
}

}  // namespace

TEST_CASE("cg: with Jacobi on the 2D Poisson equation, within the bound of the theory") {
  Heap heap;
  const uint32_t side = 40;
  std::mt19937 random(20);
  const Csc a = grid(side, side).csc(heap.context);
  const std::vector<double> b = random_vector(a.cols, random);
  std::vector<double> x(a.cols, 0.0);
  Jacobi jacobi(heap.context);
  must(jacobi.build(a));
  CgResult result;
  must(conjugate_gradients(heap.context, symmetric_operator(a), jacobi.linear_operator(), span(b),
                           span(x), {}, &result));
  CHECK(result.converged);
  CHECK(result.residual <= 1e-10);
  CHECK(result.residual == doctest::Approx(relative_residual(a, x, b)));
  // The error falls by (k - 1) / (k + 1) a step, k = sqrt(condition) = cot(pi / 2 (side + 1)).
  const double k = 1.0 / std::tan(0.5 * k_pi / (side + 1));
  const double bound = std::log(2.0 * k / 1e-10) / std::log((k + 1.0) / (k - 1.0));
  CHECK(result.iterations <= bound);
  CHECK(result.iterations > 20);
}

TEST_CASE("cg: an eigenvector takes one iteration") {
  Heap heap;
  double eigenvalue = 0.0;
  const std::vector<double> wave = grid_wave(12, 15, 3, 2, &eigenvalue);
  const Csc a = grid(12, 15).csc(heap.context);
  Jacobi jacobi(heap.context);
  must(jacobi.build(a));
  std::vector<double> x(wave.size(), 0.0);
  CgResult result;
  must(conjugate_gradients(heap.context, symmetric_operator(a), jacobi.linear_operator(),
                           span(wave), span(x), {}, &result));
  CHECK(result.iterations == 1);
  for (size_t i = 0; i < x.size(); ++i) {
    CHECK(x[i] * eigenvalue == doctest::Approx(wave[i]).epsilon(1e-12).scale(1.0));
  }
}

TEST_CASE("cg: Jacobi undoes a bad scaling of rows and columns") {
  Heap heap;
  std::mt19937 random(21);
  Symmetric a = random_spd(200, 4.0, random);
  const Csc plain = a.csc(heap.context);
  std::vector<double> d(a.n);
  for (double& v : d) v = std::ldexp(1.0, static_cast<int>(random() % 40) - 20);
  for (auto& [place, value] : a.entries) value *= d[place.first] * d[place.second];
  const Csc scaled = a.csc(heap.context);
  Jacobi plain_jacobi(heap.context), scaled_jacobi(heap.context);
  must(plain_jacobi.build(plain));
  must(scaled_jacobi.build(scaled));
  std::vector<double> b = random_vector(a.n, random), x(a.n, 0.0), y(a.n, 0.0);
  CgOptions options;
  options.max_iterations = 30;
  options.tolerance = 0.0;
  CgResult result;
  must(conjugate_gradients(heap.context, symmetric_operator(plain), plain_jacobi.linear_operator(),
                           span(std::as_const(b)), span(x), options, &result));
  for (uint32_t i = 0; i < a.n; ++i) b[i] *= d[i];
  must(conjugate_gradients(heap.context, symmetric_operator(scaled),
                           scaled_jacobi.linear_operator(), span(std::as_const(b)), span(y),
                           options, &result));
  for (uint32_t i = 0; i < a.n; ++i) CHECK(y[i] * d[i] == x[i]);
}

TEST_CASE("cg: one or two iterations with the exact factor, few with an old one") {
  Heap heap;
  std::mt19937 random(22);
  const Symmetric a = square(grid(30, 30));
  const Csc lower = a.csc(heap.context);
  const std::vector<double> b = random_vector(a.n, random);
  for (double change : {0.0, 0.02, 0.2}) {
    CAPTURE(change);
    Cholesky factor(heap.context);
    factorise(aged(a, change, random).csc(heap.context), &factor);
    std::vector<double> x(a.n, 0.0);
    CgResult result;
    must(conjugate_gradients(heap.context, symmetric_operator(lower), inverse_operator(factor),
                             span(b), span(x), {}, &result));
    CHECK(result.converged);
    CHECK(relative_residual(lower, x, b) <= 1e-10);
    if (change == 0.0) {
      CHECK(result.iterations <= 2);
    } else {
      CHECK(result.iterations > 2);
      CHECK(result.iterations <= (change < 0.1 ? 60 : 250));
    }
  }
}

TEST_CASE("cg: a good start is kept, a zero right-hand side gives zero") {
  Heap heap;
  std::mt19937 random(23);
  const Csc a = grid(9, 9).csc(heap.context);
  Jacobi jacobi(heap.context);
  must(jacobi.build(a));
  const std::vector<double> truth = random_vector(81, random);
  std::vector<double> b(81), x = truth;
  must(multiply_symmetric(a, span(truth), span(b), 1));
  CgResult result;
  must(conjugate_gradients(heap.context, symmetric_operator(a), jacobi.linear_operator(),
                           span(std::as_const(b)), span(x), {}, &result));
  CHECK(result.iterations == 0);
  CHECK(result.converged);
  CHECK(x == truth);
  std::fill(b.begin(), b.end(), 0.0);
  must(conjugate_gradients(heap.context, symmetric_operator(a), jacobi.linear_operator(),
                           span(std::as_const(b)), span(x), {}, &result));
  CHECK(result.converged);
  CHECK(result.residual == 0.0);
  CHECK(x == std::vector<double>(81, 0.0));
}

TEST_CASE("cg: limits end it without a failure") {
  Heap heap;
  std::mt19937 random(24);
  const Csc a = square(grid(30, 30)).csc(heap.context);
  Jacobi jacobi(heap.context);
  must(jacobi.build(a));
  const std::vector<double> b = random_vector(a.cols, random);
  std::vector<double> x(a.cols, 0.0);
  CgResult result;
  CgOptions options;
  SUBCASE("iterations") {
    options.max_iterations = 7;
    must(conjugate_gradients(heap.context, symmetric_operator(a), jacobi.linear_operator(), span(b),
                             span(x), options, &result));
    CHECK(result.iterations == 7);
    CHECK_FALSE(result.converged);
    CHECK(result.residual == doctest::Approx(relative_residual(a, x, b)));
  }
  SUBCASE("accuracy out of reach") {
    options.tolerance = 1e-30;
    options.max_iterations = 100000;
    must(conjugate_gradients(heap.context, symmetric_operator(a), jacobi.linear_operator(), span(b),
                             span(x), options, &result));
    CHECK_FALSE(result.converged);
    CHECK(result.residual < 1e-9);
    CHECK(result.iterations < 20000);
  }
}

TEST_CASE("cg: no equations") {
  Heap heap;
  const Csc a = Symmetric(0).csc(heap.context);
  Jacobi jacobi(heap.context);
  must(jacobi.build(a));
  CgResult result;
  must(conjugate_gradients(heap.context, symmetric_operator(a), jacobi.linear_operator(), {}, {},
                           {}, &result));
  CHECK(result.converged);
}

TEST_CASE("cg: breakdown is a status") {
  Heap heap;
  std::mt19937 random(25);
  Symmetric a = grid(6, 6), m = a;
  std::vector<double> b = random_vector(a.n, random);
  SUBCASE("negative curvature") {
    for (auto& entry : a.entries) {
      if (entry.first.first != entry.first.second) entry.second = -5.0;
    }
  }
  SUBCASE("negative matrix and preconditioner") {
    for (auto& entry : a.entries) entry.second = -entry.second;
    m = a;
  }
  SUBCASE("negative preconditioner") {
    for (auto& entry : m.entries) entry.second = -entry.second;
  }
  SUBCASE("not a number in the matrix") {
    a.at(7, 8) = std::numeric_limits<double>::quiet_NaN();
  }
  SUBCASE("not a number on the right") {
    b[3] = std::numeric_limits<double>::quiet_NaN();
  }
  SUBCASE("infinite right") {
    b[3] = std::numeric_limits<double>::infinity();
  }
  const Csc lower = a.csc(heap.context);
  Jacobi jacobi(heap.context);
  must(jacobi.build(m.csc(heap.context)));
  std::vector<double> x(a.n, 0.0);
  CgResult result;
  CHECK(conjugate_gradients(heap.context, symmetric_operator(lower), jacobi.linear_operator(),
                            span(std::as_const(b)), span(x), {}, &result)
            .code == Code::not_positive_definite);
  CHECK_FALSE(result.converged);
  for (double v : x) CHECK(std::isfinite(v));
}

TEST_CASE("cg: every failing allocation and every cancel is a clean status") {
  std::mt19937 random(26);
  const Symmetric a = grid(10, 10);
  const std::vector<double> b = random_vector(a.n, random);
  for (bool cancel : {false, true}) {
    bool done = false;
    for (size_t k = 0; !done; ++k) {
      REQUIRE(k < 1000);
      Heap heap;
      {
        const Csc lower = a.csc(heap.context);
        Jacobi jacobi(heap.context);
        must(jacobi.build(lower));
        if (cancel) {
          heap.cancel_at = heap.checkpoints + k;
        } else {
          heap.allocator.fail_at = heap.allocator.calls + k;
        }
        std::vector<double> x(a.n, 0.0);
        CgResult result;
        const Status status =
            conjugate_gradients(heap.context, symmetric_operator(lower), jacobi.linear_operator(),
                                span(b), span(x), {}, &result);
        done = status.ok();
        if (done) {
          CHECK(result.converged);
          CHECK(k >= 4);
        } else {
          CHECK(status.code == (cancel ? Code::cancelled : Code::out_of_memory));
        }
      }
      CHECK(heap.allocator.clean());
    }
  }
}
