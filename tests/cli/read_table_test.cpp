#include <doctest/doctest.h>

#include <clocale>

#include "cli/corpus.h"
#include "cli/support.h"
#include "read_network.h"

using namespace wireskin_cli;
using namespace cli_test;

static std::string complaint(const std::string& text) {
  return failure_of([&] { read_table("f.csv", text); });
}

TEST_CASE("blank lines separate curves, equal coordinates are one point") {
  const Network network = read_table("f.txt", corpus_file("table/blank.txt"));
  REQUIRE(network.curves.size() == 2);
  CHECK(network.curves[0].closed);
  CHECK(network.curves[0].vertices == std::vector<uint32_t>{0, 1, 2});
  CHECK(network.curves[1].vertices == std::vector<uint32_t>{4, 5});
  CHECK_FALSE(network.curves[1].closed);
  CHECK(network.nodes == std::vector<uint32_t>{0, 1, 2, 0, 2, 5});
  CHECK(network.curves[1].line == 6);
  CHECK(network.normals.empty());
}

TEST_CASE("a header with names, a column of curves, normals that are missing") {
  const Network network = read_table("f.csv", corpus_file("table/normals.csv"));
  REQUIRE(network.curves.size() == 2);
  CHECK(network.curves[0].name == "a");
  CHECK(network.curves[1].name == "b");
  CHECK(network.has_normal == std::vector<uint8_t>{1, 1, 1, 1, 0, 1});
  CHECK_FALSE(network.normal_known(4));
  CHECK(network.normals[3 * 5 + 1] == 1.0);
}

TEST_CASE("semicolons with decimal commas, quotes, units, a mark, CR LF, empty rows") {
  const Network network = read_network(std::string(WIRESKIN_CORPUS) + "/table/german.csv");
  REQUIRE(network.curves.size() == 2);
  CHECK(network.positions[3 * 5] == 2.5);
  CHECK(network.positions[3 * 5 + 1] == 2.25);
  CHECK(network.positions[3 * 5 + 2] == 0.5);
}

TEST_CASE("numbers mean the same under every locale") {
  for (const char* name : {"de_DE.UTF-8", "fr_FR.UTF-8", "de_DE", "C.UTF-8"}) {
    if (std::setlocale(LC_ALL, name) != nullptr) break;
  }
  const Network network = read_table("f.csv", "1.5;2,5;3\n4;5;6\n");
  std::setlocale(LC_ALL, "C");
  CHECK(network.positions[0] == 1.5);
  CHECK(network.positions[1] == 2.5);
}

TEST_CASE("what a row may leave out: tags, and a normal whose cells are empty") {
  const Network network = read_table(
      "f.csv", "x,y,z,curve,nx,ny,nz,sharp\n0,0,0,a,0,0,1,1\n1,0,0,a,,,\n2,0,0,a,0,0,1\n");
  REQUIRE(network.curves.size() == 1);
  CHECK(network.curves[0].sharp);
  CHECK(network.has_normal == std::vector<uint8_t>{1, 0, 1});
}

TEST_CASE("tabs and a number of the curve without a header; rows of a curve may be apart") {
  const Network tabs = read_table("f.tsv", corpus_file("table/tabs.tsv"));
  REQUIRE(tabs.curves.size() == 2);
  CHECK(tabs.has_normal == std::vector<uint8_t>{1, 1, 0, 1});
  const Network apart = read_table("f.csv", "0,0,0,1\n0,0,1,2\n1,0,0,1\n1,0,1,2\n");
  REQUIRE(apart.curves.size() == 2);
  CHECK(apart.curves[0].vertices == std::vector<uint32_t>{0, 2});
}

TEST_CASE("a number of the curve in the first column, without a header") {
  const Network four = read_table("f.csv", "1,0,0,0.5\n1,1,0,0.25\n2,0,1,0.5\n2,1,1,0.125\n");
  REQUIRE(four.curves.size() == 2);
  CHECK(four.curves[1].name == "2");
  CHECK(four.positions[5] == 0.25);
  CHECK(four.normals.empty());
  const Network seven = read_table("f.txt",
                                   "7 0 0 0 0 0 1\n7 1 0 0 0 0 1\n8 0 1 0 0 0 1\n"
                                   "8 1 1 0 0 0 1\n8 3 1 0 0 0.6 0.8\n");
  REQUIRE(seven.curves.size() == 2);
  CHECK(seven.curves[1].vertices.size() == 3);
  CHECK(seven.normals[3 * 4 + 2] == 0.8);
  // Curves in a plane: the last column is all one number.
  const Network flat = read_table("f.csv", "1,0,0,0\n1,1,0,0\n1,2,0,0\n2,0,1,0\n2,0,2,0\n");
  REQUIRE(flat.curves.size() == 2);
  CHECK(flat.curves[0].vertices.size() == 3);
  // Where both would do it is the last, as for names.
  CHECK(read_table("f.csv", "0,0,0,1\n0,1,0,1\n1,0,0,2\n1,1,0,2\n").positions[4] == 1.0);
  CHECK(read_table("f.csv", "0,0,0,rim\n0,1,0,rim\n").curves[0].name == "rim");
  const Network german = read_table("f.csv", "1;0,5;0;0\n1;1,5;0;0,5\n2;0;1;2,5\n2;1;1;0\n");
  REQUIRE(german.curves.size() == 2);
  CHECK(german.positions[0] == 0.5);
}

TEST_CASE(
    "rows in a row at one place are one sample; names of columns that mean nothing are kept") {
  const Network network = read_table("f.csv",
                                     "time,x,y,z,Kurve \xe4,quality\n0,0,0,0,a,9\n1,0,0,0,a,9\n"
                                     "2,1,0,0,a,8\n3,1,1,0,a,8\n4,1,1,0,a,8\n5,0,0,0,a,8\n"
                                     "6,0,0,0,a,8\n");
  REQUIRE(network.curves.size() == 1);
  CHECK(network.curves[0].closed);
  CHECK(network.curves[0].vertices == std::vector<uint32_t>{0, 2, 3});
  CHECK(network.ignored_columns == std::vector<std::string>{"time", "quality"});
}

TEST_CASE("a fourth column that numbers no curves is not taken for one") {
  CHECK(complaint("0.5,0,0,0.25\n1.5,0,0,0.5\n") ==
        "f.csv:1: 4 columns without a header, neither the first nor the last of which numbers the "
        "curves: a first line with names, as x,y,z,curve, tells what they are");
  // Milliseconds do not repeat.
  CHECK(complaint("10,0.5,0,0,0,0,0.7\n20,1.5,0,0,0,0,0.6\n").find("f.csv:1: 7 columns") == 0);
}

TEST_CASE("lines CURVE name") {
  const Network network = read_table("f.txt", corpus_file("table/titles.txt"));
  REQUIRE(network.curves.size() == 2);
  CHECK(network.curves[1].name == "1");
  CHECK(network.positions[2] == 4.23855247789e-07);
}

TEST_CASE("flags in columns; columns of other meaning are passed over") {
  const Network network = read_table("f.csv",
                                     "time,Sharp,Points:0,Points:1,Points:2,Boundary\n"
                                     "0,1,1,2,3,0\nx,1,4,5,6,0\n\n9,0,1,2,3,yes\n9,0,7,7,7,yes\n");
  REQUIRE(network.curves.size() == 2);
  CHECK(network.curves[0].sharp);
  CHECK_FALSE(network.curves[0].boundary);
  CHECK(network.curves[1].boundary);
  CHECK(network.positions[3] == 4.0);
}

TEST_CASE("a block of a single row is a point, rows of .xyz are points") {
  CHECK(read_table("f.txt", "0 0 0\n\n1 0 0\n2 0 0\n").points == std::vector<uint32_t>{0});
  const Network points = read_points("f.xyz", corpus_file("points/six.xyz"));
  CHECK(points.points == std::vector<uint32_t>{0, 1});
  CHECK(points.curves.empty());
  CHECK(points.normals.size() == 6);
}

TEST_CASE("complaints name the line and what is wanted") {
  CHECK(complaint("a,b,c\n1,2,3\n") ==
        "f.csv:1: the first line is neither numbers nor a header that names x, y and z: \"a,b,c\"");
  CHECK(complaint("x,y,z,nx\n1,2,3,4\n") ==
        "f.csv:1: the header names some of nx, ny and nz, but not all");
  CHECK(complaint("x,y,z,px\n1,2,3,4\n") ==
        "f.csv:1: two columns of the header mean the same, the second is \"px\"");
  CHECK(complaint("1 2\n").find("f.csv:1: 2 columns where 3 (x y z), 6 ") == 0);
  CHECK(complaint("1 2 3\n4 5\n") == "f.csv:2: 2 columns where 3 are needed");
  CHECK(complaint("1 2 3\n4 5 z\n") == "f.csv:2: \"z\" is not a number");
  CHECK(complaint("1 2 3\n4 5 1e999\n") == "f.csv:2: \"1e999\" is too large a number");
  CHECK(complaint("x,y,z,curve\n0,0,0,a\n1,0,0\n") == "f.csv:3: 3 columns where 4 are needed");
  CHECK(complaint("x,y,z,curve\n0,0,0,a\n1,0,0,\n") ==
        "f.csv:3: the cell that says which curve this row is of is empty");
  CHECK(complaint("x,y,z,nx,ny,nz\n0,0,0,0,0,1\n1,0,0\n") ==
        "f.csv:3: 3 columns where 6 are needed");
  CHECK(complaint("1,2,3\n4,,6\n") == "f.csv:2: an empty cell where a number is needed");
  CHECK(complaint("1,5 2,5 3,5\n") ==
        "f.csv:1: \"5 2\" is not a number (decimal commas need semicolons or tabs between the "
        "columns)");
  CHECK(complaint("x;y;z;sharp\n1;2;3;maybe\n") == "f.csv:2: \"maybe\" is not 0 or 1");
  CHECK(complaint("x,y,z\n") == "f.csv: no row of numbers in this file");
  CHECK(complaint("CURVE 1\n") == "f.csv: no row of numbers in this file");
}

TEST_CASE("lines of megabytes and bytes that are no text end in one short line") {
  for (const std::string& cell : {std::string(3 << 20, '7'), std::string(3 << 20, 'x')}) {
    const std::string line = complaint("1 2 3\n" + cell + " 1 1\n");
    CHECK(line.find("f.csv:2: ") == 0);
    CHECK(line.size() < 100);
  }
  CHECK(complaint(std::string("1 2 3\n4 5 \0\n", 12)) == "f.csv:2: \"?\" is not a number");
}
