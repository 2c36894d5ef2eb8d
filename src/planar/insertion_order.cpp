#include "planar/insertion_order.h"

#include "base/in_parts.h"
#include "num/minmax.h"

namespace wireskin::planar {

struct OrderKey {
  uint64_t key;
  uint32_t index;
};

static constexpr int k_most_hilbert_bits = 20;
static constexpr int k_digit_bits = 11;
// So many points in one cell are worth a finer grid.
static constexpr size_t k_crowd = 64;

// The place of the cell (x, y) along the Hilbert curve through 2^bits x 2^bits cells.
static uint64_t hilbert_place(uint32_t x, uint32_t y, int bits) {
  uint64_t place = 0;
  for (int bit = bits - 1; bit >= 0; --bit) {
    const uint32_t right = x >> bit & 1, upper = y >> bit & 1;
    place = 4 * place + ((3 * right) ^ upper);
    // The curve enters the lower quarters turned; turn the rest of the coordinates back: both are
    // reflected in the right one, then they change places. No branch, for none could be foreseen.
    const uint32_t lower = upper - 1;  // all bits, or none
    const uint32_t reflected = lower & (0u - right);
    const uint32_t kept = x ^ reflected, other = y ^ reflected;
    x = kept ^ (lower & (kept ^ other));
    y = other ^ (lower & (kept ^ other));
  }
  return place;
}

// Three quarters of the points belong to the last round, three quarters of the rest to the one
// before, and so on, by lot: drawn from the index, with the mixing of S. Vigna's splitmix64 (2015).
static uint64_t insertion_round(uint32_t index, uint64_t last_round) {
  uint64_t z = (index + 1ull) * 0x9e3779b97f4a7c15ull;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
  z ^= z >> 31;
  uint64_t round = last_round;
  for (; round > 0 && (z & 3) == 0; z >>= 2) --round;
  return round;
}

// Sorts by the lowest `bits` of the keys, equal ones by the order they are in: digit by digit from
// the lowest, between the two arrays, and leaves the result in the first.
static Status sort_by_digits(Array<OrderKey>* keys, int bits) {
  constexpr uint32_t k_digits = 1u << k_digit_bits;
  const size_t count = keys->size();
  Array<OrderKey> other(keys->context());
  Array<uint32_t> starts(keys->context());
  TRY(other.resize(count));
  TRY(starts.resize(k_digits + 1));
  for (int shift = 0; shift < bits; shift += k_digit_bits) {
    const auto digit = [shift](const OrderKey& key) { return key.key >> shift & (k_digits - 1); };
    for (uint32_t& start : starts) start = 0;
    for (const OrderKey& key : *keys) ++starts[digit(key)];
    starts_from_counts(starts.span());
    TRY(in_parts(keys->context(), keys->size(), [&](size_t i) {
      const OrderKey& key = (*keys)[i];
      other[starts[digit(key)]++] = key;
    }));
    Array<OrderKey> sorted = static_cast<Array<OrderKey>&&>(other);
    other = static_cast<Array<OrderKey>&&>(*keys);
    *keys = static_cast<Array<OrderKey>&&>(sorted);
  }
  return {};
}

// How many points the fullest cell of a round has.
static size_t longest_run(Span<const OrderKey> keys) {
  size_t longest = 0, first = 0;
  for (size_t i = 0; i < keys.size(); ++i) {
    if (keys[i].key != keys[first].key) first = i;
    if (i - first >= longest) longest = i - first + 1;
  }
  return longest;
}

static Status sort_by_cells(Span<const Vec2> points, int hilbert_bits, uint64_t last_round,
                            Array<OrderKey>* keys) {
  Vec2 low = points[0];
  Vec2 high = points[0];
  for (const Vec2& p : points) {
    low = {p.x < low.x ? p.x : low.x, p.y < low.y ? p.y : low.y};
    high = {p.x > high.x ? p.x : high.x, p.y > high.y ? p.y : high.y};
  }
  const double extent = larger(high.x - low.x, high.y - low.y);
  const double cells = static_cast<double>((1u << hilbert_bits) - 1);
  const double step = extent > 0.0 ? cells / extent : 0.0;
  TRY(in_parts(keys->context(), points.size(), [&](size_t p) {
    const uint32_t i = static_cast<uint32_t>(p);
    const Vec2 cell = step * (points[i] - low);
    const uint64_t place =
        hilbert_place(static_cast<uint32_t>(cell.x), static_cast<uint32_t>(cell.y), hilbert_bits);
    (*keys)[i] = {insertion_round(i, last_round) << (2 * hilbert_bits) | place, i};
  }));
  int bits = 2 * hilbert_bits;
  for (uint64_t round = last_round; round > 0; round >>= 1) ++bits;
  return sort_by_digits(keys, bits);
}

Status insertion_order(Span<const Vec2> points, Array<uint32_t>* order) {
  const size_t count = points.size();
  Array<OrderKey> keys(order->context());
  TRY(keys.resize(count));
  TRY(order->resize(count));
  if (count == 0) return {};
  // The first round should hold a few hundred points at most; more rounds would only lengthen
  // walks.
  uint64_t last_round = 0;
  int hilbert_bits = 6;
  for (size_t rest = count; rest > 256; rest >>= 2) {
    ++last_round;
    ++hilbert_bits;
  }
  TRY(sort_by_cells(points, hilbert_bits, last_round, &keys));
  if (longest_run(keys.span()) > k_crowd) {
    TRY(sort_by_cells(points, k_most_hilbert_bits, last_round, &keys));
  }
  return in_parts(order->context(), count, [&](size_t i) { (*order)[i] = keys[i].index; });
}

}  // namespace wireskin::planar
