#include <doctest/doctest.h>

#include "cli/corpus.h"
#include "cli/support.h"
#include "read_network.h"
#include "write_mesh.h"

using namespace wireskin_cli;
using namespace cli_test;

static std::string complaint(const std::string& bytes) {
  return failure_of([&] { read_ply("f.ply", bytes); });
}

static std::string header(const std::string& lines, const char* coding = "ascii") {
  return std::string("ply\nformat ") + coding + " 1.0\n" + lines + "end_header\n";
}

static const std::string k_xyz = "property float x\nproperty float y\nproperty float z\n";

TEST_CASE("the same network in text and both byte orders") {
  for (const char* name : {"ply/text.ply", "ply/crlf.ply", "ply/little.ply", "ply/big.ply"}) {
    CAPTURE(name);
    const Network network = read_ply("f.ply", corpus_file(name));
    CHECK(network.positions == std::vector<double>{0, 0, 0, 1.5, 0, 0, 1.5, -1.25, 3, 0, 1, -2});
    CHECK(network.normals == std::vector<double>{0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1});
    REQUIRE(network.curves.size() == 4);
    CHECK(network.curves[2].vertices == std::vector<uint32_t>{2, 3});
    CHECK(network.curves[2].boundary);
    CHECK_FALSE(network.curves[3].boundary);
    // Binary files have no lines.
    const std::string path = name;
    const bool text = path == "ply/text.ply" || path == "ply/crlf.ply";
    CHECK(network.vertex_lines[1] == (text ? 23u : 0u));
  }
}

TEST_CASE("faces as loops, vertices as points, lines that end with CR") {
  const Network faces = read_ply("f.ply", corpus_file("ply/faces.ply"));
  CHECK(faces.curves.size() == 7);
  const Network points = read_ply("f.ply", corpus_file("ply/points.ply"));
  CHECK(points.points == std::vector<uint32_t>{0, 1});
  CHECK(points.positions == std::vector<double>{0, 0, 0, 1, 2, 3});
  CHECK(complaint(header("element vertex 3\n" + k_xyz +
                         "element face 1\nproperty list uchar int vertex_indices\n") +
                  "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n") ==
        "f.ply: a mesh of triangles without curves: the curves must be given as the element edge");
}

TEST_CASE("what the command writes with its curves can be read") {
  const Square square;
  const Network network = read_ply("f.ply", ply_bytes(square.view(), true));
  CHECK(network.positions == square.positions);
  CHECK(network.normals == square.normals);
  REQUIRE(network.curves.size() == 4);
  CHECK(network.curves[3].vertices == std::vector<uint32_t>{3, 0});
}

TEST_CASE("complaints about the header") {
  CHECK(complaint("ply\nformat ascii 1.0\n") ==
        "f.ply: the header of this PLY file has no end_header");
  CHECK(complaint("ply\nend_header\n") == "f.ply: the PLY header names no format");
  CHECK(complaint("ply\nformat binary 1.0\nend_header\n") ==
        "f.ply:2: \"binary\" is not a format of PLY: ascii, binary_little_endian or "
        "binary_big_endian");
  CHECK(complaint(header("element vertex -1\n")) ==
        "f.ply:3: \"-1\" is not the number of elements");
  CHECK(complaint(header("element vertex\n")) == "f.ply:3: an element needs a name and a number");
  CHECK(complaint(header("property float x\n")) == "f.ply:3: a property before any element");
  CHECK(complaint(header("element vertex 1\nproperty real x\n")) ==
        "f.ply:4: \"real\" is not a type of PLY");
  CHECK(complaint(header("element vertex 1\nproperty list float int x\n")) ==
        "f.ply:4: the count of a list is not an integer");
  CHECK(complaint(header("elephant\n")) == "f.ply:3: \"elephant\" is not a line of a PLY header");
  CHECK(complaint(header("element vertex 1\nproperty float x\n") + "1\n") ==
        "f.ply:6: the vertices have no x, y and z");
  CHECK(complaint(header("")) == "f.ply: no vertex in this file");
}

TEST_CASE("counts of the header are not believed, and truncated files say how far they came") {
  for (const char* coding : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    CHECK(complaint(header("element vertex 4000000000\n" + k_xyz, coding)) ==
          "f.ply: the file ends after 0 of 4000000000 elements \"vertex\"");
    CHECK(complaint(header("element vertex 0\n" + k_xyz + "element face 4000000000\n", coding)) ==
          complaint(header("element face 4000000000\n", coding)));
    // Elements without properties take no bytes: four thousand million of them no time.
    CHECK(complaint(header("element ghost 4000000000\n", coding)) ==
          "f.ply: no vertex in this file");
  }
  const std::string little = corpus_file("ply/little.ply");
  CHECK(complaint(little.substr(0, little.size() - 1)) ==
        "f.ply: the file ends after 3 of 4 elements \"edge\"");
  const std::string endless = header(
      "element vertex 0\n" + k_xyz + "element face 1\nproperty list uint int vertex_indices\n",
      "binary_little_endian");
  CHECK(complaint(endless + std::string("\xfe\xff\xff\xff\1\0\0\0", 8)) ==
        "f.ply: the file ends after 0 of 1 elements \"face\"");
}

TEST_CASE("complaints about the data") {
  const std::string head = header("element vertex 2\n" + k_xyz +
                                  "element edge 1\nproperty int vertex1\nproperty int vertex2\n");
  CHECK(complaint(head + "0 0 0\n1 0 0\n0 1\n") == "");
  CHECK(complaint(head + "0 0 0\n1 0\n0 1\n") == "f.ply:12: 2 values, more are needed");
  CHECK(complaint(head + "0 0 0\n1 0 0 0\n0 1\n") == "f.ply:12: 4 values where the header wants 3");
  CHECK(complaint(head + "0 0 0\n1 0 x\n0 1\n") == "f.ply:12: \"x\" is not a number");
  CHECK(complaint(head + "0 0 0\n1 0 1e999\n0 1\n") == "f.ply:12: \"1e999\" is too large a number");
  CHECK(complaint(head + "0 0 0\n1 0 0\n0 -1\n") == "f.ply:13: \"-1\" is not a vertex index");
  CHECK(complaint(head + "0 0 0\n1 0 0\n0 2\n") ==
        "f.ply: edge 0: vertex index 2 is out of range, the file has 2 vertices, which count from "
        "0 in PLY");
  CHECK(complaint(header("element vertex 1\n" + k_xyz + "element vertex 1\n" + k_xyz) +
                  "0 0 0\n1 0 0\n") == "f.ply: a second element vertex");
  CHECK(complaint(header("element vertex 1\n" + k_xyz + "element edge 1\nproperty int vertex1\n") +
                  "0 0 0\n0\n") == "f.ply:11: the edges have no vertex1 and vertex2");
}
