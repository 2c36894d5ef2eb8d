// The angles of meshed regions over shapes, with holes and curves inside, whose borders are finer
// or coarser than the spacing.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <set>
#include <utility>
#include <vector>

#include "planar/polygon_mesh.h"
#include "support/context.h"

using namespace wireskin;
using namespace wireskin::planar;

namespace {

constexpr double k_pi = 3.14159265358979323846;

using Polyline = std::vector<Vec2>;

struct Shape {
  const char* name;
  std::vector<Polyline> loops, lines;
};

struct Input {
  std::vector<Vec2> points;
  std::vector<uint32_t> border, lines;
};

// The curve with its segments divided into pieces of about the given length.
Polyline divide(const Polyline& corners, double size, bool closed) {
  Polyline divided;
  const size_t segments = closed ? corners.size() : corners.size() - 1;
  for (size_t i = 0; i < segments; ++i) {
    const Vec2 a = corners[i], b = corners[(i + 1) % corners.size()];
    const int count = std::max(1, static_cast<int>(std::lround(length(b - a) / size)));
    for (int k = 0; k < count; ++k)
      divided.push_back(a + (static_cast<double>(k) / count) * (b - a));
  }
  if (!closed) divided.push_back(corners.back());
  return divided;
}

Polyline circle(Vec2 centre, double radius, double size) {
  Polyline points;
  const int count = std::max(6, static_cast<int>(std::lround(2.0 * k_pi * radius / size)));
  for (int i = 0; i < count; ++i) {
    const double t = 2.0 * k_pi * i / count;
    points.push_back(centre + radius * Vec2{std::cos(t), std::sin(t)});
  }
  return points;
}

Polyline star(double inner) {
  Polyline corners;
  for (int i = 0; i < 10; ++i) {
    const double r = i % 2 == 0 ? 1.0 : inner;
    corners.push_back({r * std::cos(0.2 * k_pi * i), r * std::sin(0.2 * k_pi * i)});
  }
  return corners;
}

Polyline turned(Polyline points, double angle) {
  for (Vec2& p : points) {
    p = {p.x * std::cos(angle) - p.y * std::sin(angle),
         p.x * std::sin(angle) + p.y * std::cos(angle)};
  }
  return points;
}

std::vector<Shape> shapes(double size) {
  const Polyline square = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  const auto loop = [&](const Polyline& corners) { return divide(corners, size, true); };
  const auto line = [&](const Polyline& corners) { return divide(corners, size, false); };
  return {
      {"square", {loop(square)}, {}},
      {"turned square", {loop(turned(square, 0.3))}, {}},
      {"disc", {circle({0, 0}, 1, size)}, {}},
      {"L", {loop({{-1, -1}, {1, -1}, {1, 0}, {0, 0}, {0, 1}, {-1, 1}})}, {}},
      {"star", {loop(star(0.4))}, {}},
      {"strip", {loop({{0, 0}, {4, 0}, {4, 0.4}, {0, 0.4}})}, {}},
      {"triangle", {loop({{0, 0}, {2, 0}, {0.7, 1.5}})}, {}},
      {"trapezium", {loop({{0, 0}, {3, 0.3}, {2.2, 1.6}, {0.3, 1.1}})}, {}},
      {"holes", {loop(square), circle({0.3, 0.3}, 0.3, size), circle({-0.5, -0.4}, 0.2, size)}, {}},
      {"lines inside",
       {loop(square)},
       {line({{-0.6, -0.6}, {0, 0.2}, {0.7, 0.3}}), line({{-0.5, 0.5}, {0.1, 0.7}})}}};
}

void append(const Polyline& curve, bool closed, std::vector<Vec2>* points,
            std::vector<uint32_t>* edges) {
  const uint32_t first = static_cast<uint32_t>(points->size());
  const uint32_t count = static_cast<uint32_t>(curve.size());
  points->insert(points->end(), curve.begin(), curve.end());
  for (uint32_t i = 0; i < (closed ? count : count - 1); ++i) {
    edges->insert(edges->end(), {first + i, first + (i + 1) % count});
  }
}

Input input_of(const Shape& shape) {
  Input input;
  for (const Polyline& loop : shape.loops) append(loop, true, &input.points, &input.border);
  for (const Polyline& line : shape.lines) append(line, false, &input.points, &input.lines);
  return input;
}

double least_angle(const Vec2 (&p)[3]) {
  double least = 180.0;
  for (int i = 0; i < 3; ++i) {
    const Vec2 u = p[(i + 1) % 3] - p[i], v = p[(i + 2) % 3] - p[i];
    least = std::min(least, std::atan2(cross(u, v), dot(u, v)) * 180.0 / k_pi);
  }
  return least;
}

// Nothing is added on a border or a curve: the edges given are edges of the mesh.
void check_given(const Input& input, const PolygonMesh& mesh) {
  REQUIRE(mesh.points.size() >= input.points.size());
  CHECK(std::memcmp(mesh.points.data(), input.points.data(), input.points.size() * sizeof(Vec2)) ==
        0);
  std::set<std::pair<uint32_t, uint32_t>> edges;
  for (size_t i = 0; i < mesh.triangles.size(); ++i) {
    const uint32_t a = mesh.triangles[i], b = mesh.triangles[i % 3 == 2 ? i - 2 : i + 1];
    edges.insert({std::min(a, b), std::max(a, b)});
  }
  size_t missing = 0;
  for (const std::vector<uint32_t>* given : {&input.border, &input.lines}) {
    for (size_t i = 0; i < given->size(); i += 2) {
      missing += 1 - edges.count(std::minmax((*given)[i], (*given)[i + 1]));
    }
  }
  CHECK(missing == 0);
}

struct Angles {
  size_t triangles = 0;
  double median = 0.0;
  double least = 180.0;  // of the triangles with a vertex that was added
};

Angles mesh_shape(const Shape& shape, double spacing) {
  const Input input = input_of(shape);
  unit::Heap heap;
  PolygonMesh mesh(heap.context);
  const Region region = {{input.points.data(), input.points.size()},
                         {input.border.data(), input.border.size()},
                         {input.lines.data(), input.lines.size()},
                         true};
  REQUIRE(mesh_region(heap.context, region, spacing, &mesh).ok());
  check_given(input, mesh);
  Angles result;
  std::vector<double> angles;
  for (size_t i = 0; i < mesh.triangles.size(); i += 3) {
    const uint32_t* v = &mesh.triangles[i];
    angles.push_back(least_angle({mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]]}));
    if (*std::max_element(v, v + 3) >= input.points.size())
      result.least = std::min(result.least, angles.back());
  }
  std::sort(angles.begin(), angles.end());
  result.triangles = angles.size();
  result.median = angles[angles.size() / 2];
  return result;
}

// Over all shapes, with borders this many times finer than the spacing.
void check_grading(double spacing, double fineness, double median, double least) {
  Angles worst = {0, 180.0, 180.0};
  for (const Shape& shape : shapes(spacing / fineness)) {
    CAPTURE(shape.name);
    CAPTURE(fineness);
    const Angles angles = mesh_shape(shape, spacing);
    CHECK(angles.median >= median);
    CHECK(angles.least >= least);
    worst = {worst.triangles + angles.triangles, std::min(worst.median, angles.median),
             std::min(worst.least, angles.least)};
  }
  std::printf("border %5.3g times finer: %6zu triangles, worst median %.2f, least angle %.1f\n",
              fineness, worst.triangles, worst.median, worst.least);
}

}  // namespace

TEST_CASE("borders as fine as the spacing and finer: medians of at least 50 degrees") {
  for (const double fineness : {1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0, 16.0}) {
    check_grading(0.08, fineness, 50.0, 27.0);
  }
}

TEST_CASE("borders coarser than the spacing: medians of at least 50 degrees where there is room") {
  check_grading(0.04, 0.5, 50.0, 27.0);
  check_grading(0.02, 0.25, 50.0, 27.0);
}

// Down to a few dozen triangles, corners and borders decide: each takes a triangle or two that no
// placing of points makes equilateral.
TEST_CASE("coarse borders of few points") {
  check_grading(0.08, 0.5, 47.5, 27.0);
  check_grading(0.08, 0.25, 45.0, 27.0);
}
