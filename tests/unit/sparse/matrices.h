// Matrices for the tests of src/sparse: built by entry, or with known inverses, eigenvectors and
// elimination orders.
#pragma once

#include <cmath>
#include <cstdint>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include "sparse/csc.h"
#include "support/context.h"

namespace matrices {

using wireskin::Array;
using wireskin::Span;
using wireskin::Status;
using wireskin::sparse::Csc;

using unit::Heap;
using unit::must;
using unit::span;

// A symmetric matrix by its lower entries.
struct Symmetric {
  uint32_t n = 0;
  std::map<std::pair<uint32_t, uint32_t>, double> entries;  // (column, row)

  explicit Symmetric(uint32_t size) : n(size) {
    for (uint32_t j = 0; j < n; ++j) entries[{j, j}] = 0.0;
  }
  double& at(uint32_t i, uint32_t j) { return entries[{std::min(i, j), std::max(i, j)}]; }
  double get(uint32_t i, uint32_t j) const {
    const auto found = entries.find({std::min(i, j), std::max(i, j)});
    return found == entries.end() ? 0.0 : found->second;
  }
  bool has(uint32_t i, uint32_t j) const {
    return entries.count({std::min(i, j), std::max(i, j)}) != 0;
  }
  // Adds an edge of weight w to a graph Laplacian.
  void connect(uint32_t i, uint32_t j, double w = 1.0) {
    at(i, j) -= w;
    at(i, i) += w;
    at(j, j) += w;
  }
  Csc csc(wireskin::Context& context) const {
    Csc a(context);
    a.rows = a.cols = n;
    must(a.start.assign(n + 1, 0));
    for (const auto& [place, value] : entries) {
      must(a.row.push(place.second));
      must(a.value.push(value));
      a.start[place.first + 1] = static_cast<uint32_t>(a.row.size());
    }
    return a;
  }
};

// The second difference on n inner points of an interval; A x = 1 has x_i = (i + 1) (n - i) / 2.
inline Symmetric path(uint32_t n) {
  Symmetric a(n);
  for (uint32_t i = 0; i < n; ++i) a.at(i, i) = 2.0;
  for (uint32_t i = 1; i < n; ++i) a.at(i, i - 1) = -1.0;
  return a;
}

// The five-point Laplacian on w x h inner points of a rectangle.
inline Symmetric grid(uint32_t w, uint32_t h) {
  Symmetric a(w * h);
  for (uint32_t y = 0; y < h; ++y) {
    for (uint32_t x = 0; x < w; ++x) {
      const uint32_t i = y * w + x;
      a.at(i, i) = 4.0;
      if (x > 0) a.at(i, i - 1) = -1.0;
      if (y > 0) a.at(i, i - w) = -1.0;
    }
  }
  return a;
}

// The square of a symmetric matrix: from grid() a bilaplacian with the same eigenvectors.
inline Symmetric square(const Symmetric& a) {
  std::vector<std::vector<std::pair<uint32_t, double>>> rows(a.n);
  for (const auto& [place, value] : a.entries) {
    rows[place.first].push_back({place.second, value});
    if (place.first != place.second) rows[place.second].push_back({place.first, value});
  }
  Symmetric result(a.n);
  for (const auto& row : rows) {
    for (const auto& [i, u] : row) {
      for (const auto& [j, v] : row) {
        if (i >= j) result.at(i, j) += u * v;
      }
    }
  }
  return result;
}

constexpr double k_pi = 3.14159265358979323846;

// The eigenvector of grid(w, h) with p half waves along x and q along y, and its eigenvalue.
inline std::vector<double> grid_wave(uint32_t w, uint32_t h, uint32_t p, uint32_t q,
                                     double* eigenvalue) {
  const double ax = k_pi * p / (w + 1), ay = k_pi * q / (h + 1);
  *eigenvalue = 4.0 - 2.0 * std::cos(ax) - 2.0 * std::cos(ay);
  std::vector<double> wave;
  for (uint32_t y = 0; y < h; ++y) {
    for (uint32_t x = 0; x < w; ++x)
      wave.push_back(std::sin(ax * (x + 1)) * std::sin(ay * (y + 1)));
  }
  return wave;
}

// About `degree` random neighbours for each row; diagonally dominant, so positive definite.
inline Symmetric random_spd(uint32_t n, double degree, std::mt19937& random) {
  Symmetric a(n);
  std::uniform_real_distribution<double> weight(-1.0, 1.0);
  const uint32_t edges = static_cast<uint32_t>(0.5 * degree * n);
  for (uint32_t k = 0; n > 1 && k < edges; ++k) {
    const uint32_t i = static_cast<uint32_t>(random() % n), j = static_cast<uint32_t>(random() % n);
    if (i == j) continue;
    const double w = weight(random);
    a.at(i, j) += w;
    a.at(i, i) += std::fabs(w);
    a.at(j, j) += std::fabs(w);
  }
  for (uint32_t i = 0; i < n; ++i) a.at(i, i) += 0.1 + std::fabs(weight(random));
  return a;
}

inline std::vector<double> random_vector(size_t n, std::mt19937& random) {
  std::uniform_real_distribution<double> value(-1.0, 1.0);
  std::vector<double> v(n);
  for (double& x : v) x = value(random);
  return v;
}

inline std::vector<uint32_t> natural_order(uint32_t n) {
  std::vector<uint32_t> order(n);
  for (uint32_t i = 0; i < n; ++i) order[i] = i;
  return order;
}

inline std::vector<uint32_t> random_order(uint32_t n, std::mt19937& random) {
  std::vector<uint32_t> order = natural_order(n);
  for (uint32_t i = n; i > 1; --i) std::swap(order[i - 1], order[random() % i]);
  return order;
}

// Nested dissection of a w x h grid by its middle lines: the order that is optimal up to a
// constant.
inline void dissect(uint32_t x0, uint32_t x1, uint32_t y0, uint32_t y1, uint32_t w,
                    std::vector<uint32_t>* order) {
  if (x0 >= x1 || y0 >= y1) return;
  if (x1 - x0 < y1 - y0) {
    const uint32_t middle = (y0 + y1) / 2;
    dissect(x0, x1, y0, middle, w, order);
    dissect(x0, x1, middle + 1, y1, w, order);
    for (uint32_t x = x0; x < x1; ++x) order->push_back(middle * w + x);
  } else {
    const uint32_t middle = (x0 + x1) / 2;
    dissect(x0, middle, y0, y1, w, order);
    dissect(middle + 1, x1, y0, y1, w, order);
    for (uint32_t y = y0; y < y1; ++y) order->push_back(y * w + middle);
  }
}

// What an elimination in the given order fills in, found by playing it through on sets.
struct Elimination {
  std::vector<std::vector<uint32_t>> columns;  // rows of each column of the factor, by position

  Elimination(const Symmetric& a, const std::vector<uint32_t>& order) : columns(a.n) {
    std::vector<uint32_t> position(a.n);
    for (uint32_t k = 0; k < a.n; ++k) position[order[k]] = k;
    std::vector<std::map<uint32_t, bool>> below(a.n);
    for (const auto& entry : a.entries) {
      const uint32_t i = position[entry.first.first], j = position[entry.first.second];
      if (i != j) below[std::min(i, j)][std::max(i, j)] = true;
    }
    for (uint32_t j = 0; j < a.n; ++j) {
      columns[j].push_back(j);
      for (const auto& row : below[j]) columns[j].push_back(row.first);
      for (size_t k = 2; k < columns[j].size(); ++k) below[columns[j][1]][columns[j][k]] = true;
    }
  }
  size_t nonzeros() const {
    size_t sum = 0;
    for (const auto& column : columns) sum += column.size();
    return sum;
  }
};

}  // namespace matrices
