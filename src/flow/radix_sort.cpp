#include "flow/radix_sort.h"

namespace wireskin::flow {

static constexpr int k_digit_bits = 11;
static constexpr uint32_t k_digit_values = 1u << k_digit_bits;

static uint32_t digit_at(const BitsKey& key, int shift) {
  return static_cast<uint32_t>(key.bits >> shift) & (k_digit_values - 1);
}

// One stable pass. False where all digits are equal, and nothing was done.
static bool sort_by_digit(Span<const BitsKey> from, int shift, Span<BitsKey> to) {
  uint32_t first[k_digit_values] = {};
  for (const BitsKey& key : from) ++first[digit_at(key, shift)];
  if (first[digit_at(from[0], shift)] == from.size()) return false;
  starts_from_counts({first, k_digit_values});
  for (const BitsKey& key : from) to[first[digit_at(key, shift)]++] = key;
  return true;
}

Status radix_sort(Context& context, Array<BitsKey>* keys) {
  if (keys->size() < 2) return {};
  Array<BitsKey> other(context);
  TRY(other.resize(keys->size()));
  for (int shift = 0; shift < 64; shift += k_digit_bits) {
    TRY(context.checkpoint());
    if (!sort_by_digit(keys->span(), shift, other.span())) continue;
    Array<BitsKey> kept = static_cast<Array<BitsKey>&&>(*keys);
    *keys = static_cast<Array<BitsKey>&&>(other);
    other = static_cast<Array<BitsKey>&&>(kept);
  }
  return {};
}

}  // namespace wireskin::flow
