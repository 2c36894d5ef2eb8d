// libFuzzer target: sparse symmetric matrices to the orderings, to Cholesky, to L D L^T and to
// conjugate gradients. Whatever is diagonally dominant must be solved, and by all three to the same
// numbers; a factor made again has the same bits, by other instructions too.
#include "fuzz/bytes.h"
#include "sparse/conjugate_gradients.h"
#include "sparse/ldl.h"
#include "sparse/nested_dissection.h"
#include "sparse/ordering.h"

using namespace wireskin;

struct Matrix {
  uint32_t n;
  std::vector<double> dense;

  double& at(uint32_t i, uint32_t j) { return dense[size_t{i} * n + j]; }
};

static Matrix read_matrix(fuzz::Bytes& bytes, bool dominant) {
  Matrix m;
  m.n = bytes.count(28, 120);
  m.dense.assign(size_t{m.n} * m.n, 0.0);
  for (uint32_t i = 0; i < m.n; ++i) m.at(i, i) = dominant ? 1.0 : bytes.number();
  for (uint32_t left = 4 * m.n; left > 0 && !bytes.empty(); --left) {
    const uint32_t i = bytes.below(m.n), j = bytes.below(m.n);
    if (i == j) continue;
    const double value = dominant ? (bytes.byte() - 128) / 8.0 : bytes.number();
    m.at(i, j) = m.at(j, i) = value;
  }
  for (uint32_t i = 0; dominant && i < m.n; ++i) {
    for (uint32_t j = 0; j < m.n; ++j) m.at(i, i) += i == j ? 0.0 : std::fabs(m.at(i, j));
  }
  return m;
}

static Status lower_of(Matrix& m, sparse::Csc* lower) {
  lower->rows = lower->cols = m.n;
  for (uint32_t j = 0; j < m.n; ++j) {
    TRY(lower->start.push(static_cast<uint32_t>(lower->row.size())));
    for (uint32_t i = j; i < m.n; ++i) {
      if (i != j && m.at(i, j) == 0.0) continue;
      TRY(lower->row.push(i));
      TRY(lower->value.push(m.at(i, j)));
    }
  }
  return lower->start.push(static_cast<uint32_t>(lower->row.size()));
}

template <typename Solver>
static Status solve(const sparse::Csc& lower, const Array<uint32_t>& order, Solver* solver,
                    std::vector<double>* x, uint32_t columns) {
  TRY(solver->analyse(lower, order.span()));
  TRY(solver->factor(lower));
  return solver->solve({x->data(), x->size()}, columns);
}

static Status order_columns(fuzz::Bytes& bytes, bool dissect, const sparse::Csc& lower,
                            Array<uint32_t>* order) {
  std::vector<Vec3> places;
  std::vector<uint32_t> patches;
  if (!dissect) return sparse::minimum_degree(lower, order);
  for (uint32_t i = 0; i < lower.cols; ++i) {
    places.push_back({bytes.byte() / 8.0, bytes.byte() / 8.0, 0.0});
    patches.push_back(bytes.below(3));
  }
  return sparse::nested_dissection(
      lower, {{}, {places.data(), places.size()}, {patches.data(), patches.size()}}, order);
}

// Asked for once: where the machine is a virtual one, asking takes longer than a small system.
static sparse::Instructions choose_instructions(uint32_t byte) {
  using sparse::Instructions;
  static const bool has_avx2 = has_instructions(Instructions::avx2);
  static const bool has_avx512 = has_instructions(Instructions::avx512);
  if (byte % 4 == 0 && has_avx2) return Instructions::avx2;
  return byte % 4 < 3 && has_avx512 ? Instructions::avx512 : Instructions::baseline;
}

static void require_equal(const std::vector<double>& x, const std::vector<double>& y) {
  fuzz::require(std::memcmp(x.data(), y.data(), x.size() * sizeof(double)) == 0);
}

static void require_near(const std::vector<double>& x, const std::vector<double>& y,
                         double tolerance) {
  for (size_t i = 0; i < x.size(); ++i) fuzz::require(std::fabs(x[i] - y[i]) < tolerance);
}

// The same by conjugate gradients, with the diagonal or the factor itself to help.
static void iterate(Context& context, bool by_diagonal, const sparse::Csc& lower,
                    sparse::Cholesky& cholesky) {
  std::vector<double> ones(lower.cols, 1.0), x(lower.cols, 0.0), y = ones;
  sparse::Jacobi jacobi(context);
  sparse::CgResult result;
  fuzz::require(jacobi.build(lower).ok() && cholesky.solve({y.data(), y.size()}, 1).ok());
  const sparse::LinearOperator help =
      by_diagonal ? jacobi.linear_operator() : sparse::inverse_operator(cholesky);
  const Status status =
      sparse::conjugate_gradients(context, sparse::symmetric_operator(lower), help,
                                  {ones.data(), ones.size()}, {x.data(), x.size()}, {}, &result);
  fuzz::require(status.ok() && result.converged);
  require_near(x, y, 1e-8);
}

static void check(Context& context, fuzz::Bytes& bytes) {
  const bool dominant = bytes.one_in(2), dissect = bytes.one_in(2);
  const uint32_t iterative = bytes.below(8), instructions = bytes.byte();
  const uint32_t columns = bytes.count(2, 6);
  Matrix m = read_matrix(bytes, dominant);
  sparse::Csc lower(context);
  fuzz::require(lower_of(m, &lower).ok());
  Array<uint32_t> order(context);
  fuzz::require(order_columns(bytes, dissect, lower, &order).ok());
  std::vector<uint8_t> seen(m.n, 0);
  fuzz::require(order.size() == m.n);
  for (const uint32_t column : order) fuzz::require(column < m.n && seen[column]++ == 0);

  std::vector<double> x(size_t{m.n} * columns, 1.0), y = x, again = x;
  sparse::Cholesky cholesky(context, choose_instructions(instructions));
  sparse::Ldl ldl(context);
  const Status first = solve(lower, order, &cholesky, &x, columns);
  const Status second = solve(lower, order, &ldl, &y, columns);
  if (first.ok()) {
    fuzz::require(cholesky.factor(lower).ok());
    fuzz::require(cholesky.solve({again.data(), again.size()}, columns).ok());
    require_equal(again, x);
  }
  if (first.ok() && instructions >= 224) {
    std::vector<double> other(x.size(), 1.0);
    sparse::Cholesky baseline(context, sparse::Instructions::baseline);
    fuzz::require(solve(lower, order, &baseline, &other, columns).ok());
    require_equal(other, x);
  }
  if (!dominant) return;
  fuzz::require(first.ok() && second.ok());
  require_near(x, y, 1e-9);
  if (iterative < 2) iterate(context, iterative == 0, lower, cholesky);
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  fuzz::Bytes bytes(data, size);
  fuzz::Arena heap;
  {
    Context context({heap.allocate, heap.release, &heap}, size_t{1} << 26, {});
    check(context, bytes);
  }
  fuzz::require(heap.clean());
  return 0;
}
