#include <doctest/doctest.h>

#include <cmath>

#include "cli/support.h"
#include "read_network.h"

using namespace wireskin_cli;
using namespace cli_test;

static const std::string k_vertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\nvn 0 0 1\nvn 0 1 0\nvn 1 0 0\n";

static std::string complaint(const std::string& text) {
  return failure_of([&] { read_obj("f.obj", text); });
}

TEST_CASE("vertices, normals and curves in every notation") {
  const Network network = read_obj("f.obj", "# a comment\r\nmtllib nothing\r\n" + k_vertices +
                                                "l 1 2 3 1\n"
                                                "l 1/5 2/6 \\\n 3/7\n"
                                                "l -3 -1 # back\n");
  CHECK(network.positions == std::vector<double>{0, 0, 0, 1, 0, 0, 1, 1, 0});
  CHECK(network.normals == std::vector<double>{0, 0, 1, 0, 1, 0, 1, 0, 0});
  REQUIRE(network.curves.size() == 3);
  CHECK(network.curves[0].closed);
  CHECK(network.curves[0].vertices == std::vector<uint32_t>{0, 1, 2});
  CHECK_FALSE(network.curves[1].closed);
  CHECK(network.curves[1].vertices == std::vector<uint32_t>{0, 1, 2});
  CHECK(network.curves[2].vertices == std::vector<uint32_t>{0, 2});
  CHECK(network.curves[2].line == 12);
  CHECK(network.vertex_lines[0] == 3);
}

TEST_CASE("colours and weights behind a vertex are passed over") {
  CHECK(read_obj("f.obj", "v 1 2 3 1\nv 4 5 6 0.1 0.2 0.3\nl 1 2\n").positions ==
        std::vector<double>{1, 2, 3, 4, 5, 6});
}

TEST_CASE("curves may name vertices that come later, and vertices may be unused") {
  CHECK(read_obj("f.obj", "l 1 2\nv 0 0 0\nv 1 0 0\nv 5 5 5\n").curves.size() == 1);
}

TEST_CASE("curves under a name with boundary, until the next name") {
  const Network network = read_obj("f.obj", k_vertices +
                                                "l 1 2\n"
                                                "g outer_BOUNDARY_1\nl 2 3\nl 1 3\n"
                                                "o inner\nl 1 2\n"
                                                "g red Boundary\nl 1 2\n"
                                                "g\nl 1 2\n");
  std::vector<bool> boundary;
  for (const NetworkCurve& curve : network.curves) boundary.push_back(curve.boundary);
  CHECK(boundary == std::vector<bool>{false, true, true, false, true, false});
}

TEST_CASE("curves under a name with sharp, until the next name") {
  const Network network = read_obj(
      "f.obj", k_vertices + "l 1 2\no Sharp_edges\nl 2 3\ng sharp boundary\nl 1 3\ng\nl 1 2\n");
  std::vector<bool> sharp, boundary;
  for (const NetworkCurve& curve : network.curves) {
    sharp.push_back(curve.sharp);
    boundary.push_back(curve.boundary);
  }
  CHECK(sharp == std::vector<bool>{false, true, true, false});
  CHECK(boundary == std::vector<bool>{false, false, true, false});
}

TEST_CASE("every complaint about a line names it") {
  CHECK(complaint("v 1 2\nl 1 1\n") == "f.obj:1: 2 coordinates where 3 are needed");
  CHECK(complaint("v 1 2 3\nvn 0 0\n") == "f.obj:2: 2 components of a normal where 3 are needed");
  CHECK(complaint("v 1 2 1,5\n") == "f.obj:1: \"1,5\" is not a number");
  CHECK(complaint(k_vertices + "l 1 4\n") ==
        "f.obj:7: vertex index 4 is out of range, the file has 3 vertices, which count from 1 in "
        "OBJ");
  CHECK(complaint(k_vertices + "l 1 -4\n") ==
        "f.obj:7: vertex index -4 is out of range, only 3 vertices stand before it");
  CHECK(complaint(k_vertices + "l 0 1\n") ==
        "f.obj:7: \"0\" is not a vertex index, which count from 1 in OBJ");
  CHECK(complaint(k_vertices + "l 1 b\n") ==
        "f.obj:7: \"b\" is not a vertex index, which count from 1 in OBJ");
  CHECK(complaint(k_vertices + "l 1 99999999999\n") ==
        "f.obj:7: \"99999999999\" is not a vertex index, which count from 1 in OBJ");
  CHECK(complaint(k_vertices + "l 1\n") ==
        "f.obj:7: a curve (l) needs at least two vertex indices");
}

TEST_CASE("complaints about the whole file") {
  CHECK(complaint(k_vertices + "f 1 2 3\n") ==
        "f.obj: a mesh of triangles (f) without curves: the curves must be given as l");
  CHECK(complaint(k_vertices) == "f.obj: no curve (l, curv or f) in this file");
  CHECK(complaint("v 0 0 0\nv 1 0 0\nvn 0 0 1\nl 1 2\n") ==
        "f.obj: 1 normals (vn) for 2 vertices (v): each vertex needs one, in the same order");
  CHECK(read_obj("f.obj", "v 0 0 0\nv 1 0 0\nl 1 2\n").normals.empty());
}

static const std::string k_square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 2 1 0\n";

TEST_CASE("faces are loops where no curve is given, and share their edges") {
  const Network one = read_obj("f.obj", k_square + "g rim boundary\nf 1 2 3 4\n");
  REQUIRE(one.curves.size() == 1);
  CHECK(one.curves[0].closed);
  CHECK(one.curves[0].boundary);
  CHECK(one.curves[0].name == "rim boundary");
  CHECK(one.curves[0].vertices == std::vector<uint32_t>{0, 1, 2, 3});
  const Network two = read_obj("f.obj", k_square + "f 1 2 3 4\nf 2/1 5/2 6/3 3/4\n");
  REQUIRE(two.curves.size() == 7);
  for (const NetworkCurve& curve : two.curves) {
    CHECK(curve.vertices.size() == 2);
    CHECK_FALSE(curve.closed);
  }
  // Beside curves faces do not count.
  CHECK(read_obj("f.obj", k_square + "f 1 2 3 4\nl 1 2 3\n").curves.size() == 1);
}

TEST_CASE("normals that faces name, where there is not one for each vertex") {
  const Network network = read_obj(
      "f.obj", k_square + "vn 0 0 1\nvn 1 0 0\nf 1//1 2//1 3//1 4//1\nf 2//2 5//2 6//2 3//1\n");
  REQUIRE(network.has_normal.size() == 6);
  CHECK(network.has_normal == std::vector<uint8_t>{1, 0, 1, 1, 1, 1});
  CHECK(network.normals[3 * 4] == 1.0);
  CHECK(network.normals[3 * 1] == 0.0);
  // As many as vertices, but in another order.
  const Network swapped = read_obj("f.obj",
                                   "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 1 0 0\nvn 0 0 1\nvn 0 1 "
                                   "0\nvn 0 0 -1\nf 1//2 2//1 3//3 4//4\n");
  CHECK(swapped.normals == std::vector<double>{0, 0, 1, 1, 0, 0, 0, 1, 0, 0, 0, -1});
  CHECK(complaint(k_square + "vn 0 0 1\nf 1//1 2//1 3//2 4//1\n") ==
        "f.obj:8: normal index 2 is out of range, the file has 1 normals, which count from 1 in "
        "OBJ");
  CHECK(complaint(k_square + "vn 0 0 1\nf 1//1 2//1 3//x 4//1\n") ==
        "f.obj:8: \"x\" is not a normal index, which count from 1 in OBJ");
}

TEST_CASE("points (p) are kept apart") {
  const Network network = read_obj("f.obj", k_square + "p 5 -1\nl 1 2\n");
  CHECK(network.points == std::vector<uint32_t>{4, 5});
}

TEST_CASE("curves of degree 1, as Rhino writes polylines, keep their vertices") {
  const Network network = read_obj(
      "f.obj",
      k_square +
          "cstype bspline\r\ndeg 1\r\ncurv 0 3 1 2 3 1\r\nparm u 0 0 1 2 \\\r\n3 3\r\nend\r\n");
  REQUIRE(network.curves.size() == 1);
  CHECK(network.vertex_count() == 6);
  CHECK(network.curves[0].closed);
  CHECK(network.curves[0].vertices == std::vector<uint32_t>{0, 1, 2});
}

static double radius(const Network& network, uint32_t v) {
  const double* p = &network.positions[3 * size_t{v}];
  return std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
}

TEST_CASE("a rational quarter circle is one, as B-spline and as Bezier curve") {
  const std::string points = "v 1 0 0 1\nv 1 1 0 0.70710678118654752\nv 0 1 0 1\n";
  for (const char* kind : {"bspline", "bezier"}) {
    CAPTURE(kind);
    const std::string knots = std::string(kind) == "bspline" ? "0 0 0 1 1 1" : "0 1";
    const Network network =
        read_obj("f.obj", points + "cstype rat " + kind + "\ndeg 2\ncurv 0 1 1 2 3\nparm u " +
                              knots + "\nend\n");
    REQUIRE(network.curves.size() == 1);
    const std::vector<uint32_t>& samples = network.curves[0].vertices;
    CHECK(samples.size() == 33);
    CHECK(samples.front() == 0);
    CHECK(samples.back() == 2);
    for (const uint32_t v : samples) CHECK(std::fabs(radius(network, v) - 1.0) < 1e-14);
  }
  // Without the word rat, weights do not count: a parabola, whose middle is at (3/4, 3/4).
  const Network parabola =
      read_obj("f.obj", points + "cstype bezier\ndeg 2\ncurv 0 1 1 2 3\nparm u 0 1\nend\n");
  CHECK(radius(parabola, parabola.curves[0].vertices[16]) ==
        doctest::Approx(0.75 * std::sqrt(2.0)));
}

TEST_CASE("a polynomial comes back from its B-spline, with knots inside and a part of its range") {
  // The control points of u are the Greville abscissae, whatever the knots: x(u) = u.
  const double t[] = {0, 0, 0, 0, 0.25, 0.25, 0.7, 1, 1, 1, 1};
  std::string text, parm = "parm u";
  for (int i = 0; i < 7; ++i) {
    text += "v " + std::to_string((t[i + 1] + t[i + 2] + t[i + 3]) / 3.0) + " 0 0\n";
  }
  for (const double knot : t) parm += " " + std::to_string(knot);
  const Network network = read_obj(
      "f.obj", text + "cstype bspline\ndeg 3\ncurv 0.125 0.875 1 2 3 4 5 6 7\n" + parm + "\nend\n");
  const std::vector<uint32_t>& samples = network.curves[0].vertices;
  const double first = network.positions[3 * size_t{samples.front()}];
  CHECK(first == doctest::Approx(0.125));
  CHECK(network.positions[3 * size_t{samples.back()}] == doctest::Approx(0.875));
  for (size_t i = 1; i < samples.size(); ++i) {
    CHECK(network.positions[3 * size_t{samples[i]}] >
          network.positions[3 * size_t{samples[i - 1]}]);
  }
}

TEST_CASE("a closed spline without end knots, as Blender writes it, is closed") {
  // Four control points, the first three repeated; relative indices; no full multiplicity.
  const Network network = read_obj(
      "f.obj",
      "v 1 0 0\nv 0 1 0\nv -1 0 0\nv 0 -1 0\ng NurbsCircle\ncstype bspline\ndeg 3\n"
      "curv 0.3 0.7 -4 -3 -2 -1 -4 -3 -2\nparm u 0 0.1 0.2 0.3 0.4 0.5 0.6 0.7 0.8 0.9 1\nend\n");
  REQUIRE(network.curves.size() == 1);
  CHECK(network.curves[0].closed);
  CHECK(network.curves[0].vertices.size() == 32);
  CHECK(network.curves[0].name == "NurbsCircle");
}

TEST_CASE("normals of control points are blended, and missing where one is") {
  const std::string curve = "cstype bezier\ndeg 2\ncurv 0 1 1 2 3\nparm u 0 1\nend\n";
  const Network network = read_obj("f.obj", k_vertices + curve);
  REQUIRE(network.normals.size() == network.positions.size());
  const size_t middle = network.curves[0].vertices[16];
  CHECK(network.normals[3 * middle] == doctest::Approx(0.25));
  CHECK(network.normals[3 * middle + 1] == doctest::Approx(0.5));
  CHECK(network.normals[3 * middle + 2] == doctest::Approx(0.25));
}

TEST_CASE("free-form curves that cannot be read are refused by name") {
  const std::string vertices = k_square + "cstype bspline\ndeg 3\n";
  const std::string curve = "curv 0 1 1 2 3 4\nparm u 0 0 0 0 1 1 1 1\nend\n";
  REQUIRE(complaint(vertices + curve) == "");
  CHECK(complaint(k_square + "cstype cardinal\ndeg 3\n" + curve) ==
        "f.obj:9: curves of the kind \"cardinal\" are not read: write them as bspline, bezier or "
        "polylines (l)");
  CHECK(complaint(k_square + curve) == "f.obj:7: a curve (curv) without a kind (cstype) before it");
  CHECK(complaint(k_square + "cstype bspline\n" + curve) ==
        "f.obj:8: a curve (curv) without a degree (deg) before it");
  CHECK(complaint(k_square + "deg 4000000000\n") ==
        "f.obj:7: a degree of 4000000000, those from 1 to 25 are read");
  CHECK(complaint(vertices + "curv 0 1 1 2 3 4\nparm u 0 0 0 1 1\n") ==
        "f.obj:9: 5 knots (parm u) for 4 control points of degree 3, not 8");
  CHECK(complaint(vertices + "curv 0 1 1 2\nparm u 0 0 1 1\n") ==
        "f.obj:9: 4 knots (parm u) for 2 control points of degree 3, not 6");
  CHECK(complaint(vertices + "curv 0 1 1 2 3 4\nparm u 0 0 0 0 -1 1 1 1\n") ==
        "f.obj:9: the knots decrease");
  CHECK(complaint(vertices + "curv 0 1 1 2 3 4\nparm u 0 0 0 0 0 0 0 0\n") ==
        "f.obj:9: the knots span no range");
  CHECK(complaint(vertices + "curv 0 nan 1 2 3 4\n") ==
        "f.obj:9: the range of the curve (curv) is empty");
  CHECK(complaint(vertices + "curv 3 4 1 2 3 4\nparm u 0 0 0 0 1 1 1 1\n") ==
        "f.obj:9: the range of the curve (curv) lies outside its knots");
  CHECK(complaint(vertices + "curv 0 1 1 2 3 9\nparm u 0 0 0 0 1 1 1 1\n") ==
        "f.obj:9: vertex index 9 is out of range, the file has 6 vertices, which count from 1 in "
        "OBJ");
  CHECK(complaint("v 0 0 0 -1\nv 1 0 0 1\ncstype rat bezier\ndeg 1\ncurv 0 1 1 2\n") ==
        "f.obj:1: the weight of a control point is not above zero");
}
