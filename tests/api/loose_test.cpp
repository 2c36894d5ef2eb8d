// Patches of several loops, loose curves and points, and patches that cannot be made, through the C
// API.
#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "wireskin.h"

namespace {

constexpr double k_turn = 6.283185307179586;

struct Line {
  std::vector<double> position, normal;
  std::vector<uint32_t> node;
  bool closed = false, boundary = false;
};

struct Net {
  std::vector<Line> lines;

  void circle(double x, double y, double z, double radius, bool boundary, bool outward = false) {
    Line line;
    line.closed = true;
    line.boundary = boundary;
    for (int k = 0; k < 48; ++k) {
      const double c = std::cos(k_turn * k / 48), s = std::sin(k_turn * k / 48);
      line.position.insert(line.position.end(), {x + radius * c, y + radius * s, z});
      line.normal.insert(line.normal.end(),
                         {outward ? c : 0, outward ? s : 0, outward ? 0.0 : 1.0});
      line.node.push_back(WSK_NONE);
    }
    lines.push_back(line);
  }
  // From a to b, flat but for a bump, normals up.
  void bump(double ax, double bx, double height) {
    Line line;
    for (int k = 0; k <= 20; ++k) {
      const double t = k / 20.0, x = ax + t * (bx - ax);
      line.position.insert(line.position.end(), {x, 0.3, height * std::sin(k_turn * t / 2)});
      line.normal.insert(line.normal.end(), {0, 0, 1});
      line.node.push_back(WSK_NONE);
    }
    lines.push_back(line);
  }
  void point(double x, double y, double z, bool with_normal) {
    Line line;
    line.position = {x, y, z};
    if (with_normal) line.normal = {0, 0, 1};
    line.node = {WSK_NONE};
    lines.push_back(line);
  }
};

struct Built {
  wsk_report report;
  wsk_surface* surface = nullptr;
  wsk_surface_view view;
  wsk_status status;

  explicit Built(const Net& net, bool partial = false, wsk_method method = WSK_METHOD_FAIR) {
    std::vector<wsk_curve> curves;
    for (const Line& line : net.lines) {
      wsk_curve c;
      std::memset(&c, 0, sizeof c);
      c.sample_count = line.node.size();
      c.positions = line.position.data();
      c.normals = line.normal.empty() ? nullptr : line.normal.data();
      c.nodes = line.node.data();
      c.closed = line.closed;
      c.boundary = line.boundary;
      curves.push_back(c);
    }
    wsk_options options;
    wsk_options_init(&options, sizeof options);
    options.partial = partial;
    options.method = method;
    options.spacing = 0.25;
    wsk_report_init(&report, sizeof report);
    status = wsk_build(curves.data(), curves.size(), &options, &surface, &report);
    wsk_surface_get_view(surface, &view, sizeof view);
    CAPTURE(std::string(report.sentence));
    CHECK(status == report.status);
  }
  Built(const Built&) = delete;
  ~Built() { wsk_surface_free(surface); }

  // Whether a vertex of this curve lies there.
  bool passes(double x, double y, double z, uint32_t curve) const {
    for (uint32_t v = 0; v < view.vertex_count; ++v) {
      const double* p = &view.positions[3 * v];
      const bool here = p[0] == x && p[1] == y && p[2] == z;
      if (here && view.vertex_curve[v] == curve) return true;
    }
    return false;
  }
  double greatest_height() const {
    double greatest = 0.0;
    for (uint32_t v = 0; v < view.vertex_count; ++v) {
      greatest = std::fmax(greatest, std::fabs(view.positions[3 * v + 2]));
    }
    return greatest;
  }
};

Net disc() {
  Net net;
  net.circle(0, 0, 0, 4, true);
  return net;
}

}  // namespace

TEST_CASE("loose: a point holds the surface, with a normal or without") {
  for (bool with_normal : {true, false}) {
    Net net = disc();
    net.point(1, 0.5, 0.5, with_normal);
    for (wsk_method method : {WSK_METHOD_STANKO, WSK_METHOD_ITERATED, WSK_METHOD_FAIR}) {
      const Built b(net, false, method);
      REQUIRE_MESSAGE(b.status == WSK_OK, std::string(b.report.sentence));
      CHECK(b.report.euler_characteristic == 1);
      CHECK(b.passes(1, 0.5, 0.5, 1));
      CHECK(b.greatest_height() > 0.49);
      CHECK(b.greatest_height() < 0.8);
    }
  }
}

TEST_CASE("loose: a dangling curve inside a patch holds it") {
  Net net = disc();
  net.bump(-1.5, 1.5, 0.4);
  const Built b(net);
  REQUIRE_MESSAGE(b.status == WSK_OK, std::string(b.report.sentence));
  CHECK(b.report.euler_characteristic == 1);
  CHECK(b.report.patches == 1);
  CHECK(b.report.constraint_distance_max < 1e-2);
  CHECK(b.greatest_height() == doctest::Approx(0.4).epsilon(0.15));
}

TEST_CASE("loose: what lies in no patch is named") {
  Net net = disc();
  net.point(0, 0, 0, true);
  net.point(9, 0, 0, true);
  const Built p(net);
  CHECK(p.status == WSK_ERROR_OPEN_NETWORK);
  CHECK(p.report.curve == 2);
  Net beside = disc();
  beside.bump(6, 8, 0);
  const Built c(beside);
  CHECK(c.status == WSK_ERROR_OPEN_NETWORK);
  CHECK(c.report.curve == 1);
}

TEST_CASE("loops: a hole, an inner curve, a band, a great circle") {
  Net hole = disc();
  hole.circle(1, 0.5, 0, 1, true);
  const Built h(hole);
  REQUIRE(h.status == WSK_OK);
  CHECK(h.report.euler_characteristic == 0);
  CHECK(h.report.boundary_loops == 2);
  CHECK(h.greatest_height() < 1e-9);

  Net inner = disc();
  inner.circle(1, 0.5, 0, 1, false);
  const Built i(inner);
  REQUIRE(i.status == WSK_OK);
  CHECK(i.report.patches == 2);
  CHECK(i.report.euler_characteristic == 1);

  Net band;
  band.circle(0, 0, 0, 1, true, true);
  band.circle(0, 0, 1.5, 1, true, true);
  const Built t(band);
  REQUIRE(t.status == WSK_OK);
  CHECK(t.report.euler_characteristic == 0);
  CHECK(t.view.patch_way[0] == WSK_PATCH_MINIMAL_AREA);
  double worst = 0.0;
  for (uint32_t v = 0; v < t.view.vertex_count; ++v) {
    const double* p = &t.view.positions[3 * v];
    worst = std::fmax(worst, std::fabs(std::hypot(p[0], p[1]) - 1.0));
  }
  CHECK(worst < 2e-3);

  Net sphere;
  sphere.circle(0, 0, 0, 1, false, true);
  const Built s(sphere);
  REQUIRE(s.status == WSK_OK);
  CHECK(s.report.patches == 2);
  CHECK(s.report.euler_characteristic == 2);
  CHECK(s.report.guarded_patches == 0);
  for (uint32_t v = 0; v < s.view.vertex_count; ++v) {
    const double* p = &s.view.positions[3 * v];
    worst = std::fmax(worst, std::fabs(std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]) - 1.0));
  }
  CHECK(worst < 1e-2);
}

TEST_CASE("loops that might as well have been joined otherwise are counted") {
  for (const double height : {1.5, 7.6}) {  // beyond 8 two domes have less area than the tube
    CAPTURE(height);
    Net pair;
    pair.circle(0, 0, 0, 1, true, true);
    pair.circle(0, 0, height, 1, true, true);
    const Built b(pair);
    REQUIRE_MESSAGE(b.status == WSK_OK, std::string(b.report.sentence));
    CHECK(b.report.patches == 1);
    CHECK(b.report.ambiguous_patches == (height > 7.0 ? 1 : 0));
    CHECK(b.report.first_ambiguous_patch == (height > 7.0 ? 0 : WSK_NONE));
  }
}

TEST_CASE("the normals of a dangling curve bind as those of other curves do") {
  Net net = disc();
  net.bump(-2, 2, 0.0);
  Line& line = net.lines.back();
  for (size_t i = 0; i < line.normal.size(); i += 3) {  // turned about the curve by 20 degrees
    line.normal[i + 1] = std::sin(k_turn / 18);
    line.normal[i + 2] = std::cos(k_turn / 18);
  }
  const Built b(net);
  REQUIRE(b.status == WSK_OK);
  double sum = 0.0;
  size_t count = 0;
  for (uint32_t v = 0; v < b.view.vertex_count; ++v) {
    const double *n = &b.view.normals[3 * v], *p = &b.view.positions[3 * v];
    if (b.view.vertex_curve[v] != 1 || std::fabs(p[0]) > 1.5) continue;
    const double* given = &b.view.constraint_normals[3 * v];
    sum += std::acos(std::fmin(1.0, n[0] * given[0] + n[1] * given[1] + n[2] * given[2]));
    ++count;
  }
  REQUIRE(count > 10);
  const double mean = sum / static_cast<double>(count) * 360.0 / k_turn;
  CHECK(mean < 2.0);
}

TEST_CASE("partial: patches that fail are left out and listed") {
  Net net = disc();
  Line eight;  // crosses itself
  eight.closed = eight.boundary = true;
  for (int k = 0; k < 60; ++k) {
    const double a = k_turn * (k + 0.6) / 60;
    eight.position.insert(eight.position.end(),
                          {20 + std::sin(2 * a), 0.6 * std::sin(a) + 1e-3, 0});
    eight.normal.insert(eight.normal.end(), {0, 0, 1});
    eight.node.push_back(WSK_NONE);
  }
  net.lines.insert(net.lines.begin(), eight);
  net.bump(-1.5, 0.5, 0.4);
  net.bump(0.5, 2.0, 0.3);
  net.lines[2].node.back() = net.lines[3].node.front() = 7;
  const Built strict(net);
  CHECK(strict.status == WSK_ERROR_PATCH_FOLDED);
  CHECK(strict.report.curve == 0);
  CHECK(strict.report.patch == 0);
  const Built b(net, true);
  REQUIRE_MESSAGE(b.status == WSK_OK, std::string(b.report.sentence));
  CHECK(b.report.patches == 2);
  CHECK(b.report.failed_patches == 1);
  REQUIRE(b.view.patch_count == 2);
  CHECK(b.view.patch_status[0] == WSK_ERROR_PATCH_FOLDED);
  CHECK(b.view.patch_status[1] == WSK_OK);
  CHECK(std::string(b.view.patch_sentence[0]).size() > 10);
  CHECK(std::string(b.view.patch_sentence[1]).empty());
  CHECK(b.view.patch_curve_start[1] == 1);
  CHECK(b.view.patch_curves[0] == 0);
  CHECK(b.view.patch_curves[1] == 1);
  CHECK(b.report.euler_characteristic == 1);  // the curves inside are of one piece with it
  CHECK(b.greatest_height() == doctest::Approx(0.4).epsilon(0.15));
  for (uint32_t t = 0; t < b.view.triangle_count; ++t) CHECK(b.view.triangle_patch[t] == 1);
  for (uint32_t v = 0; v < b.view.vertex_count; ++v) CHECK(b.view.positions[3 * v] < 5.0);
  Net all;
  all.lines.push_back(eight);
  CHECK(Built(all, true).status == WSK_ERROR_PATCH_FOLDED);
}

namespace {

// Along t in [0, 1], normals away from the z axis.
void add_on_tube(Net* net, bool closed, bool boundary, double (*angle)(double),
                 double (*height)(double)) {
  Line line;
  line.closed = closed;
  line.boundary = boundary;
  for (int k = 0; k < (closed ? 40 : 41); ++k) {
    const double a = angle(k / 40.0), z = height(k / 40.0);
    line.position.insert(line.position.end(), {std::cos(a), std::sin(a), z});
    line.normal.insert(line.normal.end(), {std::cos(a), std::sin(a), 0.0});
    line.node.push_back(WSK_NONE);
  }
  net->lines.push_back(line);
}

Net tube(double height) {
  Net net;
  net.circle(0, 0, 0, 1, true, true);
  net.circle(0, 0, height, 1, true, true);
  return net;
}

// How far the surface is from the cylinder of radius 1 about the z axis.
double off_the_tube(const Built& b) {
  double worst = 0.0;
  for (uint32_t v = 0; v < b.view.vertex_count; ++v) {
    const double* p = &b.view.positions[3 * v];
    worst = std::fmax(worst, std::fabs(std::hypot(p[0], p[1]) - 1.0));
  }
  return worst;
}

}  // namespace

TEST_CASE("no plane: curves and points on a tube hold it where they lie") {
  Net net = tube(2.0);
  add_on_tube(
      &net, false, false, [](double t) { return 3 * t; }, [](double t) { return 0.4 + 0.9 * t; });
  add_on_tube(
      &net, false, false, [](double t) { return 4 + t; }, [](double) { return 0.7; });
  const double bump = 1.1;
  net.point(bump * std::cos(5.5), bump * std::sin(5.5), 1.2, false);
  net.point(std::cos(3.6), std::sin(3.6), 1.5, false);
  const Built b(net);
  REQUIRE_MESSAGE(b.status == WSK_OK, std::string(b.report.sentence));
  CHECK(b.report.patches == 1);
  CHECK(b.report.minimal_area_patches == 1);
  CHECK(b.report.guarded_patches == 0);
  CHECK(b.report.euler_characteristic == 0);
  CHECK(b.report.boundary_loops == 2);
  CHECK(b.report.constraint_distance_max < 1e-2);
  CHECK(b.passes(bump * std::cos(5.5), bump * std::sin(5.5), 1.2, 4));
  CHECK(b.passes(std::cos(3.6), std::sin(3.6), 1.5, 5));
  CHECK(off_the_tube(b) < 0.13);
  CHECK(off_the_tube(b) > 0.09);
}

TEST_CASE("no plane: a closed curve on a tube is a hole where it is tagged, else a patch") {
  for (const bool boundary : {true, false}) {
    CAPTURE(boundary);
    Net net = tube(2.0);
    add_on_tube(
        &net, true, boundary, [](double t) { return 0.6 * std::cos(k_turn * t); },
        [](double t) { return 1.0 + 0.5 * std::sin(k_turn * t); });
    const Built b(net);
    REQUIRE_MESSAGE(b.status == WSK_OK, std::string(b.report.sentence));
    CHECK(b.report.patches == (boundary ? 1 : 2));
    CHECK(b.report.boundary_loops == (boundary ? 3 : 2));
    CHECK(b.report.euler_characteristic == (boundary ? -1 : 0));
    CHECK(b.report.components == 1);
    CHECK(off_the_tube(b) < 1.5e-2);
  }
}

TEST_CASE("no plane: a point tells on which side of a great circle the surface lies") {
  for (const double side : {1.0, -1.0}) {
    CAPTURE(side);
    Net net;
    net.circle(0, 0, 0, 1, true, true);
    CHECK(Built(net).status == WSK_ERROR_OPEN_NETWORK);
    net.point(0, 0, side, false);
    const Built b(net);
    REQUIRE_MESSAGE(b.status == WSK_OK, std::string(b.report.sentence));
    CHECK(b.report.euler_characteristic == 1);
    CHECK(b.passes(0, 0, side, 1));
    for (uint32_t v = 0; v < b.view.vertex_count; ++v) {
      const double* p = &b.view.positions[3 * v];
      CHECK(side * p[2] > -1e-9);
      CHECK(std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]) == doctest::Approx(1).epsilon(0.02));
    }
  }
}

TEST_CASE("no plane: points on both halves of a sphere of one circle") {
  Net net;
  net.circle(0, 0, 0, 1, false, true);
  net.point(0, 0, 1, false);
  net.point(0, 0, -1, false);
  net.point(0.6, 0, 0.8, false);
  const Built b(net);
  REQUIRE_MESSAGE(b.status == WSK_OK, std::string(b.report.sentence));
  CHECK(b.report.patches == 2);
  CHECK(b.report.euler_characteristic == 2);
  CHECK(b.passes(0, 0, 1, 1));
  CHECK(b.passes(0, 0, -1, 2));
  CHECK(b.passes(0.6, 0, 0.8, 3));
}

TEST_CASE("no plane: curves that cross without a node are named") {
  Net net = tube(2.0);
  add_on_tube(
      &net, false, false, [](double t) { return 2 * t; }, [](double t) { return 0.5 + t; });
  add_on_tube(
      &net, false, false, [](double t) { return 2 * t; }, [](double t) { return 1.4 - t; });
  const Built b(net);
  CHECK(b.status == WSK_ERROR_PATCH_FOLDED);
  CHECK((b.report.curve == 2 || b.report.curve == 3));
}

TEST_CASE("rings of one axis become bands between neighbours") {
  struct Ring {
    double height, radius;
  };
  const std::vector<std::vector<Ring>> stacks = {
      {{0, 1}, {1, 1}, {2, 1}},
      {{0, 1}, {0.8, 1.3}, {1.7, 0.6}, {2.2, 0.6}},
      {{0, 0.5}, {0.5, 1}, {1, 0.7}, {2.2, 1.2}, {3, 1}},
      {{0, 1}, {7.9, 1}},  // boundary curves cannot be closed by themselves
  };
  for (const std::vector<Ring>& stack : stacks) {
    for (const bool open : {true, false}) {
      if (!open && stack.size() == 2) continue;
      Net net;
      for (size_t i = 0; i < stack.size(); ++i) {
        const bool end = i == 0 || i + 1 == stack.size();
        net.circle(0, 0, stack[i].height, stack[i].radius, open && end, true);
      }
      const Built b(net);
      REQUIRE_MESSAGE(b.status == WSK_OK, std::string(b.report.sentence));
      CHECK(b.report.patches == stack.size() + (open ? -1 : 1));
      CHECK(b.report.components == 1);
      CHECK(b.report.euler_characteristic == (open ? 0 : 2));
      CHECK(b.report.boundary_loops == (open ? 2 : 0));
    }
  }
}

TEST_CASE("no plane: the border of a Moebius band is named, not filled with a crossing") {
  Net net;
  Line line;
  line.closed = line.boundary = true;
  for (int k = 0; k < 200; ++k) {
    const double t = k_turn * k / 200, a = 2 * t, c = std::cos(t), s = std::sin(t);
    const double r = 1 + 0.4 * c;
    line.position.insert(line.position.end(), {r * std::cos(a), r * std::sin(a), 0.4 * s});
    line.normal.insert(line.normal.end(), {s * std::cos(a), s * std::sin(a), -c});
    line.node.push_back(WSK_NONE);
  }
  net.lines.push_back(line);
  const Built b(net);
  CHECK(b.status == WSK_ERROR_PATCH_FOLDED);
  CHECK(b.report.curve == 0);
  CHECK(std::string(b.report.sentence).find("one-sided") != std::string::npos);
}

TEST_CASE("rings on top of a torus: what lies in the plane of a ring is inside it, not outside") {
  Net net;
  for (int k = 0; k < 6; ++k) {
    const double v = k_turn * k / 6, c = std::cos(v), s = std::sin(v);
    net.circle(0, 0, 2 * s, 4 + 2 * c, false);
    for (size_t i = 0; i < net.lines[k].normal.size(); i += 3) {
      const double* p = &net.lines[k].position[i];
      const double r = std::hypot(p[0], p[1]);
      net.lines[k].normal[i] = c * p[0] / r;
      net.lines[k].normal[i + 1] = c * p[1] / r;
      net.lines[k].normal[i + 2] = s;
    }
  }
  const Built b(net);
  REQUIRE_MESSAGE(b.status == WSK_OK, std::string(b.report.sentence));
  CHECK(b.report.patches == 6);
  CHECK(b.report.euler_characteristic == 0);
  double worst = 0.0;
  for (uint32_t v = 0; v < b.view.vertex_count; ++v) {
    const double* p = &b.view.positions[3 * v];
    worst = std::fmax(worst, std::fabs(std::hypot(std::hypot(p[0], p[1]) - 4, p[2]) - 2));
  }
  CHECK(worst < 0.05);
}

// A square of 2 x 2 squares of side 2, corners at the origin and (4, 4). Where `dangling` says so,
// a boundary curve runs into the square without an end there.
static Net four_squares(const std::vector<int>& dangling) {
  Net net;
  const auto line = [&net](std::vector<double> from, std::vector<double> to, bool boundary,
                           std::vector<uint32_t> nodes) {
    Line made;
    made.boundary = boundary;
    const size_t n = 8 * (nodes.size() - 1);
    for (size_t k = 0; k <= n; ++k) {
      const double t = static_cast<double>(k) / static_cast<double>(n);
      made.position.insert(made.position.end(),
                           {(1 - t) * from[0] + t * to[0], (1 - t) * from[1] + t * to[1], 0});
      made.normal.insert(made.normal.end(), {0, 0, 1});
      made.node.push_back(k % 8 == 0 ? nodes[k / 8] : WSK_NONE);
    }
    net.lines.push_back(made);
  };
  for (uint32_t i = 0; i < 3; ++i) {
    const double at = 2.0 * i;
    line({0, at}, {4, at}, i != 1, {3 * i, 3 * i + 1, 3 * i + 2});
    line({at, 0}, {at, 4}, i != 1, {i, 3 + i, 6 + i});
  }
  for (const int square : dangling) {
    const double x = 2 * (square % 2), y = 2 * (square / 2);
    const uint32_t corner = 4;  // the one in the middle
    line({2, 2}, {x + 1, y + 1}, true, {corner, WSK_NONE});
  }
  return net;
}

TEST_CASE("partial: a dangling boundary curve fails its own patch only") {
  const Net net = four_squares({2});
  const Built strict(net);
  CHECK(strict.status == WSK_ERROR_OPEN_NETWORK);
  CHECK(strict.report.curve == 6);
  const Built b(net, true);
  REQUIRE_MESSAGE(b.status == WSK_OK, std::string(b.report.sentence));
  CHECK(b.report.patches == 4);
  CHECK(b.report.failed_patches == 1);
  CHECK(b.report.euler_characteristic == 1);
  for (uint32_t p = 0; p < 4; ++p) {
    if (b.view.patch_status[p] == WSK_OK) continue;
    CHECK(b.view.patch_status[p] == WSK_ERROR_OPEN_NETWORK);
    CHECK(b.view.patch_curve_start[p + 1] - b.view.patch_curve_start[p] == 5);
    CHECK(b.view.patch_curves[b.view.patch_curve_start[p + 1] - 1] == 6);
  }
  double area = 0.0;
  for (uint32_t t = 0; t < b.view.triangle_count; ++t) {
    const double* p[3];
    for (int k = 0; k < 3; ++k) p[k] = &b.view.positions[3 * b.view.triangles[3 * t + k]];
    area += 0.5 *
            ((p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) - (p[2][0] - p[0][0]) * (p[1][1] - p[0][1]));
  }
  CHECK(std::fabs(area - 12.0) < 1e-9);
}

TEST_CASE("partial: patches that are left touch at a node, each with a vertex of its own") {
  const Built b(four_squares({0, 3}), true);
  REQUIRE_MESSAGE(b.status == WSK_OK, std::string(b.report.sentence));
  CHECK(b.report.failed_patches == 2);
  CHECK(b.report.components == 2);
  CHECK(b.report.euler_characteristic == 2);
  int at_middle = 0;
  for (uint32_t v = 0; v < b.view.vertex_count; ++v) {
    const double* p = &b.view.positions[3 * v];
    at_middle += p[0] == 2.0 && p[1] == 2.0 && p[2] == 0.0;
  }
  CHECK(at_middle == 2);
}

TEST_CASE("partial: points keep their curves when nodes of other patches go") {
  for (const int left_out : {0, 3}) {
    CAPTURE(left_out);
    Net net = four_squares({left_out});
    net.point(left_out == 0 ? 0.5 : 3.5, left_out == 0 ? 1.5 : 2.5, 0,
              true);  // goes with its patch
    net.point(3, 1, 0.1, true);
    net.point(1, 3, 0.2, false);
    const Built b(net, true);
    REQUIRE_MESSAGE(b.status == WSK_OK, std::string(b.report.sentence));
    CHECK(b.report.failed_patches == 1);
    CHECK(b.passes(3, 1, 0.1, 8));
    CHECK(b.passes(1, 3, 0.2, 9));
    // Whoever is on no curve is free.
    uint32_t free = 0;
    for (uint32_t v = 0; v < b.view.vertex_count; ++v) free += b.view.vertex_curve[v] == WSK_NONE;
    CHECK(free == b.report.free_vertices);
    for (uint32_t v = 0; v < b.view.vertex_count; ++v) CHECK(b.view.vertex_curve[v] + 1 != 8);
  }
}

TEST_CASE("partial: an inner curve that is tagged as boundary fails the patches at it") {
  Net net = four_squares({});
  Line half = net.lines[3];  // the vertical one in the middle: its lower half is tagged
  Line tagged = half;
  tagged.boundary = true;
  tagged.position.resize(3 * 9), tagged.normal.resize(3 * 9), tagged.node.resize(9);
  half.position.erase(half.position.begin(), half.position.begin() + 24);
  half.normal.erase(half.normal.begin(), half.normal.begin() + 24);
  half.node.erase(half.node.begin(), half.node.begin() + 8);
  net.lines[3] = half;
  net.lines.push_back(tagged);
  CHECK(Built(net).status == WSK_ERROR_OPEN_NETWORK);
  const Built b(net, true);
  REQUIRE_MESSAGE(b.status == WSK_OK, std::string(b.report.sentence));
  CHECK(b.report.failed_patches == 2);
  CHECK(b.report.euler_characteristic == 1);
}
