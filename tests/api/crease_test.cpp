// Creases through the C API, against closed forms: solids with flat faces, cylinders with lids and
// caps, roofs, and a crease that dies inside the surface.
#include <doctest/doctest.h>

#include <cstring>

#include "support/crease_nets.h"
#include "support/faulty_allocator.h"
#include "support/scenes.h"

using namespace crease_nets;

namespace {

const wsk_method k_all[] = {WSK_METHOD_STANKO,  WSK_METHOD_BIHARMONIC, WSK_METHOD_TRIHARMONIC,
                            WSK_METHOD_CLAMPED, WSK_METHOD_ITERATED,   WSK_METHOD_FAIR};

Built must_build(const Net& net, wsk_method method, double spacing) {
  const Built b = build(net, method, spacing);
  REQUIRE_MESSAGE(b.status == WSK_OK, b.report.sentence);
  for (const P& n : b.normal) CHECK(std::fabs(dot(n, n) - 1) < 1e-12);
  return b;
}

double volume(const Built& b) {
  double sum = 0;
  for (size_t t = 0; t < b.triangle.size(); t += 3) {
    const P p = b.position[b.triangle[t]], q = b.position[b.triangle[t + 1]];
    const P r = b.position[b.triangle[t + 2]];
    sum += p.x * (q.y * r.z - q.z * r.y) + p.y * (q.z * r.x - q.x * r.z) +
           p.z * (q.x * r.y - q.y * r.x);
  }
  return sum / 6;
}

double cube_distance(P p) {
  const P q = turn_back(p);
  return std::fmax(std::fabs(q.x), std::fmax(std::fabs(q.y), std::fabs(q.z))) - 1;
}
double cylinder_distance(P p) {
  return std::hypot(p.x, p.y) - 1;
}
double sphere_distance(P p, double radius) {
  const double z = p.z + std::sqrt(radius * radius - 1);
  return std::sqrt(p.x * p.x + p.y * p.y + z * z) - radius;
}
bool above(P p) {
  return p.z > 1e-3;
}
bool below(P p) {
  return p.z < -1e-3;
}
// Of the can: its side and its lids, where the method does not pull the side far in.
bool on_side(P p) {
  return std::fabs(p.z) < 1 - 1e-3;
}
bool on_lid(P p) {
  return std::hypot(p.x, p.y) < 0.95 && std::fabs(p.z) > 0.9;
}
double lid_distance(P p) {
  return std::fabs(p.z) - 1;
}

}  // namespace

TEST_CASE("creases: a cube is flat with the normals of both sides, of one side, and of none") {
  for (int normals = 0; normals < 4; ++normals) {
    for (wsk_method method : k_all) {
      CAPTURE(normals);
      CAPTURE(method);
      const Built b = must_build(cube(normals), method, 0.25);
      CHECK(b.report.patches == 6);
      CHECK(b.report.euler_characteristic == 2);
      const Error e = error_of(b, cube_distance);
      CHECK(e.count > 300);
      CHECK(e.max < 1e-9);
      CHECK(volume(b) == doctest::Approx(8).epsilon(1e-9));
      for (double h : b.curvature) CHECK(std::fabs(h) < 1e-8);
    }
  }
}

TEST_CASE("creases: normals at a cube's edges are the means of its sides") {
  const Built b = must_build(cube(3), WSK_METHOD_FAIR, 0.25);
  const Built none = must_build(cube(0), WSK_METHOD_FAIR, 0.25);
  for (uint32_t v = 0; v < 8; ++v) {  // nodes come first
    const P outward = std::sqrt(1.0 / 3) * b.position[v];
    CHECK(dot(b.normal[v], outward) > 1 - 1e-9);
    CHECK(dot(b.constraint[v], outward) > 1 - 1e-9);
    CHECK(dot(none.normal[v], outward) > 1 - 1e-9);
  }
  for (size_t v = 0; v < b.position.size(); ++v) {
    const P n = b.constraint[v];
    CHECK(dot(n, n) == doctest::Approx(b.is_free(v) ? 0 : 1));
    CHECK(dot(none.constraint[v], none.constraint[v]) == 0);
  }
}

TEST_CASE("creases: a can is a cylinder as without its lids, and these are flat") {
  for (wsk_method method : {WSK_METHOD_STANKO, WSK_METHOD_ITERATED, WSK_METHOD_FAIR}) {
    CAPTURE(method);
    const Error open = error_of(must_build(can(Rim::border, 24), method, 0.1), cylinder_distance);
    const Built b = must_build(can(Rim::crease, 24), method, 0.1);
    const Error side = error_of(b, cylinder_distance, on_side);
    CHECK(side.count == open.count);
    CHECK(side.rms == doctest::Approx(open.rms).epsilon(1e-3));
    const Error lid = error_of(b, lid_distance, on_lid);
    CHECK(lid.count > 500);
    CHECK(lid.max < 1e-9);
  }
}

TEST_CASE("creases: each corner has the normal of its own side") {
  const Built b = must_build(can(Rim::crease, 24), WSK_METHOD_FAIR, 0.1);
  std::vector<uint8_t> has_sides(b.position.size(), 0);
  int lids = 0;
  for (size_t i = 0; i < b.crease_corner.size(); ++i) {
    const uint32_t corner = b.crease_corner[i];
    if (i > 0) CHECK(b.crease_corner[i - 1] < corner);
    const P p = b.position[b.triangle[corner]], n = b.crease_normal[i];
    has_sides[b.triangle[corner]] = 1;
    const bool lid = std::fabs(n.z) > 0.9;
    lids += lid;
    const P wish = lid ? P{0, 0, p.z > 0.0 ? 1.0 : -1.0} : P{p.x, p.y, 0};
    CHECK(std::fabs(dot(n, wish) - 1.0) < (lid ? 1e-9 : 1e-3));
  }
  CHECK(lids > 0);
  CHECK(lids < static_cast<int>(b.crease_corner.size()));
  // All corners of a vertex or none; the vertices of both rims and no others.
  size_t corners = 0;
  for (const uint32_t v : b.triangle) corners += has_sides[v];
  CHECK(corners == b.crease_corner.size());
  for (size_t v = 0; v < b.position.size(); ++v) {
    const P p = b.position[v];
    const double radius = std::hypot(p.x, p.y);
    const bool rim = std::fabs(radius - 1.0) < 1e-5 && std::fabs(p.z) > 1.0 - 1e-9;
    CHECK(rim == (has_sides[v] != 0));
  }
  CHECK(must_build(can(Rim::border, 24), WSK_METHOD_FAIR, 0.1).crease_corner.empty());
}

TEST_CASE("creases: a can whose lines alone have normals") {
  const Built b = must_build(can(Rim::bare_crease, 24), WSK_METHOD_FAIR, 0.1);
  CHECK(error_of(b, cylinder_distance, on_side).rms < 2e-4);
  CHECK(error_of(b, lid_distance, on_lid).max < 1e-6);
  CHECK(volume(b) == doctest::Approx(4 * k_quarter).epsilon(0.01));
}

TEST_CASE("creases: one closed sharp curve instead of four arcs") {
  Net net = can(Rim::crease, 12);
  Line circle;
  circle.closed = circle.sharp = true;
  for (size_t k = 0; k < 4; ++k) {  // the bottom arcs, each without its last sample
    const Line& arc = net.lines[k];
    const size_t n = arc.nodes.size() - 1;
    circle.nodes.insert(circle.nodes.end(), arc.nodes.begin(), arc.nodes.end() - 1);
    const auto append = [n](const std::vector<double>& from, std::vector<double>* to) {
      to->insert(to->end(), from.begin(), from.begin() + static_cast<std::ptrdiff_t>(3 * n));
    };
    append(arc.positions, &circle.positions);
    append(arc.normals, &circle.normals);
    append(arc.right, &circle.right);
  }
  net.lines.erase(net.lines.begin(), net.lines.begin() + 4);
  net.lines.push_back(circle);
  const Built b = must_build(net, WSK_METHOD_FAIR, 0.1);
  CHECK(error_of(b, cylinder_distance, on_side).rms < 2e-4);
  CHECK(error_of(b, lid_distance, on_lid).max < 1e-9);
}

// A hemisphere joins its cylinder smoothly, but their curvatures differ: as a crease with the same
// normal on both sides it is closer by far. The flatter cap meets the cylinder at 45 degrees.
TEST_CASE("creases: a spherical cap on a cylinder, joined smoothly and sharply") {
  for (double radius : {1.0, std::sqrt(2.0)}) {
    CAPTURE(radius);
    const auto sphere = [=](P p) { return sphere_distance(p, radius); };
    const auto rms = [&](Rim joint, int parts, bool cap) {
      const Built b = must_build(capped(radius, joint, parts, 24), WSK_METHOD_FAIR, 0.08);
      return cap ? error_of(b, sphere, above).rms : error_of(b, cylinder_distance, below).rms;
    };
    CHECK(rms(Rim::crease, 3, true) < 2 * rms(Rim::border, 1, true));
    CHECK(rms(Rim::crease, 3, false) < 2 * rms(Rim::border, 2, false));
    CHECK(rms(Rim::crease, 3, true) < 2e-5);
    CHECK(rms(Rim::bare_crease, 3, true) < 1e-3);
    if (radius == 1.0) {
      CHECK(rms(Rim::smooth, 3, true) < 0.01);
      CHECK(rms(Rim::smooth, 3, true) > 50 * rms(Rim::crease, 3, true));
    }
  }
}

TEST_CASE("creases: roofs, flat and steep, are two planes") {
  for (double slope : {0.0, 0.5, 5.0, 12.0}) {
    for (int normals = 0; normals < 4; ++normals) {
      for (wsk_method method : k_all) {
        CAPTURE(slope);
        CAPTURE(normals);
        CAPTURE(method);
        const Built b = must_build(roof(slope, normals), method, 0.2);
        const auto height = [=](P p) {
          const P q = turn_back(p);
          return q.z + std::fabs(q.x) * slope;
        };
        CHECK(error_of(b, height).max < 1e-9);
      }
    }
  }
}

TEST_CASE("creases: a border without normals, the ridge has them") {
  Net net = roof(0.5, 3);
  for (Line& line : net.lines) {
    if (!line.boundary) continue;
    line.sharp = true;
    line.normals.clear();
  }
  for (wsk_method method : k_all) {
    const Built b = must_build(net, method, 0.1);
    CHECK(error_of(b, [](P p) {
            const P q = turn_back(p);
            return q.z + 0.5 * std::fabs(q.x);
          }).max < 1e-9);
  }
}

TEST_CASE("creases: one that dies, at the end of a smooth curve and against one") {
  for (bool goes_on : {false, true}) {
    for (bool normals : {false, true}) {
      for (wsk_method method : {WSK_METHOD_STANKO, WSK_METHOD_ITERATED, WSK_METHOD_FAIR}) {
        CAPTURE(goes_on);
        CAPTURE(normals);
        CAPTURE(method);
        const Built b = must_build(fading(goes_on, normals, 16), method, 0.05);
        CHECK(b.report.patches == (goes_on ? 4 : 3));
        const Error e = error_of(b, [](P p) { return p.z - fading_height(p.x, p.y); });
        CHECK(e.rms < 4e-3);
        CHECK(e.max < 8e-3);
      }
    }
  }
}

// Great circles of the sphere, some of them sharp though the sphere is smooth there.
TEST_CASE("creases: sharp and smooth curves mixed on a sphere") {
  const scenes::Scene scene = scenes::octants();
  for (size_t sharp = 0; sharp <= 3; ++sharp) {
    for (bool normals : {true, false}) {
      Net net;
      for (size_t c = 0; c < 3; ++c) {
        const scenes::Curve& circle = scene.curves[c];
        Line line;
        line.positions = circle.positions;
        line.nodes = circle.nodes;
        line.closed = true;
        line.sharp = c < sharp;
        if (!line.sharp || normals) line.normals = circle.normals;
        if (line.sharp && normals) line.right = circle.normals;
        net.lines.push_back(line);
      }
      CAPTURE(sharp);
      CAPTURE(normals);
      const Built b = must_build(net, WSK_METHOD_FAIR, 0.08);
      const double rms = error_of(b, [](P p) { return std::sqrt(dot(p, p)) - 1; }).rms;
      if (normals) CHECK(rms < 5e-5);
      if (!normals && sharp < 3) CHECK(rms < 3e-3);
      if (!normals && sharp == 3) {  // nothing tells that it bulges
        CHECK(rms > 0.05);
        CHECK(rms < 0.2);
      }
    }
  }
}

TEST_CASE("creases: scaled by a power of two, the result is scaled exactly") {
  Net net = capped(std::sqrt(2.0), Rim::crease, 3, 12);
  const Built b = must_build(net, WSK_METHOD_FAIR, 0.2);
  for (Line& line : net.lines) {
    for (double& x : line.positions) x *= 1024;
  }
  const Built c = must_build(net, WSK_METHOD_FAIR, 0.2 * 1024);
  REQUIRE(b.triangle == c.triangle);
  for (size_t v = 0; v < b.position.size(); ++v) {
    CHECK(c.position[v].x == 1024 * b.position[v].x);
    CHECK(c.position[v].z == 1024 * b.position[v].z);
  }
}

TEST_CASE("creases: walked the other way, with the sides exchanged, they are the same") {
  Net net = capped(std::sqrt(2.0), Rim::crease, 3, 12);
  const Built b = must_build(net, WSK_METHOD_STANKO, 0.2);
  for (Line& line : net.lines) {
    if (!line.sharp) continue;
    const auto reverse = [](std::vector<double>* values) {
      for (size_t i = 0, j = values->size() / 3; i + 1 < j; ++i) {
        --j;
        for (size_t k = 0; k < 3; ++k) std::swap((*values)[3 * i + k], (*values)[3 * j + k]);
      }
    };
    reverse(&line.positions);
    reverse(&line.normals);
    reverse(&line.right);
    std::swap(line.normals, line.right);
    for (size_t i = 0, j = line.nodes.size() - 1; i < j; ++i, --j) {
      std::swap(line.nodes[i], line.nodes[j]);
    }
  }
  const Built c = must_build(net, WSK_METHOD_STANKO, 0.2);
  // Patches may begin at other corners, so the free vertices may differ a little.
  const auto sphere = [](P p) { return sphere_distance(p, std::sqrt(2.0)); };
  CHECK(error_of(b, sphere, above).rms ==
        doctest::Approx(error_of(c, sphere, above).rms).epsilon(0.1));
  CHECK(error_of(b, cylinder_distance, below).rms ==
        doctest::Approx(error_of(c, cylinder_distance, below).rms).epsilon(0.1));
}

TEST_CASE("creases: bad input is named") {
  const auto status = [](const Net& net) { return build(net, WSK_METHOD_STANKO, 0.25); };
  {
    Net net = cube(3);
    net.lines[5].right[7] = std::nan("");
    const Built b = status(net);
    CHECK(b.status == WSK_ERROR_NOT_A_NUMBER);
    CHECK(b.report.curve == 5);
    CHECK(b.report.sample == 2);
  }
  {
    Net net = cube(3);
    for (int k = 0; k < 3; ++k) net.lines[4].right[static_cast<size_t>(6 + k)] = 0;
    CHECK(status(net).status == WSK_ERROR_ZERO_NORMAL);
    net = cube(3);
    for (int k = 0; k < 3; ++k) net.lines[4].right[static_cast<size_t>(6 + k)] *= -1;
    const Built b = status(net);
    CHECK(b.status == WSK_ERROR_INCONSISTENT_NORMALS);
    CHECK(b.report.curve == 4);
  }
  {
    Net net = cube(0);
    net.lines[3].sharp = false;  // a smooth curve needs its normals
    const Built b = status(net);
    CHECK(b.status == WSK_ERROR_MISSING_NORMALS);
    CHECK(b.report.curve == 3);
  }
  {
    Net net = roof(0.0, 0);  // flat, and no normal anywhere: nothing tells which side is up
    for (Line& line : net.lines) {
      line.sharp = true;
      line.normals.clear();
    }
    const Built b = status(net);
    CHECK(b.status == WSK_ERROR_MISSING_NORMALS);
    CHECK(b.report.node == 1);
  }
  {
    Net net = can(Rim::crease, 8);  // the radial normals of one line turned inward
    for (double& x : net.lines[8].normals) x = -x;
    const Built b = status(net);
    CHECK(b.status == WSK_ERROR_INCONSISTENT_NORMALS);
    CHECK(b.report.node != WSK_NONE);
  }
}

TEST_CASE("creases: a point has no sides, so it cannot be sharp") {
  Net net = roof(0.5, 3);
  const P place = turn({0.5, 0.2, -0.25}), normal = turn({0.5, 0, 1});
  Line point;
  point.positions = {place.x, place.y, place.z};
  point.normals = {normal.x, normal.y, normal.z};
  point.nodes = {WSK_NONE};
  net.lines.push_back(point);
  const Built smooth = must_build(net, WSK_METHOD_STANKO, 0.1);
  for (const bool right : {false, true}) {
    net.lines.back().sharp = true;
    net.lines.back().right = right ? point.normals : std::vector<double>();
    const Built sharp = must_build(net, WSK_METHOD_STANKO, 0.1);
    REQUIRE(sharp.position.size() == smooth.position.size());
    for (size_t i = 0; i < sharp.position.size(); ++i) {
      const P apart = sharp.position[i] - smooth.position[i];
      CHECK(dot(apart, apart) == 0);
    }
  }
}

TEST_CASE("creases: memory that runs out is a status and gives everything back") {
  const Net net = can(Rim::bare_crease, 4);
  const std::vector<wsk_curve> curves = net.curves();
  for (wsk_method method : {WSK_METHOD_STANKO, WSK_METHOD_FAIR}) {
    size_t calls = 1;
    for (size_t at = scenes::FaultyAllocator::k_never, k = 0; k < 61; ++k) {
      scenes::FaultyAllocator allocator;
      allocator.fail_at = at;
      wsk_options options;
      wsk_options_init(&options, sizeof options);
      allocator.install(&options);
      options.method = method;
      options.spacing = 0.5;
      wsk_surface* surface = nullptr;
      const wsk_status status =
          wsk_build(curves.data(), curves.size(), &options, &surface, nullptr);
      CHECK(status == (k == 0 ? WSK_OK : WSK_ERROR_OUT_OF_MEMORY));
      wsk_surface_free(surface);
      CHECK(allocator.clean());
      if (k == 0) calls = allocator.calls;
      at = k * (calls - 1) / 60;
    }
  }
}
