#include "curves/curve.h"

#include <doctest/doctest.h>

#include <ctime>
#include <string>

#include "support/meshes.h"

using namespace unit;
using namespace wireskin::curves;
using wireskin::dot;
using wireskin::length;

namespace {

// Samples that own their arrays.
struct Polyline {
  std::vector<Vec3> position, normal;
  std::vector<uint32_t> node;
  bool closed = false;

  void add(Vec3 p, Vec3 n = {0, 0, 1}, uint32_t number = k_none) {
    position.push_back(p);
    normal.push_back(wireskin::unit(n));
    node.push_back(number);
  }
  Samples samples() const { return {view(position), view(normal), view(node), closed}; }
  Status check() const {
    Heap heap;
    wireskin::Pace pace(heap.context);
    return check_samples(samples(), &pace);
  }
};

Polyline line(const std::vector<double>& x) {
  Polyline p;
  for (double t : x) p.add({t, 0, 0});
  return p;
}

// The unit circle at these angles, normals pointing out.
Polyline circle(const std::vector<double>& angles) {
  Polyline p;
  p.closed = true;
  for (double a : angles) {
    const Vec3 r = {std::cos(a), std::sin(a), 0};
    p.add(r, r);
  }
  return p;
}

std::vector<double> even(size_t n) {
  std::vector<double> angles;
  for (size_t i = 0; i < n; ++i)
    angles.push_back(2 * k_pi * static_cast<double>(i) / static_cast<double>(n));
  return angles;
}

struct Fitted {
  Heap heap;
  Curves curves{heap.context};

  Fitted() = default;
  explicit Fitted(const Polyline& p) { must(add_curve(p.samples(), &curves)); }
  std::vector<uint32_t> kept(size_t c = 0) const {
    const Curve curve = curves[c];
    return {curve.sample.begin(), curve.sample.end()};
  }
};

uint32_t last_knot(const Curve& c) {
  return static_cast<uint32_t>(c.arc.size() - 1);
}

double whole_length(const Curve& c) {
  return c.arc[last_knot(c)];
}

using Indices = std::vector<uint32_t>;

}  // namespace

TEST_CASE("curve: samples that cannot be fitted are named") {
  CHECK(line({0, 1}).check().ok());
  CHECK(line({}).check().code == Code::too_few_samples);
  CHECK(line({0}).check().code == Code::too_few_samples);
  Polyline two = line({0, 1});
  two.closed = true;
  CHECK(two.check().code == Code::too_few_samples);
  CHECK(line({3, 3, 3}).check().code == Code::zero_length_curve);

  Status s = line({0, 1, 2, 2, 3, 3}).check();
  CHECK(s.code == Code::duplicate_samples);
  CHECK(s.place.sample == 3);
  CHECK(s.place.curve == k_none);

  Polyline ring = circle(even(5));
  CHECK(ring.check().ok());
  ring.add(ring.position[0], ring.normal[0]);
  s = ring.check();
  CHECK(s.code == Code::duplicate_samples);
  CHECK(s.place.sample == 0);
  ring.closed = false;  // an open curve may end where it began
  CHECK(ring.check().ok());

  Polyline flip = line({0, 1, 2, 3});
  flip.normal[2] = wireskin::unit({0, 0.5, -0.8});
  s = flip.check();
  CHECK(s.code == Code::inconsistent_normals);
  CHECK(s.place.sample == 2);
  flip.normal[2] = wireskin::unit({0, 1, -0.5});
  CHECK(flip.check().ok());

  Polyline seam = circle(even(4));
  seam.normal = {{1, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-0.8, 0.6, 0}};
  s = seam.check();
  CHECK(s.code == Code::inconsistent_normals);
  CHECK(s.place.sample == 0);
  seam.closed = false;
  CHECK(seam.check().ok());
}

TEST_CASE("curve: samples near the last one kept are dropped") {
  // Mean spacing 1: below 0.5 from the last one kept goes.
  CHECK(Fitted(line({0, 0.4, 0.6, 1.05, 1.2, 6})).kept() == Indices{0, 2, 4, 5});
  CHECK(Fitted(line({0, 1, 2, 3})).kept() == Indices{0, 1, 2, 3});
  // The end stays, and pushes out the sample just before it.
  CHECK(Fitted(line({0, 1.5, 3, 3.9, 4})).kept() == Indices{0, 1, 2, 4});
  CHECK(Fitted(line({0, 9})).kept() == Indices{0, 1});
  CHECK(Fitted(line({0, 0.1, 9})).kept() == Indices{0, 2});
  CHECK(Fitted(line({0, 8.9, 9})).kept() == Indices{0, 2});
}

TEST_CASE("curve: nodes stay, however near") {
  Polyline p = line({0, 0.9, 1, 1.1, 5, 5.01, 9, 14});
  p.node[2] = 4;
  p.node[4] = 5;
  p.node[5] = 6;
  const Fitted f(p);
  CHECK(f.kept() == Indices{0, 2, 4, 5, 6, 7});
  const Curve c = f.curves[0];
  CHECK(c.node[1] == 4);
  CHECK(c.node[2] == 5);
  CHECK(c.node[3] == 6);
  CHECK(c.node[0] == k_none);
  CHECK(c.position.value[1] == p.position[2]);
}

TEST_CASE("curve: closed curves begin at their first node, and are thinned across the seam") {
  Polyline p = circle(even(8));
  Fitted plain(p);
  CHECK(plain.kept() == Indices{0, 1, 2, 3, 4, 5, 6, 7, 0});
  p.node[3] = 11;
  p.node[6] = 10;
  const Fitted turned(p);
  CHECK(turned.kept() == Indices{3, 4, 5, 6, 7, 0, 1, 2, 3});
  const Curve c = turned.curves[0];
  CHECK(c.node[0] == 11);
  CHECK(c.node[8] == 11);
  CHECK(c.node[3] == 10);

  Polyline q = circle({0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.2});
  CHECK(Fitted(q).kept() == Indices{0, 1, 2, 3, 4, 5, 0});
  q.node[6] = 1;  // now sample 0 is the one that goes
  CHECK(Fitted(q).kept() == Indices{6, 1, 2, 3, 4, 5, 6});
}

TEST_CASE("curve: too few samples left are too few, so all stay") {
  Polyline sliver = circle({0.0, 0.1, 3.0});
  CHECK(Fitted(sliver).kept() == Indices{0, 1, 2, 0});
}

// A loop from a node back to it that is shorter than half the mean spacing would collapse to one
// point twice.
TEST_CASE("curve: nodes at the same point are kept apart") {
  Polyline p = line({0, 10, 10.1, 10, 20, 30});
  p.position[2].y = 0.1;
  p.node[1] = p.node[3] = 7;
  for (int closed = 0; closed < 2; ++closed) {
    p.closed = closed == 1;
    if (p.closed) p.position[4].y = p.position[5].y = 8;
    REQUIRE(p.check().ok());
    const Fitted f(p);
    const Curve c = f.curves[0];
    for (size_t k = 1; k < c.arc.size(); ++k) {
      CHECK(c.position.knot[k] > c.position.knot[k - 1]);
      CHECK(c.arc[k] > c.arc[k - 1]);
    }
    CHECK(length(tangent_at_knot(c, 1)) > 0.0);
  }
}

// Edge crossings of a mesh come with a spacing that varies 300-fold, and a spline through all of
// them turns measured normals far from the surface's.
TEST_CASE("curve: a ratio of spacings of 300 does not swing the normals") {
  Random random(6);
  std::vector<double> angles;
  for (double a = 0.0; a < 2 * k_pi - 0.06; a += 0.05 * std::pow(300.0, -0.5 + 0.5 * random())) {
    angles.push_back(a);
  }
  Polyline p = circle(angles);
  for (Vec3& n : p.normal) n = wireskin::unit(n + 0.02 * Vec3{random(), random(), random()});
  for (Vec3& x : p.position) x += 1e-4 * Vec3{random(), random(), random()};
  const auto worst_turn = [](const Curve& c) {
    double worst = 0.0;
    for (int k = 0; k < 2000; ++k) {
      const CurvePoint q = point_at(c, 0, last_knot(c), whole_length(c) * k / 2000);
      const double cosine = dot(q.normal, wireskin::unit(q.position));
      worst = std::fmax(worst, std::acos(std::fmin(cosine, 1.0)) * 180.0 / k_pi);
    }
    return worst;
  };
  const double thinned = worst_turn(Fitted(p).curves[0]);
  for (uint32_t i = 0; i < p.node.size(); ++i) p.node[i] = i;  // nodes are never dropped
  const double plain = worst_turn(Fitted(p).curves[0]);
  MESSAGE("worst turn of a normal: ", thinned, " degrees thinned, ", plain, " plain");
  CHECK(thinned < 6.0);
  CHECK(plain > 3.0 * thinned);
}

TEST_CASE("curve: the length of a circle and of a helix") {
  const Fitted f(circle(even(200)));
  CHECK(whole_length(f.curves[0]) == doctest::Approx(2 * k_pi).epsilon(1e-8));
  Polyline helix;
  for (int i = 0; i <= 400; ++i) {
    const double t = 3.0 * k_pi * i / 400;
    helix.add({2 * std::cos(t), 2 * std::sin(t), 0.5 * t}, {std::cos(t), std::sin(t), 0});
  }
  const Fitted h(helix);
  CHECK(whole_length(h.curves[0]) == doctest::Approx(3.0 * k_pi * std::sqrt(4.25)).epsilon(1e-7));
  Polyline straight = line({0, 1, 1.75, 3});
  CHECK(whole_length(Fitted(straight).curves[0]) == doctest::Approx(3.0).epsilon(1e-15));
}

TEST_CASE("curve: points are uniform in arc length, and exact at knots") {
  Random random(7);
  Polyline p;
  for (int i = 0; i < 30; ++i) p.add({0.3 * i + 0.1 * random(), random(), random()});
  const Fitted f(p);
  const Curve c = f.curves[0];
  for (uint32_t k = 0; k <= last_knot(c); ++k) {
    CHECK(point_at(c, 0, last_knot(c), c.arc[k]).position == c.position.value[k]);
    CHECK(length(point_at(c, 0, last_knot(c), c.arc[k]).normal - c.normal.value[k]) < 1e-15);
  }
  // The chords of many points in one interval, against their share of its length.
  const uint32_t n = 20000;
  for (uint32_t knot : {0u, 7u, last_knot(c) - 1}) {
    const double from = c.arc[knot], share = (c.arc[knot + 1] - from) / n;
    double worst = 0.0;
    Vec3 before = c.position.value[knot];
    double walked = 0.0;
    for (uint32_t k = 1; k <= n; ++k) {
      const Vec3 x = point_at(c, knot, knot + 1, from + k * share).position;
      walked += length(x - before);
      worst = std::fmax(worst, std::fabs(walked - k * share));
      before = x;
    }
    MESSAGE("interval ", knot, ": worst deviation from uniform ", worst);
    CHECK(worst < 1e-3);  // the quadrature's error on wild data; below on smooth data
  }
  // On smooth data it is good to 1e-9.
  const Fitted ring(circle(even(100)));
  const Curve r = ring.curves[0];
  const double whole = whole_length(r);
  for (int k = 0; k < 1000; ++k) {
    const CurvePoint q = point_at(r, 0, last_knot(r), whole * k / 1000);
    const double angle = std::atan2(q.position.y, q.position.x);
    const double turned = angle < -1e-12 ? angle + 2 * k_pi : angle;
    CHECK(std::fabs(turned - 2 * k_pi * k / 1000) < 3e-8);
    CHECK(length(q.normal) == doctest::Approx(1.0).epsilon(1e-15));
  }
  for (int k = 0; k < 999; ++k) {
    const double a = whole * k / 1000, b = whole * (k + 1) / 1000;
    const double chord =
        length(point_at(r, 0, last_knot(r), b).position - point_at(r, 0, last_knot(r), a).position);
    CHECK(std::fabs(chord - 2 * std::sin(k_pi / 1000)) < 1e-9);
  }
}

TEST_CASE("curve: points stay on the stretch asked for") {
  Polyline p = circle(even(12));
  p.node[4] = 0;
  p.node[8] = 1;
  const Fitted f(p);
  const Curve c = f.curves[0];
  CHECK(point_at(c, 0, 4, c.arc[0]).position == p.position[4]);
  CHECK(point_at(c, 0, 4, c.arc[4]).position == p.position[8]);
  CHECK(point_at(c, 4, 12, c.arc[12]).position == p.position[4]);
  CHECK(length(point_at(c, 4, 12, 0.5 * (c.arc[4] + c.arc[12])).position - p.position[0]) < 1e-12);
}

TEST_CASE("curve: tangents at knots") {
  const Fitted f(circle(even(64)));
  const Curve c = f.curves[0];
  for (uint32_t k = 0; k <= 64; ++k) {
    const Vec3 x = c.position.value[k];
    CHECK(length(wireskin::unit(tangent_at_knot(c, k)) - Vec3{-x.y, x.x, 0}) < 1e-5);
  }
}

TEST_CASE("curve: opposite normals that cancel out give none") {
  Polyline p = line({0, 1});
  p.normal[1] = {0, 0, -1};  // what check_samples would refuse
  const Fitted f(p);
  CHECK(point_at(f.curves[0], 0, 1, 0.5).normal == Vec3{});
}

// The thin ellipse of half axes 1 and `thickness`, without samples at its tips; normals point out.
static Polyline thin_section(double thickness, size_t n) {
  Polyline p;
  p.closed = true;
  for (size_t i = 0; i < n; ++i) {
    const double a = 2 * k_pi * (static_cast<double>(i) + 0.5) / static_cast<double>(n);
    p.add({std::cos(a), thickness * std::sin(a), 0}, {thickness * std::cos(a), std::sin(a), 0});
  }
  return p;
}

TEST_CASE("curve: a tip without a sample is told from a wrong sign, and one sample mends it") {
  const auto says = [](const Polyline& p, const char* what) {
    const Status status = p.check();
    CHECK(status.code == Code::inconsistent_normals);
    return std::string(status.sentence).find(what) != std::string::npos;
  };
  for (const double thickness : {0.05, 0.03, 0.01}) {
    for (const size_t n : {12u, 24u}) {
      Polyline p = thin_section(thickness, n);
      CHECK(says(p, "give it one at the tip"));
      CHECK(p.check().place.sample == 0);
      Polyline inwards = p;
      for (Vec3& normal : inwards.normal) normal = -1.0 * normal;
      CHECK(says(inwards, "give it one at the tip"));
      p.add({1, 0, 0}, {1, 0, 0});
      CHECK(says(p, "give it one at the tip"));
      CHECK(p.check().place.sample == n / 2);  // the other tip
      const auto at = static_cast<std::ptrdiff_t>(n / 2);
      p.position.insert(p.position.begin() + at, {-1, 0, 0});
      p.normal.insert(p.normal.begin() + at, {-1, 0, 0});
      p.node.push_back(k_none);
      CHECK(p.check().ok());
    }
  }
  // A wrong sign away from the tips.
  Polyline p = thin_section(0.04, 24);
  p.position.erase(p.position.begin());
  p.normal.erase(p.normal.begin());
  p.closed = false;
  p.node.pop_back();
  p.normal[5] = -1.0 * p.normal[5];
  CHECK(says(p, "orient makes them agree"));
  // Normals that turn while the curve does not.
  Polyline q;
  for (int k = 0; k < 6; ++k) q.add({1.0 * k, 0, 0}, {k < 3 ? 0.9 : -0.9, 0, 0.43});
  CHECK(says(q, "does not turn with it"));
  CHECK(q.check().place.sample == 3);
}

TEST_CASE("curve: many curves stand one after the other, at linear cost") {
  Fitted f;
  CHECK(f.curves.size() == 0);
  const std::clock_t begin = std::clock();
  const Polyline open = line({0, 1, 2}), ring = circle(even(5));
  for (int i = 0; i < 10000; ++i) {
    must(add_curve(open.samples(), &f.curves));
    must(add_curve(ring.samples(), &f.curves));
  }
  const double seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  CHECK(seconds < 4.0);
  CHECK(f.curves.size() == 20000);
  CHECK(f.curves[19998].arc.size() == 3);
  CHECK(f.curves[19999].arc.size() == 6);
  CHECK(whole_length(f.curves[19998]) == doctest::Approx(2.0));
  CHECK(f.curves[19999].position.value[5] == ring.position[0]);
}

TEST_CASE("curve: every failed allocation is a status") {
  const Polyline p = circle(even(12));
  for (size_t at = 0;; ++at) {
    REQUIRE(at < 100);
    Heap heap;
    heap.allocator.fail_at = at;
    {
      Curves curves(heap.context);
      const Status s = add_curve(p.samples(), &curves);
      if (s.ok()) break;
      CHECK(s.code == Code::out_of_memory);
    }
    CHECK(heap.allocator.clean());
  }
}
