#include "sparse/cholesky.h"

#include <cfloat>
#include <cmath>

#include "sparse/dense.h"
#include "sparse/elimination_tree.h"

namespace wireskin::sparse {

static constexpr const char* k_no_permutation = "the elimination order is not a permutation";

Cholesky::Cholesky(Context& context)
    : context_(&context),
      order_(context),
      lower_(context),
      supernodes_(context),
      value_(context),
      waiting_(context),
      next_(context),
      used_(context),
      position_(context),
      relative_(context),
      permuted_(context),
      tail_(context) {}

Status Cholesky::count_work(size_t work) {
  constexpr size_t k_work_per_checkpoint = size_t{1} << 22;
  work_ += work;
  if (work_ < k_work_per_checkpoint) return {};
  work_ = 0;
  return context_->checkpoint();
}

Status Cholesky::count_solve(uint32_t s, uint32_t columns) {
  return count_work(size_t{supernodes_.height(s)} * supernodes_.width(s) * columns);
}

static void invert_order(Span<const uint32_t> order, Span<uint32_t> position) {
  for (uint32_t k = 0; k < order.size(); ++k) position[order[k]] = k;
}

// Renumbers the elimination so that it runs through the elimination tree in postorder. That changes
// neither fill nor work, and makes the columns of a supernode neighbours.
static Status order_by_tree(const Csc& lower, Array<uint32_t>* order, Array<uint32_t>* position,
                            Array<uint32_t>* parent) {
  Context& context = order->context();
  const uint32_t n = lower.cols;
  Pattern upper(context);
  Array<uint32_t> tree(context), post(context), given(context);
  TRY(given.copy(order->span()));
  TRY(parent->resize(n));
  TRY(permute_pattern(lower, position->span(), Triangle::upper, &upper));
  TRY(elimination_tree(upper, &tree));
  TRY(postorder(tree.span(), &post));
  invert_order(post.span(), position->span());
  for (uint32_t k = 0; k < n; ++k) {
    const uint32_t above = tree[post[k]];
    (*parent)[k] = above == k_none ? k_none : (*position)[above];
    (*order)[k] = given[post[k]];
  }
  invert_order(order->span(), position->span());
  return {};
}

Status Cholesky::allocate_workspace(size_t entries) {
  uint32_t tallest = 0;
  for (uint32_t s = 0; s < supernodes_.count; ++s) {
    if (supernodes_.height(s) > tallest) tallest = supernodes_.height(s);
  }
  TRY(relative_.resize(tallest));
  TRY(waiting_.resize(supernodes_.count));
  TRY(next_.resize(supernodes_.count));
  TRY(used_.resize(supernodes_.count));
  TRY(position_.resize(n_));
  return value_.resize(entries);
}

Status Cholesky::analyse(const Csc& lower, Span<const uint32_t> order) {
  WIRESKIN_ASSERT(is_lower_triangle(lower));
  analysed_ = factored_ = false;
  n_ = lower.cols;
  Array<uint32_t> position(*context_), parent(*context_), count(*context_);
  if (order.size() != n_) return fail(Code::bad_argument, k_no_permutation);
  TRY(order_.copy(order));
  TRY(position.assign(n_, k_none));
  for (uint32_t k = 0; k < n_; ++k) {
    if (order[k] >= n_ || position[order[k]] != k_none) {
      return fail(Code::bad_argument, k_no_permutation);
    }
    position[order[k]] = k;
  }
  TRY(order_by_tree(lower, &order_, &position, &parent));
  TRY(context_->checkpoint());
  TRY(permute_pattern(lower, position.span(), Triangle::lower, &lower_));
  TRY(column_counts(lower_, parent.span(), &count));
  TRY(context_->checkpoint());
  TRY(find_supernodes(lower_, parent.span(), count.span(), &supernodes_));
  TRY(allocate_workspace(supernodes_.panel[supernodes_.count]));
  nonzeros_ = 0;
  for (const uint32_t c : count) nonzeros_ += c;
  analysed_ = true;
  return {};
}

// Clears the panel of `s` and adds the entries of the matrix.
void Cholesky::assemble(uint32_t s, const double* source) {
  const uint32_t height = supernodes_.height(s);
  const uint32_t* rows = supernodes_.rows(s);
  double* panel = value_.data() + supernodes_.panel[s];
  std::memset(panel, 0, size_t{height} * supernodes_.width(s) * sizeof(double));
  for (uint32_t r = 0; r < height; ++r) position_[rows[r]] = r;
  for (uint32_t j = supernodes_.first[s]; j < supernodes_.first[s + 1]; ++j, panel += height) {
    for (uint32_t k = lower_.start[j]; k < lower_.start[j + 1]; ++k) {
      panel[position_[lower_.index[k]]] = source[lower_.source[k]];
    }
  }
}

// Subtracts from the panel of `to` what the columns of `from` contribute to it: the products of the
// unused rows of `from` with those of them that are columns of `to`.
Status Cholesky::apply_update(uint32_t from, uint32_t to) {
  constexpr uint32_t k_columns = 16;  // between two looks at the work done
  const size_t height = supernodes_.height(from);
  const uint32_t depth = supernodes_.width(from);
  const uint32_t* rows = supernodes_.rows(from) + used_[from];
  const uint32_t count = supernodes_.height(from) - used_[from];
  uint32_t columns = 0;
  while (columns < count && rows[columns] < supernodes_.first[to + 1]) ++columns;
  for (uint32_t r = 0; r < count; ++r) relative_[r] = position_[rows[r]];

  const double* source = value_.data() + supernodes_.panel[from] + used_[from];
  const size_t target_height = supernodes_.height(to);
  double* target = value_.data() + supernodes_.panel[to];
  for (uint32_t first = 0; first < columns; first += k_columns) {
    const Products products = {source + first, height, source + first, 1, height, depth};
    const uint32_t* relative = relative_.data() + first;
    const uint32_t width = columns - first < k_columns ? columns - first : k_columns;
    for_lower_products(products, count - first, width, [=](uint32_t i, uint32_t j, double product) {
      target[relative[i] + relative[j] * target_height] -= product;
    });
    TRY(count_work(size_t{count - first} * width * depth));
  }
  used_[from] += columns;
  return {};
}

// A supernode waits where its first unused row is a column; after the last row it waits nowhere.
void Cholesky::link(uint32_t s) {
  if (used_[s] == supernodes_.height(s)) return;
  const uint32_t to = supernodes_.of_column[supernodes_.rows(s)[used_[s]]];
  next_[s] = waiting_[to];
  waiting_[to] = s;
}

Status Cholesky::apply_updates(uint32_t s) {
  for (uint32_t from = waiting_[s]; from != k_none;) {
    const uint32_t after = next_[from];
    TRY(apply_update(from, s));
    link(from);
    from = after;
  }
  return {};
}

// Factors `count` columns of a panel, from `first` on, that have taken all updates from their left.
// Returns the first column with a bad pivot, or k_none.
static uint32_t factor_columns(double* panel, uint32_t height, uint32_t first, uint32_t count) {
  for (uint32_t j = first; j < first + count; ++j) {
    double* column = panel + size_t{j} * height;
    for (uint32_t k = first; k < j; ++k) {
      const double* left = panel + size_t{k} * height;
      const double factor = left[j];
      for (uint32_t i = j; i < height; ++i) column[i] -= left[i] * factor;
    }
    if (!(column[j] > 0.0 && column[j] <= DBL_MAX)) return j;
    const double pivot = std::sqrt(column[j]);
    column[j] = pivot;
    for (uint32_t i = j + 1; i < height; ++i) column[i] /= pivot;
  }
  return k_none;
}

// The dense factorisation of a complete panel, a few columns at a time.
Status Cholesky::factor_panel(uint32_t s) {
  constexpr uint32_t k_block = 4;
  const uint32_t height = supernodes_.height(s), width = supernodes_.width(s);
  double* panel = value_.data() + supernodes_.panel[s];
  for (uint32_t first = 0; first < width; first += k_block) {
    const uint32_t count = width - first < k_block ? width - first : k_block;
    double* target = panel + size_t{first} * height + first;
    const Products products = {panel + first, height, panel + first, 1, height, first};
    for_lower_products(
        products, height - first, count,
        [=](uint32_t i, uint32_t j, double product) { target[i + size_t{j} * height] -= product; });
    const uint32_t bad = factor_columns(panel, height, first, count);
    if (bad != k_none) {
      Place place;
      place.vertex = order_[supernodes_.first[s] + bad];
      return fail(Code::not_positive_definite, "the matrix is not positive definite", place);
    }
    TRY(count_work(size_t{height} * count * (first + count)));
  }
  return {};
}

Status Cholesky::factor(const Csc& lower) {
  context_->count_factorisation();
  factored_ = false;
  if (!analysed_ || lower.cols != n_ || lower.value.size() != lower_.source.size()) {
    return fail(Code::bad_argument, "the matrix has not the pattern that was analysed");
  }
  for (uint32_t& w : waiting_) w = k_none;
  for (uint32_t s = 0; s < supernodes_.count; ++s) {
    assemble(s, lower.value.data());
    TRY(apply_updates(s));
    TRY(factor_panel(s));
    used_[s] = supernodes_.width(s);
    link(s);
  }
  factored_ = true;
  return {};
}

// y_S := L_SS^-1 y_S, then the rows below lose L_TS y_S.
void Cholesky::solve_forward(uint32_t s, uint32_t columns) {
  const uint32_t height = supernodes_.height(s), width = supernodes_.width(s);
  const uint32_t* rows = supernodes_.rows(s);
  const double* panel = value_.data() + supernodes_.panel[s];
  double* y = permuted_.data();
  double* own = y + size_t{supernodes_.first[s]} * columns;
  for (uint32_t j = 0; j < width; ++j) {
    const double* column = panel + size_t{j} * height;
    double* yj = own + size_t{j} * columns;
    for (uint32_t c = 0; c < columns; ++c) yj[c] /= column[j];
    for (uint32_t i = j + 1; i < width; ++i) {
      double* yi = own + size_t{i} * columns;
      for (uint32_t c = 0; c < columns; ++c) yi[c] -= column[i] * yj[c];
    }
  }
  const Products products = {panel + width, height, own, 1, columns, width};
  for_products(products, height - width, columns, [=](uint32_t i, uint32_t c, double product) {
    y[size_t{rows[width + i]} * columns + c] -= product;
  });
}

void Cholesky::gather_tail(uint32_t s, uint32_t columns) {
  const uint32_t height = supernodes_.height(s);
  double* to = tail_.data();
  for (uint32_t r = supernodes_.width(s); r < height; ++r, to += columns) {
    const double* from = permuted_.data() + size_t{supernodes_.rows(s)[r]} * columns;
    for (uint32_t c = 0; c < columns; ++c) to[c] = from[c];
  }
}

// y_S loses L_TS^T y_T, then y_S := L_SS^-T y_S.
void Cholesky::solve_backward(uint32_t s, uint32_t columns) {
  const uint32_t height = supernodes_.height(s), width = supernodes_.width(s);
  const double* panel = value_.data() + supernodes_.panel[s];
  double* own = permuted_.data() + size_t{supernodes_.first[s]} * columns;
  gather_tail(s, columns);
  const Products products = {tail_.data(), columns, panel + width, height, 1, height - width};
  for_products(products, columns, width, [=](uint32_t c, uint32_t j, double product) {
    own[size_t{j} * columns + c] -= product;
  });
  for (uint32_t j = width; j-- > 0;) {
    const double* column = panel + size_t{j} * height;
    double* yj = own + size_t{j} * columns;
    for (uint32_t i = j + 1; i < width; ++i) {
      const double* yi = own + size_t{i} * columns;
      for (uint32_t c = 0; c < columns; ++c) yj[c] -= column[i] * yi[c];
    }
    for (uint32_t c = 0; c < columns; ++c) yj[c] /= column[j];
  }
}

Status Cholesky::solve(Span<double> x, uint32_t columns) {
  if (!factored_) return fail(Code::bad_argument, "there is no factor to solve with");
  WIRESKIN_ASSERT(x.size() == size_t{n_} * columns);
  TRY(permuted_.resize(size_t{n_} * columns));
  TRY(tail_.resize(relative_.size() * columns));
  for (uint32_t k = 0; k < n_; ++k) {
    const double* from = x.data() + size_t{order_[k]} * columns;
    for (uint32_t c = 0; c < columns; ++c) permuted_[size_t{k} * columns + c] = from[c];
  }
  for (uint32_t s = 0; s < supernodes_.count; ++s) {
    solve_forward(s, columns);
    TRY(count_solve(s, columns));
  }
  for (uint32_t s = supernodes_.count; s-- > 0;) {
    solve_backward(s, columns);
    TRY(count_solve(s, columns));
  }
  for (uint32_t k = 0; k < n_; ++k) {
    double* to = x.data() + size_t{order_[k]} * columns;
    for (uint32_t c = 0; c < columns; ++c) to[c] = permuted_[size_t{k} * columns + c];
  }
  return {};
}

}  // namespace wireskin::sparse
