#include "network/ring_pairs.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "support/ribbon.h"

using namespace unit;
using namespace wireskin::network;

namespace {

struct Scene {
  Heap heap;
  RingBands bands{heap.context};
  Array<uint32_t> partner{heap.context};
  Array<uint8_t> doubtful{heap.context};

  // A side by itself, which costs `alone` to close.
  void add(double radius, double z, bool counter_clockwise, double tilt, double alone) {
    RibbonBorder one;
    one.add_circle(radius, z, counter_clockwise, tilt);
    RingSide side;
    side.patch = side.component = static_cast<uint32_t>(bands.side.size());
    side.lid = side.alone = alone;
    must(add_ring_side(one.border, side, &bands));
  }
  void pair() { must(pair_sides(&bands, &partner, &doubtful)); }
};

// The least sum of costs over all ways to pair the sides from `first` on.
double least_cost(const std::vector<std::vector<double>>& band, const std::vector<double>& alone,
                  std::vector<bool>& taken) {
  const size_t first =
      static_cast<size_t>(std::find(taken.begin(), taken.end(), false) - taken.begin());
  if (first == taken.size()) return 0.0;
  taken[first] = true;
  double least = alone[first] + least_cost(band, alone, taken);
  for (size_t b = first + 1; b < taken.size(); ++b) {
    if (taken[b] || !(band[first][b] < DBL_MAX)) continue;
    taken[b] = true;
    least = std::min(least, band[first][b] + least_cost(band, alone, taken));
    taken[b] = false;
  }
  taken[first] = false;
  return least;
}

}  // namespace

TEST_CASE("pairs: as little as any way to pair the sides, or nearly") {
  std::mt19937 random(9);
  const auto uniform = [&random] { return random() / 4294967296.0; };
  int least_found = 0;
  constexpr int k_scenes = 60;
  for (int k = 0; k < k_scenes; ++k) {
    Scene s;
    constexpr uint32_t n = 8;
    for (uint32_t i = 0; i < n; ++i) {
      // Ends of tubes that look up or down: every two of them see each other, or neither does.
      s.add(0.8 + 0.4 * uniform(), 6.0 * uniform(), i % 2 == 0, k_pi / 2, 20.0);
    }
    std::vector<std::vector<double>> band(n, std::vector<double>(n, DBL_MAX));
    for (uint32_t a = 0; a < n; ++a) {
      for (uint32_t b = 0; b < n; ++b) {
        if (a == b) continue;
        const RingBand between = band_between(s.bands, a, b);
        if (between.cosine >= 0.02) band[a][b] = between.cost;
      }
    }
    s.pair();
    double found = 0.0;
    for (uint32_t a = 0; a < n; ++a) {
      const uint32_t b = s.partner[a];
      if (b != k_none) CHECK(s.partner[b] == a);
      found += b == k_none ? 20.0 : 0.5 * band_between(s.bands, a, b).cost;
    }
    std::vector<bool> taken(n, false);
    const double least = least_cost(band, std::vector<double>(n, 20.0), taken);
    CHECK(found <= 1.5 * least);
    least_found += found <= 1.0001 * least;
  }
  CHECK(least_found >= k_scenes * 3 / 4);
}

TEST_CASE("pairs: a choice that is as good as another one is doubtful") {
  for (double offset : {0.0, 1.0}) {
    Scene s;  // one end between two others
    s.add(1.0, 0.0, true, k_pi / 2, 30.0);
    s.add(1.0, 2.0, false, k_pi / 2, 30.0);
    s.add(1.0, 2.0 + offset, false, k_pi / 2, 0.1);
    s.pair();
    CHECK(s.partner[0] == 1);
    CHECK(s.partner[2] == k_none);
  }
  Scene lids;  // a band with as much area as the two lids
  lids.add(1.0, 0.0, true, k_pi / 2, 2 * k_pi);
  lids.add(1.0, 2.0, false, k_pi / 2, 2 * k_pi);
  lids.pair();
  CHECK(lids.partner[0] == 1);
  CHECK(lids.doubtful[0] == 1);
  Scene tube;
  tube.add(1.0, 0.0, true, k_pi / 2, 8 * k_pi);
  tube.add(1.0, 2.0, false, k_pi / 2, 8 * k_pi);
  tube.pair();
  CHECK(tube.partner[0] == 1);
  CHECK(tube.doubtful[0] == 0);
}

TEST_CASE("pairs: many bands have checkpoints between them") {
  Scene s;
  constexpr uint32_t n = 400;
  for (uint32_t i = 0; i < n; ++i) s.add(1.0, 0.5 * i, i % 2 == 0, k_pi / 2, 20.0);
  must(list_ring_bands(&s.bands));
  const size_t listing = s.heap.checkpoints, bands = s.bands.band.size();
  REQUIRE(bands > 1024);
  s.bands.band.clear();
  s.heap.checkpoints = 0;
  s.pair();
  // Two passes to list the bands of sides, two to pair, at least two rounds, one for doubts.
  CHECK(s.heap.checkpoints >= listing + 7 * (bands / 1024) + 2);
}
