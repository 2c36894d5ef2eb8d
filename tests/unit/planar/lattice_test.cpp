#include "planar/lattice.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

using namespace wireskin;
using namespace wireskin::planar;

namespace {

void* allocate(size_t bytes, void*) {
  return std::malloc(bytes);
}
void release(void* memory, size_t, void*) {
  std::free(memory);
}

std::vector<Vec2> lattice_of(const std::vector<Vec2>& border, double spacing,
                             double expected = 1e6) {
  Context context({allocate, release, nullptr}, 0, {});
  Array<Vec2> points(context);
  std::vector<LatticeObstacle> edges;
  for (size_t i = 0; i < border.size(); ++i) {
    const Vec2 a = border[i], b = border[(i + 1) % border.size()];
    edges.push_back({a, b, length(b - a), true});
  }
  REQUIRE(lattice_points({edges.data(), edges.size()}, spacing, expected, &points).ok());
  return {points.begin(), points.end()};
}

double distance_to_segment(Vec2 p, Vec2 a, Vec2 b) {
  const double t = std::clamp(dot(p - a, b - a) / dot(b - a, b - a), 0.0, 1.0);
  return length(p - a - t * (b - a));
}

bool is_inside(Vec2 p, const std::vector<Vec2>& border) {
  bool inside = false;
  for (size_t i = 0; i < border.size(); ++i) {
    const Vec2 a = border[i], b = border[(i + 1) % border.size()];
    if ((a.y <= p.y) != (b.y <= p.y) && a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x) > p.x) {
      inside = !inside;
    }
  }
  return inside;
}

// An L whose edges are all one unit long, turned by `angle`.
std::vector<Vec2> turned_ell(double angle) {
  std::vector<Vec2> border;
  const Vec2 steps[] = {{1, 0}, {0, 1}, {-1, 0}, {0, 1}, {-1, 0}, {0, -1}};
  const int counts[] = {20, 10, 10, 10, 10, 20};
  Vec2 p;
  for (int side = 0; side < 6; ++side) {
    for (int i = 0; i < counts[side]; ++i) {
      border.push_back({std::cos(angle) * p.x - std::sin(angle) * p.y,
                        std::sin(angle) * p.x + std::cos(angle) * p.y});
      p = p + steps[side];
    }
  }
  return border;
}

}  // namespace

TEST_CASE("points lie inside, one spacing apart, clear of the border, and leave no hole") {
  for (const double angle : {0.0, 0.3, 2.0}) {
    const std::vector<Vec2> border = turned_ell(angle);
    const std::vector<Vec2> points = lattice_of(border, 1.0);
    // 300 unit squares hold 346 points; a strip of about one spacing along 80 edges is left out.
    CHECK(points.size() > 230);
    CHECK(points.size() < 300);
    double nearest_border = 1e9, nearest_point = 1e9, loneliest = 0.0;
    for (size_t i = 0; i < points.size(); ++i) {
      CHECK(is_inside(points[i], border));
      for (size_t k = 0; k < border.size(); ++k) {
        nearest_border =
            std::min(nearest_border,
                     distance_to_segment(points[i], border[k], border[(k + 1) % border.size()]));
      }
      double nearest = 1e9;
      for (size_t k = 0; k < points.size(); ++k) {
        if (k != i) nearest = std::min(nearest, length(points[k] - points[i]));
      }
      nearest_point = std::min(nearest_point, nearest);
      loneliest = std::max(loneliest, nearest);
    }
    CHECK(nearest_border >= 0.8 - 1e-9);
    CHECK(nearest_point == doctest::Approx(1.0));
    CHECK(loneliest == doctest::Approx(1.0));
  }
}

TEST_CASE("the lattice turns with the polygon and continues a border that fits") {
  const std::vector<Vec2> straight = lattice_of(turned_ell(0.0), 1.0);
  const std::vector<Vec2> turned = lattice_of(turned_ell(0.7), 1.0);
  REQUIRE(straight.size() == turned.size());
  for (size_t i = 0; i < straight.size(); ++i) {
    const Vec2 p = straight[i];
    const Vec2 q = {std::cos(0.7) * p.x - std::sin(0.7) * p.y,
                    std::sin(0.7) * p.x + std::cos(0.7) * p.y};
    CHECK(length(turned[i] - q) < 1e-12);
  }
  const double row = straight[0].y / (0.5 * std::sqrt(3.0));
  CHECK(row == doctest::Approx(std::round(row)));
}

TEST_CASE("the finer the border against the spacing, the farther the lattice keeps away") {
  const std::vector<Vec2> border = turned_ell(0.0);
  double nearest = 1e9;
  for (const Vec2& p : lattice_of(border, 1.5)) {
    for (const Vec2& q : border) nearest = std::min(nearest, length(p - q));
  }
  CHECK(nearest > 2.0 * 1.5);
}

TEST_CASE("no lattice where its rows would cost more than it is worth") {
  // A zigzag of a thousand long, thin teeth next to almost no area.
  std::vector<Vec2> border;
  for (int i = 0; i < 1000; ++i) {
    border.push_back({i * 1e-6, 0.0});
    border.push_back({(i + 0.5) * 1e-6, 1.0});
  }
  border.push_back({1e-3, 2.0});
  border.push_back({0.0, 2.0});
  CHECK(lattice_of(border, 1e-4, 1e5).empty());
}

TEST_CASE("a spacing beyond the resolution of the coordinates gives no lattice, and no hang") {
  // Wide near the origin of coordinates, but the frame's origin is at the far end of the long edge.
  const std::vector<Vec2> border = {{-1.0, 0.0}, {0.0, -1e-19}, {1e-17, 0.0}, {0.0, 1e-17}};
  CHECK(lattice_of(border, 1e-19).empty());
}
