#include "network/linking.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <random>

#include "support/ribbon.h"

using namespace unit;
using namespace wireskin::network;

namespace {

struct Ribbon : RibbonBorder {
  int number() {
    int32_t found = 99;
    must(linking_number(border, &found));
    return found;
  }
};

// A circle whose normals turn `turns` times about it.
int twisted_circle(int turns, uint32_t n) {
  Ribbon r;
  r.add(n, [=](double t) {
    const Vec3 out = {std::cos(t), std::sin(t), 0};
    return std::make_pair(out,
                          std::cos(turns * t) * out + std::sin(turns * t) * Vec3{0.0, 0.0, 1.0});
  });
  return r.number();
}

}  // namespace

TEST_CASE("circles whose normals turn about them link their copy as often") {
  for (int turns : {-3, -1, 0, 1, 2}) {
    CAPTURE(turns);
    for (uint32_t n : {24u, 61u, 400u})
      CHECK(std::abs(twisted_circle(turns, n)) == std::abs(turns));
  }
  CHECK(twisted_circle(1, 50) == -twisted_circle(-1, 50));
}

TEST_CASE("the border of a Moebius band and knots are refused, bands and discs are not") {
  Ribbon moebius;
  moebius.add(200, [](double t) {
    const double a = 2 * t, w = 0.4, c = std::cos(t), s = std::sin(t);
    const Vec3 out = {std::cos(a), std::sin(a), 0}, up = {0, 0, 1};
    const Vec3 across = c * out + s * up;
    return std::make_pair(out + w * across, s * out - c * up);
  });
  CHECK(std::abs(moebius.number()) == 2);

  Ribbon trefoil;
  trefoil.add(160, [](double t) {
    return std::make_pair(Vec3{std::sin(t) + 2 * std::sin(2 * t), std::cos(t) - 2 * std::cos(2 * t),
                               -std::sin(3 * t)},
                          Vec3{0, 0, 1});
  });
  CHECK(std::abs(trefoil.number()) == 3);

  for (double twist : {0.0, 0.5, 2.0}) {  // a tube whose ends have other starts
    Ribbon tube;
    for (int end : {1, -1}) {
      tube.add(60, [=](double t) {
        const double a = end * t + end * twist;
        const Vec3 out = {std::cos(a), std::sin(a), 0};
        return std::make_pair(out + Vec3{0, 0, 1.0 * end}, out);
      });
    }
    CHECK(tube.number() == 0);
  }

  Ribbon sphere;  // no mirror takes this curve to itself
  sphere.add(150, [](double t) {
    const double up = 0.6 * std::sin(2 * t) + 0.4 * std::sin(3 * t + 0.5);
    const double round = t + 0.5 * std::sin(2 * t + 1);
    const Vec3 p = {std::cos(up) * std::cos(round), std::cos(up) * std::sin(round), std::sin(up)};
    return std::make_pair(p, p);
  });
  CHECK(sphere.number() == 0);

  Ribbon saddle;  // normals of z = x^2 - y^2
  saddle.add(90, [](double t) {
    const double x = std::cos(t), y = std::sin(t);
    return std::make_pair(Vec3{x, y, x * x - y * y}, Vec3{-2 * x, 2 * y, 1});
  });
  CHECK(saddle.number() == 0);
}

TEST_CASE("where normals are not known the number is not defined") {
  Ribbon r;
  r.add(40, [](double t) {
    const Vec3 out = {std::cos(t), std::sin(t), 0};
    return std::make_pair(
        out, t > 3.0 && t < 3.3 ? Vec3{} : std::cos(t) * out + Vec3{0, 0, std::sin(t)});
  });
  CHECK(r.number() == 0);
}

// The definition itself: how often a border and its copy, pushed a little along the normals, go
// round each other, by Gauss's integral.
static double linked_with_copy(const Border& border, double push) {
  double sum = 0.0;
  const auto copy = [&](uint32_t i) { return border.position[i] + push * border.normal[i]; };
  for (uint32_t l = 0; l < border.loops(); ++l) {
    for (uint32_t i = border.start[l]; i < border.start[l + 1]; ++i) {
      const Vec3 &a = border.position[i], &b = border.position[next_on_border(border, l, i)];
      for (uint32_t m = 0; m < border.loops(); ++m) {
        for (uint32_t j = border.start[m]; j < border.start[m + 1]; ++j) {
          const Vec3 c = copy(j), d = copy(next_on_border(border, m, j));
          const auto solid = [](const Vec3& x, const Vec3& y, const Vec3& z) {
            const double p = length(x), q = length(y), r = length(z);
            return 2.0 * std::atan2(dot(x, cross(y, z)),
                                    p * q * r + dot(x, y) * r + dot(y, z) * p + dot(z, x) * q);
          };
          // Two edges are never seen to cross from more than a half of all directions.
          sum += std::remainder(solid(c - a, d - a, d - b) + solid(c - a, d - b, c - b), 4 * k_pi);
        }
      }
    }
  }
  return sum / (4 * k_pi);
}

// From each edge and normal to the next one.
static bool turns_little(const Border& border) {
  bool little = true;
  for (uint32_t l = 0; l < border.loops(); ++l) {
    for (uint32_t i = border.start[l]; i < border.start[l + 1]; ++i) {
      const uint32_t j = next_on_border(border, l, i), k = next_on_border(border, l, j);
      const Vec3 a = wireskin::unit(border.position[j] - border.position[i]);
      const Vec3 b = wireskin::unit(border.position[k] - border.position[j]);
      little = little && dot(a, b) > 0.9 && dot(border.normal[i], border.normal[j]) > 0.9;
    }
  }
  return little;
}

TEST_CASE("the number is that of the border and its copy pushed along the normals") {
  std::mt19937 random(7);
  const auto uniform = [&random] { return 2.0 * random() / 4294967296.0 - 1.0; };
  int others = 0;
  for (int k = 0; k < 80; ++k) {
    Ribbon r;
    for (int loop = 0; loop < 1 + k % 3; ++loop) {
      // Round a circle, knotted on the way, with normals that turn about the curve.
      double c[12];
      for (double& x : c) x = uniform();
      const int turns = static_cast<int>(3.0 * uniform());
      const auto at = [&c](double t) {
        return Vec3{2 * std::cos(2 * t) + c[0] * std::cos(3 * t) + c[1] * std::sin(t) + 0.3 * c[9],
                    2 * std::sin(2 * t) + c[2] * std::cos(t) + c[3] * std::sin(3 * t),
                    c[4] * std::cos(3 * t) + c[5] * std::sin(t) + c[6] * std::cos(5 * t)};
      };
      r.add(240, [&](double t) {
        const Vec3 tangent = wireskin::unit(at(t + 1e-4) - at(t - 1e-4));
        const Vec3 u = wireskin::unit(wireskin::reject({c[7], c[8], 2.0}, tangent));
        return std::make_pair(
            at(t), std::cos(turns * t) * u + std::sin(turns * t) * wireskin::cross(tangent, u));
      });
    }
    if (!turns_little(r.border)) continue;  // then the copy would have to be nearer still
    const double truth = linked_with_copy(r.border, 1e-5);
    if (std::fabs(truth - std::round(truth)) > 0.05) continue;  // loops that nearly touch
    ++others;
    CHECK(std::abs(r.number()) == std::abs(static_cast<int>(std::round(truth))));
    CHECK(r.number() == -static_cast<int>(std::round(truth)));
  }
  CHECK(others > 30);
}

TEST_CASE("a border of many edges: few pairs where it is wide, checkpoints where all meet") {
  constexpr uint32_t n = 1u << 15;
  Ribbon band;
  for (int end : {1, -1}) {
    band.add(n, [=](double t) {
      const Vec3 out = {std::cos(end * t), std::sin(end * t), 0};
      return std::make_pair(out + Vec3{0, 0, 0.1 * end}, out);
    });
  }
  CHECK(band.number() == 0);
  CHECK(band.heap.checkpoints <= 4);  // each counted 2^18 pairs; all would be 2^31
  Ribbon turning;
  turning.add(n, [](double t) {
    const Vec3 out = {std::cos(t), std::sin(t), 0};
    return std::make_pair(out, std::cos(3 * t) * out + std::sin(3 * t) * Vec3{0, 0, 1});
  });
  CHECK(std::abs(turning.number()) == 3);
  CHECK(turning.heap.checkpoints <= 4);
  Ribbon stack;  // of squares: in every view most edges meet most others along its axis
  constexpr uint32_t k_squares = 1000;
  for (uint32_t k = 0; k < k_squares; ++k) {
    stack.add(4, [=](double t) {
      const Vec3 p = {std::cos(t), std::sin(t), 1e-4 * k};
      return std::make_pair(p, Vec3{0, 0, 1});
    });
  }
  CHECK(stack.number() == 0);
  const size_t all = 4 * k_squares * (4 * k_squares - 1) / 2;
  CHECK(stack.heap.checkpoints >= all / (1u << 20));
  CHECK(stack.heap.checkpoints <= all / (1u << 18));
}
