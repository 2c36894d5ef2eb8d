#include "network/ring_bands.h"

#include "base/sort.h"
#include "num/minmax.h"

namespace wireskin::network {

// No turn and no twist counts for less than this one: a band that turns back is long, not endless.
static constexpr double k_sharpest = 0.1;
// What is so many times as long as its chords is no band: a rim that bends straight back is four
// times as long.
static constexpr double k_most_bent = 16.0;
// First looks take every fourth place.
static constexpr uint32_t k_coarse = 4;
// A side gives up after so many looks at others that gave no band, or none better than those kept.
static constexpr uint32_t k_most_in_vain = 64;

namespace {

// Another side that may be looked at, and the least cost that the band to it can have.
struct RingRival {
  double least;
  uint32_t side;
};

}  // namespace

static bool comes_later(const RingRival& x, const RingRival& y) {
  return x.least != y.least ? x.least > y.least : x.side > y.side;
}

Status add_ring_side(const Border& border, const RingSide& side, RingBands* bands) {
  const uint32_t n = border.size(), own = static_cast<uint32_t>(bands->side.size());
  RingSide added = side;
  added.length = border_length(border);
  for (uint32_t k = 0; k < k_ring_places; ++k) {
    const uint32_t at = static_cast<uint32_t>(uint64_t{k} * n / k_ring_places);
    const uint32_t i = side.reversed ? n - 1 - at : at;
    const Vec3 along =
        border.position[next_on_border(border, 0, i)] - border.position[i > 0 ? i - 1 : n - 1];
    const Vec3 conormal = unit(cross(border.normal[i], along));
    added.centre += (1.0 / k_ring_places) * border.position[i];
    TRY(bands->place.push(
        {border.position[i], side.reversed ? -conormal : conormal, border.normal[i], own}));
  }
  return bands->side.push(added);
}

static double bent_way(const SightTurn& t) {
  const double least = larger(1.0 + t.out, k_sharpest) * larger(1.0 + t.back, k_sharpest) *
                       larger(1.0 + t.twist, k_sharpest);
  return t.chord * 8.0 / least;
}

// Places of two sides hardly ever stand right across from each other: as much of the way along the
// first as that may be does not count.
static SightPlace moved_across(const SightPlace& p, SightPlace q, double half_step) {
  const Vec3 along = cross(p.conormal, p.normal);
  const double off = dot(q.position - p.position, along);
  q.position -= (off > half_step ? half_step : off < -half_step ? -half_step : off) * along;
  return q;
}

// The second side runs against the first: with the surface between them both have it on the left.
static RingBand band_of_places(const RingBands& bands, uint32_t a, uint32_t b, uint32_t step) {
  const uint32_t count = k_ring_places / step;
  const double half_step = 0.5 / count * bands.side[b].length;
  double sum[k_ring_places] = {}, chord[k_ring_places] = {}, out[k_ring_places] = {},
         back[k_ring_places] = {}, twist[k_ring_places] = {};
  for (uint32_t i = 0; i < count; ++i) {
    for (uint32_t j = 0; j < count; ++j) {
      const SightPlace& from = bands.place[a * k_ring_places + i * step];
      const SightPlace& to = bands.place[b * k_ring_places + j * step];
      const SightTurn t = turn_between(from, moved_across(from, to, half_step));
      const uint32_t shift = (i + j) % count;
      sum[shift] += bent_way(t);
      chord[shift] += t.chord;
      out[shift] += t.out;
      back[shift] += t.back;
      twist[shift] += t.twist;
    }
  }
  uint32_t best = 0;
  for (uint32_t k = 1; k < count; ++k) {
    if (sum[k] < sum[best]) best = k;
  }
  const double width = 0.5 * (bands.side[a].length + bands.side[b].length);
  const double cosine = smaller(smaller(out[best], back[best]), twist[best]) / count;
  const double area = sum[best] / count * width;
  if (sum[best] > k_most_bent * chord[best]) return {a < b ? a : b, a < b ? b : a, DBL_MAX, cosine};
  return {a < b ? a : b, a < b ? b : a, area / band_weight(cosine), cosine};
}

RingBand band_between(const RingBands& bands, uint32_t a, uint32_t b) {
  return band_of_places(bands, a < b ? a : b, a < b ? b : a, 1);
}

// Keeps the least of the bands seen so far, the least first.
static void keep_band(const RingBand& band, RingBand* kept, uint32_t* count) {
  uint32_t at = *count < k_ring_choices ? (*count)++ : k_ring_choices - 1;
  for (; at > 0 && band.cost < kept[at - 1].cost; --at) kept[at] = kept[at - 1];
  kept[at] = band;
}

// The sides of all other curves as a heap, the first one that whose band may be the least: no band
// has less area than the distance of the centres times its mean length.
static void heap_rivals(const RingBands& bands, uint32_t a, Array<RingRival>* heap) {
  const RingSide& own = bands.side[a];
  heap->clear();
  for (uint32_t b = 0; b < bands.side.size(); ++b) {
    const RingSide& other = bands.side[b];
    if (other.component == own.component) continue;
    const double width = 0.5 * (own.length + other.length);
    heap->push_reserved({length(other.centre - own.centre) * width / band_weight(1.0), b});
  }
  for (size_t i = heap->size() / 2; i-- > 0;) {
    sift_down(heap->data(), i, heap->size(), comes_later);
  }
}

static uint32_t nearest_bands(const RingBands& bands, uint32_t a, Array<RingRival>* heap,
                              RingBand* kept) {
  uint32_t count = 0, in_vain = 0;
  heap_rivals(bands, a, heap);
  while (!heap->empty() && in_vain < k_most_in_vain) {
    const RingRival rival = (*heap)[0];
    if (count == k_ring_choices && !(rival.least < kept[count - 1].cost)) break;
    (*heap)[0] = heap->back();
    heap->pop();
    if (!heap->empty()) sift_down(heap->data(), 0, heap->size(), comes_later);
    const uint32_t b = rival.side;
    const RingBand band = band_of_places(bands, a < b ? a : b, a < b ? b : a, k_coarse);
    const bool better = count < k_ring_choices || band.cost < kept[count - 1].cost;
    if (band.cost < DBL_MAX && better) {
      keep_band(band, kept, &count);
    } else {
      ++in_vain;
    }
  }
  return count;
}

Status list_ring_bands(RingBands* bands) {
  RingBand kept[k_ring_choices];
  Array<RingRival> heap(bands->band.context());
  TRY(heap.reserve(bands->side.size()));
  for (uint32_t a = 0; a < bands->side.size(); ++a) {
    const uint32_t count = nearest_bands(*bands, a, &heap, kept);
    for (uint32_t k = 0; k < count; ++k) {
      const RingBand band = band_between(*bands, kept[k].a, kept[k].b);
      if (band.cost < DBL_MAX) TRY(bands->band.push(band));
    }
    TRY(bands->band.context().checkpoint());
  }
  sort(bands->band.span(), [](const RingBand& x, const RingBand& y) {
    if (x.cost != y.cost) return x.cost < y.cost;
    return x.a != y.a ? x.a < y.a : x.b < y.b;
  });
  uint32_t left = 0;  // two sides may both have listed the band between them: its bits are the same
  for (uint32_t i = 0; i < bands->band.size(); ++i) {
    const RingBand& band = bands->band[i];
    const RingBand* last = left > 0 ? &bands->band[left - 1] : nullptr;
    if (last != nullptr && last->a == band.a && last->b == band.b) continue;
    bands->band[left++] = band;
  }
  bands->band.shrink(left);
  return {};
}

}  // namespace wireskin::network
