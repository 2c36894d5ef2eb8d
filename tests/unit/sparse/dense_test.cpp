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

// The columns of a panel as they are stored, and the same in a rectangle.
struct Trapezoid {
  uint32_t rows, width;
  std::vector<double> stored, whole;

  Trapezoid(uint32_t rows_in, uint32_t width_in, std::mt19937& random)
      : rows(rows_in),
        width(width_in),
        stored(random_vector(trapezoid_size(rows, width), random)),
        whole(size_t{rows} * width) {
    for (uint32_t j = 0; j < width; ++j) {
      for (uint32_t i = j / k_trapezoid_block * k_trapezoid_block; i < rows; ++i) {
        whole[i + size_t{j} * rows] = stored[trapezoid_offset(rows, j) + i];
      }
    }
  }
  std::vector<double> below_diagonal(bool of_stored) const {
    std::vector<double> values;
    for (uint32_t j = 0; j < width; ++j) {
      for (uint32_t i = j; i < rows; ++i) {
        values.push_back(of_stored ? stored[trapezoid_offset(rows, j) + i]
                                   : whole[i + size_t{j} * rows]);
      }
    }
    return values;
  }
};

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

TEST_CASE("dense: columns of a trapezoid lose the products of those on their left") {
  std::mt19937 random(9);
  for (const auto [rows, depth, columns] : {std::array<uint32_t, 3>{12, 8, 3},
                                            {20, 16, 4},
                                            {32, 16, 13},
                                            {56, 24, 30},
                                            {148, 32, 64},
                                            {260, 64, 64},
                                            {352, 40, 150},
                                            {420, 264, 60}}) {
    const Trapezoid given(rows, depth + columns, random);
    Trapezoid truth = given;
    const double* from = truth.whole.data() + depth;
    plain_update({rows - depth, columns, depth, from, rows, from, 1, rows,
                  truth.whole.data() + depth + size_t{depth} * rows, rows, true, false});
    for (const Instructions set : k_all) {
      if (!has_instructions(set)) continue;
      Trapezoid result = given;
      std::vector<double> scratch(k_update_scratch);
      from = result.stored.data() + depth;
      dense_kernels(set).update({rows - depth, columns, depth, from, rows, from, 1, rows,
                                 result.stored.data() + trapezoid_offset(rows, depth) + depth,
                                 rows - depth, true, false, true, true},
                                scratch.data());
      REQUIRE(result.below_diagonal(true) == truth.below_diagonal(false));
    }
  }
}

TEST_CASE("dense: the rows below a trapezoid make an update") {
  std::mt19937 random(10);
  for (const auto [rows, width] :
       {std::array<uint32_t, 2>{8, 1}, {24, 8}, {40, 13}, {120, 20}, {132, 32}, {400, 75}}) {
    const Trapezoid given(rows, width, random);
    const uint32_t first = (width + 3) / 4 * 4, tail = rows - first;
    std::vector<double> truth(size_t{tail} * tail);
    const double* from = given.whole.data() + first;
    plain_update({tail, tail, width, from, rows, from, 1, rows, truth.data(), tail, false, true});
    for (const Instructions set : k_all) {
      if (!has_instructions(set)) continue;
      std::vector<double> result(size_t{tail} * tail), scratch(k_update_scratch);
      from = given.stored.data() + first;
      dense_kernels(set).update({tail, tail, width, from, rows, from, 1, rows, result.data(), tail,
                                 true, true, true, false},
                                scratch.data());
      for (uint32_t j = 0; j < tail; ++j) {
        for (uint32_t i = j; i < tail; ++i) {
          REQUIRE(result[i + size_t{j} * tail] == truth[i + size_t{j} * tail]);
        }
      }
    }
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
