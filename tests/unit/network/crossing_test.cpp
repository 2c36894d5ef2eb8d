#include "network/crossing.h"

#include <doctest/doctest.h>

#include <cmath>

#include "num/trig.h"
#include "support/strung_beads.h"

using namespace wireskin;
using namespace wireskin::network;
using namespace unit;

namespace {

struct Judged : StrungBeads {
  Array<Branch> scratch{heap.context};
  Array<Approach> approaches{heap.context};

  Contact contact(size_t k) {
    Contact result = Contact::meets, other = Contact::meets;
    must(judge_contact(beads, approaches[k], &scratch, &result));
    Approach swapped = approaches[k];
    std::swap(swapped.a, swapped.b);
    std::swap(swapped.at_a, swapped.at_b);
    must(judge_contact(beads, swapped, &scratch, &other));
    CHECK(result == other);
    return result;
  }
  // How many of the places within reach are meant to meet, or what else is asked for.
  uint32_t count(double reach, Contact kind = Contact::meets) {
    approaches.clear();
    if (beads.bead.empty()) string(0);
    must(find_approaches(wires, beads.curve.span(), reach, &approaches));
    uint32_t found = 0;
    for (size_t k = 0; k < approaches.size(); ++k) found += contact(k) == kind;
    return found;
  }
};

// Some rotation of space, so that no axis is special.
Vec3 turned(const Vec3& p) {
  const double c = 0.6, s = 0.8;
  const Vec3 q = {c * p.x - s * p.y, s * p.x + c * p.y, p.z};
  return {q.x, 0.28 * q.y - 0.96 * q.z, 0.96 * q.y + 0.28 * q.z};
}

std::vector<Vec3> turned(std::vector<Vec3> points) {
  for (Vec3& p : points) p = turned(p);
  return points;
}

std::vector<Vec3> circle(const Vec3& centre, double radius, uint32_t n) {
  std::vector<Vec3> points;
  for (uint32_t k = 0; k < n; ++k) {
    const double a = 2 * k_pi * (k + 0.3) / n;
    points.push_back(centre + radius * Vec3{std::cos(a), std::sin(a), 0});
  }
  return points;
}

}  // namespace

TEST_CASE("crossing: lines that pass over each other cross, unless they run along each other") {
  for (const double degrees : {90.0, 60.0, 30.0, 15.0, 8.0, 2.0}) {
    for (const uint32_t n : {1u, 2u, 17u}) {
      CAPTURE(degrees);
      CAPTURE(n);
      const double a = degrees * k_pi / 180.0;
      Judged net;
      net.add(turned(line({-1, 0, 0}, {1.1, 0, 0}, n)));
      net.add(turned(line({-std::cos(a), -std::sin(a), 0.04},
                          {1.1 * std::cos(a), 1.1 * std::sin(a), 0.04}, n)));
      CHECK(net.count(0.05) == (degrees > 10.0));
      CHECK(net.approaches.size() >= 1);
    }
  }
}

TEST_CASE("crossing: closed curves on a sphere cross each other wherever they do") {
  Judged net;
  std::vector<Vec3> equator = circle({0, 0, 0}, 1.0, 40), meridian;
  for (const Vec3& p : circle({0, 0, 0}, 1.02, 33)) meridian.push_back({p.x, 0, p.y});
  net.add(turned(equator), true);
  net.add(turned(meridian), true);
  CHECK(net.count(0.05) == 2);
}

TEST_CASE("crossing: a hole beside the border of its patch does not cross it, nor do parallels") {
  for (const uint32_t n : {5u, 6u, 8u, 24u}) {
    CAPTURE(n);
    Judged net;
    net.add(turned({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}), true);
    net.add(turned(circle({0.1, 0.05, 0}, 0.89, n)), true);
    net.add(turned(line({-1, 1.03, 0.01}, {1, 1.03, 0.01}, 9)), false);
    // Flat sides and round ones lie beside the border, corners may point to it.
    CHECK(net.count(0.3, Contact::beside) + net.count(0.3, Contact::points) >= 1);
    uint32_t beside = 0;
    for (size_t k = 0; k < net.approaches.size(); ++k) {
      // The ends of the parallel may meet what they like.
      if (net.beads.curve[net.approaches[k].b.edge] == 1) {
        CHECK(net.contact(k) != Contact::meets);
        ++beside;
      }
    }
    CHECK(beside >= 1);
  }
}

TEST_CASE("crossing: a corner crosses only where it passes to the other side") {
  for (const bool across : {false, true}) {
    Judged net;
    net.add(turned(line({-1, 0, 0}, {1, 0, 0}, 7)));
    const double far = across ? -0.5 : 0.5;
    net.add(turned({{-0.5, 0.5, 0.02}, {0.01, 0.02, 0.02}, {0.4, far, 0.02}}));
    CHECK(net.count(0.05, across ? Contact::meets : Contact::points) == 1);
    CHECK(net.approaches.size() == 1);
  }
}

TEST_CASE("crossing: what ends may meet whatever is near") {
  for (const Vec3& far : {Vec3{0.03, 1, 0}, Vec3{1, 0.3, 0}, Vec3{0.03, 0.02, 1}}) {
    Judged net;
    net.add(turned(line({-1, 0, 0}, {1, 0, 0}, 11)));
    net.add(turned(line({0.03, 0.02, 0}, far, 20)));
    CHECK(net.count(0.05) == 1);
  }
}

TEST_CASE("crossing: at a node all its curves are seen together") {
  // Four stretches that meet at the origin, or two on one side of it; another curve passes above.
  for (const bool all : {false, true}) {
    Judged net;
    net.add(turned(line({0, 0, 0}, {1, 0.5, 0}, 8)));
    net.add(turned(line({0, 0, 0}, {-1, 0.5, 0}, 8)));
    if (all) net.add(turned(line({0.5, -1, 0}, {0, 0, 0}, 8)));
    if (all) net.add(turned(line({0, 0, 0}, {-0.5, -1, 0}, 8)));
    net.add(turned(line({-1, -0.004, 0.02}, {1, 0.004, 0.02}, 15)));
    CHECK((net.count(0.025) > 0) == all);
    CHECK(net.approaches.size() >= 1);
    CHECK((net.count(0.025, Contact::points) > 0) == !all);
  }
}

TEST_CASE("crossing: noise of the curves does not turn side by side into crossing") {
  // Both wiggle by a tenth of the gap.
  Random random(5);
  const auto noise = [&] { return 0.003 * random(); };
  for (int round = 0; round < 50; ++round) {
    Judged net;
    std::vector<Vec3> a = line({-1, 0, 0}, {1, 0, 0}, 40), b = circle({0, 0.53, 0}, 0.5, 40);
    for (Vec3& p : a) p = p + Vec3{noise(), noise(), noise()};
    for (Vec3& p : b) p = p + Vec3{noise(), noise(), noise()};
    net.add(turned(a));
    net.add(turned(b), true);
    CHECK(net.count(0.05) == 0);
    CHECK(net.approaches.size() >= 1);
  }
}

TEST_CASE("crossing: two curves that meet in front of another one point to it") {
  Judged net;
  net.add(turned(line({0, 0.01, 0}, {1, 0.8, 0}, 8)));
  net.add(turned(line({-0.7, 0.6, 0.1}, {0, 0.01, 0}, 9)));
  net.add(turned(line({-1, 0, 0}, {1, 0, 0}, 15)));
  CHECK(net.count(0.03, Contact::points) >= 1);
  CHECK(net.count(0.03) == 0);
}

TEST_CASE(
    "crossing: a node on a curve that has crossed another one just before is not pointed to") {
  // The second and the third are one line, cut a little beyond the first.
  Judged net;
  net.add(turned(line({-1, 0, 0}, {1, 0, 0}, 15)));
  net.add(turned({{0.01, -1, 0}, {0.01, -0.5, 0}, {0.01, 0.01, 0.002}}));
  net.add(turned({{0.01, 0.01, 0.002}, {0.01, 0.5, 0}, {0.01, 1, 0}}));
  CHECK(net.count(0.03, Contact::points) == 0);
  CHECK(net.count(0.03, Contact::beside) >= 1);
}
