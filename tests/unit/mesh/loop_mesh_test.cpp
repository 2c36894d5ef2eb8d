#include "mesh/loop_mesh.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "mesh/mesh.h"
#include "support/faulty_allocator.h"

using namespace wireskin;
using mesh::LoopMesh;
using mesh::mesh_loop;

namespace {

constexpr double k_turn = 6.283185307179586;

struct Loop {
  std::vector<Vec3> position, normal;

  void add(const Vec3& p, const Vec3& n) {
    position.push_back(p);
    normal.push_back(unit(n));
  }
  size_t size() const { return position.size(); }
};

struct Figures {
  Status status;
  std::vector<Vec3> position;  // the loop's vertices, then the inner ones
  std::vector<uint32_t> triangle;
  size_t inner = 0;
  double area = 0.0, longest = 0.0;                       // of edges inside
  double least = 0.0, first_percent = 0.0, median = 0.0;  // least angles, degrees
  double edges_off = 0.0;  // share of edges inside beyond 0.5 to 1.5 spacings
};

double mean_edge(const Loop& loop) {
  double sum = 0.0;
  for (size_t i = 0; i < loop.size(); ++i) {
    sum += length(loop.position[(i + 1) % loop.size()] - loop.position[i]);
  }
  return sum / static_cast<double>(loop.size());
}

double least_angle_of(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 p[3] = {a, b, c};
  double least = 180.0;
  for (int k = 0; k < 3; ++k) {
    const Vec3 u = p[(k + 1) % 3] - p[k], v = p[(k + 2) % 3] - p[k];
    least = std::min(least, std::atan2(length(cross(u, v)), dot(u, v)) * 360.0 / k_turn);
  }
  return least;
}

void measure(size_t rim, double spacing, Figures* f) {
  std::vector<double> angle;
  size_t inside = 0, off = 0;
  for (size_t t = 0; t < f->triangle.size(); t += 3) {
    const uint32_t* v = &f->triangle[t];
    const Vec3 &a = f->position[v[0]], &b = f->position[v[1]], &c = f->position[v[2]];
    f->area += 0.5 * length(cross(b - a, c - a));
    angle.push_back(least_angle_of(a, b, c));
    for (int k = 0; k < 3; ++k) {
      const uint32_t p = v[k], q = v[(k + 1) % 3];
      if (p < rim && (p + 1) % rim == q) continue;
      const double edge = length(f->position[p] - f->position[q]);
      f->longest = std::max(f->longest, edge);
      ++inside;
      off += edge < 0.5 * spacing || edge > 1.5 * spacing;
    }
  }
  std::sort(angle.begin(), angle.end());
  f->least = angle[0];
  f->first_percent = angle[angle.size() / 100];
  f->median = angle[angle.size() / 2];
  f->edges_off = inside == 0 ? 0.0 : static_cast<double>(off) / static_cast<double>(inside);
}

// A manifold disc whose border is the loop, in its direction.
void check_disc(size_t rim, const Figures& f) {
  scenes::FaultyAllocator heap;
  Context context({heap.allocate, heap.release, &heap}, 0, {});
  Array<uint32_t> twins(context);
  mesh::Topology topology(context);
  const uint32_t n = static_cast<uint32_t>(f.position.size());
  const Span<const uint32_t> triangles(f.triangle.data(), f.triangle.size());
  REQUIRE(mesh::find_twins(n, triangles, &twins).ok());
  REQUIRE(mesh::find_topology(n, triangles, twins.span(), &topology).ok());
  CHECK(topology.components == 1);
  CHECK(topology.boundary_loops == 1);
  CHECK(topology.euler_characteristic == 1);
  size_t border = 0, wrong = 0;
  for (uint32_t h = 0; h < twins.size(); ++h) {
    if (twins[h] != k_none) continue;
    const uint32_t a = triangles[h], b = triangles[mesh::next_half_edge(h)];
    ++border;
    wrong += a >= rim || b != (a + 1) % rim;
  }
  CHECK(border == rim);
  CHECK(wrong == 0);
  CHECK(mesh::check_areas(context, {f.position.data(), f.position.size()}, triangles).ok());
}

Figures run(const Loop& loop, double spacing = 0.0) {
  Figures f;
  scenes::FaultyAllocator heap;
  {
    Context context({heap.allocate, heap.release, &heap}, 0, {});
    LoopMesh result(context);
    if (!(spacing > 0.0)) spacing = mean_edge(loop);
    f.status = mesh_loop(context, {loop.position.data(), loop.size()},
                         {loop.normal.data(), loop.size()}, spacing, &result);
    f.position = loop.position;
    f.inner = result.inner.size();
    f.position.insert(f.position.end(), result.inner.begin(), result.inner.end());
    f.triangle.assign(result.triangle.begin(), result.triangle.end());
  }
  CHECK(heap.clean());
  if (f.status.ok()) {
    check_disc(loop.size(), f);
    measure(loop.size(), spacing, &f);
  } else {
    CHECK(f.triangle.empty());
    CHECK(f.inner == 0);
  }
  return f;
}

Figures run_and_print(const char* name, const Loop& loop, double spacing = 0.0) {
  const Figures f = run(loop, spacing);
  MESSAGE(std::string(name) << ": loop " << loop.size() << ", inner " << f.inner << ", area "
                            << f.area << ", least angles " << f.least << " / 1 % "
                            << f.first_percent << " / median " << f.median << ", edges off "
                            << 100.0 * f.edges_off << " %");
  return f;
}

Loop circle(size_t n, double radius = 1.0) {
  Loop loop;
  for (size_t i = 0; i < n; ++i) {
    const double t = k_turn * static_cast<double>(i) / static_cast<double>(n);
    loop.add({radius * std::cos(t), radius * std::sin(t), 0.0}, {0, 0, 1});
  }
  return loop;
}

// The polygon's sides divided into pieces of about `spacing`.
Loop polygon(const std::vector<Vec3>& corners, double spacing) {
  Loop loop;
  for (size_t i = 0; i < corners.size(); ++i) {
    const Vec3 a = corners[i], b = corners[(i + 1) % corners.size()];
    const int pieces = std::max(1, static_cast<int>(std::lround(length(b - a) / spacing)));
    for (int k = 0; k < pieces; ++k) {
      loop.add(a + (static_cast<double>(k) / pieces) * (b - a), {0, 0, 1});
    }
  }
  return loop;
}

// A sheet over [0, 1]^2 seen as its border; f gives position and normal.
template <typename F>
Loop border_of_sheet(int along, int across, const F& f) {
  Loop loop;
  const auto add = [&](double u, double v) {
    const std::pair<Vec3, Vec3> point = f(u, v);
    loop.add(point.first, point.second);
  };
  for (int i = 0; i < along; ++i) add(static_cast<double>(i) / along, 0.0);
  for (int i = 0; i < across; ++i) add(1.0, static_cast<double>(i) / across);
  for (int i = 0; i < along; ++i) add(1.0 - static_cast<double>(i) / along, 1.0);
  for (int i = 0; i < across; ++i) add(0.0, 1.0 - static_cast<double>(i) / across);
  return loop;
}

// A cylinder of radius 1 cut open: the sheet winds round by `turns`.
Loop cut_ring(double turns, double height, double spacing) {
  const int along = static_cast<int>(k_turn * turns / spacing);
  return border_of_sheet(along, static_cast<int>(height / spacing), [&](double u, double v) {
    const double t = k_turn * turns * u;
    return std::make_pair(Vec3{std::cos(t), std::sin(t), height * v},
                          Vec3{std::cos(t), std::sin(t), 0.0});
  });
}

// Torus, R = 4, r = 2: the inner half of a quarter.
Loop torus_patch(double spacing) {
  return border_of_sheet(
      static_cast<int>(k_turn / 4 * 4 / spacing), static_cast<int>(k_turn / 2 * 2 / spacing),
      [](double u, double v) {
        const double a = k_turn / 4 * u, b = k_turn / 4 + k_turn / 2 * v;
        const Vec3 n = {std::cos(b) * std::cos(a), std::cos(b) * std::sin(a), std::sin(b)};
        return std::make_pair(Vec3{4 * std::cos(a), 4 * std::sin(a), 0.0} + 2.0 * n, n);
      });
}

// A closed curve on the unit sphere, star-shaped seen from the pole, as wild as `swing`.
Loop on_sphere(size_t n, double swing, std::mt19937* random) {
  std::uniform_real_distribution<double> unit_interval(-1.0, 1.0);
  double amplitude[6], phase[6];
  for (int k = 0; k < 6; ++k) {
    amplitude[k] = swing * unit_interval(*random) / (k + 1);
    phase[k] = k_turn * unit_interval(*random);
  }
  Loop loop;
  for (size_t i = 0; i < n; ++i) {
    const double t = k_turn * static_cast<double>(i) / static_cast<double>(n);
    double height = 0.0;
    for (int k = 0; k < 6; ++k) height += amplitude[k] * std::cos((k + 1) * t + phase[k]);
    const Vec3 p = unit(Vec3{std::cos(t), std::sin(t), height});
    loop.add(p, p);
  }
  return loop;
}

}  // namespace

TEST_CASE("a loop in a plane is filled exactly, facing the way of its direction") {
  const std::vector<std::pair<const char*, Loop>> loops = {
      {"circle", circle(60)},
      {"square", polygon({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, 0.07)},
      {"triangle", polygon({{0, 0, 0}, {1, 0, 0}, {0.2, 0.7, 0}}, 0.05)},
      {"sliver", polygon({{0, 0, 0}, {3, 0, 0}, {3, 0.06, 0}, {0, 0.06, 0}}, 0.05)},
      {"L", polygon({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}}, 0.1)},
      {"comb", polygon({{0, 0, 0},
                        {4, 0, 0},
                        {4, 3, 0},
                        {3, 3, 0},
                        {2.9, .4, 0},
                        {2.1, .4, 0},
                        {2, 3, 0},
                        {1, 3, 0},
                        {0.9, .4, 0},
                        {.5, .4, 0},
                        {.4, 3, 0},
                        {0, 3, 0}},
                       0.1)}};
  for (const auto& named : loops) {
    const char* const name = named.first;
    const Loop& loop = named.second;
    CAPTURE(name);
    double expected = 0.0;
    for (size_t i = 0; i < loop.size(); ++i) {
      expected += 0.5 * cross(loop.position[i], loop.position[(i + 1) % loop.size()]).z;
    }
    const Figures f = run_and_print(name, loop);
    REQUIRE(f.status.ok());
    // The sum of absolute areas is that of the polygon only if no triangle is turned over.
    CHECK(f.area == doctest::Approx(expected).epsilon(1e-9));
    for (size_t t = 0; t < f.triangle.size(); t += 3) {
      const Vec3 &a = f.position[f.triangle[t]], &b = f.position[f.triangle[t + 1]];
      CHECK(cross(b - a, f.position[f.triangle[t + 2]] - a).z > 0.0);
    }
    CHECK(f.least > 15.0);
    CHECK(f.median > 40.0);
    CHECK(f.edges_off < 0.05);
  }
}

TEST_CASE("the smallest loops") {
  const Figures three = run(circle(3));
  CHECK(three.triangle.size() == 3);
  CHECK(three.inner == 0);
  CHECK(run(circle(4)).status.ok());
  CHECK(run(circle(5)).status.ok());
  for (size_t n = 6; n < 40; ++n) CHECK(run(circle(n)).area > 0.0);
}

TEST_CASE("a saddle-shaped loop: area near that of the least surface") {
  // Over the circle z = a cos 2t is spanned by z = a (x^2 - y^2), a minimal surface up to O(a^4).
  const double a = 0.3;
  Loop loop;
  for (int i = 0; i < 100; ++i) {
    const double t = k_turn * i / 100;
    loop.add({std::cos(t), std::sin(t), a * std::cos(2 * t)},
             {-2 * a * std::cos(t), 2 * a * std::sin(t), 1});
  }
  const Figures f = run_and_print("saddle", loop);
  REQUIRE(f.status.ok());
  double expected = 0.0;  // integral of sqrt(1 + 4 a^2 r^2) r dr dt
  for (int i = 0; i < 1000; ++i) {
    const double r = (i + 0.5) / 1000;
    expected += k_turn * std::sqrt(1 + 4 * a * a * r * r) * r / 1000;
  }
  CHECK(f.area > 0.99 * expected);
  CHECK(f.area < 1.03 * expected);
  CHECK(f.least > 15.0);
}

TEST_CASE("loops that no plane can take: rings cut open, the torus, hemispheres") {
  for (double turns : {0.7, 0.95}) {
    for (double height : {0.3, 1.0}) {
      const Figures f = run_and_print("cut ring", cut_ring(turns, height, 0.05));
      REQUIRE(f.status.ok());
      // The strip itself, and not the discs above and below.
      CHECK(f.area < 1.05 * k_turn * turns * height);
      CHECK(f.area > 0.8 * k_turn * turns * height);
      CHECK(f.least > 15.0);
    }
  }
  const Figures torus = run_and_print("torus, inner half", torus_patch(0.2));
  REQUIRE(torus.status.ok());
  CHECK(torus.least > 15.0);

  // A great circle with radial normals, either way round: the mean normal is zero.
  Loop there = circle(80);
  there.normal = there.position;
  Loop back = there;
  std::reverse(back.position.begin(), back.position.end());
  std::reverse(back.normal.begin(), back.normal.end());
  const Figures f = run_and_print("hemisphere", there), g = run_and_print("other one", back);
  REQUIRE(f.status.ok());
  REQUIRE(g.status.ok());
  CHECK(f.area == doctest::Approx(40 * std::sin(k_turn / 80)));
  CHECK(g.area == doctest::Approx(40 * std::sin(k_turn / 80)));
  CHECK(f.least > 15.0);
}

TEST_CASE("long loops cost no more than their points") {
  Loop coil;  // a ribbon that winds up a cylinder: long, narrow, far from any plane
  coil = border_of_sheet(2480, 20, [](double u, double v) {
    const double t = 3 * k_turn * u;
    return std::make_pair(Vec3{std::cos(t), std::sin(t), u + 0.15 * v},
                          Vec3{std::cos(t), std::sin(t), 0});
  });
  const Figures ribbon = run_and_print("ribbon", coil);
  REQUIRE(ribbon.status.ok());
  CHECK(ribbon.area == doctest::Approx(0.15 * 3 * k_turn).epsilon(0.05));
  CHECK(ribbon.first_percent > 20.0);
  const Figures disc = run_and_print("disc", circle(2000), 0.03);
  REQUIRE(disc.status.ok());
  CHECK(disc.area == doctest::Approx(1000 * std::sin(k_turn / 2000)));
  CHECK(disc.least > 15.0);
}

TEST_CASE("random loops on a sphere") {
#ifdef WIRESKIN_TESTS_SANITIZED
  constexpr int k_rounds = 10;
#else
  constexpr int k_rounds = 40;
#endif
  std::mt19937 random(20261);
  double least = 90.0, first_percent = 90.0;
  for (int round = 0; round < k_rounds; ++round) {
    const Loop loop = on_sphere(20 + random() % 300, 0.1 * (1 + round % 10), &random);
    const Figures f = run(loop);
    REQUIRE(f.status.ok());
    CHECK(f.area > 0.5);
    CHECK(f.area < 2 * k_turn);
    least = std::min(least, f.least);
    first_percent = std::min(first_percent, f.first_percent);
  }
  MESSAGE("least angle " << least << ", worst 1 % " << first_percent);
  CHECK(first_percent > 10.0);
}

TEST_CASE("uneven loops: sizes are graded from fine edges to the spacing") {
  Loop loop = polygon({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, 0.1);
  Loop fine;
  for (size_t i = 0; i < loop.size(); ++i) {
    const Vec3 a = loop.position[i], b = loop.position[(i + 1) % loop.size()];
    const int pieces = i < 5 ? 20 : 1;
    for (int k = 0; k < pieces; ++k)
      fine.add(a + (k / static_cast<double>(pieces)) * (b - a), {0, 0, 1});
  }
  const Figures f = run_and_print("fine rim", fine, 0.1);
  REQUIRE(f.status.ok());
  CHECK(f.area == doctest::Approx(1.0));
  CHECK(f.least > 5.0);  // an edge beside one of a twentieth leaves no better
  CHECK(f.inner < 1500);
  const Figures inwards = run_and_print("coarse rim", circle(24), 0.03);
  REQUIRE(inwards.status.ok());
  CHECK(inwards.least > 15.0);
  CHECK(inwards.longest < 0.45);
}

TEST_CASE("degenerate loops: a status or a disc, never a hang") {
  Loop line;
  for (int i = 0; i < 10; ++i) line.add({0.1 * i, 0, 0}, {0, 0, 1});
  for (int i = 10; i > 0; --i) line.add({0.1 * i, 0, 0}, {0, 0, 1});
  CHECK(run(line, 0.1).status.code == Code::patch_folded);

  Loop there_and_back;  // retraces itself on a curve
  for (int i = 0; i <= 20; ++i) there_and_back.add({0.1 * i, 0.01 * i * i, 0}, {0, 0, 1});
  for (int i = 19; i > 0; --i) there_and_back.add({0.1 * i, 0.01 * i * i, 0}, {0, 0, 1});
  run(there_and_back, 0.1);

  Loop repeated = circle(12);
  repeated.position[5] = repeated.position[4];
  CHECK(run(repeated, 0.1).status.code == Code::patch_folded);
  Loop point = circle(12);
  for (Vec3& p : point.position) p = {1, 2, 3};
  CHECK(run(point, 0.1).status.code == Code::patch_folded);
  Loop two;
  two.add({0, 0, 0}, {0, 0, 1});
  two.add({1, 0, 0}, {0, 0, 1});
  CHECK(run(two, 0.1).status.code == Code::patch_folded);
  Loop not_a_number = circle(12);
  not_a_number.position[3].x = std::nan("");
  CHECK(!run(not_a_number, 0.1).status.ok());
  CHECK(run(circle(12), -1.0 / 0.0 * 0.0).status.ok());  // the helper takes the mean edge instead
  CHECK(run(circle(12), 1e-9).status.code == Code::too_large);

  Loop eight;  // touches itself in a vertex
  for (int i = 0; i < 40; ++i) {
    const double t = k_turn * i / 40;
    eight.add({std::sin(t), std::sin(t) * std::cos(t), 0}, {0, 0, 1});
  }
  run(eight);
  Loop spikes;  // leaps to and fro
  for (int i = 0; i < 60; ++i) {
    const double t = k_turn * i / 60, r = i % 2 == 0 ? 1.0 : 1e-3;
    spikes.add({r * std::cos(t), r * std::sin(t), 0.1 * (i % 3)}, {0, 0, 1});
  }
  run(spikes);
  Loop tiny = circle(30);  // one part in a million millions
  for (int i = 0; i < 12; ++i) {
    tiny.position[static_cast<size_t>(i)] = {1.0, 1e-12 * i, 1e-13 * i * i};
  }
  run(tiny);

  std::mt19937 random(5);
  std::uniform_real_distribution<double> coordinate(-1.0, 1.0);
  for (int round = 0; round < 100; ++round) {  // no shape at all, some on a coarse lattice
    Loop loop;
    const size_t n = 3 + random() % 60;
    const double cells = round % 2 == 0 ? 1e9 : 2.0;
    for (size_t i = 0; i < n; ++i) {
      const auto snapped = [&] { return std::floor(cells * coordinate(random)) / cells; };
      loop.add({snapped(), snapped(), round % 3 == 0 ? 0.0 : snapped()},
               {coordinate(random), coordinate(random), coordinate(random)});
    }
    const Figures f = run(loop, 0.3);
    CHECK((f.status.ok() || f.status.code == Code::patch_folded));
  }
}

TEST_CASE("each allocation failed in turn, and a cancel at each checkpoint") {
  Loop loop = cut_ring(0.9, 0.5, 0.1);
  const auto call = [&](scenes::FaultyAllocator* heap, const Callbacks& callbacks,
                        std::vector<uint32_t>* triangles) {
    Context context({heap->allocate, heap->release, heap}, 0, callbacks);
    LoopMesh result(context);
    const Status status = mesh_loop(context, {loop.position.data(), loop.size()},
                                    {loop.normal.data(), loop.size()}, 0.1, &result);
    triangles->assign(result.triangle.begin(), result.triangle.end());
    return status;
  };
  scenes::FaultyAllocator counting;
  std::vector<uint32_t> expected, triangles;
  REQUIRE(call(&counting, {}, &expected).ok());
  CHECK(counting.clean());
  for (size_t k = 0; k < counting.calls; ++k) {
    scenes::FaultyAllocator heap;
    heap.fail_at = k;
    CHECK(call(&heap, {}, &triangles).code == Code::out_of_memory);
    CHECK(triangles.empty());
    CHECK(heap.clean());
  }
  for (int k = 0;; ++k) {
    int left = k;
    Callbacks callbacks;
    callbacks.cancel_user = &left;
    callbacks.cancel = [](void* user) { return (*static_cast<int*>(user))-- == 0 ? 1 : 0; };
    scenes::FaultyAllocator heap;
    const Status status = call(&heap, callbacks, &triangles);
    CHECK(heap.clean());
    if (status.ok()) {
      CHECK(k > 10);
      break;
    }
    REQUIRE(status.code == Code::cancelled);
    CHECK(triangles.empty());
  }
  CHECK(triangles == expected);  // and the same bits, whatever the memory held before
}

TEST_CASE("loop mesh: where the spacing leaves needles it is coarser, and says so") {
  std::mt19937 random(4);
  const auto uniform = [&random] { return random() / 4294967296.0; };
#ifdef WIRESKIN_TESTS_SANITIZED
  constexpr int k_strips = 8;
#else
  constexpr int k_strips = 25;
#endif
  int coarse = 0;
  for (int k = 0; k < k_strips; ++k) {
    // A bent strip with noise, a few of its edges far shorter than the others.
    Loop loop;
    const double width = 0.002 + 0.05 * uniform();
    for (int side = 0; side < 2; ++side) {
      for (int i = 0; i < 24; ++i) {
        const double t = (side == 0 ? i : 23 - i) / 23.0;
        const Vec3 p = {t + 0.01 * uniform(), side * width, 0.3 * t * t + 0.004 * uniform()};
        loop.add(p, {-0.6 * t, 0, 1});
        for (int extra = 0; extra < 2 && uniform() < 0.15; ++extra) {
          const double d = 1e-4 * (1 + extra) * (side == 0 ? 1 : -1);
          loop.add(p + Vec3{d, 1e-5 * uniform(), 1e-4 * uniform()}, {-0.6 * t, 0, 1});
        }
      }
    }
    scenes::FaultyAllocator heap;
    Context context({heap.allocate, heap.release, &heap}, 0, {});
    LoopMesh mesh(context);
    const double spacing = 0.5 * mean_edge(loop);
    const Status status = mesh_loop(context, {loop.position.data(), loop.size()},
                                    {loop.normal.data(), loop.size()}, spacing, &mesh);
    REQUIRE_MESSAGE(status.ok(), std::string(status.sentence));
    coarse += mesh.coarse;
    size_t flat = 0;
    for (size_t t = 0; t < mesh.triangle.size(); t += 3) {
      Vec3 p[3];
      for (size_t c = 0; c < 3; ++c) {
        const uint32_t v = mesh.triangle[t + c];
        p[c] = v < loop.size() ? loop.position[v] : mesh.inner[v - loop.size()];
      }
      flat += !(length(cross(p[1] - p[0], p[2] - p[0])) > 0.0);
    }
    CHECK(flat == 0);
  }
  CHECK(coarse > 0);
  CHECK(coarse < k_strips);
}
