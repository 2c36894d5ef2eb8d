#include "sparse/cholesky.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <limits>
#include <thread>

#include "matrices.h"
#include "sparse/nested_dissection.h"
#include "sparse/ordering.h"

using namespace matrices;
using namespace wireskin::sparse;
using wireskin::Code;

namespace {

// Orders, analyses and factors.
Status prepare(const Csc& lower, Cholesky* factor) {
  Array<uint32_t> order(lower.start.context());
  TRY(minimum_degree(lower, &order));
  TRY(factor->analyse(lower, order.span()));
  return factor->factor(lower);
}

std::vector<double> solution(const Symmetric& a, std::vector<double> b, uint32_t columns = 1) {
  Heap heap;
  Cholesky factor(heap.context);
  must(prepare(a.csc(heap.context), &factor));
  must(factor.solve(span(b), columns));
  return b;
}

// A dense Cholesky solve, the plainest there is.
std::vector<double> dense_solution(const Symmetric& a, std::vector<double> b) {
  const uint32_t n = a.n;
  std::vector<std::vector<double>> l(n, std::vector<double>(n));
  for (uint32_t i = 0; i < n; ++i) {
    for (uint32_t j = 0; j <= i; ++j) {
      double sum = a.get(i, j);
      for (uint32_t k = 0; k < j; ++k) sum -= l[i][k] * l[j][k];
      l[i][j] = i == j ? std::sqrt(sum) : sum / l[j][j];
    }
  }
  for (uint32_t i = 0; i < n; ++i) {
    for (uint32_t k = 0; k < i; ++k) b[i] -= l[i][k] * b[k];
    b[i] /= l[i][i];
  }
  for (uint32_t i = n; i-- > 0;) {
    for (uint32_t k = i + 1; k < n; ++k) b[i] -= l[k][i] * b[k];
    b[i] /= l[i][i];
  }
  return b;
}

double largest(const std::vector<double>& v) {
  double m = 0.0;
  for (double x : v) m = std::max(m, std::fabs(x));
  return m;
}

double difference(const std::vector<double>& a, const std::vector<double>& b) {
  double m = 0.0;
  for (size_t i = 0; i < a.size(); ++i) m = std::max(m, std::fabs(a[i] - b[i]));
  return m;
}

}  // namespace

TEST_CASE("cholesky: nothing to solve, and one equation") {
  CHECK(solution(Symmetric(0), {}).empty());
  Symmetric one(1);
  one.at(0, 0) = 4.0;
  CHECK(solution(one, {6.0, 2.0}, 2) == std::vector<double>{1.5, 0.5});
}

TEST_CASE("cholesky: a diagonal matrix divides") {
  Symmetric a(50);
  std::vector<double> b(50), x(50);
  for (uint32_t i = 0; i < 50; ++i) {
    a.at(i, i) = (i + 1.0) * (i + 1.0);
    x[i] = i - 20.0;
    b[i] = a.at(i, i) * x[i];
  }
  CHECK(difference(solution(a, b), x) <= 1e-14);
}

TEST_CASE("cholesky: the parabola of the 1D Poisson equation") {
  for (uint32_t n : {2u, 3u, 10u, 1000u}) {
    const std::vector<double> x = solution(path(n), std::vector<double>(n, 1.0));
    for (uint32_t i = 0; i < n; ++i) {
      CHECK(x[i] == doctest::Approx(0.5 * (i + 1.0) * (n - i)).epsilon(1e-10));
    }
  }
}

TEST_CASE("cholesky: waves of the 2D Poisson equation and of the bilaplacian") {
  const uint32_t w = 33, h = 21;
  for (auto [p, q] : {std::pair<uint32_t, uint32_t>{1, 1}, {3, 2}, {33, 21}, {20, 1}}) {
    double eigenvalue = 0.0;
    const std::vector<double> wave = grid_wave(w, h, p, q, &eigenvalue);
    std::vector<double> x = solution(grid(w, h), wave);
    std::vector<double> y = solution(square(grid(w, h)), wave);
    for (double& v : x) v *= eigenvalue;
    for (double& v : y) v *= eigenvalue * eigenvalue;
    CHECK(difference(x, wave) <= 1e-12);
    CHECK(difference(y, wave) <= 1e-9);
  }
}

TEST_CASE("cholesky: random matrices against a dense factor") {
  std::mt19937 random(14);
  for (int round = 0; round < 100; ++round) {
    const uint32_t n = 1 + static_cast<uint32_t>(random() % 90);
    const Symmetric a = random_spd(n, 0.1 * (1 + random() % 100), random);
    const std::vector<double> b = random_vector(n, random);
    const std::vector<double> x = dense_solution(a, b);
    REQUIRE(difference(solution(a, b), x) <= 1e-12 * (1.0 + largest(x)));
  }
}

// The blocks of the large updates are far more than that.
TEST_CASE("cholesky: a small system needs little memory") {
  Heap heap;
  const Symmetric a = square(grid(8, 8));
  Cholesky factor(heap.context);
  must(prepare(a.csc(heap.context), &factor));
  CHECK(factor.factor_bytes() < 64u << 10);
  CHECK(heap.allocator.peak_bytes < 128u << 10);
}

TEST_CASE("cholesky: any order gives the solution") {
  std::mt19937 random(15);
  const Symmetric a = random_spd(80, 5.0, random);
  const std::vector<double> b = random_vector(80, random);
  const std::vector<double> truth = dense_solution(a, b);
  for (int round = 0; round < 20; ++round) {
    Heap heap;
    const Csc lower = a.csc(heap.context);
    const std::vector<uint32_t> order = random_order(80, random);
    Cholesky factor(heap.context);
    must(factor.analyse(lower, span(order)));
    must(factor.factor(lower));
    std::vector<double> x = b;
    must(factor.solve(span(x), 1));
    CHECK(difference(x, truth) <= 1e-12);
    CHECK(factor.nonzeros() == Elimination(a, order).nonzeros());
  }
}

TEST_CASE("cholesky: rows and columns scaled by powers of two scale the solution exactly") {
  std::mt19937 random(16);
  const Symmetric a = random_spd(60, 6.0, random);
  const std::vector<double> b = random_vector(60, random);
  Symmetric scaled = a;
  std::vector<double> d(60), c = b;
  for (uint32_t i = 0; i < 60; ++i) d[i] = std::ldexp(1.0, static_cast<int>(random() % 200) - 100);
  for (auto& [place, value] : scaled.entries) value *= d[place.first] * d[place.second];
  for (uint32_t i = 0; i < 60; ++i) c[i] *= d[i];
  const std::vector<double> x = solution(a, b);
  std::vector<double> y = solution(scaled, c);
  for (uint32_t i = 0; i < 60; ++i) y[i] *= d[i];
  CHECK(x == y);
}

TEST_CASE("cholesky: many right-hand sides have the bits of single ones") {
  std::mt19937 random(17);
  const Symmetric a = square(grid(23, 17));
  for (uint32_t columns : {1u, 2u, 3u, 4u, 5u, 9u}) {
    const std::vector<double> b = random_vector(a.n * columns, random);
    const std::vector<double> x = solution(a, b, columns);
    for (uint32_t c = 0; c < columns; ++c) {
      std::vector<double> bc(a.n);
      for (uint32_t i = 0; i < a.n; ++i) bc[i] = b[i * columns + c];
      const std::vector<double> xc = solution(a, bc);
      for (uint32_t i = 0; i < a.n; ++i) REQUIRE(xc[i] == x[i * columns + c]);
    }
  }
}

TEST_CASE("cholesky: a repeated factor has the bits of a fresh one and allocates nothing") {
  std::mt19937 random(18);
  Heap heap;
  const Symmetric first = square(grid(20, 20));
  Symmetric second = first;
  for (uint32_t i = 0; i < second.n; ++i) second.at(i, i) += 0.25 * (random() % 16);
  const std::vector<double> b = random_vector(first.n, random);
  const Csc a1 = first.csc(heap.context), a2 = second.csc(heap.context);
  Cholesky factor(heap.context);
  must(prepare(a1, &factor));
  std::vector<double> x = b;
  must(factor.solve(span(x), 1));
  const size_t calls = heap.allocator.calls;
  must(factor.factor(a2));
  x = b;
  must(factor.solve(span(x), 1));
  CHECK(heap.allocator.calls == calls);
  CHECK(x == solution(second, b));
  CHECK(x != solution(first, b));
}

namespace {

// Runs the bodies on three threads, the last ones first.
void on_three_threads(uint32_t count, void (*body)(uint32_t, void*), void* data, void* calls) {
  ++*static_cast<size_t*>(calls);
  std::vector<std::thread> threads;
  for (uint32_t t = 0; t < 3; ++t) {
    threads.emplace_back([=] {
      for (uint32_t i = count; i-- > 0;) {
        if (i % 3 == t) body(i, data);
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
}

}  // namespace

TEST_CASE("cholesky: after the last factor less memory solves the same") {
  std::mt19937 random(21);
  const Symmetric a = random_spd(60, 4.0, random);
  const std::vector<double> b = random_vector(60, random);
  Heap heap;
  Cholesky factor(heap.context);
  const Csc lower = a.csc(heap.context);
  must(prepare(lower, &factor));
  std::vector<double> before = b, after = b;
  must(factor.solve(span(before), 1));
  const size_t used = heap.context.used_bytes();
  factor.end_factoring();
  CHECK(heap.context.used_bytes() < used);
  must(factor.solve(span(after), 1));
  CHECK(after == before);
  CHECK(factor.factor(lower).code == Code::bad_argument);
  must(prepare(lower, &factor));
  after = b;
  must(factor.solve(span(after), 1));
  CHECK(after == before);
}

TEST_CASE("cholesky: the same bits on every instruction set and on any number of threads") {
  std::mt19937 random(21);
  const uint32_t side = 110;
  const Symmetric a = square(grid(side, side));
  const std::vector<double> b = random_vector(a.n * 9, random);
  std::vector<wireskin::Vec3> place;
  for (uint32_t i = 0; i < a.n; ++i) {
    place.push_back({static_cast<double>(i % side), static_cast<double>(i / side), 0.0});
  }
  const std::vector<uint32_t> patch(a.n, 0);
  std::vector<double> truth;
  for (const bool threads : {false, true}) {
    for (const Instructions set :
         {Instructions::baseline, Instructions::avx2, Instructions::avx512}) {
      if (!has_instructions(set)) continue;
      scenes::FaultyAllocator allocator;
      size_t calls = 0;
      wireskin::Callbacks callbacks;
      callbacks.parallel_for = threads ? &on_three_threads : nullptr;
      callbacks.parallel_for_user = &calls;
      wireskin::Context context({&allocator.allocate, &allocator.release, &allocator}, 0,
                                callbacks);
      const Csc lower = a.csc(context);
      Array<uint32_t> order(context);
      must(nested_dissection(lower, {{}, span(place), span(patch)}, &order));
      Cholesky factor(context, set);
      must(factor.analyse(lower, order.span()));
      const size_t before = context.used_bytes();
      must(factor.factor(lower));
      CHECK(context.used_bytes() - before == factor.factor_bytes());
      std::vector<double> x = b;
      must(factor.solve(span(x), 9));
      if (truth.empty()) truth = x;
      CHECK(x == truth);
      CHECK((calls > 10) == threads);
      // A bad column is the same one, however the work is divided.
      Csc bad = a.csc(context);
      for (const uint32_t j : {700u, 7000u, 9000u}) bad.value[bad.start[j]] = -1.0;
      const Status status = factor.factor(bad);
      CHECK(status.code == Code::not_positive_definite);
      static uint32_t place_of_bad = wireskin::k_none;
      if (place_of_bad == wireskin::k_none) place_of_bad = status.place.vertex;
      CHECK(status.place.vertex == place_of_bad);
    }
  }
}

TEST_CASE("cholesky: another pattern may be analysed in the same object") {
  std::mt19937 random(19);
  Heap heap;
  Cholesky factor(heap.context);
  for (const Symmetric& a : {grid(12, 9), random_spd(30, 4.0, random), square(grid(15, 15))}) {
    const std::vector<double> b = random_vector(a.n, random);
    must(prepare(a.csc(heap.context), &factor));
    std::vector<double> x = b;
    must(factor.solve(span(x), 1));
    CHECK(x == solution(a, b));
  }
}

TEST_CASE("cholesky: a matrix that is not positive definite is a status and leaves no factor") {
  const double infinite = std::numeric_limits<double>::infinity();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Symmetric good = square(grid(8, 8));
  Symmetric bad = good;
  SUBCASE("negative diagonal") {
    bad.at(17, 17) = -1.0;
  }
  SUBCASE("zero diagonal") {
    bad.at(17, 17) = 0.0;
  }
  SUBCASE("indefinite by a large entry") {
    bad.at(17, 18) = 1e3;
  }
  SUBCASE("diagonal not a number") {
    bad.at(17, 17) = nan;
  }
  SUBCASE("entry not a number") {
    bad.at(17, 18) = nan;
  }
  SUBCASE("infinite diagonal") {
    bad.at(17, 17) = infinite;
  }
  SUBCASE("infinite entry") {
    bad.at(17, 18) = -infinite;
  }
  SUBCASE("minus everything") {
    for (auto& entry : bad.entries) entry.second = -entry.second;
  }
  SUBCASE("all zero") {
    for (auto& entry : bad.entries) entry.second = 0.0;
  }
  Heap heap;
  Cholesky factor(heap.context);
  const Status status = prepare(bad.csc(heap.context), &factor);
  CHECK(status.code == Code::not_positive_definite);
  CHECK(status.place.vertex < good.n);
  std::vector<double> x(good.n, 3.0);
  CHECK(factor.solve(span(x), 1).code == Code::bad_argument);
  CHECK(x == std::vector<double>(good.n, 3.0));
  // The same object recovers with good values.
  must(factor.factor(good.csc(heap.context)));
  must(factor.solve(span(x), 1));
  CHECK(x == solution(good, std::vector<double>(good.n, 3.0)));
}

TEST_CASE("cholesky: the place is the column whose pivot fails") {
  Heap heap;
  Symmetric a(4);
  for (uint32_t i = 0; i < 4; ++i) a.at(i, i) = 1.0;
  a.at(3, 1) = 2.0;
  const Csc lower = a.csc(heap.context);
  Cholesky factor(heap.context);
  for (const std::vector<uint32_t>& order :
       {std::vector<uint32_t>{0, 1, 2, 3}, std::vector<uint32_t>{3, 0, 2, 1}}) {
    must(factor.analyse(lower, span(order)));
    CHECK(factor.factor(lower).place.vertex == order[3]);
  }
}

TEST_CASE("cholesky: calls out of turn and orders that are none are refused") {
  Heap heap;
  const Csc lower = path(5).csc(heap.context);
  Cholesky factor(heap.context);
  std::vector<double> x(5, 1.0);
  CHECK(factor.factor(lower).code == Code::bad_argument);
  CHECK(factor.solve(span(x), 1).code == Code::bad_argument);
  for (const std::vector<uint32_t>& order :
       {std::vector<uint32_t>{0, 1, 2, 3, 3}, {0, 1, 2, 3, 5}, {0, 1, 2, 3}, {0, 1, 2, 3, 4, 5}}) {
    CHECK(factor.analyse(lower, span(order)).code == Code::bad_argument);
    CHECK(factor.factor(lower).code == Code::bad_argument);
  }
  must(prepare(lower, &factor));
  CHECK(factor.factor(grid(2, 3).csc(heap.context)).code == Code::bad_argument);
}

TEST_CASE("cholesky: a factor of more than 2^32 entries is too large, at no cost") {
  Heap heap;
  const uint32_t n = 100000;
  Csc star(heap.context);  // eliminated from its hub, it fills in completely
  star.rows = star.cols = n;
  must(star.start.push(0));
  for (uint32_t j = 0; j < n; ++j) {
    for (uint32_t i = j; i < (j == 0 ? n : j + 1); ++i) {
      must(star.row.push(i));
      must(star.value.push(i == j ? n : -1.0));
    }
    must(star.start.push(static_cast<uint32_t>(star.row.size())));
  }
  Cholesky factor(heap.context);
  const std::vector<uint32_t> order = natural_order(n);
  CHECK(factor.analyse(star, span(order)).code == Code::too_large);
  CHECK(heap.allocator.peak_bytes < 30u << 20);
  // Eliminated from its leaves it does not fill in at all.
  must(prepare(star, &factor));
  CHECK(factor.nonzeros() == star.row.size());
}

TEST_CASE("cholesky: every failing allocation and every cancel is a clean status") {
  const Symmetric a = square(grid(40, 40));
  const std::vector<double> b(a.n * 2, 1.0);
  const std::vector<double> truth = solution(a, b, 2);
  for (bool cancel : {false, true}) {
    bool done = false;
    for (size_t k = 0; !done; ++k) {
      REQUIRE(k < 1000);
      Heap heap;
      {
        const Csc lower = a.csc(heap.context);
        const size_t before = heap.allocator.calls;
        if (cancel) {
          heap.cancel_at = k;
        } else {
          heap.allocator.fail_at = before + k;
        }
        Cholesky factor(heap.context);
        std::vector<double> x = b;
        Status status = prepare(lower, &factor);
        if (status.ok()) status = factor.solve(span(x), 2);
        done = status.ok();
        if (done) {
          CHECK(k >= (cancel ? 3 : 10));
        } else {
          CHECK(status.code == (cancel ? Code::cancelled : Code::out_of_memory));
          if (!cancel) CHECK(x == b);
          // The same object succeeds when asked again.
          x = b;
          must(prepare(lower, &factor));
          must(factor.solve(span(x), 2));
        }
        CHECK(x == truth);
      }
      CHECK(heap.allocator.clean());
    }
  }
}
