#include "flow/delaunay_order.h"

#include <cstring>

#include "base/in_parts.h"
#include "base/sort.h"
#include "flow/radix_sort.h"
#include "num/minmax.h"

namespace wireskin::flow {

static constexpr int k_place_bits = 20;

static uint64_t bits_of(double x) {
  const double positive_zero = x + 0.0;
  uint64_t bits = 0;
  std::memcpy(&bits, &positive_zero, sizeof bits);
  return bits;
}

// The mixing of S. Vigna's splitmix64 (2015).
static uint64_t mix(uint64_t z) {
  z += 0x9e3779b97f4a7c15ull;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
  return z ^ (z >> 31);
}

uint64_t hash_place(const Vec3& p, uint64_t seed) {
  return mix(mix(mix(mix(seed) ^ bits_of(p.x)) ^ bits_of(p.y)) ^ bits_of(p.z));
}

// The lowest 21 bits, each followed by two zeros.
static uint64_t spread_bits(uint64_t x) {
  x = (x | x << 32) & 0x1f00000000ffffull;
  x = (x | x << 16) & 0x1f0000ff0000ffull;
  x = (x | x << 8) & 0x100f00f00f00f00full;
  x = (x | x << 4) & 0x10c30c30c30c30c3ull;
  return (x | x << 2) & 0x1249249249249249ull;
}

// Where the curve through 2^20 cells a side passes the cell (x, y, z). Skilling turns the three
// coordinates in place into the digits of the result.
static uint64_t curve_place(uint32_t x, uint32_t y, uint32_t z) {
  uint32_t axis[3] = {x, y, z};
  constexpr uint32_t k_top = 1u << (k_place_bits - 1);
  for (uint32_t bit = k_top; bit > 1; bit >>= 1) {
    const uint32_t lower = bit - 1;
    for (uint32_t& a : axis) {
      // Where the bit is set, turn axis 0 over; else exchange it with this one. Without branches,
      // for the bits are as good as random.
      const uint32_t set = (a & bit) != 0 ? ~0u : 0u;
      const uint32_t exchange = (axis[0] ^ a) & lower & ~set;
      axis[0] ^= exchange | (lower & set);
      a ^= exchange;
    }
  }
  axis[1] ^= axis[0];
  axis[2] ^= axis[1];
  uint32_t parity = 0;
  for (uint32_t bit = k_top; bit > 1; bit >>= 1) {
    parity ^= (axis[2] & bit) != 0 ? bit - 1 : 0;
  }
  for (uint32_t& a : axis) a ^= parity;
  return spread_bits(axis[0]) << 2 | spread_bits(axis[1]) << 1 | spread_bits(axis[2]);
}

// Seven eighths of the points belong to the last round, seven eighths of the rest to the one
// before, and so on, by lot drawn from the place.
static uint64_t place_round(const Vec3& p, uint64_t last_round) {
  uint64_t lot = hash_place(p, 0);
  uint64_t round = last_round;
  for (; round > 0 && (lot & 7) == 0; lot >>= 3) --round;
  return round;
}

// The round, then the place along the curve.
static Status set_place_keys(Context& context, Span<const Vec3> points, Span<BitsKey> keys) {
  Vec3 low = points[0];
  Vec3 high = points[0];
  for (const Vec3& p : points) {
    low = {smaller(low.x, p.x), smaller(low.y, p.y), smaller(low.z, p.z)};
    high = {larger(high.x, p.x), larger(high.y, p.y), larger(high.z, p.z)};
  }
  const double extent = larger(high.x - low.x, larger(high.y - low.y, high.z - low.z));
  constexpr double k_cells = (1u << k_place_bits) - 1;
  const double step = extent > 0.0 ? k_cells / extent : 0.0;
  uint64_t last_round = 0;
  for (size_t rest = points.size(); rest > 512; rest >>= 3) ++last_round;
  return in_parts(context, points.size(), [&](size_t i) {
    const Vec3 cell = step * (points[i] - low);
    const uint64_t place = curve_place(static_cast<uint32_t>(cell.x), static_cast<uint32_t>(cell.y),
                                       static_cast<uint32_t>(cell.z));
    keys[i] = {place_round(points[i], last_round) << (3 * k_place_bits) | place,
               static_cast<uint32_t>(i)};
  });
}

static bool place_before(const Vec3& p, const Vec3& q) {
  if (p.x != q.x) return p.x < q.x;
  if (p.y != q.y) return p.y < q.y;
  return p.z < q.z;
}

// Points of one cell by their coordinates.
static void sort_cells(Span<const Vec3> points, Span<BitsKey> keys) {
  const auto before = [points](const BitsKey& a, const BitsKey& b) {
    const Vec3& p = points[a.index];
    const Vec3& q = points[b.index];
    return p == q ? a.index < b.index : place_before(p, q);
  };
  size_t first = 0;
  for (size_t i = 1; i <= keys.size(); ++i) {
    if (i < keys.size() && keys[i].bits == keys[first].bits) continue;
    if (i - first > 1) sort(keys.part(first, i - first), before);
    first = i;
  }
}

Status delaunay_order(Context& context, Span<const Vec3> points, Array<uint32_t>* order,
                      Array<uint32_t>* same_as) {
  Array<BitsKey> keys(context);
  TRY(keys.resize(points.size()));
  TRY(order->reserve(points.size()));
  TRY(same_as->resize(points.size()));
  order->clear();
  if (points.empty()) return {};
  TRY(set_place_keys(context, points, keys.span()));
  TRY(radix_sort(context, &keys));
  sort_cells(points, keys.span());
  for (const BitsKey& key : keys) {
    // Points at the same place have the same key, so they stand together.
    const bool seen = !order->empty() && points[order->back()] == points[key.index];
    if (!seen) order->push_reserved(key.index);
    (*same_as)[key.index] = order->back();
  }
  return {};
}

}  // namespace wireskin::flow
