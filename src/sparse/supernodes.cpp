#include "sparse/supernodes.h"

#include "base/sort.h"

namespace wireskin::sparse {

// A supernode while the partition is made: its columns begin at `first`, `tail` rows lie below
// them.
struct SupernodeBlock {
  uint32_t first;
  uint32_t width;
  uint32_t tail;
  uint64_t zeros;  // entries stored though they are not in the factor's structure
};

static uint64_t trapezoid_entries(uint64_t width, uint64_t tail) {
  return width * (width + 1) / 2 + width * tail;
}

static SupernodeBlock join(const SupernodeBlock& child, const SupernodeBlock& parent) {
  SupernodeBlock joined = {child.first, child.width + parent.width, parent.tail, 0};
  joined.zeros = child.zeros + parent.zeros + trapezoid_entries(joined.width, joined.tail) -
                 trapezoid_entries(child.width, child.tail) -
                 trapezoid_entries(parent.width, parent.tail);
  return joined;
}

// The wider the panel, the less there is to gain and the fewer zeros are accepted.
static bool is_worth_joining(const SupernodeBlock& joined) {
  if (joined.zeros == 0 || joined.width <= 4) return true;
  const uint64_t entries = trapezoid_entries(joined.width, joined.tail);
  if (joined.width <= 16) return 2 * joined.zeros < entries;
  if (joined.width <= 48) return 8 * joined.zeros < entries;
  return 20 * joined.zeros < entries;
}

static bool is_child_of(const SupernodeBlock& block, Span<const uint32_t> parent,
                        const SupernodeBlock& above) {
  const uint32_t p = parent[block.first + block.width - 1];
  return p != k_none && p < above.first + above.width;
}

// In postorder the last child of a block stands right before it: a stack of finished blocks is all
// that joining needs.
static Status partition_columns(Span<const uint32_t> parent, Span<const uint32_t> count,
                                Array<SupernodeBlock>* blocks) {
  const uint32_t n = static_cast<uint32_t>(parent.size());
  TRY(blocks->reserve(n));
  for (uint32_t j = 0; j < n;) {
    SupernodeBlock block = {j, 1, count[j] - 1, 0};
    for (++j; j < n && parent[j - 1] == j && count[j - 1] == count[j] + 1; ++j) {
      ++block.width;
      --block.tail;
    }
    while (!blocks->empty() && is_child_of(blocks->back(), parent, block)) {
      const SupernodeBlock joined = join(blocks->back(), block);
      if (!is_worth_joining(joined)) break;
      block = joined;
      blocks->pop();
    }
    blocks->push_reserved(block);
  }
  return {};
}

static Status size_panels(const Array<SupernodeBlock>& blocks, Supernodes* result) {
  uint64_t rows = 0, values = 0;
  for (uint32_t s = 0; s < result->count; ++s) {
    const SupernodeBlock& block = blocks[s];
    result->first[s] = block.first;
    result->row_start[s] = static_cast<uint32_t>(rows);
    result->panel[s] = static_cast<uint32_t>(values);
    const uint32_t height = block.width + block.tail;
    rows += height;
    values += trapezoid_size(round_up_rows(height), block.width) + k_panel_margin;
    if (rows >= k_none || values >= k_none) {
      return fail(Code::too_large, "the factor is too large for 32-bit indices");
    }
    for (uint32_t j = block.first; j < block.first + block.width; ++j) result->of_column[j] = s;
  }
  result->first[result->count] = static_cast<uint32_t>(result->of_column.size());
  result->row_start[result->count] = static_cast<uint32_t>(rows);
  result->panel[result->count] = static_cast<uint32_t>(values);
  return {};
}

// What the row lists are collected with: supernodes whose rows continue in the same supernode are
// linked, and mark[i] == s + 1 means that row i is listed in supernode s.
struct RowCollector {
  Array<uint32_t> child;  // of each supernode
  Array<uint32_t> sibling;
  Array<uint32_t> mark;

  explicit RowCollector(Context& c) : child(c), sibling(c), mark(c) {}
};

static void collect_row(RowCollector* rows, uint32_t s, uint32_t i, Supernodes* result,
                        uint32_t* end) {
  if (i < result->first[s + 1] || rows->mark[i] == s + 1) return;
  rows->mark[i] = s + 1;
  WIRESKIN_ASSERT(*end < result->row_start[s + 1]);
  result->row[(*end)++] = i;
}

// Rows come from the matrix and from the children, and from nowhere else.
static void list_rows(const Pattern& lower, uint32_t s, RowCollector* rows, Supernodes* result) {
  uint32_t end = result->row_start[s];
  for (uint32_t j = result->first[s]; j < result->first[s + 1]; ++j) result->row[end++] = j;
  const uint32_t tail = end;
  for (uint32_t j = result->first[s]; j < result->first[s + 1]; ++j) {
    for (uint32_t k = lower.start[j]; k < lower.start[j + 1]; ++k) {
      collect_row(rows, s, lower.index[k], result, &end);
    }
  }
  for (uint32_t c = rows->child[s]; c != k_none; c = rows->sibling[c]) {
    for (uint32_t k = result->row_start[c]; k < result->row_start[c + 1]; ++k) {
      collect_row(rows, s, result->row[k], result, &end);
    }
  }
  WIRESKIN_ASSERT(end == result->row_start[s + 1]);
  sort(result->row.span().part(tail, end - tail), [](uint32_t a, uint32_t b) { return a < b; });
  if (tail == end) return;
  const uint32_t above = result->of_column[result->row[tail]];
  rows->sibling[s] = rows->child[above];
  rows->child[above] = s;
}

Status find_supernodes(const Pattern& lower, Span<const uint32_t> parent,
                       Span<const uint32_t> count, Supernodes* result) {
  constexpr uint32_t k_rows_per_checkpoint = 1u << 18;
  Context& context = result->first.context();
  Array<SupernodeBlock> blocks(context);
  TRY(partition_columns(parent, count, &blocks));
  result->count = static_cast<uint32_t>(blocks.size());
  TRY(result->first.resize(blocks.size() + 1));
  TRY(result->row_start.resize(blocks.size() + 1));
  TRY(result->panel.resize(blocks.size() + 1));
  TRY(result->of_column.resize(parent.size()));
  TRY(size_panels(blocks, result));
  TRY(result->row.resize(result->row_start[result->count]));
  RowCollector rows(context);
  TRY(rows.child.assign(result->count, k_none));
  TRY(rows.sibling.assign(result->count, k_none));
  TRY(rows.mark.assign(parent.size(), 0));
  uint32_t checked = 0;
  for (uint32_t s = 0; s < result->count; ++s) {
    list_rows(lower, s, &rows, result);
    if (result->row_start[s] - checked < k_rows_per_checkpoint) continue;
    checked = result->row_start[s];
    TRY(context.checkpoint());
  }
  return {};
}

}  // namespace wireskin::sparse
