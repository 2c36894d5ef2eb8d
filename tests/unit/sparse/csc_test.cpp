#include "sparse/csc.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "matrices.h"

using namespace matrices;
using namespace wireskin::sparse;

TEST_CASE("csc: a lower triangle is told from what is none") {
  Heap heap;
  Csc a = grid(3, 2).csc(heap.context);
  CHECK(is_lower_triangle(a));
  SUBCASE("missing diagonal") {
    a.row[a.start[2]] = 3;
  }
  SUBCASE("rows not ascending") {
    std::swap(a.row[1], a.row[2]);
  }
  SUBCASE("row out of range") {
    a.row[2] = 6;
  }
  SUBCASE("not square") {
    a.rows = 7;
  }
  SUBCASE("column above the diagonal") {
    a.row[a.start[5]] = 0;
  }
  CHECK_FALSE(is_lower_triangle(a));
}

TEST_CASE("csc: an empty matrix is a lower triangle and has an empty product") {
  Heap heap;
  Csc a = Symmetric(0).csc(heap.context);
  CHECK(is_lower_triangle(a));
  must(multiply_symmetric(a, {}, {}, 3));
  Csc t(heap.context);
  must(transpose(a, &t));
  CHECK(is_lower_triangle(t));
}

TEST_CASE("csc: the symmetric product agrees with the sum over all entries") {
  std::mt19937 random(1);
  for (uint32_t n : {1u, 2u, 7u, 40u}) {
    Heap heap;
    const Symmetric a = random_spd(n, 4.0, random);
    const Csc lower = a.csc(heap.context);
    const uint32_t columns = 3;
    const std::vector<double> x = random_vector(n * columns, random);
    std::vector<double> y(n * columns, 77.0);
    must(multiply_symmetric(lower, span(x), span(y), columns));
    for (uint32_t i = 0; i < n; ++i) {
      for (uint32_t c = 0; c < columns; ++c) {
        double sum = 0.0;
        for (uint32_t j = 0; j < n; ++j) sum += a.get(i, j) * x[j * columns + c];
        CHECK(y[i * columns + c] == doctest::Approx(sum).epsilon(1e-14).scale(1.0));
      }
    }
  }
}

TEST_CASE("csc: many columns give the bits of single ones") {
  std::mt19937 random(2);
  Heap heap;
  const uint32_t n = 50, columns = 5;
  const Csc lower = random_spd(n, 6.0, random).csc(heap.context);
  const std::vector<double> x = random_vector(n * columns, random);
  std::vector<double> y(n * columns), xc(n), yc(n);
  must(multiply_symmetric(lower, span(x), span(y), columns));
  for (uint32_t c = 0; c < columns; ++c) {
    for (uint32_t i = 0; i < n; ++i) xc[i] = x[i * columns + c];
    must(multiply_symmetric(lower, span(xc), span(yc), 1));
    for (uint32_t i = 0; i < n; ++i) REQUIRE(yc[i] == y[i * columns + c]);
  }
}

TEST_CASE("csc: the transpose of a rectangle, and back") {
  Heap heap;
  Csc a(heap.context), t(heap.context), back(heap.context);
  a.rows = 2;
  a.cols = 4;  // [1 . 3 .; . 2 4 .]
  for (uint32_t s : {0u, 1u, 2u, 4u, 4u}) must(a.start.push(s));
  for (uint32_t r : {0u, 1u, 0u, 1u}) must(a.row.push(r));
  for (double v : {1.0, 2.0, 3.0, 4.0}) must(a.value.push(v));
  must(transpose(a, &t));
  CHECK(t.rows == 4);
  CHECK(t.cols == 2);
  CHECK(std::vector<uint32_t>(t.start.begin(), t.start.end()) == std::vector<uint32_t>{0, 2, 4});
  CHECK(std::vector<uint32_t>(t.row.begin(), t.row.end()) == std::vector<uint32_t>{0, 2, 1, 2});
  CHECK(std::vector<double>(t.value.begin(), t.value.end()) == std::vector<double>{1, 3, 2, 4});
  must(transpose(t, &back));
  CHECK(std::equal(a.start.begin(), a.start.end(), back.start.begin(), back.start.end()));
  CHECK(std::equal(a.row.begin(), a.row.end(), back.row.begin(), back.row.end()));
  CHECK(std::equal(a.value.begin(), a.value.end(), back.value.begin(), back.value.end()));
}

TEST_CASE("csc: both triangles of the permuted pattern list every entry once") {
  std::mt19937 random(3);
  Heap heap;
  const uint32_t n = 30;
  const Symmetric a = random_spd(n, 5.0, random);
  const Csc lower = a.csc(heap.context);
  const std::vector<uint32_t> order = random_order(n, random);
  std::vector<uint32_t> position(n);
  for (uint32_t k = 0; k < n; ++k) position[order[k]] = k;
  for (Triangle triangle : {Triangle::lower, Triangle::upper}) {
    Pattern pattern(heap.context);
    must(permute_pattern(lower, span(std::as_const(position)), triangle, &pattern));
    std::vector<int> seen(lower.row.size(), 0);
    for (uint32_t j = 0; j < n; ++j) {
      for (uint32_t k = pattern.start[j]; k < pattern.start[j + 1]; ++k) {
        const uint32_t i = pattern.index[k];
        CHECK((triangle == Triangle::lower ? i >= j : i <= j));
        CHECK(lower.value[pattern.source[k]] == a.get(order[i], order[j]));
        ++seen[pattern.source[k]];
      }
    }
    CHECK(std::count(seen.begin(), seen.end(), 1) == static_cast<ptrdiff_t>(seen.size()));
  }
}

TEST_CASE("csc: an appended column has its rows ascending, each with its own value") {
  Heap heap;
  Csc matrix(heap.context);
  const std::vector<double> sum = {0.5, 1.5, 2.5, 3.5, 4.5};
  const std::vector<uint32_t> first = {4, 0, 3}, second = {2};
  must(append_column(span(first), span(sum), &matrix));
  must(append_column({}, span(sum), &matrix));
  must(append_column(span(second), span(sum), &matrix));
  CHECK(unit::to_vector(matrix.row) == std::vector<uint32_t>{0, 3, 4, 2});
  CHECK(unit::to_vector(matrix.value) == std::vector<double>{0.5, 3.5, 4.5, 2.5});

  std::vector<double> many_sums(500);
  std::vector<uint32_t> many;
  for (uint32_t i = 0; i < 500; ++i) many_sums[i] = i, many.push_back(i * 7 % 500);
  must(append_column(span(many), span(many_sums), &matrix));
  REQUIRE(matrix.row.size() == 504);
  for (uint32_t i = 0; i < 500; ++i) {
    CHECK(matrix.row[4 + i] == i);
    CHECK(matrix.value[4 + i] == i);
  }
}
