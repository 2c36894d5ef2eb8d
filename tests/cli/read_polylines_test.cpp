#include <doctest/doctest.h>

#include "cli/corpus.h"
#include "cli/support.h"
#include "read_network.h"

using namespace wireskin_cli;
using namespace cli_test;

template <typename Reader>
static std::string complaint(const Reader& reader, const std::string& text) {
  return failure_of([&] { reader("f", text); });
}

TEST_CASE("CASSIE") {
  const Network network = read_curves("f", corpus_file("curves/cassie.curves"));
  REQUIRE(network.curves.size() == 2);
  CHECK(network.positions[1] == -1.5);
  CHECK(network.curves[1].closed);
  CHECK(network.curves[1].vertices == std::vector<uint32_t>{2, 3, 4});
  CHECK(complaint(read_curves, "w 1\n0 0 0\n") == "f:1: a line \"v N\" is needed before a curve");
  CHECK(complaint(read_curves, "v 2\n0 0 0\n") ==
        "f:2: the file ends after 1 of 2 points of a curve");
  CHECK(complaint(read_curves, "v 4000000000\n") ==
        "f:1: the file ends after 0 of 4000000000 points of a curve");
  CHECK(complaint(read_curves, "v 1\n0 0\n") == "f:2: 2 columns where 3 are needed: x y z");
  CHECK(complaint(read_curves, "v x\n") == "f:1: \"x\" is not the number of points of a curve");
}

TEST_CASE("cycle discovery") {
  const Network network = read_curve("f", corpus_file("curve/cycle.curve"));
  REQUIRE(network.curves.size() == 2);
  CHECK(network.nodes == std::vector<uint32_t>{0, 1, 2, 2, 0});
  CHECK(complaint(read_curve, "1\n2 0\n") ==
        "f:2: 2 columns where 3 are needed: the number of points, a type and a capacity");
  CHECK(complaint(read_curve, "3\n1 0 1\n0 0 0\n") == "f:3: the file ends after 1 of 3 curves");
  CHECK(complaint(read_curve, "1\n1 0 1\n0 0 0\n5\n") == "f:4: text after the last curve");
}

TEST_CASE("contours in planes") {
  const Network network = read_contour("f", corpus_file("contour/planes.contour"));
  REQUIRE(network.curves.size() == 4);
  CHECK(network.vertex_count() == 5);
  CHECK(network.curves[3].vertices == std::vector<uint32_t>{3, 4});
  CHECK(network.nodes[3] == 0);
  CHECK(complaint(read_contour, "1\n0 0 1 0\n1 1\n0 0 0\n0 1 0 0\n") ==
        "f:5: vertex index 1 is out of range, the plane has 1 vertices");
  CHECK(complaint(read_contour, "1\n0 0 1\n") ==
        "f:2: 3 columns where 4 are needed: a plane a b c d");
  CHECK(complaint(read_contour, "2\n0 0 1 0\n0 0\n") == "f:3: the file ends after 1 of 2 planes");
}

TEST_CASE("curves with tangents, which are no normals") {
  const Network network = read_curf("f", corpus_file("curf/tangents.curf"));
  REQUIRE(network.curves.size() == 2);
  CHECK(network.normals.empty());
  CHECK(complaint(read_curf, "v 0 0 0\ne 1 2\n") ==
        "f:2: vertex index 2 is out of range, the file has 1 vertices");
  CHECK(complaint(read_curf, "v 0 0 0\ne 0 1\n") == "f:2: vertex indices count from 1 here");
}

TEST_CASE("raw measurements are kept as they are") {
  const Network network = read_rawnet("f", corpus_file("rawnet/two.rawnet"));
  CHECK(network.positions.empty());
  REQUIRE(network.raw_curves.size() == 2);
  const RawCurve& ring = network.raw_curves[0];
  CHECK(ring.boundary);
  CHECK(ring.closed);
  CHECK(ring.nodes == std::vector<uint32_t>{0, 2, 4});
  CHECK(ring.global_nodes == std::vector<uint32_t>{0, 1, 0});
  CHECK(ring.arc_lengths == std::vector<double>{0, 1, 2, 3, 4});
  CHECK(ring.tangents.size() == 15);
  CHECK(ring.normals[14] == 1.0);
  CHECK(ring.sample_lines[0] == 8);
  const RawCurve& open = network.raw_curves[1];
  CHECK_FALSE(open.boundary);
  CHECK_FALSE(open.closed);
  CHECK(open.tangents[0] == -0.5);
}

TEST_CASE("raw measurements: complaints") {
  const auto raw = [](const std::string& text) { return complaint(read_rawnet, text); };
  CHECK(raw("1\n2\n") == "f:2: \"2\" is not 0 or 1 (1: boundary)");
  CHECK(raw("1\n0\n0\n2\n1\n") ==
        "f:5: 1 column where 2 are needed: the sample of each node, counted from 1");
  CHECK(raw("1\n0\n0\n1\n0\n") == "f:5: samples count from 1 here");
  CHECK(raw("1\n0\n0\n2\n3 3\n") == "f:5: the samples of nodes must increase");
  CHECK(raw("1\n0\n0\n1\n9\n0\n2\n") == "f:7: a node lies on sample 9 of 2");
  CHECK(raw("1\n0\n0\n0\n4000000000\n") ==
        "f:5: the file ends after 0 of 4000000000 samples of a curve");
  CHECK(raw("1\n0\n0\n0\n1\n0 1 0 0 0 0\n") ==
        "f:6: 6 columns where 7 are needed: length tx ty tz nx ny nz");
  CHECK(raw("1\n0\n0\n0\n2\n0 1 0 0 0 0 1\n0 1 0 0 0 0 1\n") ==
        "f:7: the length along the curve does not increase");
  CHECK(raw("1\n0\n0\n0\n1\n0 1 0 0 0 0 1\n7\n") == "f:7: text after the last curve");
}
