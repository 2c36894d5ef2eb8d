#include "network/size_limit.h"

#include <doctest/doctest.h>

#include <cmath>

#include "support/curve_nets.h"

using namespace wireskin;
using namespace wireskin::network;
using namespace unit;

// How many vertices a square of this area needs at least is known to a quarter.
static double spacing_for(double area, double vertices) {
  return std::sqrt(1.1547 * area / vertices);
}

static CurveNet disc(double radius) {
  CurveNet net;
  net.add_circle({}, radius, true);
  return net;
}

TEST_CASE("size limit: what fits is let through, what does not is named") {
  const double most = k_most_vertices;
  for (const double share : {0.01, 0.5, 0.95, 1.4, 10.0, 1e6}) {
    CAPTURE(share);
    Stages s(disc(3.0));
    const Status status =
        check_vertex_count(s.curves, s.network, spacing_for(9 * k_pi, share * most));
    CHECK((status.code == Code::too_large) == (share > 1.0));
    if (share > 1.0) CHECK(status.place.curve == 0);
    if (share > 1.0 && share < 1e6) CHECK(status.place.patch == 0);
  }
}

TEST_CASE("size limit: the curves alone may be too long") {
  Stages s(disc(1.0));
  const Status status =
      check_vertex_count(s.curves, s.network, 2 * k_pi / (1.01 * k_most_vertices));
  CHECK(status.code == Code::too_large);
  CHECK(status.place.curve == 0);
  CHECK(status.place.patch == k_none);
  // A long thin strip would have few vertices besides.
  CurveNet strip;
  strip.add_circle({}, 1.0, true);
  strip.add_circle({}, 1.0 - 1e-6, true);
  Stages t(strip);
  for (const double share : {0.9, 1.1}) {
    const double spacing = 2 * k_pi / (share * k_most_edges_of_segment);
    CHECK(check_vertex_count(t.curves, t.network, spacing).ok() == (share < 1.0));
  }
}

TEST_CASE("size limit: of several patches the largest is named") {
  CurveNet net = disc(1.0);
  net.add_circle({10, 0, 0}, 4.0, true);
  net.add_circle({20, 0, 0}, 2.0, true);
  Stages s(net);
  const Status status = check_vertex_count(s.curves, s.network, spacing_for(1.0, k_most_vertices));
  CHECK(status.code == Code::too_large);
  CHECK(status.place.curve == 1);
}

TEST_CASE("size limit: a ring needs no more than its own area") {
  CurveNet net = disc(1.0);
  net.add_circle({}, 0.9, true);
  for (const double share : {0.9, 2.0}) {
    Stages s(net);
    const Status status = check_vertex_count(
        s.curves, s.network, spacing_for(k_pi * (1 - 0.81), share * k_most_vertices));
    CHECK(status.ok() == (share < 1.0));
  }
}

namespace {

// Two circles of radius one, one above the other.
struct Band : Heap {
  Border border{context};

  Band(double height, uint32_t n) {
    for (int l = 0; l < 2; ++l) {
      must(border.start.push(l == 0 ? 0 : n));
      for (uint32_t k = 0; k < n; ++k) {
        const double a = (l == 0 ? 2 : -2) * k_pi * k / n;
        must(border.position.push({std::cos(a), std::sin(a), l * height}));
        must(border.normal.push({std::cos(a), std::sin(a), 0}));
        must(border.vertex.push(l * n + k));
      }
    }
    must(border.start.push(2 * n));
  }
};

}  // namespace

TEST_CASE("size limit: a band between two circles") {
  // Their vector areas cancel out, but not what joins them: half a disc, or the way across.
  for (const double height : {0.1, 0.5, 3.0}) {
    const Band band(height, 3000);
    const double least = std::fmin(std::sqrt(2.0) * k_pi * height, 0.5 * k_pi);
    for (const double share : {0.7, 1.6}) {
      CAPTURE(height);
      CAPTURE(share);
      const Status status =
          check_border_size(band.border, spacing_for(least, share * k_most_vertices));
      CHECK(status.ok() == (share < 1.0));
    }
    // No band has less: 2 pi h, or the two discs.
    const double area = height < 1.0 ? 2 * k_pi * height : 2 * k_pi;
    CHECK(check_border_size(band.border, spacing_for(area, 0.9 * k_most_vertices)).ok());
  }
  const Band crowded(1.0, k_longest_border_in_space / 2 + 1);
  CHECK(check_border_size(crowded.border, 1.0).code == Code::too_large);
}
