#include "sparse/cholesky.h"

#include "sparse/elimination_tree.h"

namespace wireskin::sparse {

static constexpr const char* k_no_permutation = "the elimination order is not a permutation";

Cholesky::Cholesky(Context& context, Instructions instructions)
    : context_(&context),
      kernels_(dense_kernels(instructions)),
      order_(context),
      lower_(context),
      supernodes_(context),
      fronts_(context),
      value_(context),
      workspace_(context),
      scratch_(context) {}

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

// Replaces the rows of the permuted pattern by their places in the panels.
Status Cholesky::locate_entries() {
  Array<uint32_t> position(*context_);
  TRY(position.resize(n_));
  for (uint32_t s = 0; s < supernodes_.count; ++s) {
    const uint32_t* rows = supernodes_.rows(s);
    TRY(checkpoint_at_column(*context_, s));
    for (uint32_t r = 0; r < supernodes_.height(s); ++r) position[rows[r]] = r;
    const uint32_t end = lower_.start[supernodes_.first[s + 1]];
    for (uint32_t k = lower_.start[supernodes_.first[s]]; k < end; ++k) {
      lower_.index[k] = position[lower_.index[k]];
    }
  }
  return {};
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
  TRY(plan_fronts(supernodes_, context_->is_parallel() ? Fronts::k_batch : 1, &fronts_));
  TRY(locate_entries());
  tallest_ = 0;
  for (uint32_t s = 0; s < supernodes_.count; ++s) {
    if (supernodes_.height(s) > tallest_) tallest_ = supernodes_.height(s);
  }
  nonzeros_ = 0;
  for (const uint32_t c : count) nonzeros_ += c;
  analysed_ = true;
  return {};
}

// Threads that work side by side need scratch memory each; small systems are not divided.
uint32_t Cholesky::slots() const {
  constexpr double k_worth_dividing = 2e7;
  return context_->is_parallel() && fronts_.work > k_worth_dividing ? Fronts::k_batch : 1;
}

size_t Cholesky::factor_bytes() const {
  if (!analysed_) return 0;
  const size_t numbers =
      supernodes_.panel[supernodes_.count] + fronts_.workspace + slots() * k_update_scratch;
  return numbers * sizeof(double);
}

Status Cholesky::allocate_workspace() {
  TRY(value_.resize(supernodes_.panel[supernodes_.count]));
  TRY(workspace_.resize(fronts_.workspace));
  return scratch_.resize(slots() * k_update_scratch);
}

// Adds the update matrix of a child to the front of its parent.
void Cholesky::add_child(uint32_t c, const Panel& panel) {
  const uint32_t tail = supernodes_.height(c) - supernodes_.width(c);
  const double* from = workspace_.data() + fronts_.update[c];
  const Run* end = fronts_.run.data() + fronts_.run_start[c + 1];
  for (const Run* run = fronts_.run.data() + fronts_.run_start[c]; run < end; ++run) {
    for (uint32_t k = run->from; k < run->from + run->length; ++k) {
      const double* column = from + size_t{k} * round_up_rows(tail);
      const uint32_t to = run->to + (k - run->from);
      if (to < panel.width) {
        kernels_.add_runs(run, end, k, column, panel.value + size_t{to} * panel.step(), 0);
      } else {
        double* above = panel.update + size_t{to - panel.width} * round_up_rows(panel.tail());
        kernels_.add_runs(run, end, k, column, above, panel.width);
      }
    }
  }
}

// The front of `s`: entries of the matrix and updates of the children.
Panel Cholesky::assemble(uint32_t s, const double* source) {
  Panel panel = {value_.data() + supernodes_.panel[s], supernodes_.height(s), supernodes_.width(s),
                 workspace_.data() + fronts_.update[s], fronts_.child[s] == k_none};
  const size_t step = panel.step();
  std::memset(panel.value, 0, (step * panel.width + k_panel_margin) * sizeof(double));
  double* column = panel.value;
  for (uint32_t j = supernodes_.first[s]; j < supernodes_.first[s + 1]; ++j, column += step) {
    for (uint32_t k = lower_.start[j]; k < lower_.start[j + 1]; ++k) {
      column[lower_.index[k]] = source[lower_.source[k]];
    }
  }
  if (panel.first) return panel;
  const uint32_t tail = panel.tail(), rows = round_up_rows(tail);
  for (uint32_t k = 0; k < tail; ++k) {
    const uint32_t top = k / 4 * 4;
    std::memset(panel.update + size_t{k} * rows + top, 0, (rows - top) * sizeof(double));
  }
  for (uint32_t c = fronts_.child[s]; c != k_none; c = fronts_.sibling[c]) add_child(c, panel);
  return panel;
}

// A batch of tasks under way; bad_*: of each task, where it failed.
struct Cholesky::Batch {
  Cholesky* self;
  const double* source;
  uint32_t first_task;
  uint32_t bad_supernode[Fronts::k_batch];
  uint32_t bad_column[Fronts::k_batch];
};

void Cholesky::factor_task(uint32_t index, void* data) {
  Batch& batch = *static_cast<Batch*>(data);
  Cholesky& self = *batch.self;
  const Task& task = self.fronts_.task[batch.first_task + index];
  const uint32_t slot = self.context_->is_parallel() ? index % self.slots() : 0;
  const PanelTools tools = {&self.kernels_, self.scratch_.data() + slot * k_update_scratch, 1};
  batch.bad_column[index] = k_none;
  for (uint32_t s = task.first; s <= task.root && batch.bad_column[index] == k_none; ++s) {
    batch.bad_supernode[index] = s;
    batch.bad_column[index] = factor_panel(tools, self.assemble(s, batch.source));
  }
}

Status Cholesky::refuse_column(uint32_t s, uint32_t column) const {
  Place place;
  place.vertex = order_[supernodes_.first[s] + column];
  return fail(Code::not_positive_definite, "the matrix is not positive definite", place);
}

Status Cholesky::factor_step(const Step& step, const double* source) {
  Batch batch = {};
  batch.self = this;
  batch.source = source;
  const bool divided = slots() > 1;
  for (uint32_t first = step.first_task; first < step.end_task;) {
    // One by one there is a checkpoint after each task.
    const uint32_t count = divided ? step.end_task - first : 1;
    batch.first_task = first;
    if (divided) {
      context_->for_each(count, &factor_task, &batch);
    } else {
      factor_task(0, &batch);
    }
    for (uint32_t t = 0; t < count; ++t) {
      if (batch.bad_column[t] != k_none) {
        return refuse_column(batch.bad_supernode[t], batch.bad_column[t]);
      }
    }
    first += count;
    TRY(context_->checkpoint());
  }
  const PanelTools tools = {&kernels_, scratch_.data(), slots()};
  for (uint32_t u = step.first_upper; u < step.end_upper; ++u) {
    const uint32_t s = fronts_.upper[u];
    uint32_t bad = k_none;
    TRY(factor_panel_in_parts(*context_, tools, assemble(s, source), &bad));
    if (bad != k_none) return refuse_column(s, bad);
  }
  return {};
}

Status Cholesky::factor(const Csc& lower) {
  context_->count_factorisation();
  factored_ = false;
  if (!analysed_ || lower.cols != n_ || lower.value.size() != lower_.source.size()) {
    return fail(Code::bad_argument, "the matrix has not the pattern that was analysed");
  }
  TRY(allocate_workspace());
  for (const Step& step : fronts_.step) TRY(factor_step(step, lower.value.data()));
  factored_ = true;
  return {};
}

// The lanes of a right-hand side that stand side by side: a row of the solution.
static DiagonalBlock triangle_at(const double* at, size_t step, uint32_t columns, bool backward) {
  DiagonalBlock d;
  d.columns = columns;
  for (uint32_t j = 0; j < columns; ++j) {
    const uint32_t to = backward ? columns - 1 - j : j;
    d.inverse[to] = 1.0 / at[j + j * step];
    for (uint32_t i = j + 1; i < columns; ++i) {
      if (backward) {
        d.entry[to][columns - 1 - i] = at[i + j * step];
      } else {
        d.entry[i][j] = at[i + j * step];
      }
    }
  }
  return d;
}

// y_S := L_SS^-1 y_S, then the rows below lose L_TS y_S: eight columns at a time, so that the panel
// is read from end to end. Transposed, a row of y is a column.
void Cholesky::solve_forward(uint32_t s, uint32_t lanes) {
  constexpr uint32_t k_block = DiagonalBlock::k_size;
  const uint32_t width = supernodes_.width(s), tail = supernodes_.height(s) - width;
  const size_t step = supernodes_.column_step(s), bytes = lanes * sizeof(double);
  const double* panel = value_.data() + supernodes_.panel[s];
  const uint32_t* rows = supernodes_.rows(s) + width;
  double* y = workspace_.data();
  double* own = y + size_t{supernodes_.first[s]} * lanes;
  double* below = y + size_t{n_} * lanes;
  for (uint32_t r = 0; r < tail; ++r) {
    std::memcpy(below + size_t{r} * lanes, y + size_t{rows[r]} * lanes, bytes);
  }
  for (uint32_t j = 0; j < width; j += k_block) {
    const uint32_t columns = width - j < k_block ? width - j : k_block;
    const uint32_t after = j + columns;
    const double* block = panel + j * step;
    double* x = own + size_t{j} * lanes;
    kernels_.solve_block(triangle_at(block + j, step, columns, false), lanes, x, lanes);
    const auto subtract = [&](uint32_t row, uint32_t count, double* from) {
      kernels_.update(
          {lanes, count, columns, x, lanes, block + row, 1, step, from, lanes, false, false},
          scratch_.data());
    };
    if (after < width) subtract(after, width - after, own + size_t{after} * lanes);
    if (tail > 0) subtract(width, tail, below);
  }
  for (uint32_t r = 0; r < tail; ++r) {
    std::memcpy(y + size_t{rows[r]} * lanes, below + size_t{r} * lanes, bytes);
  }
}

// y_S loses L_TS^T y_T, then y_S := L_SS^-T y_S.
void Cholesky::solve_backward(uint32_t s, uint32_t lanes) {
  constexpr uint32_t k_block = DiagonalBlock::k_size;
  const uint32_t width = supernodes_.width(s), tail = supernodes_.height(s) - width;
  const size_t step = supernodes_.column_step(s);
  const double* panel = value_.data() + supernodes_.panel[s];
  double* y = workspace_.data();
  double* own = y + size_t{supernodes_.first[s]} * lanes;
  if (tail > 0) {
    const uint32_t* rows = supernodes_.rows(s) + width;
    double* below = y + size_t{n_} * lanes;
    for (uint32_t r = 0; r < tail; ++r) {
      std::memcpy(below + size_t{r} * lanes, y + size_t{rows[r]} * lanes, lanes * sizeof(double));
    }
    kernels_.update(
        {lanes, width, tail, below, lanes, panel + width, step, 1, own, lanes, false, false},
        scratch_.data());
  }
  for (uint32_t j = (width - 1) / k_block * k_block + k_block; j > 0;) {
    j -= k_block;
    const uint32_t columns = width - j < k_block ? width - j : k_block;
    const uint32_t after = j + columns;
    double* x = own + size_t{j} * lanes;
    if (after < width) {
      kernels_.update({lanes, columns, width - after, own + size_t{after} * lanes, lanes,
                       panel + j * step + after, step, 1, x, lanes, false, false},
                      scratch_.data());
    }
    kernels_.solve_block(triangle_at(panel + j * step + j, step, columns, true), lanes,
                         x + size_t{columns - 1} * lanes, -static_cast<ptrdiff_t>(lanes));
  }
}

Status Cholesky::count_solve(uint32_t s, uint32_t lanes, size_t* work) {
  constexpr size_t k_work_per_checkpoint = size_t{1} << 24;
  *work += size_t{supernodes_.height(s)} * supernodes_.width(s) * lanes;
  if (*work < k_work_per_checkpoint) return {};
  *work = 0;
  return context_->checkpoint();
}

Status Cholesky::solve(Span<double> x, uint32_t columns) {
  if (!factored_) return fail(Code::bad_argument, "there is no factor to solve with");
  WIRESKIN_ASSERT(x.size() == size_t{n_} * columns);
  const uint32_t lanes = round_up_rows(columns);
  // The update matrices are done with: their memory holds the right-hand sides in elimination
  // order, and behind them those of the rows below one supernode.
  const size_t room = (size_t{n_} + tallest_) * lanes;
  if (workspace_.size() < room) workspace_.clear();
  TRY(workspace_.resize(room));
  for (uint32_t k = 0; k < n_; ++k) {
    const double* from = x.data() + size_t{order_[k]} * columns;
    double* to = workspace_.data() + size_t{k} * lanes;
    for (uint32_t c = 0; c < lanes; ++c) to[c] = c < columns ? from[c] : 0.0;
  }
  size_t work = 0;
  for (uint32_t s = 0; s < supernodes_.count; ++s) {
    solve_forward(s, lanes);
    TRY(count_solve(s, lanes, &work));
  }
  for (uint32_t s = supernodes_.count; s-- > 0;) {
    solve_backward(s, lanes);
    TRY(count_solve(s, lanes, &work));
  }
  for (uint32_t k = 0; k < n_; ++k) {
    double* to = x.data() + size_t{order_[k]} * columns;
    const double* from = workspace_.data() + size_t{k} * lanes;
    for (uint32_t c = 0; c < columns; ++c) to[c] = from[c];
  }
  return {};
}

}  // namespace wireskin::sparse
