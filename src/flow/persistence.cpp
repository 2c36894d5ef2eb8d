#include "flow/persistence.h"

#include <cstring>

#include "base/in_parts.h"
#include "base/sort_in_parts.h"
#include "flow/radix_sort.h"
#include "num/minmax.h"

namespace wireskin::flow {

static constexpr double k_least_ratio = 1.0 + 1e-6;
static constexpr double k_flat_share = 0.98;  // of the squared radius: one in a hundred of it

// Components of the complement of the balls as the radius shrinks: union-find over the tetrahedra
// and, as the last node, the outside. Each root knows the maximum of its component.
struct VoidForest {
  explicit VoidForest(Context& context) : parent(context), maximum(context) {}

  Array<uint32_t> parent;
  Array<uint32_t> maximum;

  uint32_t root_of(uint32_t node) {
    while (parent[node] != node) {
      parent[node] = parent[parent[node]];
      node = parent[node];
    }
    return node;
  }
};

static bool lower_maximum(const Complex& complex, uint32_t a, uint32_t b) {
  const uint32_t outside = complex.tet_count();
  if (a == outside || b == outside) return b == outside && a != outside;
  const double fa = complex.tet_value[a];
  const double fb = complex.tet_value[b];
  return fa != fb ? fa < fb : a < b;
}

// Values are not negative, so the order of their bits is theirs; turned over, the greatest is
// first.
static uint64_t descending_bits(double value) {
  uint64_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  return ~bits;
}

static bool is_in_turn(Pass pass, Pass now) {
  return pass == now || (pass == Pass::flat && now == Pass::by_radius) ||
         (pass == Pass::hole && now == Pass::first);
}

// By their turn, then decreasing value, then number.
static Status sort_triangles(Context& context, const Complex& complex, Span<const Pass> turn,
                             Array<BitsKey>* keys, Array<uint32_t>* order) {
  const uint32_t count = complex.triangle_count();
  TRY(keys->resize(count));
  TRY(in_parts(context, count, [&](size_t i) {
    const uint32_t t = count - 1 - static_cast<uint32_t>(i);
    const bool flat = !turn.empty() && turn[t] == Pass::flat;
    const double value = complex.triangle_value[t];
    (*keys)[i] = {descending_bits(flat ? k_flat_share * value : value), t};
  }));
  TRY(radix_sort(context, keys));
  TRY(order->reserve(count));
  constexpr Pass k_turns[4] = {Pass::first, Pass::by_radius, Pass::late, Pass::last};
  for (const Pass now : k_turns) {
    if (turn.empty() && now != Pass::by_radius) continue;
    TRY(in_parts(context, count, [&](size_t i) {
      const uint32_t t = (*keys)[i].index;
      if (turn.empty() || is_in_turn(turn[t], now)) order->push_reserved(t);
    }));
  }
  return {};
}

static Void describe_void(const Complex& complex, uint32_t creator, uint32_t maximum) {
  const double cap = 0.375 * complex.diagonal * complex.diagonal;
  const double f = complex.triangle_value[creator];
  const double filling = smaller(complex.tet_value[maximum], cap);
  const double capped = smaller(f, cap);
  const double ratio = capped > 0.0 ? std::sqrt(filling / capped) : 1.0;
  return {creator, maximum, std::sqrt(f), std::sqrt(filling), ratio, false};
}

static Status list_voids(const Complex& complex, Span<const uint32_t> maximum_of,
                         Span<const Pass> turn, Persistence* persistence) {
  Array<Void>& voids = persistence->voids;
  Pace pace(voids.context());
  voids.clear();
  for (uint32_t t = 0; t < complex.triangle_count(); ++t) {
    TRY(pace.after());
    if (maximum_of[t] == k_none) continue;
    Void one = describe_void(complex, t, maximum_of[t]);
    one.held = !turn.empty() && turn[t] == Pass::last;
    if (one.held || one.ratio > k_least_ratio) TRY(voids.push(one));
  }
  const auto before = [](const Void& a, const Void& b) {
    if (a.held != b.held) return a.held;
    return a.ratio != b.ratio ? a.ratio > b.ratio : a.creator < b.creator;
  };
  TRY(sort_in_parts(voids.context(), voids.span(), before));
  TRY(persistence->void_of.assign(complex.triangle_count(), k_none));
  for (uint32_t i = 0; i < voids.size(); ++i) persistence->void_of[voids[i].creator] = i;
  return {};
}

Status find_persistence(Context& context, const Complex& complex, Persistence* persistence,
                        Span<const Pass> turn) {
  Pace pace(context);
  const uint32_t outside = complex.tet_count();
  Array<BitsKey> keys(context);
  Array<uint32_t> order(context), maximum_of(context);
  VoidForest voids(context);
  TRY(sort_triangles(context, complex, turn, &keys, &order));
  TRY(maximum_of.assign(complex.triangle_count(), k_none));
  TRY(persistence->creator.assign(complex.triangle_count(), 0));
  TRY(voids.parent.resize(outside + 1));
  TRY(voids.maximum.resize(outside + 1));
  for (uint32_t node = 0; node <= outside; ++node) voids.parent[node] = voids.maximum[node] = node;
  for (size_t i = 0; i < order.size(); ++i) {
    TRY(pace.after());
    const uint32_t t = order[i];
    uint32_t low = voids.root_of(complex.side_of(t, 0));
    uint32_t high = voids.root_of(complex.side_of(t, 1));
    const bool hole = !turn.empty() && turn[t] == Pass::hole;
    if (hole) persistence->creator[t] = 1;
    if (low == high) continue;
    if (lower_maximum(complex, voids.maximum[high], voids.maximum[low])) swap_values(low, high);
    persistence->creator[t] = 1;
    if (!hole) maximum_of[t] = voids.maximum[low];
    voids.parent[low] = high;
  }
  return list_voids(complex, maximum_of.span(), turn, persistence);
}

}  // namespace wireskin::flow
