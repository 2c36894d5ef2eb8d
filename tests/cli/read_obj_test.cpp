#include <doctest/doctest.h>

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
        "f.obj: a mesh (f) without curves: the curves must be given as l");
  CHECK(complaint(k_vertices + "cstype bspline\ndeg 3\ncurv 0 1 1 2 3\n") ==
        "f.obj: free-form curves (curv) are not read: write them as polylines (l)");
  CHECK(complaint(k_vertices) == "f.obj: no curve (l) in this file");
  CHECK(complaint("v 0 0 0\nv 1 0 0\nvn 0 0 1\nl 1 2\n") ==
        "f.obj: 1 normals (vn) for 2 vertices (v): each vertex needs one, in the same order");
  CHECK(read_obj("f.obj", "v 0 0 0\nv 1 0 0\nl 1 2\n").normals.empty());
}

TEST_CASE("the extension decides on the reader") {
  const ScratchFolder scratch("read");
  write_file(scratch / "a.OBJ", k_vertices + "l 1 2\n");
  CHECK(read_network(scratch / "a.OBJ").curves.size() == 1);
  write_file(scratch / "a.Net", "2\n0 0 0 0 0 1\n1 0 0 0 0 1\n1\n0\n0 1\n");
  CHECK(read_network(scratch / "a.Net").curves.size() == 1);
  const std::string other = scratch / "a.stl";
  CHECK(failure_of([&] { read_network(other); }) ==
        other + ": unknown format \".stl\", known are .net and .obj");
}
