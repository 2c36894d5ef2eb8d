#include "network/smoothing.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "curves/curve.h"
#include "support/context.h"

using wireskin::Array;
using wireskin::Code;
using wireskin::k_none;
using wireskin::Span;
using wireskin::Status;
using wireskin::Vec3;
using namespace wireskin::network;
using unit::Heap;
using unit::must;
using unit::span;
using unit::view;

namespace {

constexpr double k_pi = 3.14159265358979323846;

// Normal deviates that are the same with every standard library (Box and Muller).
struct Normal {
  std::mt19937 engine;

  explicit Normal(uint32_t seed) : engine(seed) {}
  double uniform() { return (engine() + 0.5) / 4294967296.0; }
  double operator()() {
    const double radius = std::sqrt(-2.0 * std::log(uniform()));
    return radius * std::cos(2.0 * k_pi * uniform());
  }
  Vec3 vector(double sigma) {
    const double x = (*this)(), y = (*this)(), z = (*this)();
    return sigma * Vec3{x, y, z};
  }
};

// Curves with the truth at every sample. Samples with the same number are a node.
struct Scene {
  std::vector<uint32_t> start = {0}, kept_start = {0}, kept, node;
  std::vector<uint8_t> closed, corner;
  std::vector<Vec3> position, normal, true_position, true_normal;

  void add(const Vec3& p, const Vec3& n, uint32_t number = k_none) {
    kept.push_back(static_cast<uint32_t>(position.size()) - start.back());
    position.push_back(p);
    normal.push_back(n);
    node.push_back(number);
  }
  void end(bool is_closed) {
    start.push_back(static_cast<uint32_t>(position.size()));
    kept_start.push_back(static_cast<uint32_t>(kept.size()));
    closed.push_back(is_closed);
    true_position = position;
    true_normal = normal;
  }
  // The same noise for all samples of a node.
  void disturb(double sigma_position, double sigma_normal, uint32_t seed) {
    Normal random(seed);
    std::map<uint32_t, size_t> first;
    for (size_t i = 0; i < position.size(); ++i) {
      const Vec3 p = random.vector(sigma_position), n = random.vector(sigma_normal);
      const size_t from = node[i] == k_none ? i : first.insert({node[i], i}).first->second;
      position[i] = from < i ? position[from] : position[i] + p;
      normal[i] = from < i ? normal[from] : wireskin::unit(normal[i] + n);
    }
  }
  KeptSamples samples() {
    return {view(start),  view(kept_start), view(kept),     view(node),
            view(corner), view(closed),     span(position), span(normal)};
  }
  bool nodes_agree() const {
    std::map<uint32_t, size_t> first;
    for (size_t i = 0; i < position.size(); ++i) {
      if (node[i] == k_none) continue;
      const size_t from = first.insert({node[i], i}).first->second;
      if (position[from] != position[i] || normal[from] != normal[i]) return false;
    }
    return true;
  }
  double greatest_move() const {
    double most = 0.0;
    for (size_t i = 0; i < position.size(); ++i) {
      most = std::fmax(most, wireskin::length(position[i] - true_position[i]));
    }
    return most;
  }
  // Root mean square of the angle between normals and true normals.
  double normal_error() const {
    double sum = 0.0;
    for (size_t i = 0; i < normal.size(); ++i) {
      const Vec3 d = normal[i] - true_normal[i];
      sum += wireskin::dot(d, d);
    }
    return std::sqrt(sum / static_cast<double>(normal.size()));
  }
};

SmoothingReport smooth(Scene* scene, const SmoothingOptions& options = {}) {
  Heap heap;
  SmoothingReport report;
  must(smooth_samples(heap.context, scene->samples(), options, &report));
  CHECK(scene->nodes_agree());
  for (const Vec3& n : scene->normal) CHECK(std::fabs(wireskin::length(n) - 1.0) < 1e-12);
  return report;
}

Vec3 on_axes(int axis, double a) {
  const double c = std::cos(a), s = std::sin(a);
  return axis == 0 ? Vec3{0, c, s} : axis == 1 ? Vec3{s, 0, c} : Vec3{c, s, 0};
}

// Three great circles of the unit sphere with n samples each (a multiple of four) and six nodes.
Scene great_circles(uint32_t n) {
  Scene scene;
  for (int axis = 0; axis < 3; ++axis) {
    for (uint32_t i = 0; i < n; ++i) {
      Vec3 p = on_axes(axis, 2.0 * k_pi * i / n);
      uint32_t number = k_none;
      if (i % (n / 4) == 0) {
        p = {std::round(p.x), std::round(p.y), std::round(p.z)};
        number = p.x != 0 ? (p.x > 0 ? 0 : 1) : p.y != 0 ? (p.y > 0 ? 2 : 3) : p.z > 0 ? 4 : 5;
      }
      scene.add(p, p, number);
    }
    scene.end(true);
  }
  return scene;
}

Scene circle(uint32_t n, const Vec3& centre = {}) {
  Scene scene;
  for (uint32_t i = 0; i < n; ++i) {
    const Vec3 p = on_axes(2, 2.0 * k_pi * i / n);
    scene.add(p + centre, p);
  }
  scene.end(true);
  return scene;
}

// An open helix of two turns about the z axis.
Scene helix(uint32_t n) {
  Scene scene;
  for (uint32_t i = 0; i < n; ++i) {
    const double a = 4.0 * k_pi * i / (n - 1);
    scene.add(on_axes(2, a) + Vec3{0, 0, 0.2 * a}, on_axes(2, a));
  }
  scene.end(false);
  return scene;
}

double off_sphere(const std::vector<Vec3>& position) {
  double sum = 0.0;
  for (const Vec3& p : position) sum += (wireskin::length(p) - 1) * (wireskin::length(p) - 1);
  return std::sqrt(sum / static_cast<double>(position.size()));
}

double off_cylinder(const std::vector<Vec3>& position) {
  double sum = 0.0;
  for (const Vec3& p : position) sum += std::pow(std::hypot(p.x, p.y) - 1.0, 2);
  return std::sqrt(sum / static_cast<double>(position.size()));
}

void print(const char* name, const SmoothingReport& r, double sigma_p, double sigma_n,
           double before, double after) {
  std::printf(
      "%s: sigma_p %.3g (true %.3g) lambda %.2g, sigma_n %.3g (true %.3g) lambda %.2g%s; off the "
      "surface %.2e -> %.2e\n",
      name, r.sigma_position, sigma_p, r.lambda_position, r.sigma_normal, sigma_n, r.lambda_normal,
      r.filtered ? ", filtered" : "", before, after);
}

}  // namespace

TEST_CASE("noise on circles, helices and great circles is found and taken away") {
  struct Case {
    const char* name;
    Scene scene;
    double spacing;
    double (*error)(const std::vector<Vec3>&);
  };
  const Case cases[] = {{"circle", circle(200), 2.0 * k_pi / 200, off_cylinder},
                        {"helix", helix(400), 0.0321, off_cylinder},
                        {"great circles", great_circles(80), 2.0 * k_pi / 80, off_sphere}};
  for (const Case& c : cases) {
    for (const double part : {0.02, 0.1, 0.5}) {
      CAPTURE(c.name);
      CAPTURE(part);
      Scene scene = c.scene;
      const double sigma = part * c.spacing, sigma_normal = 0.05;
      scene.disturb(sigma, sigma_normal, 11);
      const double before = c.error(scene.position), normal_before = scene.normal_error();
      const SmoothingReport report = smooth(&scene);
      const double after = c.error(scene.position);
      print(c.name, report, sigma, sigma_normal, before, after);
      CHECK(std::fabs(report.sigma_position / sigma - 1.0) < 0.15);
      CHECK(std::fabs(report.sigma_normal / sigma_normal - 1.0) < 0.15);
      CHECK(after < 0.6 * before);
      CHECK(scene.normal_error() < 0.5 * normal_before);
      CHECK(report.filtered == (part > 0.25));
    }
  }
}

TEST_CASE("clean samples stay") {
  double worst = 0.0;
  for (const uint32_t n : {4u, 8u, 12u, 16u, 40u, 100u, 400u}) {
    CAPTURE(n);
    Scene scene = great_circles(n);
    smooth(&scene);
    worst = std::fmax(worst, scene.greatest_move() / (2.0 * k_pi / n));
    Scene open = helix(n);
    smooth(&open);
    worst = std::fmax(worst, open.greatest_move() / (4.0 * k_pi / n));
    CHECK(scene.normal_error() < 1e-6);
  }
  std::printf("clean: greatest move %.1e of the spacing\n", worst);
  CHECK(worst < 1e-4);
}

// Second differences of uneven samples know a smooth curve less well, so a little is taken away.
TEST_CASE("unevenly sampled clean curves hardly move") {
  Normal random(5);
  double worst = 0.0;
  for (int trial = 0; trial < 20; ++trial) {
    Scene scene;
    const uint32_t n = 60;
    for (uint32_t i = 0; i < n; ++i) {
      const Vec3 p = on_axes(2, 2.0 * k_pi * (i + 0.8 * (random.uniform() - 0.5)) / n);
      scene.add({p.x, 0.6 * p.y, 0.3 * p.x * p.y}, p);
    }
    scene.end(true);
    smooth(&scene);
    worst = std::fmax(worst, scene.greatest_move() / (2.0 * k_pi / n));
  }
  std::printf("clean, uneven: greatest move %.1e of the spacing\n", worst);
  CHECK(worst < 1e-3);
}

TEST_CASE("straight lines are as smooth as can be") {
  Scene scene;
  for (uint32_t i = 0; i < 30; ++i) scene.add({0.1 * i, 0.3 * i, 1.0}, {0, 0, 1});
  scene.end(false);
  smooth(&scene);
  CHECK(scene.greatest_move() < 1e-13);
  scene.disturb(0.01, 0.0, 3);
  const SmoothingReport report = smooth(&scene);
  for (const Vec3& p : scene.position) CHECK(std::fabs(p.z - 1.0) < 0.01);
  CHECK(report.lambda_position > 1e2);
}

TEST_CASE("noise told from outside") {
  for (const double sigma : {0.001, 0.003, 0.01}) {
    CAPTURE(sigma);
    Scene scene = great_circles(160);
    scene.disturb(sigma, 0.05, 4);
    const double before = off_sphere(scene.position);
    const SmoothingReport report = smooth(&scene, {Noise::given, sigma});
    print("given", report, sigma, 0.05, before, off_sphere(scene.position));
    CHECK(report.sigma_position == sigma);
    CHECK(off_sphere(scene.position) < 0.6 * before);
    CHECK(report.lambda_normal > 0.0);
  }
  // None given: positions stay, normals are still smoothed. The true noise found back: what is
  // taken away is what was told, whatever the truth.
  Scene scene = great_circles(160);
  scene.disturb(0.003, 0.05, 4);
  const std::vector<Vec3> position = scene.position, normal = scene.normal;
  Scene zero = scene;
  CHECK(smooth(&zero, {Noise::given, 0.0}).lambda_position == 0.0);
  CHECK(zero.position == position);
  CHECK(zero.normal != normal);
  Scene less = scene, more = scene;
  const double lambda = smooth(&less, {Noise::given, 0.002}).lambda_position;
  CHECK(smooth(&more, {Noise::given, 0.004}).lambda_position > lambda);
  Scene none = scene;
  const SmoothingReport report = smooth(&none, {Noise::none, 0.0});
  CHECK(report.sigma_normal == 0.0);
  CHECK(none.position == position);
  CHECK(none.normal == normal);
}

TEST_CASE("scaling by a power of two scales the result exactly") {
  for (const int exponent : {-41, -3, 1, 30}) {
    for (const SmoothingOptions options :
         {SmoothingOptions{}, SmoothingOptions{Noise::given, 0.004}}) {
      const double factor = std::ldexp(1.0, exponent);
      Scene scene = great_circles(40);
      scene.disturb(0.005, 0.02, 9);
      Scene scaled = scene;
      for (Vec3& p : scaled.position) p = factor * p;
      SmoothingOptions scaled_options = options;
      scaled_options.sigma *= factor;
      const SmoothingReport a = smooth(&scene, options);
      const SmoothingReport b = smooth(&scaled, scaled_options);
      CHECK(b.sigma_position == factor * a.sigma_position);
      CHECK(b.lambda_position == a.lambda_position);
      for (size_t i = 0; i < scene.position.size(); ++i) {
        CHECK(scaled.position[i] == factor * scene.position[i]);
        CHECK(scaled.normal[i] == scene.normal[i]);
      }
    }
  }
}

// The optimality conditions, with second differences written down once more: the gradient of
// sum |x - p|^2 + lambda sum s^2 |D2 x|^2 vanishes at what came out.
TEST_CASE("the result is the minimiser") {
  Scene scene = great_circles(16);
  scene.disturb(0.02, 0.05, 21);
  const std::vector<Vec3> given = scene.position;
  const SmoothingReport report = smooth(&scene);
  REQUIRE(report.lambda_position > 0.0);
  REQUIRE(!report.filtered);
  const uint32_t n = 16;
  std::vector<double> gaps;
  const auto next = [&](uint32_t i) { return i / n * n + (i + 1) % n; };
  for (uint32_t i = 0; i < 3 * n; ++i) {
    gaps.push_back(wireskin::length(given[next(i)] - given[i]));
  }
  std::vector<double> sorted = gaps;
  std::sort(sorted.begin(), sorted.end());
  const double h = sorted[sorted.size() / 2], lambda = report.lambda_position * h * h * h;
  // Unknowns: the first sample of each node, and all others.
  std::map<uint32_t, uint32_t> first;
  std::vector<uint32_t> unknown(3 * n);
  for (uint32_t i = 0; i < 3 * n; ++i) {
    unknown[i] = scene.node[i] == k_none ? i : first.insert({scene.node[i], i}).first->second;
  }
  std::vector<Vec3> gradient(3 * n);
  for (uint32_t i = 0; i < 3 * n; ++i) {
    if (unknown[i] == i) gradient[i] += scene.position[i] - given[i];
  }
  double scale = 0.0;
  for (uint32_t i = 0; i < 3 * n; ++i) {
    const uint32_t before = i, middle = next(i), after = next(middle);
    const double g = gaps[before], k = gaps[middle], s2 = 0.5 * (g + k);
    const auto& x = scene.position;
    const Vec3 d2 =
        (1.0 / s2) * ((1.0 / k) * (x[after] - x[middle]) - (1.0 / g) * (x[middle] - x[before]));
    const Vec3 a = lambda * (1.0 / g) * d2, b = lambda * (1.0 / k) * d2;
    gradient[unknown[before]] += a;
    gradient[unknown[middle]] -= a + b;
    gradient[unknown[after]] += b;
    scale = std::fmax(scale, wireskin::length(a));
  }
  for (const Vec3& gr : gradient) CHECK(wireskin::length(gr) < 1e-11 * scale);
}

TEST_CASE("corners stay where curves end or are marked") {
  // The outline of a square: four open curves, or one closed curve with marked corners.
  const uint32_t n = 40;
  const Vec3 corner[4] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  Scene open, marked;
  for (uint32_t side = 0; side < 4; ++side) {
    const Vec3 a = corner[side], b = corner[(side + 1) % 4];
    for (uint32_t i = 0; i <= n; ++i) {
      const Vec3 p = a + (static_cast<double>(i) / n) * (b - a);
      open.add(p, {0, 0, 1}, i == 0 ? side : i == n ? (side + 1) % 4 : k_none);
      if (i == n) continue;
      marked.add(p, {0, 0, 1});
      marked.corner.push_back(i == 0);
    }
    open.end(false);
  }
  marked.end(true);
  Scene rounded = marked;
  rounded.corner.clear();
  const double sigma = 0.002;
  for (Scene* scene : {&open, &marked, &rounded}) {
    scene->disturb(sigma, 0.0, 7);
    const SmoothingReport report = smooth(scene);
    std::printf("square: sigma %.2e (true %.2e), greatest move from the truth %.2e\n",
                report.sigma_position, sigma, scene->greatest_move());
  }
  const auto off_corner = [&](const Scene& scene) {
    double most = 0.0;
    for (size_t i = 0; i < scene.position.size(); ++i) {
      for (const Vec3& c : corner) {
        if (scene.true_position[i] == c) {
          most = std::fmax(most, wireskin::length(scene.position[i] - c));
        }
      }
    }
    return most;
  };
  CHECK(off_corner(open) < 2.0 * sigma);
  CHECK(off_corner(marked) < 2.0 * sigma);
  // Across a side noise all but vanishes.
  for (const Scene* scene : {&open, &marked}) {
    double sum = 0.0;
    for (const Vec3& p : scene->position) sum += p.z * p.z;
    CHECK(std::sqrt(sum / static_cast<double>(scene->position.size())) < 0.6 * sigma);
  }
}

TEST_CASE("tiny inputs stay, and odd ones do no harm") {
  Scene two, three, triangle, empty, there_and_back;
  for (int i = 0; i < 2; ++i) two.add({1.0 * i, 0.3, 0}, {0, 0, 1});
  two.end(false);
  for (int i = 0; i < 3; ++i) three.add({1.0 * i, 0.3 * i * i, 0}, {0, 0, 1});
  three.end(false);
  for (int i = 0; i < 3; ++i) triangle.add({1.0 * i, 0.3 * i * i, 0}, {0, 0, 1});
  triangle.end(true);
  // From a node out and straight back to it, twelve times: both neighbours are one unknown.
  for (int i = 0; i < 12; ++i) {
    there_and_back.add({0, 0, 0}, {0, 0, 1}, 0);
    there_and_back.add(on_axes(2, i), {0, 0, 1});
    there_and_back.add({0, 0, 0}, {0, 0, 1}, 0);
    there_and_back.end(false);
  }
  for (Scene* scene : {&two, &three, &triangle, &empty}) {
    const SmoothingReport report = smooth(scene);
    CHECK(report.lambda_position == 0.0);
    CHECK(scene->position == scene->true_position);
    CHECK(scene->normal == scene->true_normal);
  }
  smooth(&there_and_back);
  for (const Vec3& p : there_and_back.position) CHECK(std::isfinite(p.x + p.y + p.z));
  // Samples on top of each other or nearly so.
  for (const double gap : {0.0, 1e-300, 1e-12}) {
    Scene scene;
    for (int i = 0; i < 20; ++i) {
      scene.add({i + 0.1 * (i % 3), 0.1 * (i % 2), 0}, {0, 0, 1});
      scene.add({i + 0.1 * (i % 3), 0.1 * (i % 2) + gap, 0}, {0, 0, 1});
    }
    scene.end(false);
    smooth(&scene);
    for (const Vec3& p : scene.position) CHECK(std::isfinite(p.x + p.y + p.z));
  }
}

TEST_CASE("only the kept samples are read and written") {
  Scene scene = circle(100);
  scene.disturb(0.005, 0.02, 8);
  Scene fewer = scene;
  for (size_t i = 10; i < 100; i += 10) {  // one that is not kept before each tenth sample
    const size_t at = i + i / 10 - 1;
    fewer.position.insert(fewer.position.begin() + static_cast<long>(at), Vec3{7, 7, 7});
    fewer.normal.insert(fewer.normal.begin() + static_cast<long>(at), Vec3{1, 0, 0});
    fewer.node.push_back(k_none);
  }
  fewer.start.back() = static_cast<uint32_t>(fewer.position.size());
  for (uint32_t k = 0; k < 100; ++k) fewer.kept[k] = k + k / 10;
  smooth(&scene);
  smooth(&fewer);
  for (uint32_t k = 0; k < 100; ++k) CHECK(fewer.position[fewer.kept[k]] == scene.position[k]);
  CHECK(fewer.position[10] == Vec3{7, 7, 7});
}

// A circle of n samples and the given radius, and how far it is from its truth.
void add_circle(Scene* scene, uint32_t n, double radius, double noise, const Vec3& centre,
                uint32_t seed) {
  Normal random(seed);
  for (uint32_t i = 0; i < n; ++i) {
    const Vec3 p = on_axes(2, 2.0 * k_pi * i / n);
    scene->add(centre + radius * p + random.vector(noise), p);
  }
  scene->end(true);
}

double off_circle(const Scene& scene, uint32_t curve, double radius, const Vec3& centre) {
  double sum = 0.0;
  for (uint32_t i = scene.start[curve]; i < scene.start[curve + 1]; ++i) {
    const Vec3 p = scene.position[i] - centre;
    sum += std::pow(std::hypot(p.x, p.y) - radius, 2) + p.z * p.z;
  }
  return std::sqrt(sum / (scene.start[curve + 1] - scene.start[curve]));
}

TEST_CASE("every component has a noise of its own") {
  const Vec3 centre = {0, 0, 9};
  struct Case {
    const char* name;
    double large_noise, small_radius, small_noise;
  };
  // In the first and the last case the large circle's noise is more than the whole tiny circle.
  const Case cases[] = {{"quiet and tiny beside noisy", 0.01, 0.004, 0.0},
                        {"noisy and tiny beside quiet", 0.0, 0.01, 0.0002},
                        {"equally noisy", 0.005, 1.0, 0.005},
                        {"both noisy, one tiny", 0.01, 1e-4, 2e-6}};
  for (const Case& c : cases) {
    CAPTURE(c.name);
    Scene scene;
    add_circle(&scene, 200, 1.0, c.large_noise, {}, 5);
    add_circle(&scene, 60, c.small_radius, c.small_noise, centre, 6);
    const double large = off_circle(scene, 0, 1.0, {});
    const double small = off_circle(scene, 1, c.small_radius, centre);
    const SmoothingReport report = smooth(&scene);
    const double large_after = off_circle(scene, 0, 1.0, {});
    const double small_after = off_circle(scene, 1, c.small_radius, centre);
    std::printf("%s: sigma %.2e, large %.1e -> %.1e, small %.1e -> %.1e\n", c.name,
                report.sigma_position, large, large_after, small, small_after);
    const double mean =
        std::sqrt((200 * c.large_noise * c.large_noise + 60 * c.small_noise * c.small_noise) / 260);
    CHECK(std::fabs(report.sigma_position / mean - 1.0) < 0.25);
    if (c.large_noise > 0.0) {
      CHECK(large_after < 0.6 * large);
    } else {
      CHECK(large_after < 1e-6);
    }
    if (c.small_noise > 0.0) {
      CHECK(small_after < 0.6 * small);
    } else {
      CHECK(small_after < 1e-6 * c.small_radius);
    }
  }
}

TEST_CASE("a component is smoothed as if it were alone") {
  Scene alone = great_circles(40);
  alone.disturb(0.01, 0.03, 6);
  Scene scene;
  const auto add_curve = [&scene](const Scene& from, uint32_t c, uint32_t first_node,
                                  const Vec3& shift) {
    for (uint32_t i = from.start[c]; i < from.start[c + 1]; ++i) {
      const uint32_t node = from.node[i] == k_none ? k_none : from.node[i] + first_node;
      scene.add(from.position[i] + shift, from.normal[i], node);
    }
    scene.end(true);
  };
  const Scene other = circle(30);
  for (uint32_t c = 0; c < 3; ++c) {  // the curves of two components in turns
    add_curve(alone, c, 7, {});
    add_curve(other, 0, 0, {0, 0, 5.0 + c});
  }
  smooth(&alone);
  smooth(&scene);
  for (uint32_t c = 0; c < 3; ++c) {
    for (uint32_t i = 0; i < 40; ++i) {
      REQUIRE(scene.position[scene.start[2 * c] + i] == alone.position[alone.start[c] + i]);
      REQUIRE(scene.normal[scene.start[2 * c] + i] == alone.normal[alone.start[c] + i]);
    }
  }
}

TEST_CASE("where a curve would change its size its component stays") {
  Scene scene;
  add_circle(&scene, 200, 1.0, 0.005, {}, 5);
  add_circle(&scene, 24, 0.3, 0.25, {0, 0, 9}, 2);  // no circle any more
  const Scene before = scene;
  const SmoothingReport report = smooth(&scene);
  CHECK(std::fabs(report.sigma_position / 0.005 - 1.0) < 0.15);
  for (uint32_t i = 200; i < 224; ++i) CHECK(scene.position[i] == before.position[i]);
  CHECK(scene.position[0] != before.position[0]);
  Heap heap;
  SmoothingReport stated;
  CHECK(smooth_samples(heap.context, scene.samples(), {Noise::given, 0.5}, &stated).code ==
        Code::bad_argument);
}

TEST_CASE("probes for many samples find what the exact trace does") {
  Scene small = circle(16000), large = circle(17000);
  for (Scene* scene : {&small, &large}) {
    const double sigma = 0.1 * 2.0 * k_pi / static_cast<double>(scene->position.size());
    scene->disturb(sigma, 0.01, 2);
    const SmoothingReport report = smooth(scene);
    print("many", report, sigma, 0.01, 0, 0);
    CHECK(std::fabs(report.sigma_position / sigma - 1.0) < 0.03);
    CHECK(std::fabs(report.sigma_normal / 0.01 - 1.0) < 0.02);
  }
}

TEST_CASE("thinning and fitting one after the other is adding a curve") {
  Heap heap;
  Scene scene = circle(50);
  Normal random(3);
  for (Vec3& p : scene.position) p += random.vector(0.08);
  scene.node[17] = 0;
  wireskin::curves::Curves whole(heap.context), parts(heap.context);
  const wireskin::curves::Samples samples = {view(scene.position), view(scene.normal),
                                             view(scene.node), true};
  Array<uint32_t> kept(heap.context);
  wireskin::Pace pace(heap.context);
  must(wireskin::curves::add_curve(samples, &whole));
  must(wireskin::curves::thin(samples, &pace, &kept));
  must(wireskin::curves::fit_curve(samples, kept.span(), &pace, &parts));
  CHECK(kept[0] == 17);
  CHECK(kept.size() < 50);
  REQUIRE(whole.knot.size() == kept.size() + 1);
  REQUIRE(parts.knot.size() == whole.knot.size());
  for (size_t k = 0; k < whole.knot.size(); ++k) {
    CHECK(parts.knot[k] == whole.knot[k]);
    CHECK(parts.position[k] == whole.position[k]);
    CHECK(parts.position_moment[k] == whole.position_moment[k]);
    CHECK(parts.sample[k] == whole.sample[k]);
    CHECK(parts.arc[k] == whole.arc[k]);
  }
}

TEST_CASE("each allocation failed in turn") {
  Scene scene = great_circles(16);
  scene.disturb(0.12, 0.1, 1);  // enough for the filtered repeat
  const std::vector<Vec3> position = scene.position, normal = scene.normal;
  size_t allocations = 0;
  bool done = false;
  for (size_t at = 0; !done; ++at) {
    Heap heap;
    heap.allocator.fail_at = at;
    SmoothingReport report;
    const Status status = smooth_samples(heap.context, scene.samples(), {}, &report);
    CHECK(heap.allocator.clean());
    done = status.ok();
    allocations = at;
    if (done) {
      CHECK(report.filtered);
      break;
    }
    CHECK(status.code == Code::out_of_memory);
    REQUIRE(scene.position == position);
    REQUIRE(scene.normal == normal);
  }
  CHECK(allocations > 30);
}

TEST_CASE("a caller may cancel") {
  Scene scene = circle(60000);
  scene.disturb(1e-5, 0.01, 1);
  size_t checkpoints = 0;
  wireskin::Callbacks callbacks;
  callbacks.cancel = [](void* user) { return ++*static_cast<size_t*>(user) == 20 ? 1 : 0; };
  callbacks.cancel_user = &checkpoints;
  scenes::FaultyAllocator allocator;
  wireskin::Context context({&allocator.allocate, &allocator.release, &allocator}, 0, callbacks);
  SmoothingReport report;
  const std::vector<Vec3> position = scene.position;
  CHECK(smooth_samples(context, scene.samples(), {}, &report).code == Code::cancelled);
  CHECK(scene.position == position);
  CHECK(allocator.clean());
}

namespace {

// The network as Stanko's format has it: vertices with normals, then curves of vertex indices.
Scene read_net(const std::string& path, double noise, double noise_normal, uint32_t seed) {
  std::ifstream in(path);
  size_t vertices = 0, curves = 0;
  in >> vertices;
  std::vector<Vec3> position(vertices), normal(vertices);
  Normal random(seed);
  for (size_t i = 0; i < vertices; ++i) {
    in >> position[i].x >> position[i].y >> position[i].z >> normal[i].x >> normal[i].y >>
        normal[i].z;
    position[i] += random.vector(noise);
    normal[i] = wireskin::unit(wireskin::unit(normal[i]) + random.vector(noise_normal));
  }
  in >> curves;
  std::string line;
  std::vector<uint32_t> count(vertices), all;
  Scene scene;
  for (size_t c = 0; c < curves; ++c) {
    int boundary = 0;
    in >> boundary;
    std::getline(in, line);
    std::getline(in, line);
    std::vector<uint32_t> index;
    size_t used = 0;
    for (const char* s = line.c_str();;) {
      char* after = nullptr;
      const unsigned long v = std::strtoul(s, &after, 10);
      if (after == s) break;
      s = after;
      index.push_back(static_cast<uint32_t>(v));
      ++used;
    }
    const bool closed = used > 1 && index.front() == index.back();
    if (closed) index.pop_back();
    for (const uint32_t v : index) {
      ++count[v];
      scene.add(position[v], normal[v], v);
    }
    scene.end(closed);
  }
  REQUIRE(curves > 0);
  REQUIRE(!scene.position.empty());
  for (uint32_t& number : scene.node) number = count[number] > 1 ? number : k_none;
  return scene;
}

Scene thinned(Scene scene) {
  Heap heap;
  wireskin::Pace pace(heap.context);
  scene.kept.clear();
  scene.kept_start = {0};
  for (size_t c = 0; c < scene.closed.size(); ++c) {
    const size_t first = scene.start[c], n = scene.start[c + 1] - first;
    Array<uint32_t> kept(heap.context);
    must(wireskin::curves::thin(
        {view(scene.position).part(first, n), view(scene.normal).part(first, n),
         view(scene.node).part(first, n), scene.closed[c] != 0},
        &pace, &kept));
    scene.kept.insert(scene.kept.end(), kept.begin(), kept.end());
    scene.kept_start.push_back(static_cast<uint32_t>(scene.kept.size()));
  }
  return scene;
}

}  // namespace

TEST_CASE("lilium, measured curves and normals") {
  const char* folder = std::getenv("WIRESKIN_TEST_DATA");
  const std::string root = folder != nullptr && *folder != 0 ? folder : WIRESKIN_TEST_DATA;
  const std::string path = root + "/stanko-blendernet/lilium.net";
  if (root.empty() || !std::filesystem::exists(path)) {
    std::printf("skipped: lilium.net is not in WIRESKIN_TEST_DATA\n");
    return;
  }
  const double diagonal = 2.86;
  for (const double part : {0.0, 0.0005, 0.002, 0.005, 0.01}) {
    for (uint32_t seed = 1; seed < 4; ++seed) {
      CAPTURE(part);
      CAPTURE(seed);
      const double sigma = part * diagonal, sigma_normal = seed == 1 ? 0.0 : 0.0873;
      Scene scene = thinned(read_net(path, sigma, sigma_normal, seed));
      const SmoothingReport report = smooth(&scene);
      print("lilium", report, sigma, sigma_normal, 0, 0);
      if (part == 0.0) {
        CHECK(report.sigma_position == doctest::Approx(1.75e-4).epsilon(0.02));
      } else {
        CHECK(report.sigma_position == doctest::Approx(sigma).epsilon(0.15));
      }
      if (sigma_normal > 0.0) {
        CHECK(report.sigma_normal == doctest::Approx(sigma_normal).epsilon(0.1));
      } else if (part < 0.001) {
        CHECK(report.sigma_normal == doctest::Approx(0.0147).epsilon(0.15));
      }
      CHECK(report.filtered == (part >= 0.005));
    }
  }
}
