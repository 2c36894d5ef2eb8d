#include "sparse/cholesky.h"

#include "base/in_parts.h"
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

static Status invert_order(Span<const uint32_t> order, Array<uint32_t>* position) {
  return in_parts(position->context(), order.size(),
                  [&](size_t k) { (*position)[order[k]] = static_cast<uint32_t>(k); });
}

// Renumbers the elimination so that it runs through the elimination tree in postorder. That changes
// neither fill nor work, and makes the columns of a supernode neighbours.
static Status order_by_tree(const Csc& lower, Array<uint32_t>* order, Array<uint32_t>* position,
                            Array<uint32_t>* parent) {
  Context& context = order->context();
  const uint32_t n = lower.cols;
  Pattern upper(context);
  Array<uint32_t> tree(context), post(context), given(context);
  TRY(copy_in_parts(*order, &given));
  TRY(parent->resize(n));
  TRY(permute_pattern(lower, position->span(), Triangle::upper, &upper, false));
  TRY(elimination_tree(upper, &tree));
  TRY(postorder(tree.span(), &post));
  TRY(invert_order(post.span(), position));
  TRY(in_parts(context, n, [&](size_t k) {
    const uint32_t above = tree[post[k]];
    (*parent)[k] = above == k_none ? k_none : (*position)[above];
    (*order)[k] = given[post[k]];
  }));
  return invert_order(order->span(), position);
}

// A visit to an entry of the pattern takes as long as about so many multiplications.
static constexpr size_t k_entry_work = 4;

// Replaces the rows of the permuted pattern by their places in the panels.
Status Cholesky::locate_entries() {
  Array<uint32_t> position(*context_);
  TRY(position.resize(n_));
  for (uint32_t s = 0; s < supernodes_.count; ++s) {
    const uint32_t* rows = supernodes_.rows(s);
    for (uint32_t r = 0; r < supernodes_.height(s); ++r) position[rows[r]] = r;
    const uint32_t end = lower_.start[supernodes_.first[s + 1]];
    for (uint32_t k = lower_.start[supernodes_.first[s]]; k < end; ++k) {
      lower_.index[k] = position[lower_.index[k]];
    }
    const uint32_t entries = end - lower_.start[supernodes_.first[s]];
    TRY(count_work(k_entry_work * (uint64_t{supernodes_.height(s)} + entries)));
  }
  return {};
}

Status Cholesky::analyse(const Csc& lower, Span<const uint32_t> order) {
  WIRESKIN_ASSERT(is_lower_triangle(lower));
  analysed_ = factored_ = false;
  n_ = lower.cols;
  Array<uint32_t> position(*context_), parent(*context_), count(*context_);
  if (order.size() != n_) return fail(Code::bad_argument, k_no_permutation);
  TRY(copy_in_parts(order, &order_));
  TRY(assign_in_parts(n_, k_none, &position));
  for (uint32_t k = 0; k < n_; ++k) {
    TRY(checkpoint_at_column(*context_, k));
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
  TRY(in_parts(*context_, n_, [&](size_t k) { nonzeros_ += count[k]; }));
  analysed_ = true;
  return {};
}

// Threads that work side by side need scratch memory each; small systems are not divided.
uint32_t Cholesky::slots() const {
  constexpr double k_worth_dividing = 2e7;
  return context_->is_parallel() && fronts_.work > k_worth_dividing ? Fronts::k_batch : 1;
}

// The scratch memory would be most of what a small system needs, and no panel of it is tall enough.
size_t Cholesky::scratch_size() const {
  const bool needed = slots() > 1 || needs_scratch(round_up_rows(tallest_), k_block_depth);
  return needed ? slots() * k_update_scratch : 0;
}

size_t Cholesky::factor_bytes() const {
  if (!analysed_) return 0;
  const size_t numbers = supernodes_.panel[supernodes_.count] + fronts_.workspace + scratch_size();
  return numbers * sizeof(double);
}

Status Cholesky::allocate_workspace() {
  TRY(value_.resize_anew(supernodes_.panel[supernodes_.count]));
  TRY(workspace_.resize_anew(fronts_.workspace));
  return scratch_.resize_anew(scratch_size());
}

Status Cholesky::count_work(uint64_t work) {
  constexpr uint64_t k_work_per_checkpoint = uint64_t{1} << 21;
  work_ += work;
  if (work_ < k_work_per_checkpoint) return {};
  work_ = 0;
  return context_->checkpoint();
}

// Adds the update matrix of a child to the columns first .. end of the front of its parent.
void Cholesky::add_child(uint32_t c, const Panel& panel, uint32_t first, uint32_t end) {
  const uint32_t tail = supernodes_.height(c) - supernodes_.width(c);
  const double* from = workspace_.data() + fronts_.update[c];
  const Run* run = fronts_.run.data() + fronts_.run_start[c];
  const Run* const last = fronts_.run.data() + fronts_.run_start[c + 1];
  while (run < last && run->to + run->length <= first) ++run;
  for (; run < last && run->to < end; ++run) {
    const uint32_t behind = run->to + run->length;
    for (uint32_t to = run->to < first ? first : run->to; to < behind && to < end; ++to) {
      const uint32_t k = run->from + (to - run->to);
      const double* column = from + size_t{k} * round_up_rows(tail);
      if (to < panel.width) {
        kernels_.add_runs(run, last, k, column, panel.at(0, to), 0);
      } else {
        double* above = panel.update + size_t{to - panel.width} * round_up_rows(panel.tail());
        kernels_.add_runs(run, last, k, column, above, panel.width);
      }
    }
  }
}

Panel Cholesky::panel_of(uint32_t s) {
  return {value_.data() + supernodes_.panel[s], supernodes_.height(s), supernodes_.width(s),
          workspace_.data() + fronts_.update[s], fronts_.child[s] == k_none};
}

// The columns first .. end of the front of `s`: entries of the matrix and updates of the children.
void Cholesky::assemble(uint32_t s, const double* source, uint32_t first, uint32_t end) {
  const Panel panel = panel_of(s);
  const uint32_t width = panel.width, tail = panel.tail(), rows = round_up_rows(tail);
  if (first < width) {
    const size_t from = trapezoid_size(panel.rows(), first);
    const size_t to = end < width ? trapezoid_size(panel.rows(), end)
                                  : supernodes_.panel[s + 1] - supernodes_.panel[s];
    std::memset(panel.value + from, 0, (to - from) * sizeof(double));
  }
  for (uint32_t c = first; c < end && c < width; ++c) {
    const uint32_t j = supernodes_.first[s] + c;
    double* column = panel.at(0, c);
    for (uint32_t k = lower_.start[j]; k < lower_.start[j + 1]; ++k) {
      column[lower_.index[k]] = source[lower_.source[k]];
    }
  }
  if (panel.first) return;
  for (uint32_t k = first < width ? 0 : first - width; k + width < end; ++k) {
    const uint32_t top = k / 4 * 4;
    std::memset(panel.update + size_t{k} * rows + top, 0, (rows - top) * sizeof(double));
  }
  for (uint32_t c = fronts_.child[s]; c != k_none; c = fronts_.sibling[c]) {
    add_child(c, panel, first, end);
  }
}

// Some columns after the other, with checkpoints between.
Status Cholesky::assemble_in_parts(uint32_t s, const double* source) {
  const uint32_t height = supernodes_.height(s);
  const uint32_t most = static_cast<uint32_t>(k_light_steps_per_checkpoint) / height + 1;
  for (uint32_t first = 0, end = 0; first < height; first = end) {
    end = height - first < most ? height : first + most;
    assemble(s, source, first, end);
    if (end < height) TRY(context_->checkpoint());
  }
  return {};
}

// Returns the first bad column, or k_none.
uint32_t Cholesky::factor_supernode(uint32_t s, const double* source, const PanelTools& tools) {
  assemble(s, source, 0, supernodes_.height(s));
  return factor_panel(tools, panel_of(s));
}

Status Cholesky::refuse_column(uint32_t s, uint32_t column) const {
  Place place;
  place.vertex = order_[supernodes_.first[s] + column];
  return fail(Code::not_positive_definite, "the matrix is not positive definite", place);
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
  const PanelTools tools = {&self.kernels_, self.scratch_.data() + index * k_update_scratch, 1};
  batch.bad_column[index] = k_none;
  for (uint32_t s = task.first; s <= task.root && batch.bad_column[index] == k_none; ++s) {
    batch.bad_supernode[index] = s;
    batch.bad_column[index] = self.factor_supernode(s, batch.source, tools);
  }
}

// Side by side.
Status Cholesky::factor_tasks(uint32_t first, uint32_t end, const double* source) {
  Batch batch = {};
  batch.self = this;
  batch.source = source;
  batch.first_task = first;
  context_->for_each(end - first, &factor_task, &batch);
  for (uint32_t t = 0; t < end - first; ++t) {
    if (batch.bad_column[t] != k_none) {
      return refuse_column(batch.bad_supernode[t], batch.bad_column[t]);
    }
  }
  return context_->checkpoint();
}

// On this thread, where there may be checkpoints on the way.
Status Cholesky::factor_one_task(const Task& task, const double* source) {
  constexpr size_t k_column_overhead = 16;  // multiplications for each row of a column, or so
  const PanelTools tools = {&kernels_, scratch_.data(), 1};
  for (uint32_t s = task.first; s <= task.root; ++s) {
    const uint32_t bad = factor_supernode(s, source, tools);
    if (bad != k_none) return refuse_column(s, bad);
    const uint64_t height = supernodes_.height(s);
    TRY(count_work(height * height * (supernodes_.width(s) + k_column_overhead) / 2));
  }
  return context_->checkpoint();
}

Status Cholesky::factor_step(const Step& step, const double* source) {
  if (slots() > 1) {
    if (step.first_task < step.end_task) {
      TRY(factor_tasks(step.first_task, step.end_task, source));
    }
  } else {
    for (uint32_t t = step.first_task; t < step.end_task; ++t) {
      TRY(factor_one_task(fronts_.task[t], source));
    }
  }
  const PanelTools tools = {&kernels_, scratch_.data(), slots()};
  for (uint32_t u = step.first_upper; u < step.end_upper; ++u) {
    const uint32_t s = fronts_.upper[u];
    uint32_t bad = k_none;
    TRY(assemble_in_parts(s, source));
    TRY(factor_panel_in_parts(*context_, tools, panel_of(s), &bad));
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

void Cholesky::end_factoring() {
  analysed_ = false;
  lower_.start.free();
  lower_.index.free();
  lower_.source.free();
  supernodes_.of_column.free();
  fronts_ = Fronts(*context_);
}

// The triangle of a diagonal block, turned round for the backward pass.
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

// Asks for `count` numbers of a panel that are read next: in several columns at a time, too many
// and too short for the processor to foresee.
static void fetch(const double* at, size_t count) {
#if defined(__GNUC__)
  constexpr size_t k_line = 8;
  for (size_t i = 0; i < count; i += k_line) __builtin_prefetch(at + i, 0, 2);
#else
  (void)at, (void)count;
#endif
}

namespace {

// The right-hand sides of one supernode: lane l of row r of its panel at value[l * step + r].
struct Lanes {
  double* value;
  size_t step;
  uint32_t count;
  double* block;  // eight rows, the lanes of each side by side
};

}  // namespace

// Three lanes at a time, those of a row being neighbours: vectors of space come in threes.
static void gather_lanes(const uint32_t* rows, uint32_t height, const double* y, const Lanes& z) {
  uint32_t l = 0;
  for (; l + 3 <= z.count; l += 3) {
    double* to = z.value + l * z.step;
    for (uint32_t r = 0; r < height; ++r, ++to) {
      const double* from = y + (size_t{rows[r]} * z.count + l);
      to[0] = from[0], to[z.step] = from[1], to[2 * z.step] = from[2];
    }
  }
  for (; l < z.count; ++l) {
    double* to = z.value + l * z.step;
    const double* from = y + l;
    const size_t step = z.count;
    for (uint32_t r = 0; r < height; ++r) to[r] = from[step * rows[r]];
  }
}

static void scatter_lanes(const uint32_t* rows, uint32_t height, const Lanes& z, double* y) {
  uint32_t l = 0;
  for (; l + 3 <= z.count; l += 3) {
    const double* from = z.value + l * z.step;
    for (uint32_t r = 0; r < height; ++r, ++from) {
      double* to = y + (size_t{rows[r]} * z.count + l);
      to[0] = from[0], to[1] = from[z.step], to[2] = from[2 * z.step];
    }
  }
  for (; l < z.count; ++l) {
    const double* from = z.value + l * z.step;
    for (uint32_t r = 0; r < height; ++r) y[size_t{rows[r]} * z.count + l] = from[r];
  }
}

// Solves with a diagonal block in rows `first` and on.
static void solve_triangle(const DenseKernels& kernels, const DiagonalBlock& d, uint32_t first,
                           bool backward, const Lanes& z) {
  const uint32_t rows = round_up_rows(z.count);
  for (uint32_t j = 0; j < d.columns; ++j) {
    for (uint32_t l = 0; l < z.count; ++l) z.block[j * rows + l] = z.value[l * z.step + first + j];
  }
  if (backward) {
    kernels.solve_block(d, rows, z.block + size_t{d.columns - 1} * rows,
                        -static_cast<ptrdiff_t>(rows));
  } else {
    kernels.solve_block(d, rows, z.block, static_cast<ptrdiff_t>(rows));
  }
  for (uint32_t j = 0; j < d.columns; ++j) {
    for (uint32_t l = 0; l < z.count; ++l) z.value[l * z.step + first + j] = z.block[j * rows + l];
  }
}

// What solve() needs behind the right-hand sides.
static size_t lanes_size(size_t step, uint32_t lanes) {
  return step * lanes + size_t{DiagonalBlock::k_size} * round_up_rows(lanes);
}

static Lanes lanes_at(double* at, size_t step, uint32_t lanes) {
  return {at, step, lanes, at + step * lanes};
}

// y_S := L_SS^-1 y_S, then the rows below lose L_TS y_S: eight columns at a time, so that the panel
// is read from end to end.
Status Cholesky::solve_forward(uint32_t s, uint32_t lanes) {
  constexpr uint32_t k_block = DiagonalBlock::k_size;
  const uint32_t width = supernodes_.width(s), height = supernodes_.height(s);
  size_t step = supernodes_.column_step(s);
  const double* block = value_.data() + supernodes_.panel[s];  // at its first diagonal entry
  double* y = workspace_.data();
  const Lanes z = lanes_at(y + size_t{n_} * lanes, lane_step(), lanes);
  gather_lanes(supernodes_.rows(s), height, y, z);
  for (uint32_t j = 0; j < width; j += k_block, block += k_block * step, step -= k_block) {
    const uint32_t columns = width - j < k_block ? width - j : k_block;
    const uint32_t after = j + columns;
    if (after < width) fetch(block + k_block * step, columns * step);
    solve_triangle(kernels_, triangle_at(block, step, columns, false), j, false, z);
    TRY(count_work(uint64_t{height - j} * columns * lanes));
    if (after == height) break;
    kernels_.update({round_up_rows(height - after), lanes, columns, block + columns, step,
                     z.value + j, z.step, 1, z.value + after, z.step, false, false},
                    scratch_.data());
  }
  scatter_lanes(supernodes_.rows(s), height, z, y);
  return {};
}

// y_S loses L_TS^T y_T, then y_S := L_SS^-T y_S. Behind the last row the lanes are zero.
Status Cholesky::solve_backward(uint32_t s, uint32_t lanes) {
  constexpr uint32_t k_block = DiagonalBlock::k_size;
  const uint32_t width = supernodes_.width(s), height = supernodes_.height(s);
  uint32_t j = (width - 1) / k_block * k_block + k_block;
  size_t step = size_t{supernodes_.column_step(s)} - j;
  size_t at = supernodes_.panel[s] + trapezoid_size(step + j, j);
  double* y = workspace_.data();
  const Lanes z = lanes_at(y + size_t{n_} * lanes, lane_step(), lanes);
  gather_lanes(supernodes_.rows(s), height, y, z);
  for (uint32_t l = 0; l < lanes; ++l) {
    for (uint32_t r = height; r < height + 4; ++r) z.value[l * z.step + r] = 0.0;
  }
  while (j > 0) {
    j -= k_block;
    step += k_block;
    at -= k_block * step;
    const uint32_t columns = width - j < k_block ? width - j : k_block;
    const uint32_t after = j + columns;
    const double* block = value_.data() + at;  // at its first diagonal entry
    if (j > 0) fetch(block - k_block * (step + k_block), k_block * (step + k_block));
    if (after < height) {
      kernels_.subtract_dots({columns, lanes, round_up_rows(height - after), block + columns, step,
                              z.value + after, z.step, z.value + j, z.step});
    }
    solve_triangle(kernels_, triangle_at(block, step, columns, true), j, true, z);
    TRY(count_work(uint64_t{height - j} * columns * lanes));
  }
  scatter_lanes(supernodes_.rows(s), width, z, y);
  return {};
}

Status Cholesky::solve(Span<double> x, uint32_t columns) {
  if (!factored_) return fail(Code::bad_argument, "there is no factor to solve with");
  WIRESKIN_ASSERT(x.size() == size_t{n_} * columns);
  // The update matrices are done with: their memory holds the right-hand sides in elimination
  // order, and behind them those of one supernode.
  const size_t right_hand_sides = size_t{n_} * columns;
  const size_t room = right_hand_sides + lanes_size(lane_step(), columns);
  if (workspace_.size() < room) workspace_.clear();
  TRY(workspace_.resize(room));
  TRY(in_parts(*context_, n_, [&](size_t k) {
    const double* from = x.data() + size_t{order_[k]} * columns;
    double* to = workspace_.data() + k * columns;
    for (uint32_t c = 0; c < columns; ++c) to[c] = from[c];
  }));
  for (size_t k = right_hand_sides; k < room; ++k) workspace_[k] = 0.0;
  for (uint32_t s = 0; s < supernodes_.count; ++s) TRY(solve_forward(s, columns));
  for (uint32_t s = supernodes_.count; s-- > 0;) TRY(solve_backward(s, columns));
  return in_parts(*context_, n_, [&](size_t k) {
    double* to = x.data() + size_t{order_[k]} * columns;
    const double* from = workspace_.data() + k * columns;
    for (uint32_t c = 0; c < columns; ++c) to[c] = from[c];
  });
}

}  // namespace wireskin::sparse
