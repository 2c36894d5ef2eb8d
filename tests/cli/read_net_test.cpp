#include <doctest/doctest.h>

#include "cli/support.h"
#include "read_network.h"

using namespace wireskin_cli;
using namespace cli_test;

static const std::string k_two_curves =
    "4\n"
    "0 0 0  0 0 1\n"
    "1 0 0  0 0 1\n"
    " +1 -1 0  0 0 1\n"
    "0 1 0  0 0 2e0\n"
    "2\n"
    "1\n"
    "0 1 2 3 0\n"
    "0\n"
    "0 2\n";

static std::string replaced(std::string text, const std::string& what, const std::string& with) {
  const size_t at = text.find(what);
  REQUIRE(at != std::string::npos);
  return text.replace(at, what.size(), with);
}

static std::string complaint(const std::string& text) {
  return failure_of([&] { read_net("f.net", text); });
}

TEST_CASE("a closed boundary curve and an open one") {
  const Network network = read_net("f.net", k_two_curves);
  REQUIRE(network.positions.size() == 12);
  REQUIRE(network.normals.size() == 12);
  CHECK(network.positions[7] == -1.0);
  CHECK(network.normals[11] == 2.0);
  CHECK(network.vertex_lines == std::vector<size_t>{2, 3, 4, 5});
  REQUIRE(network.curves.size() == 2);
  CHECK(network.curves[0].vertices == std::vector<uint32_t>{0, 1, 2, 3});
  CHECK(network.curves[0].closed);
  CHECK(network.curves[0].boundary);
  CHECK(network.curves[0].line == 8);
  CHECK(network.curves[1].vertices == std::vector<uint32_t>{0, 2});
  CHECK_FALSE(network.curves[1].closed);
  CHECK_FALSE(network.curves[1].boundary);
}

TEST_CASE("blank lines and other line ends do not matter") {
  std::string text = k_two_curves;
  for (size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 4) {
    text.replace(at, 1, "\r\n\r\n");
  }
  CHECK(read_net("f.net", text).curves.size() == 2);
}

TEST_CASE("every complaint names its line") {
  CHECK(complaint(replaced(k_two_curves, "1 0 0  0", "1 x 0  0")) ==
        "f.net:3: \"x\" is not a number");
  CHECK(complaint(replaced(k_two_curves, "1 0 0  0", "1 0 0")) ==
        "f.net:3: 5 columns where 6 are needed: x y z nx ny nz");
  CHECK(complaint(replaced(k_two_curves, "1 0 0  0", "1 0 0 0 0")) ==
        "f.net:3: 7 columns where 6 are needed: x y z nx ny nz");
  CHECK(complaint(replaced(k_two_curves, "3 0\n", "4 0\n")) ==
        "f.net:8: vertex index 4 is out of range, the file has 4 vertices");
  CHECK(complaint(replaced(k_two_curves, "3 0\n", "-1 0\n")) ==
        "f.net:8: \"-1\" is not a vertex index, which count from 0");
  CHECK(complaint(replaced(k_two_curves, "3 0\n", "1.5 0\n")) ==
        "f.net:8: \"1.5\" is not a vertex index, which count from 0");
  CHECK(complaint(replaced(k_two_curves, "\n1\n", "\n2\n")) ==
        "f.net:7: a line with 0 or 1 (boundary) is needed before the indices of a curve");
  CHECK(complaint(replaced(k_two_curves, "0 2\n", "2\n")) ==
        "f.net:10: a curve needs at least two vertex indices");
  CHECK(complaint(replaced(k_two_curves, "4\n", "4 5\n")) ==
        "f.net:1: 2 columns where the number of vertices should stand alone");
  CHECK(complaint(replaced(k_two_curves, "4\n", "many\n")) ==
        "f.net:1: \"many\" is not the number of vertices");
  CHECK(complaint(k_two_curves + "\n7\n") == "f.net:12: text after the last curve");
}

TEST_CASE("a truncated file says how far it came, wherever it ends") {
  CHECK(complaint("\n") == "f.net:1: the file ends before the number of vertices");
  CHECK(complaint("4\n0 0 0 0 0 1\n") == "f.net:2: the file ends after 1 of 4 vertices");
  CHECK(complaint("4000000000\n0 0 0 0 0 1\n") ==
        "f.net:2: the file ends after 1 of 4000000000 vertices");
  CHECK(complaint("1\n0 0 0 0 0 1\n") == "f.net:2: the file ends before the number of curves");
  CHECK(complaint("1\n0 0 0 0 0 1\n3\n0\n0 0\n") == "f.net:5: the file ends after 1 of 3 curves");
  CHECK(complaint("1\n0 0 0 0 0 1\n3\n0\n0 0\n1\n") ==
        "f.net:6: the file ends after 1 of 3 curves");
  // After the last full line but one, no prefix may pass.
  for (size_t length = 0; length + 3 < k_two_curves.size(); ++length) {
    CAPTURE(length);
    CHECK(complaint(k_two_curves.substr(0, length)) != "");
  }
}

TEST_CASE("no vertices and no curves are left to the library") {
  CHECK(read_net("f.net", "0\n0\n").curves.empty());
}
