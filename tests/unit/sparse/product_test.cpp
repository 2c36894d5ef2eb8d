#include "sparse/product.h"

#include <doctest/doctest.h>

#include "matrices.h"

using namespace matrices;
using namespace wireskin::sparse;

namespace {

// A random square matrix with about `degree` entries a column and its diagonal.
Csc random_matrix(wireskin::Context& context, uint32_t n, double degree, std::mt19937& random,
                  std::vector<std::vector<double>>* dense) {
  Csc a(context);
  a.rows = a.cols = n;
  dense->assign(n, std::vector<double>(n, 0.0));
  std::uniform_real_distribution<double> value(-1.0, 1.0);
  for (uint32_t j = 0; j < n; ++j) {
    must(a.start.push(static_cast<uint32_t>(a.row.size())));
    for (uint32_t i = 0; i < n; ++i) {
      if (i != j && random() % n >= degree) continue;
      const double x = value(random);
      must(a.row.push(i));
      must(a.value.push(x));
      (*dense)[i][j] = x;
    }
  }
  must(a.start.push(static_cast<uint32_t>(a.row.size())));
  return a;
}

// Checks A diag(w) B, cut to the unknowns, against the sums written out.
void check_product(uint32_t n, uint32_t seed, Part part, const std::vector<uint32_t>& unknown) {
  std::mt19937 random(seed);
  Heap heap;
  std::vector<std::vector<double>> da, db;
  const Csc a = random_matrix(heap.context, n, 3.0, random, &da);
  const Csc b = random_matrix(heap.context, n, 2.0, random, &db);
  std::vector<double> weight = random_vector(n, random);
  for (uint32_t k = 0; k < n; k += 3) weight[k] = 0.0;
  uint32_t unknowns = 0;
  for (uint32_t u : unknown) unknowns += u != wireskin::k_none;
  Csc product(heap.context);
  must(
      weighted_product(a, span(std::as_const(weight)), b, span(unknown), unknowns, part, &product));
  REQUIRE(product.rows == unknowns);
  REQUIRE(product.cols == unknowns);
  REQUIRE(product.start.size() == unknowns + 1);
  REQUIRE(product.row.size() == product.start[unknowns]);
  for (uint32_t column = 0; column < n; ++column) {
    const uint32_t j = unknown[column];
    if (j == wireskin::k_none) continue;
    std::map<uint32_t, double> expected;  // with the entries that are zero by weight alone
    for (uint32_t row = 0; row < n; ++row) {
      const uint32_t i = unknown[row];
      if (i == wireskin::k_none || (part == Part::lower && i < j)) continue;
      double sum = 0.0;
      bool present = false;
      for (uint32_t k = 0; k < n; ++k) {
        sum += da[row][k] * weight[k] * db[k][column];
        present = present || (da[row][k] != 0.0 && db[k][column] != 0.0);
      }
      if (present) expected[i] = sum;
    }
    std::map<uint32_t, double> got;
    for (uint32_t p = product.start[j]; p < product.start[j + 1]; ++p) {
      if (p > product.start[j]) REQUIRE(product.row[p] > product.row[p - 1]);
      got[product.row[p]] = product.value[p];
    }
    REQUIRE(got.size() == expected.size());
    for (const auto& [i, x] : expected) {
      REQUIRE(got.count(i) == 1);
      REQUIRE(std::fabs(got[i] - x) < 1e-14);
    }
  }
}

std::vector<uint32_t> some_unknowns(uint32_t n, uint32_t seed) {
  std::mt19937 random(seed);
  std::vector<uint32_t> unknown(n, wireskin::k_none);
  uint32_t next = 0;
  for (uint32_t& u : unknown) {
    if (random() % 3 != 0) u = next++;
  }
  return unknown;
}

}  // namespace

TEST_CASE("product: agrees with the dense one, whole and lower, all and some unknowns") {
  for (uint32_t n : {1u, 2u, 7u, 40u}) {
    for (uint32_t seed = 0; seed < 5; ++seed) {
      for (Part part : {Part::all, Part::lower}) {
        check_product(n, seed, part, natural_order(n));
        check_product(n, seed, part, some_unknowns(n, seed));
      }
    }
  }
}

TEST_CASE("product: no unknowns give an empty matrix") {
  check_product(5, 1, Part::all, std::vector<uint32_t>(5, wireskin::k_none));
}

TEST_CASE("product: the pattern does not depend on the weights") {
  std::mt19937 random(9);
  Heap heap;
  std::vector<std::vector<double>> dense;
  const Csc a = random_matrix(heap.context, 20, 3.0, random, &dense);
  const std::vector<uint32_t> unknown = natural_order(20);
  const std::vector<double> zeros(20, 0.0), ones(20, 1.0);
  Csc x(heap.context), y(heap.context);
  must(weighted_product(a, span(zeros), a, span(unknown), 20, Part::lower, &x));
  must(weighted_product(a, span(ones), a, span(unknown), 20, Part::lower, &y));
  CHECK(std::vector<uint32_t>(x.row.begin(), x.row.end()) ==
        std::vector<uint32_t>(y.row.begin(), y.row.end()));
  CHECK(is_lower_triangle(y));
}

TEST_CASE("product: one long column is no reason to forget the checkpoints") {
  const uint32_t n = 1500;
  Symmetric star(n);
  for (uint32_t i = 1; i < n; ++i) star.connect(0, i);
  Heap heap;
  Csc full(heap.context);
  full.rows = full.cols = n;
  for (uint32_t j = 0; j < n; ++j) {
    must(full.start.push(static_cast<uint32_t>(full.row.size())));
    for (uint32_t i = 0; i < n; ++i) {
      if (!star.has(i, j)) continue;
      must(full.row.push(i));
      must(full.value.push(star.get(i, j)));
    }
  }
  must(full.start.push(static_cast<uint32_t>(full.row.size())));
  const std::vector<double> ones(n, 1.0);
  const std::vector<uint32_t> order = natural_order(n);
  Csc product(heap.context);
  must(weighted_product(full, span(ones), full, span(order), n, Part::lower, &product));
  CHECK(heap.checkpoints >= 4);  // 2 n^2 multiplications
  heap.cancel_at = heap.checkpoints;
  CHECK(weighted_product(full, span(ones), full, span(order), n, Part::lower, &product).code ==
        wireskin::Code::cancelled);
}

TEST_CASE("product: every failed allocation is a status") {
  for (size_t at = 0;; ++at) {
    REQUIRE(at < 50);
    Heap heap;
    const Csc a = path(6).csc(heap.context);
    const std::vector<double> ones(6, 1.0);
    const std::vector<uint32_t> order = natural_order(6);
    heap.allocator.fail_at = heap.allocator.calls + at;
    Csc product(heap.context);
    const Status s = weighted_product(a, span(ones), a, span(order), 6, Part::all, &product);
    if (s.ok()) break;
    CHECK(s.code == wireskin::Code::out_of_memory);
  }
}
