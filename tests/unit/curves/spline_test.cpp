#include "curves/spline.h"

#include <doctest/doctest.h>

#include "support/meshes.h"

using namespace unit;
using namespace wireskin::curves;
using wireskin::length;

namespace {

// A fitted spline with its memory.
struct Fitted {
  Heap heap;
  std::vector<double> knots;
  std::vector<Vec3> values, moments;
  SplineScratch scratch{heap.context};

  Fitted(std::vector<double> k, std::vector<Vec3> v, SplineEnd end, Vec3 first = {}, Vec3 last = {})
      : knots(std::move(k)), values(std::move(v)), moments(values.size(), Vec3{9, 9, 9}) {
    wireskin::Pace pace(heap.context);
    must(fit_spline(view(knots), view(values), end, first, last, &pace, span(moments), &scratch));
  }
  Spline spline() const { return {view(knots), view(values), view(moments)}; }
  Vec3 at(double t) const { return spline_value(spline(), interval(t), t); }
  Vec3 slope(double t) const { return spline_derivative(spline(), interval(t), t); }
  size_t interval(double t) const {
    size_t i = 0;
    while (i + 2 < knots.size() && knots[i + 1] <= t) ++i;
    return i;
  }
};

Vec3 cubic(double t) {
  return {1 - t + 2 * t * t - 3 * t * t * t, t * t * t, 4 - 0.5 * t * t};
}
Vec3 cubic_slope(double t) {
  return {-1 + 4 * t - 9 * t * t, 3 * t * t, -t};
}

// Knots whose spacing varies by up to `ratio`, over [0, 1].
std::vector<double> uneven(size_t n, double ratio, Random& random) {
  std::vector<double> knots = {0.0};
  for (size_t i = 1; i < n; ++i) knots.push_back(knots.back() + std::pow(ratio, 0.5 * random()));
  const double whole = knots.back();
  for (double& k : knots) k /= whole;
  return knots;
}

Vec3 circle(double t) {
  return {std::cos(t), std::sin(t), 0.0};
}

// The greatest distance of the periodic spline through n points of a circle from it.
double circle_error(size_t n) {
  std::vector<double> knots;
  std::vector<Vec3> values;
  for (size_t i = 0; i <= n; ++i) {
    knots.push_back(2 * k_pi * static_cast<double>(i) / static_cast<double>(n));
    values.push_back(circle(2 * k_pi * static_cast<double>(i % n) / static_cast<double>(n)));
  }
  const Fitted f(knots, values, SplineEnd::periodic);
  double worst = 0.0;
  for (int k = 0; k < 5000; ++k) {
    const double t = 2 * k_pi * k / 5000;
    worst = std::fmax(worst, length(f.at(t) - circle(t)));
  }
  return worst;
}

}  // namespace

TEST_CASE("spline: clamped with the exact tangents is the cubic itself") {
  Random random(1);
  for (double ratio : {1.0, 10.0, 1e4}) {
    const std::vector<double> knots = uneven(12, ratio, random);
    std::vector<Vec3> values;
    for (double t : knots) values.push_back(cubic(t));
    const Fitted f(knots, values, SplineEnd::clamped, cubic_slope(0), cubic_slope(1));
    for (int k = 0; k <= 1000; ++k) {
      const double t = k / 1000.0;
      // Relative to the values, which reach four; very uneven knots cost a digit.
      CHECK(length(f.at(t) - cubic(t)) < (ratio < 100 ? 4e-14 : 2e-13));
      if (ratio < 100) CHECK(length(f.slope(t) - cubic_slope(t)) < 1e-12);
    }
  }
}

TEST_CASE("spline: natural has no second derivative at its ends") {
  Random random(2);
  const std::vector<double> knots = uneven(9, 5.0, random);
  std::vector<Vec3> values;
  for (size_t i = 0; i < 9; ++i) values.push_back({random(), random(), random()});
  const Fitted f(knots, values, SplineEnd::natural);
  CHECK(f.moments.front() == Vec3{});
  CHECK(f.moments.back() == Vec3{});
  CHECK(length(f.moments[4]) > 1.0);
  // The slope is continuous at inner knots, which makes the moments the only right ones.
  for (size_t i = 1; i + 1 < 9; ++i) {
    const Vec3 left = spline_derivative(f.spline(), i - 1, knots[i]);
    const Vec3 right = spline_derivative(f.spline(), i, knots[i]);
    CHECK(length(left - right) < 1e-12);
  }
}

TEST_CASE("spline: natural through three points by hand") {
  // M1 = 6 (s1 - s0) / (2 (h0 + h1)) with s the slopes: here 6 (-1 - 1) / 4.
  const Fitted f({0, 1, 2}, {{0, 0, 0}, {1, 0, 0}, {0, 0, 0}}, SplineEnd::natural);
  CHECK(f.moments[1].x == doctest::Approx(-3.0).epsilon(1e-15));
  CHECK(f.at(0.5).x == doctest::Approx(0.6875).epsilon(1e-15));
}

TEST_CASE("spline: knots are met bit for bit") {
  Random random(3);
  const std::vector<double> knots = uneven(40, 1e4, random);
  std::vector<Vec3> values;
  for (size_t i = 0; i < 40; ++i) values.push_back({random(), 1e6 * random(), 1e-6 * random()});
  values.back() = values.front();
  for (SplineEnd end : {SplineEnd::natural, SplineEnd::clamped, SplineEnd::periodic}) {
    const Fitted f(knots, values, end);
    for (size_t i = 0; i < 40; ++i) {
      if (i > 0) CHECK(spline_value(f.spline(), i - 1, knots[i]) == values[i]);
      if (i < 39) CHECK(spline_value(f.spline(), i, knots[i]) == values[i]);
    }
  }
}

TEST_CASE("spline: two knots") {
  const Vec3 a = {1, 2, 3}, b = {4, 0, 3};
  const Fitted line({0, 2}, {a, b}, SplineEnd::natural);
  CHECK(length(line.at(0.5) - (0.75 * a + 0.25 * b)) < 1e-15);
  const Fitted hermite({0, 1}, {cubic(0), cubic(1)}, SplineEnd::clamped, cubic_slope(0),
                       cubic_slope(1));
  for (double t : {0.1, 0.5, 0.8}) CHECK(length(hermite.at(t) - cubic(t)) < 1e-14);
  const Fitted straight({0, 2}, {a, b}, SplineEnd::clamped,
                        parabola_tangent(view(line.knots), view(line.values), false),
                        parabola_tangent(view(line.knots), view(line.values), true));
  CHECK(length(straight.moments[0]) < 1e-14);
  CHECK(length(straight.moments[1]) < 1e-14);
}

TEST_CASE("spline: the tangents of the end parabolas are exact for parabolas") {
  const auto parabola = [](double t) { return Vec3{t * t, 1 - t, 3 * t - 2 * t * t}; };
  const std::vector<double> knots = {0.5, 1.0, 2.5, 2.75, 4.0};
  std::vector<Vec3> values;
  for (double t : knots) values.push_back(parabola(t));
  CHECK(length(parabola_tangent(view(knots), view(values), false) - Vec3{1, -1, 1}) < 1e-14);
  CHECK(length(parabola_tangent(view(knots), view(values), true) - Vec3{8, -1, -13}) < 1e-13);
}

TEST_CASE("spline: periodic is C2 across the seam") {
  Random random(4);
  for (size_t n : {4u, 5u, 12u}) {  // knots; three intervals are the fewest
    const std::vector<double> knots = uneven(n, 20.0, random);
    std::vector<Vec3> values;
    for (size_t i = 0; i < n; ++i) values.push_back({random(), random(), random()});
    values.back() = values.front();
    const Fitted f(knots, values, SplineEnd::periodic);
    CHECK(f.moments.front() == f.moments.back());
    const double scale = length(f.moments[0]) + 1.0;
    const Vec3 seam = spline_derivative(f.spline(), n - 2, knots[n - 1]) -
                      spline_derivative(f.spline(), 0, knots[0]);
    CHECK(length(seam) < 1e-13 * scale);
    for (size_t i = 1; i + 1 < n; ++i) {
      const Vec3 jump = spline_derivative(f.spline(), i - 1, knots[i]) -
                        spline_derivative(f.spline(), i, knots[i]);
      CHECK(length(jump) < 1e-12 * scale);
    }
  }
}

TEST_CASE("spline: periodic on a circle converges with order four") {
  double before = circle_error(8);
  for (size_t n = 16; n <= 128; n *= 2) {
    const double error = circle_error(n), order = std::log2(before / error);
    MESSAGE(n, " points: error ", error, ", order ", order);
    CHECK(order > 3.8);
    before = error;
  }
}

TEST_CASE("spline: the derivative is that of the value") {
  Random random(5);
  std::vector<Vec3> values;
  for (size_t i = 0; i < 6; ++i) values.push_back({random(), random(), random()});
  const Fitted f({0, 1, 1.5, 3, 4, 6}, values, SplineEnd::natural);
  for (double t : {0.3, 1.2, 2.0, 3.9, 5.5}) {
    const Vec3 difference = (1.0 / 2e-5) * (f.at(t + 1e-5) - f.at(t - 1e-5));
    CHECK(length(difference - f.slope(t)) < 1e-8);
  }
}

TEST_CASE("spline: out of memory is a status") {
  Heap heap;
  heap.allocator.fail_at = 0;
  SplineScratch scratch(heap.context);
  wireskin::Pace pace(heap.context);
  const std::vector<double> knots = {0, 1};
  const std::vector<Vec3> values(2);
  std::vector<Vec3> moments(2);
  CHECK(fit_spline(view(knots), view(values), SplineEnd::natural, {}, {}, &pace, span(moments),
                   &scratch)
            .code == Code::out_of_memory);
}
