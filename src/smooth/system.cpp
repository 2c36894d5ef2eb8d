#include "smooth/system.h"

#include "base/in_parts.h"
#include "smooth/laplacian_pairs.h"
#include "sparse/nested_dissection.h"
#include "sparse/ordering.h"
#include "sparse/product.h"

namespace wireskin::smooth {

// Whether most of x is zero, as on meshes of which only the curves are known.
static bool is_mostly_zero(Span<const Vec3> x) {
  size_t others = 0;
  for (const Vec3& v : x) {
    others += v != Vec3{};
    if (4 * others >= x.size()) return false;
  }
  return true;
}

// Row j of A x for a symmetric matrix with both halves stored: column j is row j.
static Vec3 multiply_row(const sparse::Csc& a, uint32_t j, Span<const Vec3> x) {
  const uint32_t* const row = a.row.data();
  const double* const value = a.value.data();
  double sum_x = 0.0, sum_y = 0.0, sum_z = 0.0;
  for (uint32_t p = a.start[j], end = a.start[j + 1]; p < end; ++p) {
    const Vec3& at = x[row[p]];
    sum_x += value[p] * at.x;
    sum_y += value[p] * at.y;
    sum_z += value[p] * at.z;
  }
  return {sum_x, sum_y, sum_z};
}

// y = A x; columns that meet zeros are spared where there are many.
static Status multiply_vectors(Context& context, const sparse::Csc& a, Span<const Vec3> x,
                               Span<Vec3> y) {
  if (!is_mostly_zero(x)) {
    return in_parts(context, a.cols,
                    [&](size_t j) { y[j] = multiply_row(a, static_cast<uint32_t>(j), x); });
  }
  TRY(in_parts(context, y.size(), [&](size_t j) { y[j] = Vec3{}; }));
  return in_parts(context, a.cols, [&](size_t j) {
    if (x[j] == Vec3{}) return;
    for (uint32_t p = a.start[j]; p < a.start[j + 1]; ++p) y[a.row[p]] += a.value[p] * x[j];
  });
}

Status System::prepare(const sparse::Csc& laplacian, Span<const uint8_t> fixed, Order order,
                       const Places& places) {
  Context& context = weight_.context();
  laplacian_ = &laplacian;
  order_ = order;
  analysed_ = iterative_ = false;
  unknowns_ = 0;
  TRY(unknown_.resize(fixed.size()));
  TRY(in_parts(context, fixed.size(),
               [&](size_t v) { unknown_[v] = fixed[v] ? k_none : unknowns_++; }));
  place_.clear();
  patch_.clear();
  if (!places.position.empty()) {
    TRY(place_.reserve(unknowns_));
    TRY(patch_.reserve(unknowns_));
    TRY(in_parts(context, fixed.size(), [&](size_t v) {
      if (fixed[v]) return;
      place_.push_reserved(places.position[v]);
      patch_.push_reserved(places.patch[v]);
    }));
  }
  return {};
}

// Columns begin with their diagonal.
Status System::add_penalties() {
  return in_parts(weight_.context(), penalty_.size(), [&](size_t v) {
    if (unknown_[v] != k_none) matrix_.value[matrix_.start[unknown_[v]]] += penalty_[v];
  });
}

Status System::find_order(const sparse::Csc& matrix, Array<uint32_t>* order) const {
  if (place_.empty()) return sparse::minimum_degree(matrix, order);
  return sparse::nested_dissection(matrix, {{}, place_.span(), patch_.span()}, order);
}

static Status no_room_for_factor() {
  return fail(Code::memory_cap, "the memory cap leaves no room for the factor of the system");
}

// Finds the order of elimination and the structure of the factor, and whether that fits.
Status System::analyse() {
  Context& context = weight_.context();
  {
    Array<uint32_t> order(context);
    TRY(find_order(matrix_, &order));
    TRY(factor_.analyse(matrix_, order.span()));
  }
  // These go before the factor comes, see factor().
  const size_t spare =
      matrix_.row.capacity_bytes() + place_.capacity_bytes() + patch_.capacity_bytes();
  const size_t needed = factor_.factor_bytes();
  if (order_ != Order::one && needed > spare && needed - spare > context.room_bytes()) {
    TRY(prepare_iteration());
  }
  place_.free();
  patch_.free();
  analysed_ = true;
  return {};
}

// The factor of S - L_ff. Its structure no weights and no penalties change; S no weights.
Status System::prepare_iteration() {
  Context& context = weight_.context();
  sparse::Csc part(context);
  Array<double> shift(context);
  if (order_ == Order::two && !penalty_.empty()) {
    TRY(shift.resize(penalty_.size()));
    TRY(in_parts(context, shift.size(), [&](size_t v) {
      shift[v] = std::sqrt(weight_[v] > 0.0 ? penalty_[v] / weight_[v] : penalty_[v]);
    }));
  }
  TRY(shifted_laplacian(*laplacian_, unknown_.span(), unknowns_, 1.0, shift.span(), &part));
  if (!iterative_) {
    Array<uint32_t> order(context);
    factor_ = sparse::Cholesky(context);
    TRY(find_order(part, &order));
    TRY(factor_.analyse(part, order.span()));
    iterative_ = true;
  }
  const Status factored = factor_.factor(part);
  return factored.code == Code::not_positive_definite ? no_room_for_factor() : factored;
}

// y = (L_ff W L_ff)^-1 x, for order 3 (L_ff W L_ff W L_ff)^-1 x up to the sign.
Status System::apply_laplacian_inverses(void* self, Span<const double> x, Span<double> y) {
  System& system = *static_cast<System*>(self);
  Context& context = system.weight_.context();
  TRY(in_parts(context, x.size(), [&](size_t i) { y[i] = x[i]; }));
  for (int k = 1; k < static_cast<int>(system.order_); ++k) {
    TRY(system.factor_.solve(y, 1));
    TRY(in_parts(context, system.weight_.size(), [&](size_t v) {
      const uint32_t i = system.unknown_[v];
      if (i != k_none && system.weight_[v] > 0.0) y[i] /= system.weight_[v];
    }));
  }
  return system.factor_.solve(y, 1);
}

// Solves for the right-hand sides one after the other.
Status System::iterate(size_t columns) {
  const sparse::CgOptions options = {1e-11, 2000};
  Context& context = weight_.context();
  Array<double> b(context), x(context);
  TRY(b.resize(unknowns_));
  TRY(x.resize(unknowns_));
  for (size_t c = 0; c < columns; ++c) {
    TRY(in_parts(context, unknowns_, [&](size_t i) {
      b[i] = block_[columns * i + c];
      x[i] = 0.0;
    }));
    sparse::CgResult result;
    TRY(sparse::conjugate_gradients(context, sparse::symmetric_operator(matrix_),
                                    {&apply_laplacian_inverses, this}, b.span(), x.span(), options,
                                    &result));
    context.count_iterations(result.iterations);
    if (!(result.residual <= 1e-6)) return no_room_for_factor();
    TRY(in_parts(context, unknowns_, [&](size_t i) { block_[columns * i + c] = x[i]; }));
  }
  return {};
}

Status System::factor(Span<const double> weight, Span<const double> penalty, bool last) {
  Context& context = weight_.context();
  TRY(context.enter(Stage::operators));
  TRY(copy_in_parts(weight, &weight_));
  TRY(copy_in_parts(penalty, &penalty_));
  if (unknowns_ == 0) return {};
  if (order_ == Order::one) {
    TRY(shifted_laplacian(*laplacian_, unknown_.span(), unknowns_, 1.0, {}, &matrix_));
  } else if (order_ == Order::two) {
    TRY(sparse::weighted_product(*laplacian_, weight, *laplacian_, unknown_.span(), unknowns_,
                                 sparse::Part::lower, &matrix_));
  } else {
    Array<uint32_t> all(context);
    Array<double> minus(context);
    sparse::Csc squared(context);
    TRY(all.resize(weight.size()));
    TRY(minus.resize(weight.size()));
    TRY(in_parts(context, weight.size(), [&](size_t v) {
      all[v] = static_cast<uint32_t>(v);
      minus[v] = -weight[v];
    }));
    TRY(sparse::weighted_product(*laplacian_, weight, *laplacian_, all.span(), laplacian_->cols,
                                 sparse::Part::all, &squared));
    TRY(sparse::weighted_product(squared, minus.span(), *laplacian_, unknown_.span(), unknowns_,
                                 sparse::Part::lower, &matrix_));
  }
  TRY(add_penalties());
  TRY(context.enter(Stage::factor));
  const bool first = !analysed_;
  if (first) TRY(analyse());
  if (iterative_) return first || penalty.empty() ? Status{} : prepare_iteration();
  // The factor is the greatest thing in memory: what it does not need goes before it, or after.
  matrix_.row.free();
  Status factored = factor_.factor(matrix_);
  matrix_.value.free();
  if (last) {
    factor_.end_factoring();
    analysed_ = false;
  }
  factored.place = {};  // a column of ours means nothing to the caller
  return factored;
}

// Minus the gradients of the energies at the values that the fields have, among the unknowns, and
// the square of each column: L W (T - L v), for order 1 L v, for order 3 L W L W L v. With the free
// values at zero these are the right-hand sides, with a solution its residuals.
Status System::find_gradients(Span<const Field3> fields, double* squares) {
  Context& context = weight_.context();
  const size_t columns = 3 * fields.size(), n = unknown_.size();
  Array<Vec3> image(context), spare(context);
  TRY(image.resize(n));
  if (order_ == Order::three) TRY(spare.resize(n));
  for (size_t f = 0; f < fields.size(); ++f) {
    const Field3& field = fields[f];
    Span<const Vec3> x = field.value;  // the last factor L is applied row by row below
    for (int k = 1; k < static_cast<int>(order_); ++k) {
      const Span<Vec3> y = k == 1 ? image.span() : spare.span();
      const bool aims = k == 1 && !field.target.empty();
      TRY(multiply_vectors(context, *laplacian_, x, y));
      TRY(in_parts(context, n,
                   [&](size_t v) { y[v] = weight_[v] * (aims ? field.target[v] - y[v] : -y[v]); }));
      x = y;
    }
    Vec3 sum;
    TRY(in_parts(context, n, [&](size_t v) {
      if (unknown_[v] == k_none) return;
      Vec3 g = multiply_row(*laplacian_, static_cast<uint32_t>(v), x);
      if (!penalty_.empty() && penalty_[v] != 0.0) {
        g += penalty_[v] * (field.anchor[v] - field.value[v]);
      }
      double* row = &block_[columns * unknown_[v] + 3 * f];
      row[0] = g.x, row[1] = g.y, row[2] = g.z;
      sum += Vec3{g.x * g.x, g.y * g.y, g.z * g.z};
    }));
    squares[3 * f] = sum.x, squares[3 * f + 1] = sum.y, squares[3 * f + 2] = sum.z;
    TRY(context.checkpoint());
  }
  return {};
}

Status System::add_solutions(Span<const Field3> fields) const {
  const size_t columns = 3 * fields.size();
  return in_parts(weight_.context(), unknown_.size(), [&](size_t v) {
    if (unknown_[v] == k_none) return;
    const double* row = &block_[columns * unknown_[v]];
    for (const Field3& field : fields) {
      field.value[v] += Vec3{row[0], row[1], row[2]};
      row += 3;
    }
  });
}

static double greatest_ratio(const double* left, const double* whole, size_t columns) {
  double worst = 0.0;
  for (size_t c = 0; c < columns; ++c) {
    const double ratio = whole[c] > 0.0 ? std::sqrt(left[c] / whole[c]) : 0.0;
    if (!(ratio <= worst)) worst = ratio;  // not a number stays
  }
  return worst;
}

Status System::solve(Span<const Field3> fields, double* residual) {
  constexpr size_t k_most = 2;
  double whole[3 * k_most], left[3 * k_most];
  const size_t columns = 3 * fields.size();
  WIRESKIN_ASSERT(fields.size() <= k_most);
  Context& context = weight_.context();
  TRY(context.enter(Stage::solve));
  *residual = 0.0;
  if (unknowns_ == 0) return {};
  for (const Field3& field : fields) {
    TRY(in_parts(context, unknown_.size(), [&](size_t v) {
      if (unknown_[v] != k_none) field.value[v] = Vec3{};
    }));
  }
  TRY(block_.resize(columns * unknowns_));
  TRY(find_gradients(fields, whole));
  if (iterative_) {
    TRY(iterate(columns));
  } else {
    TRY(factor_.solve(block_.span(), static_cast<uint32_t>(columns)));
  }
  TRY(add_solutions(fields));
  TRY(find_gradients(fields, left));
  *residual = greatest_ratio(left, whole, columns);
  const double good = unknowns_ <= 30000 ? 1e-12 : unknowns_ <= 300000 ? 1e-11 : 1e-10;
  if (!iterative_ && *residual > good) {  // one step of iterative refinement
    TRY(factor_.solve(block_.span(), static_cast<uint32_t>(columns)));
    TRY(add_solutions(fields));
    TRY(find_gradients(fields, left));
    *residual = greatest_ratio(left, whole, columns);
  }
  return {};
}

}  // namespace wireskin::smooth
