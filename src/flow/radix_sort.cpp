#include "flow/radix_sort.h"

#include "base/in_parts.h"

namespace wireskin::flow {

static constexpr int k_digit_bits = 11;
static constexpr uint32_t k_digit_values = 1u << k_digit_bits;

static uint32_t digit_at(const BitsKey& key, int shift) {
  return static_cast<uint32_t>(key.bits >> shift) & (k_digit_values - 1);
}

// One stable pass. Where all digits are equal nothing is done, and *moved is false.
static Status sort_by_digit(Context& context, Span<const BitsKey> from, int shift, Span<BitsKey> to,
                            bool* moved) {
  uint32_t first[k_digit_values] = {};
  TRY(in_parts(context, from.size(), [&](size_t i) { ++first[digit_at(from[i], shift)]; }));
  *moved = first[digit_at(from[0], shift)] != from.size();
  if (!*moved) return {};
  starts_from_counts({first, k_digit_values});
  return in_parts(context, from.size(),
                  [&](size_t i) { to[first[digit_at(from[i], shift)]++] = from[i]; });
}

Status radix_sort(Context& context, Array<BitsKey>* keys) {
  if (keys->size() < 2) return {};
  Array<BitsKey> other(context);
  TRY(other.resize(keys->size()));
  for (int shift = 0; shift < 64; shift += k_digit_bits) {
    TRY(context.checkpoint());
    bool moved = false;
    TRY(sort_by_digit(context, keys->span(), shift, other.span(), &moved));
    if (!moved) continue;
    Array<BitsKey> kept = static_cast<Array<BitsKey>&&>(*keys);
    *keys = static_cast<Array<BitsKey>&&>(other);
    other = static_cast<Array<BitsKey>&&>(kept);
  }
  return {};
}

}  // namespace wireskin::flow
