#include "hostile/families.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>

namespace hostile {

namespace {

using scenes::Curve;
using Point = std::array<double, 3>;

constexpr double k_pi = 3.14159265358979323846;
constexpr double k_nan = std::numeric_limits<double>::quiet_NaN();
constexpr double k_infinite = std::numeric_limits<double>::infinity();

class Random {
 public:
  explicit Random(uint64_t seed) : state_(seed * 0x9e3779b97f4a7c15u + 1) {}
  double operator()() {
    state_ ^= state_ << 13;
    state_ ^= state_ >> 7;
    state_ ^= state_ << 17;
    return static_cast<double>(state_ >> 11) * 0x1p-53;
  }
  size_t below(size_t n) { return static_cast<size_t>((*this)() * static_cast<double>(n)); }

 private:
  uint64_t state_;
};

void add(Curve& curve, const Point& p, const Point& n, uint32_t node = WSK_NONE) {
  curve.positions.insert(curve.positions.end(), p.begin(), p.end());
  curve.normals.insert(curve.normals.end(), n.begin(), n.end());
  curve.nodes.push_back(node);
}

// Samples f(t), t from 0 to 1; the ends are the nodes `from` and `to`.
Curve arc(uint32_t n, uint32_t from, uint32_t to, const std::function<Point(double)>& f,
          const Point& normal = {0, 0, 1}) {
  Curve curve;
  for (uint32_t i = 0; i <= n; ++i) {
    add(curve, f(static_cast<double>(i) / n), normal, i == 0 ? from : i == n ? to : WSK_NONE);
  }
  return curve;
}

Curve line(const Point& a, const Point& b, uint32_t from, uint32_t to, uint32_t n = 4,
           const Point& normal = {0, 0, 1}) {
  return arc(
      n, from, to,
      [=](double t) {
        return Point{a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])};
      },
      normal);
}

Curve circle(const Point& c, double radius, uint32_t n = 16, double up = 1.0) {
  Curve curve;
  for (uint32_t i = 0; i < n; ++i) {
    const double a = 2 * k_pi * i / n;
    add(curve, {c[0] + radius * std::cos(a), c[1] + radius * std::sin(a), c[2]}, {0, 0, up});
  }
  curve.closed = true;
  return curve;
}

Curve boundary(Curve curve) {
  curve.boundary = true;
  return curve;
}

// A polygon of straight curves between nodes numbered from `first`.
std::vector<Curve> polygon(const std::vector<Point>& corners, uint32_t first = 0,
                           bool at_border = true) {
  std::vector<Curve> curves;
  const uint32_t n = static_cast<uint32_t>(corners.size());
  for (uint32_t i = 0; i < n; ++i) {
    Curve curve = line(corners[i], corners[(i + 1) % n], first + i, first + (i + 1) % n);
    curve.boundary = at_border;
    curves.push_back(curve);
  }
  return curves;
}

std::vector<Curve> square(double size = 1.0) {
  return polygon({{0, 0, 0}, {size, 0, 0}, {size, size, 0}, {0, size, 0}});
}

// n x n cells in the plane, heights by f.
std::vector<Curve> grid(uint32_t n, const std::function<double(double, double)>& f) {
  std::vector<Curve> curves;
  const auto at = [&](uint32_t i, uint32_t k) {
    const double x = static_cast<double>(i), y = static_cast<double>(k);
    return Point{x, y, f(x, y)};
  };
  for (uint32_t i = 0; i <= n; ++i) {
    Curve a, b;
    for (uint32_t k = 0; k <= n; ++k) {
      add(a, at(i, k), {0, 0, 1}, i * (n + 1) + k);
      add(b, at(k, i), {0, 0, 1}, k * (n + 1) + i);
    }
    a.boundary = b.boundary = i == 0 || i == n;
    curves.push_back(a);
    curves.push_back(b);
  }
  return curves;
}

std::vector<Curve> octants() {
  return scenes::octants().curves;
}

std::vector<Curve> joined(std::vector<Curve> a, const std::vector<Curve>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

// ---- The families -------------------------------------------------------------------------------

void add_empty_and_tiny(std::vector<Case>& cases) {
  cases.push_back({"no curves", {}});
  cases.push_back({"an empty curve", {Curve{}}});
  Curve one;
  add(one, {1, 2, 3}, {0, 0, 1});
  cases.push_back({"one sample", {one}});
  Curve same;
  for (int i = 0; i < 5; ++i) add(same, {1, 2, 3}, {0, 0, 1});
  cases.push_back({"zero length", {same}});
  cases.push_back({"two samples", {line({0, 0, 0}, {1, 0, 0}, 0, 1, 1)}});
  Curve three = circle({0, 0, 0}, 1, 3);
  cases.push_back({"a closed curve of three", {boundary(three)}});
  cases.push_back({"a circle", {boundary(circle({0, 0, 0}, 1))}});
  cases.push_back({"a great circle", {circle({0, 0, 0}, 1)}});
}

void add_bad_numbers(std::vector<Case>& cases) {
  for (const double bad : {k_nan, k_infinite, -k_infinite, 1.7e308, -1.7e308}) {
    for (const size_t place : {size_t{0}, size_t{4}, size_t{14}}) {
      std::vector<Curve> curves = square();
      curves[1].positions[place] = bad;
      cases.push_back({"a bad position", curves});
      curves = square();
      curves[2].normals[place] = bad;
      cases.push_back({"a bad normal", curves});
    }
  }
}

void add_duplicates(std::vector<Case>& cases) {
  std::vector<Curve> curves = square();
  for (size_t k = 0; k < 3; ++k) curves[0].positions[3 + k] = curves[0].positions[6 + k];
  cases.push_back({"duplicate samples", curves});
  curves = octants();
  for (size_t k = 0; k < 3; ++k) {
    curves[0].positions[3 + k] = curves[0].positions[k];
    curves[0].positions[3 + k] = std::nextafter(curves[0].positions[k], 2.0);
  }
  cases.push_back({"samples an ulp apart", curves});
  cases.push_back({"identical curves", joined(octants(), octants())});
  cases.push_back({"the same square twice", joined(square(), square())});
  curves = square();
  curves.push_back(curves[1]);
  cases.push_back({"one curve twice", curves});
  curves = square();
  curves[2] = curves[1];
  cases.push_back({"one curve instead of another", curves});
}

void add_degenerate_shapes(std::vector<Case>& cases) {
  cases.push_back({"collinear", polygon({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}})});
  cases.push_back({"there and back", polygon({{0, 0, 0}, {1, 0, 0}})});
  cases.push_back({"coplanar grid", grid(5, [](double, double) { return 0.0; })});
  cases.push_back({"wavy grid", grid(5, [](double x, double y) { return 0.3 * std::sin(x * y); })});
  cases.push_back(
      {"rough grid", grid(5, [](double x, double y) { return std::fmod(x * 7 + y * 3, 2); })});
  cases.push_back({"needle", polygon({{0, 0, 0}, {1, 0, 0}, {1, 1e-6, 0}, {0, 1e-6, 0}})});
  cases.push_back({"needle to a point", polygon({{0, 0, 0}, {1, 0, 0}, {1, 1e-9, 0}})});
  cases.push_back(
      {"aspect of a million", polygon({{0, 0, 0}, {1e6, 0, 0}, {1e6, 1, 0}, {0, 1, 0}})});
  cases.push_back({"vertical", polygon({{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}})});
  cases.push_back({"skew", polygon({{0, 0, 0}, {1, 0, 1}, {1, 1, 0}, {0, 1, 1}})});
  cases.push_back({"spike", polygon({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0.5, 1e-7, 0}, {0, 1, 0}})});
}

void add_crossings(std::vector<Case>& cases) {
  cases.push_back({"bow tie", polygon({{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}})});
  Curve eight;
  for (int i = 0; i < 32; ++i) {
    const double a = 2 * k_pi * i / 32;
    add(eight, {std::sin(a), std::sin(2 * a), 0}, {0, 0, 1});
  }
  eight.closed = true;
  cases.push_back({"figure eight", {eight}});
  cases.push_back({"figure eight, boundary", {boundary(eight)}});
  Curve looped = eight;
  looped.nodes[0] = looped.nodes[16] = 7;
  cases.push_back({"figure eight through a node", {looped}});
  Curve star;
  for (int i = 0; i < 5; ++i) {
    const double a = 4 * k_pi * i / 5;
    add(star, {std::cos(a), std::sin(a), 0}, {0, 0, 1});
  }
  star.closed = true;
  cases.push_back({"pentagram", {boundary(star)}});
  cases.push_back({"overlapping circles", {circle({0, 0, 0}, 1), circle({1, 0, 0}, 1)}});
}

void add_open_ends(std::vector<Case>& cases) {
  std::vector<Curve> curves = square();
  curves.pop_back();
  cases.push_back({"an unclosed cycle", curves});
  cases.push_back({"a dangling curve", joined(square(), {line({0, 0, 0}, {0.4, 0.5, 0}, 0, 9)})});
  cases.push_back(
      {"a T-junction without node", joined(square(), {line({0.5, 0, 0}, {0.5, 1, 0}, 8, 9)})});
  cases.push_back({"a curve far away", joined(square(), {line({9, 9, 9}, {9, 9, 8}, 8, 9)})});
  cases.push_back(
      {"a loose curve inside", joined(square(), {line({0.3, 0.5, 0}, {0.7, 0.5, 0}, 8, 9)})});
  cases.push_back({"lone curve", {line({0, 0, 0}, {1, 1, 1}, 0, 1)}});
  curves = square();
  curves[0].nodes[0] = 99;
  cases.push_back({"a node missed", curves});
  curves = square();
  curves[0].positions[0] += 1e-3;
  cases.push_back({"a node beside itself", curves});
  curves = square();
  curves[0].nodes.back() = 0;
  cases.push_back({"a curve from a node to the same number elsewhere", curves});
}

void add_bad_normals(std::vector<Case>& cases) {
  const auto with = [&](const char* name, const std::function<void(Curve&, size_t)>& change) {
    for (auto base : {square(), octants()}) {
      for (Curve& curve : base) {
        for (size_t i = 0; i < curve.size(); ++i) change(curve, i);
      }
      cases.push_back({name, base});
    }
  };
  with("zero normals", [](Curve& c, size_t i) {
    c.normals[3 * i] = c.normals[3 * i + 1] = c.normals[3 * i + 2] = 0;
  });
  with("flipped normals", [](Curve& c, size_t i) {
    for (size_t k = 0; k < 3; ++k) c.normals[3 * i + k] *= -1;
  });
  with("every other normal flipped", [](Curve& c, size_t i) {
    for (size_t k = 0; k < 3; ++k) c.normals[3 * i + k] *= i % 2 == 0 ? 1 : -1;
  });
  with("tangent normals", [](Curve& c, size_t i) {
    const size_t n = c.size(), a = i + 1 < n ? i : i - 1;
    for (size_t k = 0; k < 3; ++k)
      c.normals[3 * i + k] = c.positions[3 * (a + 1) + k] - c.positions[3 * a + k];
  });
  with("huge and tiny normals", [](Curve& c, size_t i) {
    for (size_t k = 0; k < 3; ++k) c.normals[3 * i + k] *= i % 2 == 0 ? 1e200 : 1e-200;
  });
  with("turning normals", [](Curve& c, size_t i) {
    const double a = static_cast<double>(i);
    c.normals[3 * i] = std::cos(a), c.normals[3 * i + 1] = std::sin(a), c.normals[3 * i + 2] = 0.1;
  });
  std::vector<Curve> curves = square();
  for (double& n : curves[2].normals) n = -n;
  cases.push_back({"one curve flipped", curves});
}

void add_nests(std::vector<Case>& cases) {
  cases.push_back({"nested circles",
                   {boundary(circle({0, 0, 0}, 1)), boundary(circle({0, 0, 0}, 0.5)),
                    boundary(circle({0, 0, 0}, 0.25))}});
  cases.push_back({"nested circles, no boundary", {circle({0, 0, 0}, 1), circle({0, 0, 0}, 0.5)}});
  cases.push_back(
      {"opposite circles", {circle({0, 0, 0}, 1, 16, 1), circle({0, 0, 1}, 1, 16, -1)}});
  cases.push_back(
      {"stacked circles", {boundary(circle({0, 0, 0}, 1)), boundary(circle({0, 0, 1}, 1))}});
  cases.push_back(
      {"touching circles", {boundary(circle({0, 0, 0}, 1)), boundary(circle({2, 0, 0}, 1))}});
  cases.push_back({"tiny beside huge", joined(square(1e6), {boundary(circle({3, 3, 0}, 1e-3))})});
  std::vector<Curve> many;
  for (int i = 0; i < 60; ++i) {
    many.push_back(boundary(circle({3.0 * (i % 8), 3.0 * (i / 8), 0}, 1, 6)));
  }
  cases.push_back({"many patches", many});
}

void add_hubs(std::vector<Case>& cases) {
  for (const uint32_t valence : {2u, 3u, 20u, 100u}) {
    std::vector<Curve> curves;
    std::vector<Point> rim;
    for (uint32_t i = 0; i < valence; ++i) {
      const double a = 2 * k_pi * i / valence;
      rim.push_back({std::cos(a), std::sin(a), 0});
    }
    if (valence > 2) curves = polygon(rim, 1);
    for (uint32_t i = 0; i < valence; ++i) curves.push_back(line({0, 0, 0}, rim[i], 0, 1 + i, 2));
    cases.push_back({"valence " + std::to_string(valence), curves});
  }
  std::vector<Curve> bundle;
  for (uint32_t i = 0; i < 12; ++i) {
    const double h = 0.1 * i;
    bundle.push_back(arc(6, 0, 1, [=](double t) { return Point{t, h * t * (1 - t), 0}; }));
  }
  bundle.front().boundary = bundle.back().boundary = true;
  cases.push_back({"bundle between two nodes", bundle});
  Curve loop = circle({1, 0, 0}, 1);
  loop.nodes[8] = 5;
  Curve other = circle({-1, 0, 0}, 1);
  other.nodes[0] = 5;
  cases.push_back({"loops at one node", {boundary(loop), boundary(other)}});
}

void add_random(std::vector<Case>& cases) {
  for (uint64_t seed = 1; seed <= 6; ++seed) {
    Random random(seed);
    std::vector<Curve> soup;
    for (int c = 0; c < 8; ++c) {
      Curve curve;
      const size_t n = 2 + random.below(7);
      for (size_t i = 0; i < n; ++i) {
        const uint32_t node = random() < 0.3 ? static_cast<uint32_t>(random.below(6)) : WSK_NONE;
        Point p = {random(), random(), random()};
        if (node != WSK_NONE) p = {node * 0.17, node * 0.31 - 0.1, (node % 2) * 0.5};
        add(curve, p, {random() - 0.5, random() - 0.5, random()}, node);
      }
      curve.closed = random() < 0.3;
      curve.boundary = random() < 0.3;
      soup.push_back(curve);
    }
    cases.push_back({"random soup " + std::to_string(seed), soup});

    std::vector<Curve> noisy = octants();
    for (Curve& curve : noisy) {
      for (size_t i = 0; i < curve.positions.size(); ++i) {
        if (curve.nodes[i / 3] == WSK_NONE) curve.positions[i] += 0.1 * (random() - 0.5);
        curve.normals[i] += seed * 0.2 * (random() - 0.5);
      }
    }
    cases.push_back({"noisy sphere " + std::to_string(seed), noisy});
  }
}

}  // namespace

std::vector<Case> all() {
  std::vector<Case> cases;
  add_empty_and_tiny(cases);
  add_bad_numbers(cases);
  add_duplicates(cases);
  add_degenerate_shapes(cases);
  add_crossings(cases);
  add_open_ends(cases);
  add_bad_normals(cases);
  add_nests(cases);
  add_hubs(cases);
  add_random(cases);
  return cases;
}

}  // namespace hostile
