#include "network/bend.h"

#include <doctest/doctest.h>

#include <cmath>

#include "support/context.h"

using namespace wireskin;
using namespace wireskin::network;
using namespace unit;

struct Bent {
  std::vector<double> arc;
  std::vector<uint8_t> pinned;
  std::vector<Vec3> shift;

  explicit Bent(size_t n, double step) : pinned(n, 0), shift(n) {
    for (size_t i = 0; i < n; ++i) arc.push_back(step * static_cast<double>(i));
  }
  void pin(size_t i, Vec3 by) {
    pinned[i] = 1;
    shift[i] = by;
  }
  void run(bool closed) {
    const double whole = arc.back() + (closed ? arc[1] : 0.0);
    Heap heap;
    Pace pace(heap.context);
    must(bend_curve({view(arc), whole, closed, view(pinned), unit::span(shift)}, &pace));
  }
  // The greatest change of direction that the displacement makes of a straight line, in radians.
  double steepest() const {
    double steepest = 0.0;
    for (size_t i = 1; i < arc.size(); ++i) {
      steepest = std::fmax(steepest, length(shift[i] - shift[i - 1]) / (arc[i] - arc[i - 1]));
    }
    return steepest;
  }
};

TEST_CASE("one pin in the middle: smooth, local, symmetric") {
  Bent bent(401, 0.01);
  bent.pin(200, {0, 0.05, 0});
  bent.run(false);
  CHECK(bent.shift[200] == Vec3{0, 0.05, 0});
  CHECK(bent.shift[200 + 80] == Vec3{});  // 16 times 0.05 away
  CHECK(bent.shift[200 + 79] != Vec3{});
  CHECK(bent.shift[0] == Vec3{});
  for (size_t k = 0; k < 100; ++k) {
    CHECK(bent.shift[200 + k].y == doctest::Approx(bent.shift[200 - k].y));
    CHECK(bent.shift[200 + k].y >= bent.shift[201 + k].y);
  }
  CHECK(bent.steepest() < 0.12);                                   // 7 degrees
  CHECK(std::fabs(bent.shift[201].y - bent.shift[200].y) < 1e-5);  // flat at the pin: no kink
}

TEST_CASE("pins hold each other's bends off, open and closed") {
  for (const bool closed : {false, true}) {
    Bent bent(100, 0.01);
    bent.pin(10, {0.1, 0, 0});
    bent.pin(30, {0, 0, 0});
    bent.pin(60, {0, -0.1, 0});
    bent.run(closed);
    CHECK(bent.shift[10] == Vec3{0.1, 0, 0});
    CHECK(bent.shift[30] == Vec3{});
    CHECK(bent.shift[60] == Vec3{0, -0.1, 0});
    for (size_t i = 31; i < 60; ++i) CHECK(bent.shift[i].x == 0.0);
    for (size_t i = 11; i < 30; ++i) CHECK(bent.shift[i].y == 0.0);
    CHECK((bent.shift[99].x != 0.0) == closed);
  }
}

TEST_CASE("pins that do not move leave every bit") {
  Bent bent(50, 0.1);
  bent.pin(0, {});
  bent.pin(25, {});
  bent.run(true);
  for (const Vec3& s : bent.shift) CHECK(s == Vec3{});
}
