#include "sparse/supernodes.h"

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
  uint32_t checked = 0;
  for (uint32_t j = 0; j < n;) {
    if (j - checked >= k_columns_per_checkpoint) {
      checked = j;
      TRY(blocks->context().checkpoint());
    }
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
    TRY(checkpoint_at_column(blocks.context(), s));
    result->first[s] = block.first;
    result->row_start[s] = static_cast<uint32_t>(rows);
    result->panel[s] = static_cast<uint32_t>(values);
    const uint32_t height = block.width + block.tail;
    rows += height;
    // With indices of 32 bits the size of the trapezoid itself might wrap.
    const uint64_t whole = uint64_t{round_up_rows(height)} * block.width;
    if (whole >= 2 * uint64_t{k_none}) {
      return fail(Code::too_large, "the factor is too large for 32-bit indices");
    }
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

namespace {

// What the row lists are collected with: supernodes whose rows continue in the same supernode are
// linked, and the rows under way are a set of bits. Bit w of `words` says that word w is not zero.
struct RowCollector {
  Array<uint32_t> child;  // of each supernode
  Array<uint32_t> sibling;
  Array<uint64_t> bits;
  Array<uint64_t> words;
  uint32_t last = 0;  // no row of the set comes after it

  explicit RowCollector(Context& c) : child(c), sibling(c), bits(c), words(c) {}

  void add(uint32_t row) {
    bits[row / 64] |= uint64_t{1} << row % 64;
    words[row / 4096] |= uint64_t{1} << row / 64 % 64;
    last = row > last ? row : last;
  }
};

}  // namespace

// The lowest bit that is set; there is one.
static uint32_t lowest_bit(uint64_t word) {
#if defined(__GNUC__) && SIZE_MAX > 0xffffffff
  return static_cast<uint32_t>(__builtin_ctzll(word));
#else
  uint32_t bit = 0;
  for (uint32_t half = 32; half > 0; half /= 2) {
    if ((word & ((uint64_t{1} << half) - 1)) != 0) continue;
    word >>= half;
    bit += half;
  }
  return bit;
#endif
}

// Writes the rows of the set, none of which is less than `first`, and empties it.
static uint32_t* take_rows(uint32_t first, RowCollector* rows, uint32_t* to) {
  for (uint32_t group = first / 4096; group <= rows->last / 4096; ++group) {
    for (; rows->words[group] != 0; rows->words[group] &= rows->words[group] - 1) {
      const uint32_t word = 64 * group + lowest_bit(rows->words[group]);
      uint64_t bits = rows->bits[word];
      rows->bits[word] = 0;
      for (; bits != 0; bits &= bits - 1) *to++ = 64 * word + lowest_bit(bits);
    }
  }
  rows->last = 0;
  return to;
}

// Rows come from the matrix and from the children, and from nowhere else. Returns how many came.
static uint32_t list_rows(const Pattern& lower, uint32_t s, RowCollector* rows,
                          Supernodes* result) {
  const uint32_t first = result->first[s], after = result->first[s + 1];
  uint32_t met = after - first + lower.start[after] - lower.start[first];
  for (uint32_t j = first; j < after; ++j) {
    rows->add(j);
    for (uint32_t k = lower.start[j]; k < lower.start[j + 1]; ++k) rows->add(lower.index[k]);
  }
  for (uint32_t c = rows->child[s]; c != k_none; c = rows->sibling[c]) {
    for (uint32_t k = result->row_start[c] + result->width(c); k < result->row_start[c + 1]; ++k) {
      rows->add(result->row[k]);
    }
    met += result->height(c) - result->width(c);
  }
  const uint32_t* end = take_rows(first, rows, result->row.data() + result->row_start[s]);
  const uint32_t tail = result->row_start[s] + (after - first);
  WIRESKIN_ASSERT(end == result->row.data() + result->row_start[s + 1]);
  if (result->row.data() + tail == end) return met;
  const uint32_t above = result->of_column[result->row[tail]];
  rows->sibling[s] = rows->child[above];
  rows->child[above] = s;
  return met;
}

Status find_supernodes(const Pattern& lower, Span<const uint32_t> parent,
                       Span<const uint32_t> count, Supernodes* result) {
  constexpr uint32_t k_entries_per_checkpoint = 1u << 18;
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
  TRY(rows.bits.assign(parent.size() / 64 + 1, 0));
  TRY(rows.words.assign(parent.size() / 4096 + 1, 0));
  uint32_t entries = 0;
  for (uint32_t s = 0; s < result->count; ++s) {
    entries += list_rows(lower, s, &rows, result);
    if (entries < k_entries_per_checkpoint) continue;
    entries = 0;
    TRY(context.checkpoint());
  }
  return {};
}

}  // namespace wireskin::sparse
