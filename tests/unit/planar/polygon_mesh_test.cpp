#include "planar/polygon_mesh.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include "num/predicates.h"

using namespace wireskin;
using namespace wireskin::planar;

namespace {

using Polygon = std::vector<Vec2>;

constexpr double k_pi = 3.14159265358979323846;

// Counts, and fails the allocation with number `fail_at` (and later ones with fail_on).
struct Heap {
  size_t calls = 0, live = 0;
  size_t fail_at = SIZE_MAX;
  bool fail_on = false;

  static void* allocate(size_t bytes, void* user) {
    Heap& self = *static_cast<Heap*>(user);
    const size_t call = self.calls++;
    if (call == self.fail_at || (self.fail_on && call > self.fail_at)) return nullptr;
    ++self.live;
    void* memory = std::malloc(bytes);
    std::memset(memory, 0xcd, bytes);
    return memory;
  }
  static void release(void* memory, size_t, void* user) {
    --static_cast<Heap*>(user)->live;
    std::free(memory);
  }
  Allocator allocator() { return {allocate, release, this}; }
};

struct Figures {
  Status status;
  size_t interior = 0;
  double expected = 0.0;  // interior points of a hexagonal lattice with this border
  double least = 0.0, first_percent = 0.0, median = 0.0;  // least angles of the triangles, degrees
  std::vector<Vec2> points;
  std::vector<uint32_t> triangles;
};

double least_angle(Vec2 a, Vec2 b, Vec2 c) {
  const Vec2 p[3] = {a, b, c};
  double least = 180.0;
  for (int i = 0; i < 3; ++i) {
    const Vec2 u = p[(i + 1) % 3] - p[i];
    const Vec2 v = p[(i + 2) % 3] - p[i];
    least = std::min(least, std::atan2(cross(u, v), dot(u, v)) * 180.0 / k_pi);
  }
  return least;
}

double polygon_area(const Polygon& border) {
  double sum = 0.0;
  for (size_t i = 2; i < border.size(); ++i) {
    sum += cross(border[i - 1] - border[0], border[i] - border[0]);
  }
  return sum / 2.0;
}

// Border kept bit for bit, every triangle counter-clockwise, one manifold disc whose rim is the
// border, area equal, locally Delaunay across every inner edge.
void check_mesh(const Polygon& border, const PolygonMesh& mesh, bool exact_copy = true) {
  const size_t count = border.size();
  REQUIRE(mesh.points.size() >= count);
  CHECK(std::memcmp(mesh.points.data(), border.data(), count * sizeof(Vec2)) == 0);
  std::map<std::pair<uint32_t, uint32_t>, uint32_t> apex;
  double area = 0.0;
  bool left = true, once = true;
  for (size_t i = 0; i < mesh.triangles.size(); i += 3) {
    const uint32_t* v = &mesh.triangles[i];
    const Vec2 a = mesh.points[v[0]], b = mesh.points[v[1]], c = mesh.points[v[2]];
    left = left && orient2d(a, b, c) > 0.0;
    area += cross(b - a, c - a) / 2.0;
    for (int k = 0; k < 3; ++k) {
      once = apex.insert({{v[k], v[(k + 1) % 3]}, v[(k + 2) % 3]}).second && once;
    }
  }
  CHECK((left || !exact_copy));
  CHECK(once);
  CHECK(mesh.triangles.size() / 3 == 2 * mesh.points.size() - count - 2);
  CHECK(area == doctest::Approx(polygon_area(border)).epsilon(1e-9));
  size_t rim = 0, not_delaunay = 0, wrong_rim = 0;
  for (const auto& [edge, c] : apex) {
    const auto other = apex.find({edge.second, edge.first});
    if (other == apex.end()) {
      ++rim;
      if (edge.second != (edge.first + 1) % count || edge.first >= count) ++wrong_rim;
    } else if (incircle(mesh.points[edge.first], mesh.points[edge.second], mesh.points[c],
                        mesh.points[other->second]) > 0.0) {
      ++not_delaunay;
    }
  }
  CHECK(rim == count);
  CHECK(wrong_rim == 0);
  CHECK((not_delaunay == 0 || !exact_copy));
}

Figures mesh(const Polygon& border, double spacing, const char* name = nullptr) {
  Heap heap;
  Figures f;
  {
    Context context(heap.allocator(), 0, {});
    PolygonMesh result(context);
    f.status = mesh_polygon(context, {border.data(), border.size()}, spacing, &result);
    if (f.status.ok()) {
      check_mesh(border, result);
      f.points.assign(result.points.begin(), result.points.end());
      f.triangles.assign(result.triangles.begin(), result.triangles.end());
    } else {
      CHECK(result.points.empty());
      CHECK(result.triangles.empty());
    }
  }
  CHECK(heap.live == 0);
  if (!f.status.ok()) return f;
  std::vector<double> angles;
  for (size_t i = 0; i < f.triangles.size(); i += 3) {
    angles.push_back(least_angle(f.points[f.triangles[i]], f.points[f.triangles[i + 1]],
                                 f.points[f.triangles[i + 2]]));
  }
  std::sort(angles.begin(), angles.end());
  f.interior = f.points.size() - border.size();
  f.expected = polygon_area(border) / (spacing * spacing * std::sqrt(3.0) / 2.0) -
               0.5 * static_cast<double>(border.size()) + 1.0;
  f.least = angles[0];
  f.first_percent = angles[angles.size() / 100];
  f.median = angles[angles.size() / 2];
  if (name != nullptr) {
    std::printf(
        "%-22s border %4zu interior %5zu (lattice %5.0f) angles: least %4.1f 1%% %4.1f median "
        "%4.1f\n",
        name, border.size(), f.interior, f.expected, f.least, f.first_percent, f.median);
  }
  return f;
}

Polygon divide(const Polygon& corners, double spacing) {
  Polygon border;
  for (size_t i = 0; i < corners.size(); ++i) {
    const Vec2 a = corners[i], b = corners[(i + 1) % corners.size()];
    const int n = std::max(1, static_cast<int>(std::lround(length(b - a) / spacing)));
    for (int k = 0; k < n; ++k) border.push_back(a + (static_cast<double>(k) / n) * (b - a));
  }
  return border;
}

Polygon ellipse(double a, double b, int count) {
  Polygon border;
  for (int i = 0; i < count; ++i) {
    const double t = 2.0 * k_pi * i / count;
    border.push_back({a * std::cos(t), b * std::sin(t)});
  }
  return border;
}

// The octant of the unit sphere between three great circles, seen along (1, 1, 1).
Polygon octant(int segments) {
  const Vec3 corner[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const Vec3 u = unit(Vec3{-1, 1, 0}), v = unit(Vec3{-1, -1, 2});
  Polygon border;
  for (int k = 0; k < 3; ++k) {
    for (int i = 0; i < segments; ++i) {
      const double t = 0.5 * k_pi * i / segments;
      const Vec3 p = std::cos(t) * corner[k] + std::sin(t) * corner[(k + 1) % 3];
      border.push_back({dot(p, u), dot(p, v)});
    }
  }
  return border;
}

Polygon star(int rays, double inner, double spacing) {
  Polygon corners;
  for (int i = 0; i < 2 * rays; ++i) {
    const double r = i % 2 == 0 ? 1.0 : inner, t = k_pi * i / rays;
    corners.push_back({r * std::cos(t), r * std::sin(t)});
  }
  return divide(corners, spacing);
}

Polygon spiral(double turns, double width, double spacing) {
  Polygon out, back;
  const int count = static_cast<int>(40 * turns);
  for (int i = 0; i <= count; ++i) {
    const double t = 2.0 * k_pi * turns * i / count, r = 0.2 + 0.1 * t / k_pi;
    out.push_back({(r + width) * std::cos(t), (r + width) * std::sin(t)});
    back.push_back({r * std::cos(t), r * std::sin(t)});
  }
  out.insert(out.end(), back.rbegin(), back.rend());
  return divide(out, spacing);
}

}  // namespace

TEST_CASE("uniform borders: angles and number of points") {
  const Polygon square = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  const Polygon ell = {{-1, -1}, {1, -1}, {1, 0}, {0, 0}, {0, 1}, {-1, 1}};
  const Polygon u = {{-1, -1}, {1, -1}, {1, 1}, {.5, 1}, {.5, -.5}, {-.5, -.5}, {-.5, 1}, {-1, 1}};
  const struct {
    const char* name;
    Polygon border;
    double spacing;
  } cases[] = {{"disc", ellipse(1, 1, 200), 2.0 * k_pi / 200},
               {"square", divide(square, 0.05), 0.05},
               {"L", divide(ell, 0.04), 0.04},
               {"U", divide(u, 0.04), 0.04},
               {"star", star(5, 0.4, 0.04), 0.04},
               {"small disc", ellipse(1, 1, 40), 2.0 * k_pi / 40}};
  for (const auto& c : cases) {
    CAPTURE(c.name);
    const Figures f = mesh(c.border, c.spacing, c.name);
    REQUIRE(f.status.ok());
    CHECK(f.least >= 28.0);
    CHECK(f.median >= 55.0);
    CHECK(static_cast<double>(f.interior) == doctest::Approx(f.expected).epsilon(0.06));
  }
}

TEST_CASE("the projected octant of a sphere") {
  const Figures f = mesh(octant(62), 0.02534, "octant");
  REQUIRE(f.status.ok());
  CHECK(f.interior >= 2300);
  CHECK(f.interior <= 2450);
  CHECK(f.least >= 28.0);
  CHECK(f.median >= 55.0);
}

TEST_CASE("borders finer, coarser and foreshortened") {
  Polygon foreshortened = ellipse(1, 1, 160);
  for (Vec2& p : foreshortened) p.y *= 0.4;
  const struct {
    const char* name;
    Polygon border;
    double spacing;
  } cases[] = {{"foreshortened", foreshortened, 2.0 * k_pi / 160},
               {"ellipse, varied", ellipse(1, 0.35, 120), 0.06},
               {"ellipse, fine border", ellipse(1, 0.35, 300), 0.06},
               {"ellipse, coarse border", ellipse(1, 0.8, 60), 0.04}};
  for (const auto& c : cases) {
    CAPTURE(c.name);
    const Figures f = mesh(c.border, c.spacing, c.name);
    REQUIRE(f.status.ok());
    CHECK(f.least >= 22.0);
    CHECK(f.median >= 49.0);
  }
}

TEST_CASE("sizes grade smoothly from a fine border to the inside") {
  const Figures f = mesh(ellipse(1, 1, 400), 0.08, "disc, fine border");
  REQUIRE(f.status.ok());
  CHECK(f.least >= 22.0);
  // Triangles that share an edge differ little in size: the ratio of the sides meeting at a vertex.
  std::vector<double> shortest(f.points.size(), 1e9), longest(f.points.size(), 0.0);
  for (size_t i = 0; i < f.triangles.size(); ++i) {
    const uint32_t a = f.triangles[i], b = f.triangles[i % 3 == 2 ? i - 2 : i + 1];
    const double side = length(f.points[a] - f.points[b]);
    for (const uint32_t v : {a, b}) {
      shortest[v] = std::min(shortest[v], side);
      longest[v] = std::max(longest[v], side);
    }
  }
  double worst = 0.0;
  for (size_t v = 0; v < f.points.size(); ++v) worst = std::max(worst, longest[v] / shortest[v]);
  std::printf("greatest ratio of edges at a vertex %.2f\n", worst);
  CHECK(worst < 3.0);
}

TEST_CASE("awkward polygons are meshed without a point on the border") {
  Polygon needle = {{0, 0}, {1, 0}, {1, 1e-6}, {0, 1e-6}};
  CHECK(mesh(needle, 0.1).status.ok());
  CHECK(mesh(needle, 0.001).status.ok());
  CHECK(mesh(divide(needle, 0.01), 0.01).status.ok());
  CHECK(mesh({{0, 0}, {1, 0}, {0, 1}}, 10.0).interior == 0);
  CHECK(mesh({{0, 0}, {1, 0}, {0, 1}}, 0.1).status.ok());
  CHECK(mesh({{0, 0}, {1, 0}, {0.5, 1e-300}}, 0.1).status.code == Code::patch_without_plane);
  CHECK(mesh({{0, 0}, {1, 0}, {0.5, 1e-16}}, 0.1).status.ok());
  // Collinear runs, and points of a grid.
  Polygon comb;
  for (int i = 0; i < 20; ++i) comb.push_back({static_cast<double>(i), 0.0});
  for (int i = 19; i >= 0; --i) comb.push_back({static_cast<double>(i), i % 2 == 0 ? 5.0 : 1.0});
  CHECK(mesh(comb, 0.5, "comb").status.ok());
  CHECK(mesh(comb, 5.0).status.ok());
  const Figures s = mesh(spiral(4, 0.12, 0.03), 0.03, "spiral");
  CHECK(s.status.ok());
  CHECK(s.least > 20.0);
  CHECK(mesh(spiral(4, 1e-6, 0.03), 0.03).status.ok());
  CHECK(mesh(star(50, 0.01, 0.5), 0.05).status.ok());
  // One very short edge among long ones.
  CHECK(mesh({{0, 0}, {1, 0}, {1, 1}, {1e-9, 1}, {0, 1}}, 0.1).status.ok());
}

TEST_CASE("random polygons, most of them star-shaped with ragged borders") {
  std::mt19937 random(7);
  const auto uniform = [&] { return static_cast<double>(random()) * 0x1p-32; };
  for (int round = 0; round < 400; ++round) {
    Polygon border;
    const int count = 3 + static_cast<int>(random() % 60);
    for (int i = 0; i < count; ++i) {
      const double t = 2.0 * k_pi * (i + 0.9 * uniform()) / count, r = 0.05 + uniform();
      border.push_back({r * std::cos(t), r * std::sin(t)});
      if (round % 3 == 0)
        border.back() = {std::round(8 * border.back().x), std::round(8 * border.back().y)};
    }
    const double spacing = std::pow(10.0, -2.0 * uniform());
    const Figures f = mesh(border, spacing);
    if (!f.status.ok()) {
      CHECK((f.status.code == Code::patch_folded || f.status.code == Code::patch_without_plane));
    }
    if (round % 3 != 0 && count > 8) CHECK(f.status.ok());
  }
}

TEST_CASE("simple or not: agrees with looking at every pair of edges") {
  std::mt19937 random(8);
  size_t good = 0, folded = 0;
  for (int round = 0; round < 4000; ++round) {
    Polygon border;
    const size_t count = 3 + random() % 5;
    for (size_t i = 0; i < count; ++i) {
      border.push_back({static_cast<double>(random() % 6), static_cast<double>(random() % 6)});
    }
    // Two edges may share no point but a common end.
    bool simple = true;
    double area = 0.0;
    for (size_t i = 0; i < count; ++i) {
      const Vec2 a = border[i], b = border[(i + 1) % count];
      area += cross(a, b);
      for (size_t k = 0; k < count; ++k) {
        const Vec2 c = border[k], d = border[(k + 1) % count];
        const bool on_line = orient2d(a, b, c) == 0.0 && dot(c - a, c - b) <= 0.0;
        if (k != i && k != (i + 1) % count && on_line) simple = false;
        if (k == (i + 1) % count && (a.x == c.x && a.y == c.y)) simple = false;
        if (orient2d(a, b, c) * orient2d(a, b, d) < 0.0 &&
            orient2d(c, d, a) * orient2d(c, d, b) < 0.0) {
          simple = false;
        }
      }
    }
    const Status status = mesh(border, 0.7).status;
    bool line = true;
    for (const Vec2& p : border) line = line && orient2d(border[0], border[1], p) == 0.0;
    if (simple && area > 0.0) {
      CHECK(status.ok());
      ++good;
    } else if (simple || line) {
      CHECK((status.code == Code::patch_without_plane ||
             (line && status.code == Code::patch_folded)));
    } else {
      CHECK(status.code == Code::patch_folded);
      ++folded;
    }
  }
  CHECK(good > 300);
  CHECK(folded > 300);
}

TEST_CASE("bad borders and bad spacings have their own statuses") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  const Polygon square = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  CHECK(mesh({}, 0.1).status.code == Code::patch_folded);
  CHECK(mesh({{0, 0}, {1, 0}}, 0.1).status.code == Code::patch_folded);
  CHECK(mesh({{0, 0}, {1, 0}, {1, 1}, {1, 0}, {0, 1}}, 0.1).status.code == Code::patch_folded);
  CHECK(mesh({{0, 0}, {1, 1}, {1, 0}, {0, 1}}, 0.1).status.code == Code::patch_folded);
  CHECK(mesh({{0, 0}, {2, 0}, {2, 1}, {1, 0}, {0, 1}}, 0.1).status.code == Code::patch_folded);
  CHECK(mesh({{0, 0}, {2, 0}, {2, 1}, {3, 1}, {1, 1}, {0, 1}}, 0.1).status.code ==
        Code::patch_folded);
  CHECK(mesh({{0, 1}, {1, 1}, {1, 0}, {0, 0}}, 0.1).status.code == Code::patch_without_plane);
  CHECK(mesh({{0, 0}, {1, 1}, {2, 2}}, 0.1).status.code == Code::patch_without_plane);
  CHECK(mesh({{0, 0}, {1, nan}, {2, 2}}, 0.1).status.code == Code::not_a_number);
  CHECK(mesh({{0, 0}, {1, infinity}, {2, 2}}, 0.1).status.code == Code::infinite);
  CHECK(mesh({{0, 0}, {1e300, 0}, {2, 2}}, 0.1).status.code == Code::bad_argument);
  for (const double spacing : {0.0, -1.0, nan, infinity}) {
    CHECK(mesh(square, spacing).status.code == Code::bad_argument);
  }
  CHECK(mesh(square, 1e-9).status.code == Code::too_large);
  CHECK(mesh(square, 1e-300).status.code == Code::too_large);
  CHECK(mesh(square, 1e300).interior == 0);
}

TEST_CASE("scaling by a power of two scales the mesh exactly") {
  const Polygon border = octant(20);
  const Figures f = mesh(border, 0.08);
  for (const double factor : {0x1p-30, 0x1p+40}) {
    Polygon scaled = border;
    for (Vec2& p : scaled) p = factor * p;
    const Figures g = mesh(scaled, factor * 0.08);
    REQUIRE(g.triangles == f.triangles);
    bool same = true;
    for (size_t i = 0; i < f.points.size(); ++i) {
      same = same && g.points[i].x == factor * f.points[i].x &&
             g.points[i].y == factor * f.points[i].y;
    }
    CHECK(same);
  }
}

TEST_CASE("each allocation failed in turn: a status, no leak, and the same bits afterwards") {
  const Polygon border = star(5, 0.5, 0.2);
  const Figures good = mesh(border, 0.2);
  REQUIRE(good.status.ok());
  for (int fail_on = 0; fail_on < 2; ++fail_on) {
    for (size_t at = 0;; ++at) {
      Heap heap;
      heap.fail_at = at;
      heap.fail_on = fail_on != 0;
      {
        Context context(heap.allocator(), 0, {});
        PolygonMesh result(context);
        const Status status = mesh_polygon(context, {border.data(), border.size()}, 0.2, &result);
        if (status.ok()) {
          CHECK(heap.calls <= at);
          CHECK(result.triangles.size() == good.triangles.size());
          break;
        }
        CHECK(status.code == Code::out_of_memory);
        CHECK(result.points.empty());
        heap.fail_at = SIZE_MAX;
        heap.fail_on = false;
        REQUIRE(mesh_polygon(context, {border.data(), border.size()}, 0.2, &result).ok());
        CHECK(std::equal(result.triangles.begin(), result.triangles.end(), good.triangles.begin()));
        CHECK(std::memcmp(result.points.data(), good.points.data(),
                          good.points.size() * sizeof(Vec2)) == 0);
      }
      CHECK(heap.live == 0);
      REQUIRE(at < 1000);
    }
  }
}

TEST_CASE("cancelling stops it") {
  Heap heap;
  Callbacks callbacks;
  callbacks.cancel = [](void*) { return 1; };
  Context context(heap.allocator(), 0, callbacks);
  PolygonMesh result(context);
  const Polygon border = ellipse(1, 1, 100);
  CHECK(mesh_polygon(context, {border.data(), border.size()}, 0.06, &result).code ==
        Code::cancelled);
}
