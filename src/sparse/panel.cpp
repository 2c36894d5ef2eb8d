#include "sparse/panel.h"

#include <cfloat>
#include <cmath>

namespace wireskin::sparse {

static constexpr uint32_t k_panel_block = 64;
static constexpr uint32_t k_diagonal_blocks = k_panel_block / DiagonalBlock::k_size;

namespace {

// Some columns under way: the columns before them whose products they lose at a time, and their
// diagonal blocks once these are factored.
struct ColumnBlock {
  uint32_t first, count;
  uint32_t from = 0, depth = 0;
  DiagonalBlock diagonal[k_diagonal_blocks];
};

// Some columns of the update matrix and some of the panel's columns, whose products they lose.
struct TailBlock {
  uint32_t first, count;
  uint32_t from, depth;
};

// What the threads share while they divide a part of the work: a chunk each.
struct PanelParts {
  const PanelTools* tools;
  const Panel* panel;
  const ColumnBlock* block;
  const TailBlock* tail;
  uint32_t first, end;  // rows of the panel, or columns of the update, or its rows
  uint32_t chunk;
  void (*part)(const PanelParts& parts, uint32_t first, uint32_t end, double* scratch);
};

}  // namespace

// Factors the lower triangle of `d.columns` columns at `at`, a column at a time. Returns the first
// bad column.
static uint32_t factor_diagonal(const double* at, size_t step, DiagonalBlock* d) {
  const uint32_t n = d->columns;
  for (uint32_t j = 0; j < n; ++j) {
    for (uint32_t i = j; i < n; ++i) d->entry[i][j] = at[i + j * step];
  }
  for (uint32_t j = 0; j < n; ++j) {
    if (!(d->entry[j][j] > 0.0 && d->entry[j][j] <= DBL_MAX)) return j;
    d->entry[j][j] = std::sqrt(d->entry[j][j]);
    d->inverse[j] = 1.0 / d->entry[j][j];
    for (uint32_t i = j + 1; i < n; ++i) d->entry[i][j] *= d->inverse[j];
    for (uint32_t k = j + 1; k < n; ++k) {
      for (uint32_t i = k; i < n; ++i) d->entry[i][k] -= d->entry[i][j] * d->entry[k][j];
    }
  }
  return k_none;
}

static void store_diagonal(const DiagonalBlock& d, double* at, size_t step) {
  for (uint32_t j = 0; j < d.columns; ++j) {
    for (uint32_t i = j; i < d.columns; ++i) at[i + j * step] = d.entry[i][j];
  }
}

static uint32_t columns_of_diagonal(const ColumnBlock& block, uint32_t offset) {
  const uint32_t left = block.count - offset;
  return left < DiagonalBlock::k_size ? left : DiagonalBlock::k_size;
}

// The rows first .. end of `columns` columns at `column` lose what `depth` columns at `from`
// contribute.
static void update_columns(const PanelTools& tools, const Panel& panel, uint32_t from,
                           uint32_t depth, uint32_t column, uint32_t columns, uint32_t first,
                           uint32_t end, double* scratch) {
  if (depth == 0) return;
  const size_t step = panel.step(from);
  tools.kernels->update(
      {end - first, columns, depth, panel.at(first, from), step, panel.at(column, from), 1, step,
       panel.at(first, column), panel.step(column), first == column, false, true, true},
      scratch);
}

// Factors the block's columns in the rows from the block's first on down to `end`.
static uint32_t factor_block(const PanelTools& tools, const Panel& panel, uint32_t end,
                             ColumnBlock* block) {
  for (uint32_t j = 0; j < block->count; j += DiagonalBlock::k_size) {
    DiagonalBlock* d = &block->diagonal[j / DiagonalBlock::k_size];
    d->columns = columns_of_diagonal(*block, j);
    const uint32_t column = block->first + j;
    const size_t step = panel.step(column);
    double* at = panel.at(column, column);
    update_columns(tools, panel, block->first, j, column, d->columns, column, end, tools.scratch);
    const uint32_t bad = factor_diagonal(at, step, d);
    if (bad != k_none) return column + bad;
    // Rows are solved in fours; those of the diagonal block that come along are stored again.
    const uint32_t below = d->columns / 4 * 4;
    tools.kernels->solve_block(*d, end - column - below, at + below, static_cast<ptrdiff_t>(step));
    store_diagonal(*d, at, step);
  }
  return k_none;
}

// The same for rows below all of the block's diagonal.
static void solve_rows_below(const PanelParts& parts, uint32_t first, uint32_t end,
                             double* scratch) {
  const ColumnBlock& block = *parts.block;
  for (uint32_t j = 0; j < block.count; j += DiagonalBlock::k_size) {
    const DiagonalBlock& d = block.diagonal[j / DiagonalBlock::k_size];
    const uint32_t column = block.first + j;
    update_columns(*parts.tools, *parts.panel, block.first, j, column, d.columns, first, end,
                   scratch);
    parts.tools->kernels->solve_block(d, end - first, parts.panel->at(first, column),
                                      static_cast<ptrdiff_t>(parts.panel->step(column)));
  }
}

// The rows first .. end of the block.
static void update_rows(const PanelParts& parts, uint32_t first, uint32_t end, double* scratch) {
  const ColumnBlock& block = *parts.block;
  update_columns(*parts.tools, *parts.panel, block.from, block.depth, block.first, block.count,
                 first, end, scratch);
}

// The columns first .. end of the update matrix.
static void update_tail(const PanelParts& parts, uint32_t first, uint32_t end, double* scratch) {
  const Panel& panel = *parts.panel;
  const size_t step = panel.rows(), tail_step = round_up_rows(panel.tail());
  const double* rows = panel.value + panel.width + first;
  const uint32_t height = static_cast<uint32_t>(tail_step) - first;
  parts.tools->kernels->update(
      {height, end - first, panel.width, rows, step, rows, 1, step,
       panel.update + first * tail_step + first, tail_step, true, panel.first, true, false},
      scratch);
}

// The rows first .. end of a block of the update matrix, from its diagonal on.
static void update_tail_rows(const PanelParts& parts, uint32_t first, uint32_t end,
                             double* scratch) {
  const Panel& panel = *parts.panel;
  const TailBlock& block = *parts.tail;
  const size_t step = panel.step(block.from), tail_step = round_up_rows(panel.tail());
  parts.tools->kernels->update(
      {end - first, block.count, block.depth, panel.at(panel.width + first, block.from), step,
       panel.at(panel.width + block.first, block.from), 1, step,
       panel.update + block.first * tail_step + first, tail_step, first == block.first,
       panel.first && block.from == 0, true, false},
      scratch);
}

static ColumnBlock block_at(const Panel& panel, uint32_t first) {
  ColumnBlock block;
  block.first = first;
  block.count = panel.width - first < k_panel_block ? panel.width - first : k_panel_block;
  return block;
}

uint32_t factor_panel(const PanelTools& tools, const Panel& panel) {
  for (uint32_t first = 0; first < panel.width; first += k_panel_block) {
    ColumnBlock block = block_at(panel, first);
    update_columns(tools, panel, 0, first, first, block.count, first, panel.rows(), tools.scratch);
    const uint32_t bad = factor_block(tools, panel, panel.rows(), &block);
    if (bad != k_none) return bad;
  }
  if (panel.tail() > 0) {
    update_tail({&tools, &panel, nullptr, nullptr, 0, 0, 0, nullptr}, 0, panel.tail(),
                tools.scratch);
  }
  return k_none;
}

// Multiplications of one thread between two checkpoints, about.
static constexpr double k_most_work = 2.5e7;

static void run_slot(uint32_t slot, void* data) {
  const PanelParts& parts = *static_cast<const PanelParts*>(data);
  double* scratch = parts.tools->scratch + slot * k_update_scratch;
  const uint32_t at = parts.first + slot * parts.chunk;
  parts.part(parts, at, parts.end - at < parts.chunk ? parts.end : at + parts.chunk, scratch);
}

// Divides first .. end into chunks of fours, so that each thread gets some, none is tiny and a
// checkpoint is never far; `work`: multiplications for each row or column.
static Status run_parts(Context& context, PanelParts parts, double work) {
  constexpr uint32_t k_least_chunk = 64;
  constexpr double k_worth_dividing = 5e5;
  const uint32_t slots = parts.tools->slots;
  const uint32_t end = parts.end;
  const uint32_t share = slots == 1 ? end - parts.first : (end - parts.first) / slots;
  const double most = k_most_work / work;
  parts.chunk = round_up_rows(share < most ? share : static_cast<uint32_t>(most));
  if (parts.chunk < k_least_chunk) parts.chunk = k_least_chunk;
  for (; parts.first < end; parts.first = parts.end) {
    const uint32_t left = end - parts.first;
    const uint32_t chunks = (left + parts.chunk - 1) / parts.chunk;
    const uint32_t now = chunks < slots ? chunks : slots;
    parts.end = left <= now * parts.chunk ? end : parts.first + now * parts.chunk;
    // Waking a thread takes as long as some hundred thousand multiplications.
    if (work * (parts.end - parts.first) < k_worth_dividing) {
      for (uint32_t slot = 0; slot < now; ++slot) run_slot(slot, &parts);
    } else {
      context.for_each(now, &run_slot, &parts);
    }
    TRY(context.checkpoint());
  }
  return {};
}

// A few columns at a time; where even these would take long, a few terms of some of their rows.
static Status update_tail_in_parts(Context& context, const PanelTools& tools, const Panel& panel) {
  const uint32_t tail = panel.tail();
  const double work = double{1} * tail * panel.width;
  if (work * k_panel_block <= k_most_work) {
    return run_parts(context, {&tools, &panel, nullptr, nullptr, 0, tail, 0, &update_tail}, work);
  }
  TailBlock block = {};
  for (; block.first < tail; block.first += block.count) {
    block.count = tail - block.first < k_panel_block ? tail - block.first : k_panel_block;
    for (block.from = 0; block.from < panel.width; block.from += block.depth) {
      const uint32_t left = panel.width - block.from;
      block.depth = left < k_block_depth ? left : k_block_depth;
      TRY(run_parts(
          context,
          {&tools, &panel, nullptr, &block, block.first, round_up_rows(tail), 0, &update_tail_rows},
          double{k_panel_block} * k_block_depth));
    }
  }
  return {};
}

// The same for a block of the panel's own columns and its rows from `below` on.
static Status update_rows_in_parts(Context& context, const PanelTools& tools, const Panel& panel,
                                   uint32_t below, ColumnBlock* block) {
  constexpr uint32_t k_most_depth = 4 * k_block_depth;
  for (block->from = 0; block->from < block->first; block->from += block->depth) {
    const uint32_t left = block->first - block->from;
    block->depth = left < k_most_depth ? left : k_most_depth;
    TRY(run_parts(context, {&tools, &panel, block, nullptr, below, panel.rows(), 0, &update_rows},
                  double{k_panel_block} * block->depth));
  }
  return {};
}

Status factor_panel_in_parts(Context& context, const PanelTools& tools, const Panel& panel,
                             uint32_t* bad_column) {
  *bad_column = k_none;
  const uint32_t rows = panel.rows();
  for (uint32_t first = 0; first < panel.width; first += k_panel_block) {
    ColumnBlock block = block_at(panel, first);
    const uint32_t below = round_up_rows(first + block.count);
    update_columns(tools, panel, 0, first, first, block.count, first, below, tools.scratch);
    if (below < rows) {
      TRY(context.checkpoint());
      TRY(update_rows_in_parts(context, tools, panel, below, &block));
    }
    *bad_column = factor_block(tools, panel, below, &block);
    if (*bad_column != k_none) return {};
    if (below < rows) {
      TRY(run_parts(context, {&tools, &panel, &block, nullptr, below, rows, 0, &solve_rows_below},
                    0.5 * k_panel_block * k_panel_block));
    }
  }
  return panel.tail() == 0 ? Status{} : update_tail_in_parts(context, tools, panel);
}

}  // namespace wireskin::sparse
