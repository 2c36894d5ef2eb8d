#include "sparse/dense.h"

#include <doctest/doctest.h>

#include <array>

#include "matrices.h"

using namespace matrices;
using namespace wireskin::sparse;

namespace {

const Instructions k_all[] = {Instructions::baseline, Instructions::avx2, Instructions::avx512};

// The definition, one output after the other.
void plain_update(const Update& u) {
  for (uint32_t j = 0; j < u.columns; ++j) {
    for (uint32_t i = 0; i < u.rows; ++i) {
      double& c = u.c[i + j * u.c_step];
      double sum = u.overwrite ? 0.0 : c;
      for (uint32_t k = 0; k < u.depth; ++k) {
        const double product = u.a[i + k * u.a_step] * u.b[j * u.b_out + k * u.b_step];
        sum = sum - product;
      }
      c = sum;
    }
  }
}

// Compares every instruction set with the definition, bit for bit.
void check_update(uint32_t rows, uint32_t columns, uint32_t depth, bool lower, bool overwrite,
                  bool by_rows, std::mt19937& random) {
  const uint32_t gap = 4 * static_cast<uint32_t>(random() % 3);
  const size_t a_step = rows + gap + random() % 5;
  const std::vector<double> a = random_vector(a_step * depth + 8, random);
  const size_t b_out = by_rows ? depth + random() % 5 : 1;
  const size_t b_step = by_rows ? 1 : columns + random() % 5;
  const std::vector<double> b = random_vector(columns * b_out + depth * b_step, random);
  const std::vector<double> c = random_vector((rows + gap) * columns, random);
  std::vector<double> truth = c, scratch(k_update_scratch);
  plain_update({rows, columns, depth, a.data(), a_step, b.data(), b_out, b_step, truth.data(),
                size_t{rows} + gap, lower, overwrite});
  for (const Instructions set : k_all) {
    if (!has_instructions(set)) continue;
    std::vector<double> result = c;
    dense_kernels(set).update({rows, columns, depth, a.data(), a_step, b.data(), b_out, b_step,
                               result.data(), size_t{rows} + gap, lower, overwrite},
                              scratch.data());
    for (uint32_t j = 0; j < columns; ++j) {
      for (uint32_t i = 0; i < rows + gap; ++i) {
        const size_t k = i + j * (size_t{rows} + gap);
        if (lower && i < j) continue;
        REQUIRE(result[k] == truth[k]);
      }
    }
  }
}

}  // namespace

TEST_CASE("dense: updates of any shape have the bits of the definition on every instruction set") {
  std::mt19937 random(3);
  for (uint32_t rows = 4; rows <= 56; rows += 4) {
    for (uint32_t columns = 1; columns <= 9; ++columns) {
      const uint32_t depth = static_cast<uint32_t>(random() % 20);
      check_update(rows, columns, depth, false, random() % 2 == 0, random() % 2 == 0, random);
      check_update(rows, columns < rows ? columns : rows, depth, true, random() % 2 == 0, false,
                   random);
    }
  }
}

TEST_CASE("dense: updates done in blocks have the same bits") {
  std::mt19937 random(4);
  for (const auto [rows, columns, depth] : {std::array<uint32_t, 3>{96, 5, 25},
                                            {100, 130, 30},
                                            {204, 201, 70},
                                            {108, 107, 300},
                                            {196, 129, 257},
                                            {300, 3, 520}}) {
    for (const bool lower : {false, true}) {
      for (const bool overwrite : {false, true}) {
        check_update(rows, columns, depth, lower && columns <= rows, overwrite, false, random);
      }
    }
    check_update(rows, columns, depth, false, false, true, random);
  }
}

TEST_CASE("dense: dot products are eight sums added pairwise on every instruction set") {
  std::mt19937 random(8);
  for (uint32_t depth = 0; depth <= 44; depth += 4) {
    for (uint32_t columns = 1; columns <= 9; ++columns) {
      for (uint32_t lanes = 1; lanes <= 7; ++lanes) {
        const size_t a_step = depth + random() % 5, b_step = depth + random() % 5;
        const size_t c_step = columns + random() % 5;
        const std::vector<double> a = random_vector(a_step * columns + 1, random);
        const std::vector<double> b = random_vector(b_step * lanes + 1, random);
        const std::vector<double> c = random_vector(c_step * lanes, random);
        std::vector<double> truth = c;
        for (uint32_t l = 0; l < lanes; ++l) {
          for (uint32_t j = 0; j < columns; ++j) {
            double s[8] = {};
            for (uint32_t k = 0; k < depth; ++k) {
              const double product = a[j * a_step + k] * b[l * b_step + k];
              s[k % 8] = s[k % 8] + product;
            }
            const double even = (s[0] + s[4]) + (s[2] + s[6]);
            const double odd = (s[1] + s[5]) + (s[3] + s[7]);
            truth[j + l * c_step] -= even + odd;
          }
        }
        for (const Instructions set : k_all) {
          if (!has_instructions(set)) continue;
          std::vector<double> result = c;
          dense_kernels(set).subtract_dots(
              {columns, lanes, depth, a.data(), a_step, b.data(), b_step, result.data(), c_step});
          REQUIRE(result == truth);
        }
      }
    }
  }
}

TEST_CASE("dense: rows are solved with every size of triangle, forwards and backwards") {
  std::mt19937 random(5);
  for (uint32_t n = 1; n <= DiagonalBlock::k_size; ++n) {
    for (uint32_t rows = 4; rows <= 32; rows += 4) {
      DiagonalBlock d = {};
      d.columns = n;
      for (uint32_t i = 0; i < n; ++i) {
        d.inverse[i] = 0.5 + 0.25 * static_cast<double>(i);
        for (uint32_t j = 0; j < i; ++j) d.entry[i][j] = random_vector(1, random)[0];
      }
      const size_t step = rows + 4;
      const std::vector<double> x = random_vector(step * n, random);
      for (const bool backward : {false, true}) {
        std::vector<double> truth = x;
        const auto at = [&](uint32_t row, uint32_t column) -> double& {
          return truth[row + step * (backward ? n - 1 - column : column)];
        };
        for (uint32_t r = 0; r < rows; ++r) {
          for (uint32_t j = 0; j < n; ++j) {
            double sum = at(r, j);
            for (uint32_t k = 0; k < j; ++k) {
              const double product = at(r, k) * d.entry[j][k];
              sum = sum - product;
            }
            at(r, j) = sum * d.inverse[j];
          }
        }
        for (const Instructions set : k_all) {
          if (!has_instructions(set)) continue;
          std::vector<double> result = x;
          const ptrdiff_t by = static_cast<ptrdiff_t>(step);
          dense_kernels(set).solve_block(d, rows, result.data() + (backward ? step * (n - 1) : 0),
                                         backward ? -by : by);
          REQUIRE(result == truth);
        }
      }
    }
  }
}

TEST_CASE("dense: a column is added run by run") {
  std::mt19937 random(6);
  const Run runs[] = {{0, 5, 7}, {7, 14, 1}, {8, 20, 12}};
  const std::vector<double> from = random_vector(20, random);
  for (const uint32_t k : {0u, 3u, 6u}) {
    for (const Instructions set : k_all) {
      if (!has_instructions(set)) continue;
      const std::vector<double> to = random_vector(40, random);
      std::vector<double> result = to, truth = to;
      for (const Run& run : runs) {
        for (uint32_t i = 0; i < run.length; ++i) {
          if (run.from + i >= k) truth[run.to + i - 2] += from[run.from + i];
        }
      }
      dense_kernels(set).add_runs(runs, runs + 3, k, from.data(), result.data(), 2);
      CHECK(result == truth);
    }
  }
}

TEST_CASE("dense: the best instructions are ones that the processor has") {
  CHECK(has_instructions(Instructions::baseline));
  CHECK(has_instructions(best_instructions()));
  if (has_instructions(Instructions::avx512)) CHECK(has_instructions(Instructions::avx2));
}
