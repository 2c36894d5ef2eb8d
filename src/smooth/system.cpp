#include "smooth/system.h"

#include "sparse/nested_dissection.h"
#include "sparse/ordering.h"
#include "sparse/product.h"

namespace wireskin::smooth {

// y = A x for a symmetric matrix with both halves stored: column j is row j.
static void multiply_vectors(const sparse::Csc& a, Span<const Vec3> x, Span<Vec3> y) {
  for (uint32_t j = 0; j < a.cols; ++j) {
    Vec3 sum;
    for (uint32_t p = a.start[j]; p < a.start[j + 1]; ++p) sum += a.value[p] * x[a.row[p]];
    y[j] = sum;
  }
}

// The lower half of -L among the unknowns.
static Status negative_part(const sparse::Csc& a, Span<const uint32_t> unknown, uint32_t unknowns,
                            sparse::Csc* part) {
  part->rows = part->cols = unknowns;
  TRY(part->start.resize(size_t{unknowns} + 1));
  TRY(part->row.reserve(a.row.size()));
  TRY(part->value.reserve(a.row.size()));
  part->row.clear();
  part->value.clear();
  uint32_t j = 0;
  for (uint32_t column = 0; column < a.cols; ++column) {
    if (unknown[column] == k_none) continue;
    part->start[j] = static_cast<uint32_t>(part->row.size());
    for (uint32_t p = a.start[column]; p < a.start[column + 1]; ++p) {
      const uint32_t i = unknown[a.row[p]];
      if (i == k_none || i < j) continue;
      part->row.push_reserved(i);
      part->value.push_reserved(-a.value[p]);
    }
    ++j;
  }
  part->start[j] = static_cast<uint32_t>(part->row.size());
  return {};
}

Status System::prepare(const sparse::Csc& laplacian, Span<const uint8_t> fixed, Order order,
                       const Places& places) {
  laplacian_ = &laplacian;
  order_ = order;
  analysed_ = iterative_ = false;
  unknowns_ = 0;
  TRY(unknown_.resize(fixed.size()));
  for (size_t v = 0; v < fixed.size(); ++v) unknown_[v] = fixed[v] ? k_none : unknowns_++;
  place_.clear();
  patch_.clear();
  if (!places.position.empty()) {
    TRY(place_.reserve(unknowns_));
    TRY(patch_.reserve(unknowns_));
    for (size_t v = 0; v < fixed.size(); ++v) {
      if (fixed[v]) continue;
      place_.push_reserved(places.position[v]);
      patch_.push_reserved(places.patch[v]);
    }
  }
  TRY(rhs_.resize(size_t{3} * unknowns_));
  TRY(solution_.resize(size_t{3} * unknowns_));
  return work_.resize(size_t{3} * unknowns_);
}

// Columns begin with their diagonal.
void System::add_penalties() {
  for (size_t v = 0; v < penalty_.size(); ++v) {
    if (unknown_[v] != k_none) matrix_.value[matrix_.start[unknown_[v]]] += penalty_[v];
  }
}

Status System::find_order(const sparse::Csc& matrix, Array<uint32_t>* order) const {
  if (place_.empty()) return sparse::minimum_degree(matrix, order);
  return sparse::nested_dissection(matrix, {{}, place_.span(), patch_.span()}, order);
}

// Finds the order of elimination and the structure of the factor, and whether that fits.
Status System::analyse() {
  Context& context = weight_.context();
  {
    Array<uint32_t> order(context);
    TRY(find_order(matrix_, &order));
    TRY(factor_.analyse(matrix_, order.span()));
  }
  if (order_ == Order::two && factor_.factor_bytes() > context.room_bytes()) {
    TRY(prepare_iteration());
  }
  place_.free();
  patch_.free();
  analysed_ = true;
  return {};
}

// The factor of -L_ff, which no weights change.
Status System::prepare_iteration() {
  Context& context = weight_.context();
  sparse::Csc part(context);
  Array<uint32_t> order(context);
  factor_ = sparse::Cholesky(context);
  TRY(negative_part(*laplacian_, unknown_.span(), unknowns_, &part));
  TRY(find_order(part, &order));
  TRY(factor_.analyse(part, order.span()));
  order.free();
  iterative_ = true;
  return factor_.factor(part);
}

// y = (L_ff W L_ff)^-1 x.
Status System::apply_laplacian_pair(void* self, Span<const double> x, Span<double> y) {
  System& system = *static_cast<System*>(self);
  for (size_t i = 0; i < x.size(); ++i) y[i] = x[i];
  TRY(system.factor_.solve(y, 1));
  for (size_t v = 0; v < system.weight_.size(); ++v) {
    const uint32_t i = system.unknown_[v];
    if (i != k_none && system.weight_[v] > 0.0) y[i] /= system.weight_[v];
  }
  return system.factor_.solve(y, 1);
}

// Solves for the three right-hand sides one after the other.
Status System::iterate() {
  const sparse::CgOptions options = {1e-11, 2000};
  Context& context = weight_.context();
  Array<double> b(context), x(context);
  TRY(b.resize(unknowns_));
  TRY(x.resize(unknowns_));
  for (size_t c = 0; c < 3; ++c) {
    for (size_t i = 0; i < unknowns_; ++i) {
      b[i] = rhs_[3 * i + c];
      x[i] = 0.0;
    }
    sparse::CgResult result;
    TRY(sparse::conjugate_gradients(context, sparse::symmetric_operator(matrix_),
                                    {&apply_laplacian_pair, this}, b.span(), x.span(), options,
                                    &result));
    context.count_iterations(result.iterations);
    if (!(result.residual <= 1e-6)) {
      return fail(Code::memory_cap, "the memory cap leaves no room for the factor of the system");
    }
    for (size_t i = 0; i < unknowns_; ++i) solution_[3 * i + c] = x[i];
  }
  return {};
}

Status System::factor(Span<const double> weight, Span<const double> penalty) {
  Context& context = weight_.context();
  TRY(context.enter(Stage::operators));
  TRY(weight_.copy(weight));
  TRY(penalty_.copy(penalty));
  if (unknowns_ == 0) return {};
  if (order_ == Order::one) {
    TRY(negative_part(*laplacian_, unknown_.span(), unknowns_, &matrix_));
  } else if (order_ == Order::two) {
    TRY(sparse::weighted_product(*laplacian_, weight, *laplacian_, unknown_.span(), unknowns_,
                                 sparse::Part::lower, &matrix_));
  } else {
    Array<uint32_t> all(context);
    Array<double> minus(context);
    sparse::Csc squared(context);
    TRY(all.resize(weight.size()));
    TRY(minus.resize(weight.size()));
    for (uint32_t v = 0; v < weight.size(); ++v) {
      all[v] = v;
      minus[v] = -weight[v];
    }
    TRY(sparse::weighted_product(*laplacian_, weight, *laplacian_, all.span(), laplacian_->cols,
                                 sparse::Part::all, &squared));
    TRY(sparse::weighted_product(squared, minus.span(), *laplacian_, unknown_.span(), unknowns_,
                                 sparse::Part::lower, &matrix_));
  }
  add_penalties();
  TRY(context.enter(Stage::factor));
  if (!analysed_) {
    TRY(analyse());
  }
  if (iterative_) return {};
  Status factored = factor_.factor(matrix_);
  factored.place = {};  // a column of ours means nothing to the caller
  return factored;
}

void System::store_right_hand_side(Span<const Vec3> values) {
  for (size_t v = 0; v < values.size(); ++v) {
    if (unknown_[v] == k_none) continue;
    double* row = &rhs_[size_t{3} * unknown_[v]];
    row[0] = values[v].x, row[1] = values[v].y, row[2] = values[v].z;
  }
}

// L W (T - L v) at the free vertices, v with the free values at zero; for order 3, L W L W L v.
Status System::right_hand_side(Span<const Vec3> target, Span<const Vec3> value) {
  Context& context = weight_.context();
  Array<Vec3> a(context), b(context);
  TRY(a.resize(value.size()));
  TRY(b.resize(value.size()));
  for (size_t v = 0; v < value.size(); ++v) a[v] = unknown_[v] == k_none ? value[v] : Vec3{};
  multiply_vectors(*laplacian_, a.span(), b.span());
  if (order_ == Order::one) {
    store_right_hand_side(b.span());
    return {};
  }
  for (size_t v = 0; v < value.size(); ++v) {
    const Vec3 missing = target.empty() ? -b[v] : target[v] - b[v];
    b[v] = weight_[v] * missing;
  }
  multiply_vectors(*laplacian_, b.span(), a.span());
  if (order_ == Order::three) {
    for (size_t v = 0; v < value.size(); ++v) b[v] = -weight_[v] * a[v];
    multiply_vectors(*laplacian_, b.span(), a.span());
  }
  store_right_hand_side(a.span());
  return {};
}

// What the solution leaves of the right-hand side, and its size relative to that, the greatest of
// the three columns.
double System::residual_of(Span<double> residual) const {
  sparse::multiply_symmetric(matrix_, solution_.span(), residual, 3);
  double left[3] = {}, whole[3] = {};
  for (size_t i = 0; i < residual.size(); ++i) {
    residual[i] = rhs_[i] - residual[i];
    left[i % 3] += residual[i] * residual[i];
    whole[i % 3] += rhs_[i] * rhs_[i];
  }
  double worst = 0.0;
  for (int c = 0; c < 3; ++c) {
    const double ratio = whole[c] > 0.0 ? std::sqrt(left[c] / whole[c]) : 0.0;
    if (!(ratio <= worst)) worst = ratio;  // not a number stays
  }
  return worst;
}

Status System::solve(Span<const Vec3> target, Span<const Vec3> anchor, Span<Vec3> value,
                     double* residual) {
  TRY(weight_.context().enter(Stage::solve));
  *residual = 0.0;
  if (unknowns_ == 0) return {};
  TRY(right_hand_side(target, value));
  for (size_t v = 0; v < penalty_.size(); ++v) {
    if (unknown_[v] == k_none || penalty_[v] == 0.0) continue;
    double* row = &rhs_[size_t{3} * unknown_[v]];
    row[0] += penalty_[v] * anchor[v].x;
    row[1] += penalty_[v] * anchor[v].y;
    row[2] += penalty_[v] * anchor[v].z;
  }
  if (iterative_) {
    TRY(iterate());
  } else {
    TRY(solution_.copy(rhs_.span()));
    TRY(factor_.solve(solution_.span(), 3));
  }
  *residual = residual_of(work_.span());
  const double good = unknowns_ <= 30000 ? 1e-12 : unknowns_ <= 300000 ? 1e-11 : 1e-10;
  if (!iterative_ && *residual > good) {  // one step of iterative refinement
    TRY(factor_.solve(work_.span(), 3));
    for (size_t i = 0; i < work_.size(); ++i) solution_[i] += work_[i];
    *residual = residual_of(work_.span());
  }
  for (size_t v = 0; v < value.size(); ++v) {
    if (unknown_[v] == k_none) continue;
    const double* row = &solution_[size_t{3} * unknown_[v]];
    value[v] = {row[0], row[1], row[2]};
  }
  return {};
}

}  // namespace wireskin::smooth
