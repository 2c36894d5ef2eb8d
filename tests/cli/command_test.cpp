// The command from outside: what it prints, what it leaves, how it ends.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>

#include "cli/json.h"
#include "cli/support.h"

using namespace cli_test;

namespace {

constexpr double k_pi = 3.14159265358979323846;

struct Run {
  int status;
  std::string out;
  std::string err;
};

// Runs it with the folder as the current one; `before` is shell code that goes in front.
Run run(const ScratchFolder& folder, const std::string& arguments, const std::string& before = "") {
  const std::string out = folder / "stdout.log";
  const std::string err = folder / "stderr.log";
  const std::string command = "cd '" + folder.path() + "' && (" + before + "'" + WIRESKIN_COMMAND +
                              "' " + arguments + ") >stdout.log 2>stderr.log";
  const int code = std::system(command.c_str());
  Run result = {code, read_file(out), read_file(err)};
#ifdef __unix__
  result.status = code >= 256 ? code / 256 : code;
#endif
  fs::remove(out);
  fs::remove(err);
  return result;
}

// The unit cube in the format .obj: its corners, and its edges as lines of two points.
std::string cube_corners() {
  std::string rows;
  for (int i = 0; i < 8; ++i) {
    for (int k = 0; k < 3; ++k) rows += (k == 0 ? "v " : " ") + std::to_string((i >> k) & 1);
    rows += "\n";
  }
  return rows;
}
std::string cube_edges() {
  std::string rows;
  for (int i = 0; i < 8; ++i) {
    for (int k = 0; k < 3; ++k) {
      if (((i >> k) & 1) != 0) continue;
      rows += "l " + std::to_string(i + 1) + " " + std::to_string((i | (1 << k)) + 1) + "\n";
    }
  }
  return rows;
}

// Three great circles of the unit sphere, in the format .net: six nodes first.
std::string sphere_net(int quarter) {
  std::vector<std::string> rows;
  for (int axis = 0; axis < 3; ++axis) {
    for (int sign = 1; sign >= -1; sign -= 2) {
      std::string p;
      for (int k = 0; k < 3; ++k) p += std::to_string(k == axis ? sign : 0) + " ";
      rows.push_back(p + p);
    }
  }
  std::string curves;
  for (int axis = 0; axis < 3; ++axis) {
    const int next = (axis + 1) % 3;
    std::string indices;
    for (int i = 0; i < 4 * quarter; ++i) {
      if (i % quarter == 0) {
        const int turn = i / quarter;
        indices += std::to_string(2 * (turn % 2 == 0 ? axis : next) + turn / 2) + " ";
        continue;
      }
      double p[3] = {0, 0, 0};
      p[axis] = std::cos(k_pi / 2 * i / quarter);
      p[next] = std::sin(k_pi / 2 * i / quarter);
      char row[200];
      std::snprintf(row, sizeof row, "%.17g %.17g %.17g ", p[0], p[1], p[2]);
      indices += std::to_string(rows.size()) + " ";
      rows.push_back(std::string(row) + row);
    }
    curves += "0\n" + indices + indices.substr(0, indices.find(' ')) + "\n";
  }
  std::string text = std::to_string(rows.size()) + "\n";
  for (const std::string& row : rows) text += row + "\n";
  return text + "3\n" + curves;
}

// The same network after one line, counted from 1, is replaced.
std::string with_line(const std::string& text, int line, const std::string& content) {
  size_t at = 0;
  for (int i = 1; i < line; ++i) at = text.find('\n', at) + 1;
  return text.substr(0, at) + content + text.substr(text.find('\n', at));
}

bool one_line(const std::string& text) {
  return !text.empty() && text.find('\n') == text.size() - 1;
}

size_t count_of(const std::string& text, const std::string& what) {
  size_t count = 0;
  for (size_t at = 0; (at = text.find(what, at)) != std::string::npos; ++at) ++count;
  return count;
}

}  // namespace

TEST_CASE("a network in, surface, picture and report out") {
  const ScratchFolder folder("command");
  write_file(folder / "sphere.net", sphere_net(16));
  const Run r = run(folder, "sphere.net -o s.obj --image s.png --report s.json --spacing 0.1");
  REQUIRE(r.err == "");
  REQUIRE(r.status == 0);
  CHECK(one_line(r.out));
  CHECK(folder.file_count() == 4);
  auto report = JsonReader(read_file(folder / "s.json")).values;
  CHECK(report["status"] == "ok");
  CHECK(report["stage"] == "result");
  CHECK(report["curves"] == "3");
  CHECK(report["nodes"] == "6");
  CHECK(report["segments"] == "12");
  CHECK(report["patches"] == "8");
  CHECK(report["components"] == "1");
  CHECK(report["boundary_loops"] == "0");
  CHECK(report["euler_characteristic"] == "2");
  CHECK(std::stod(report["spacing"]) == doctest::Approx(0.1));
  CHECK(std::stod(report["total_ms"]) > 0.0);
  CHECK(std::stod(report["peak_bytes"]) > 0.0);
  const std::string obj = read_file(folder / "s.obj");
  CHECK(std::to_string(count_of(obj, "\nv ")) == report["vertices"]);
  CHECK(std::to_string(count_of(obj, "\nvn ")) == report["vertices"]);
  CHECK(std::to_string(count_of(obj, "\nf ")) == report["triangles"]);
  CHECK(count_of(obj, "\ng patch_") == 8);
  CHECK(read_file(folder / "s.png").substr(1, 3) == "PNG");
}

TEST_CASE("every method, every output format, --quiet") {
  const ScratchFolder folder("command");
  write_file(folder / "sphere.net", sphere_net(8));
  for (const char* method : {"stanko", "biharmonic", "triharmonic", "clamped"}) {
    CAPTURE(method);
    const Run r = run(folder, std::string("sphere.net -o s.ply --spacing 0.2 --quiet --report "
                                          "s.json --method ") +
                                  method);
    CHECK(r.status == 0);
    CHECK(r.out == "");
    CHECK(r.err == "");
    CHECK(JsonReader(read_file(folder / "s.json")).values["method"] == method);
  }
  CHECK(read_file(folder / "s.ply").substr(0, 4) == "ply\n");
  CHECK(run(folder, "sphere.net -o s.stl --spacing 0.2").status == 0);
  CHECK(read_file(folder / "s.stl").size() > 84);
}

TEST_CASE("the same command twice gives the same bytes") {
  const ScratchFolder folder("command");
  write_file(folder / "sphere.net", sphere_net(8));
  REQUIRE(run(folder, "sphere.net -o a.ply --image a.png --spacing 0.1").status == 0);
  REQUIRE(run(folder, "sphere.net -o b.ply --image b.png --spacing 0.1", "LC_ALL=de_DE.UTF-8 ")
              .status == 0);
  CHECK(read_file(folder / "a.ply") == read_file(folder / "b.ply"));
  CHECK(read_file(folder / "a.png") == read_file(folder / "b.png"));
}

TEST_CASE("help and version") {
  const ScratchFolder folder("command");
  const Run help = run(folder, "--help");
  CHECK(help.status == 0);
  CHECK(help.out.find("usage: wireskin") != std::string::npos);
  CHECK(run(folder, "--version").out == std::string("wireskin ") + wsk_version_string() + "\n");
}

TEST_CASE("wrong usage ends with 2 and one line") {
  const ScratchFolder folder("command");
  for (const char* words :
       {"", "a.net", "a.net -o b.xyz", "--frob", "a.net -o a.obj --spacing x"}) {
    const Run r = run(folder, words);
    CAPTURE(words);
    CHECK(r.status == 2);
    CHECK(r.out == "");
    CHECK(one_line(r.err));
    CHECK(r.err.find("--help") != std::string::npos);
  }
}

TEST_CASE("faults of reading end with 1, one line, and no file") {
  const ScratchFolder folder("command");
  const std::string net = sphere_net(4);
  const struct {
    const char* name;
    std::string content;
    const char* message;
  } cases[] = {
      {"empty.net", "", "empty.net: the file is empty\n"},
      {"binary.net", std::string("4\n\0\1\2\3", 6),
       "binary.net: this is a binary file, not text\n"},
      {"cut.net", net.substr(0, net.find('\n', 30) + 1),
       "cut.net:3: the file ends after 2 of 42 vertices\n"},
      {"word.net", with_line(net, 5, "0 0 x 0 0 1"), "word.net:5: \"x\" is not a number\n"},
      {"few.net", with_line(net, 5, "0 0 1"),
       "few.net:5: 3 columns where 6 are needed: x y z nx ny nz\n"},
      {"range.net", with_line(net, 46, "0 42"),
       "range.net:46: vertex index 42 is out of range, the file has 42 vertices\n"},
      {"mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
       "mesh.obj: a mesh of triangles (f) without curves: the curves must be given as l\n"},
      {"other.svg", "<svg/>",
       "other.svg: this is an SVG drawing: curves in space are needed, as OBJ or a table\n"},
      {"other.foo", "hello world\n",
       "other.foo: the content is of no known format and neither is the extension \".foo\", known "
       "are .obj, .ply, .net, .rawnet, .csv, .tsv, .txt, .dat, .asc, .xyz, .curves, .curve, "
       ".contour, .curf\n"},
  };
  for (const auto& c : cases) {
    CAPTURE(c.name);
    write_file(folder / c.name, c.content);
    const Run r =
        run(folder, std::string(c.name) +
                        " --topology normals -o out.obj --image out.png --report out.json");
    CHECK(r.status == 1);
    CHECK(r.out == "");
    CHECK(r.err == c.message);
    // The report has the place and the sentence of the message.
    REQUIRE(fs::exists(folder / "out.json"));
    auto report = JsonReader(read_file(folder / "out.json")).values;
    CHECK(report["stage"] == "reading");
    CHECK(report["status"] != "ok");
    std::string head = std::string(c.name) + ":";
    if (report.count("place.line") != 0) head += report["place.line"] + ":";
    if (report["sentence"].find('\\') == std::string::npos) {
      CHECK(head + " " + report["sentence"] + "\n" == r.err);
    }
    fs::remove(folder / "out.json");
    fs::remove(folder / c.name);
    CHECK(folder.file_count() == 0);
  }
  CHECK(run(folder, "none.net -o out.obj").err == "none.net: there is no such file\n");
}

TEST_CASE("a missing normal is filled in, a broken joint is snapped unless that is off") {
  const ScratchFolder folder("command");
  const std::string net = sphere_net(4);
  write_file(folder / "hole.net",
             with_line(net, 9, "0.7071067811865476 0.7071067811865476 0 0 0 0"));
  Run r = run(folder, "hole.net -o a.obj --report a.json --method biharmonic");
  CHECK(r.status == 0);
  auto report = JsonReader(read_file(folder / "a.json")).values;
  CHECK(report["preparation.filled_normals"] == "1");
  CHECK(report["preparation.before.nodes"] == "6");
  CHECK(report["preparation.after.nodes"] == "6");

  const std::string lines =
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0.002 0 0\nvn 0 0 1\nvn 0 0 1\nvn 0 0 1\nvn 0 0 1\n"
      "vn 0 0 1\ng boundary\nl 1 2\nl 2 3\nl 3 4\nl 4 5\n";
  write_file(folder / "gap.obj", lines);
  r = run(folder, "gap.obj -o b.obj --report b.json --snap 0.01");
  CHECK(r.status == 0);
  report = JsonReader(read_file(folder / "b.json")).values;
  CHECK(report["preparation.snaps.0.kind"] == "end_end");
  CHECK(report["preparation.snaps.0.distance"] == "0.002");
  CHECK(report["preparation.before.dangling_ends"] == "2");
  CHECK(report["preparation.after.dangling_ends"] == "0");
  r = run(folder, "gap.obj -o c.obj --snap off");
  CHECK(r.status == 1);
  CHECK(r.err.find("; 2 ends of curves meet no other curve: --snap LENGTH") != std::string::npos);
}

TEST_CASE("curves without normals become a surface, and a report is written") {
  const ScratchFolder folder("command");
  write_file(folder / "cube.obj", cube_corners() + cube_edges());
  const Run r = run(folder, "cube.obj -o s.obj --report s.json --spacing 0.25");
  CHECK(r.err == "");
  REQUIRE(r.status == 0);
  auto report = JsonReader(read_file(folder / "s.json")).values;
  CHECK(report["patches"] == "6");
  CHECK(report["euler_characteristic"] == "2");
}

TEST_CASE("faults of the network: the place in one line and in the report, no surface") {
  const ScratchFolder folder("command");
  const std::string net = sphere_net(4);
  // Curve 0 begins 0 6 7 8 2, so vertex 7 is its sample 2; it stands in line 9.
  const struct {
    const char* name;
    std::string content;
    const char* status;
    const char* message;
  } cases[] = {
      {"nan.net", with_line(net, 9, "nan 0 0 1 0 0"), "not_a_number", "curve 0, sample 2: "},
      {"inf.net", with_line(net, 9, "0 inf 0 1 0 0"), "infinite", "curve 0, sample 2: "},
      {"no_curves.net", "1\n0 0 0 0 0 1\n0\n", "empty", ""},
      {"open.net", "3\n0 0 0 0 0 1\n1 0 0 0 0 1\n2 1 0 0 0 1\n1\n0\n0 1 2\n", "open_network", ""},
      {"no_normals.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nl 1 2 3 1\n", "missing_normals", ""},
      {"point.net", "2\n0 0 0 0 0 1\n0 0 0 0 0 1\n1\n0\n0 1\n", "zero_length_curve", "curve 0"},
  };
  for (const auto& c : cases) {
    CAPTURE(c.name);
    write_file(folder / c.name, c.content);
    const Run r =
        run(folder, std::string(c.name) +
                        " --topology normals -o out.obj --image out.png --report out.json");
    CAPTURE(r.err);
    CHECK(r.status == 1);
    CHECK(r.out == "");
    CHECK(one_line(r.err));
    CHECK(r.err.find(std::string(c.name) + ": " + c.message) == 0);
    REQUIRE(fs::exists(folder / "out.json"));
    auto report = JsonReader(read_file(folder / "out.json")).values;
    CHECK(report["status"] == c.status);
    CHECK(report["sentence"].size() > 5);
    if (std::string(c.message) == "curve 0, sample 2: ") {
      CHECK(r.err.find("(line 9)") != std::string::npos);
      CHECK(report["place.curve"] == "0");
      CHECK(report["place.sample"] == "2");
    }
    fs::remove(folder / c.name);
    fs::remove(folder / "out.json");
    CHECK(folder.file_count() == 0);
  }
}

TEST_CASE("a report that cannot be written does not hide the fault of the network") {
  const ScratchFolder folder("command");
  write_file(folder / "nan.net", with_line(sphere_net(4), 9, "nan 0 0 1 0 0"));
  const Run r = run(folder, "nan.net -o out.obj --report missing/out.json");
  CHECK(r.status == 1);
  CHECK(one_line(r.err));
  CHECK(r.err.find("nan.net: curve 0, sample 2: ") == 0);
  CHECK(r.err.find("; missing/out.json: cannot be written: ") != std::string::npos);
}

TEST_CASE("outputs are complete or absent, all of them") {
  const ScratchFolder folder("command");
  write_file(folder / "sphere.net", sphere_net(8));
  for (const char* outputs :
       {"-o missing/s.obj --image s.png --report s.json", "-o s.obj --image missing/s.png",
        "-o s.obj --image s.png --report missing/s.json"}) {
    CAPTURE(outputs);
    const Run r = run(folder, std::string("sphere.net ") + outputs);
    CHECK(r.status == 1);
    CHECK(one_line(r.err));
    CHECK(r.err.find("missing/s.") == 0);
    CHECK(r.err.find(": cannot be written: ") != std::string::npos);
    CHECK(folder.file_count() == 1);
  }
}

TEST_CASE("hints: spacing, huge offsets, normals, names") {
  const ScratchFolder folder("command");
  write_file(folder / "sphere.net", sphere_net(4));
  CHECK(
      run(folder, "sphere.net -o a.obj --spacing 1e-20").err ==
      "sphere.net: curve 0: the spacing is too small for the network: its surface would have more "
      "than 2^26 vertices (line 46); --spacing is 1e-20, the diagonal of the network 3.46: that "
      "makes some 2.77e+41 triangles (the default, a hundredth of the diagonal, makes some "
      "20000)\n");
  write_file(folder / "far.net",
             "3\n1e14 0 0 0 0 1\n100000000000001 0 0 0 0 1\n1e14 1 0 0 0 1\n1\n0\n0 1 2\n");
  const Run far = run(folder, "far.net -o a.obj");
  CHECK(one_line(far.err));
  CHECK(far.err.find("; the network spans 1.41 but lies 1e+14 from the origin, where numbers are "
                     "rounded to about 0.0222") != std::string::npos);
  CHECK(count_of(far.err, "move it to the origin") == 1);
  write_file(folder / "bare.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\ng a rim\nl 1 2 3 1\n");
  CHECK(run(folder, "bare.obj -o a.obj").status == 0);
  CHECK(run(folder, "bare.obj -o b.obj --topology normals").err ==
        "bare.obj: curve 0 (\"a rim\"): the curve has no normals (line 5); the file gives no "
        "normals at all: --topology flow needs none\n");
  // Names are shown in whatever language they are.
  write_file(folder / "named.obj",
             "v 0 0 0\nv 1 0 0\nv 1 1 0\ng K\xC3\xA4nte \xE6\x9B\xB2\nl 1 2 3 1\n");
  CHECK(run(folder, "named.obj -o b.obj --topology normals --report b.json")
            .err.find("curve 0 (\"K\xC3\xA4nte \xE6\x9B\xB2\"): ") != std::string::npos);
  // A normal that is missing between others is filled in; what is wrong here is something else.
  write_file(folder / "some.csv", "x,y,z,nx,ny,nz\n0,0,0,0,0,1\n1,0,0,,,\n1,1,0,0,0,1\n");
  const Run loose = run(folder, "some.csv -o a.obj");
  CHECK(loose.status == 1);
  CHECK(loose.err.find("; 2 ends of curves meet no other curve") != std::string::npos);
}

TEST_CASE("the curves go out with the mesh, and come back in") {
  const ScratchFolder folder("command");
  write_file(folder / "sphere.net", sphere_net(16));
  for (const char* name : {"s.obj", "s.ply"}) {
    CAPTURE(name);
    const std::string output = name;
    REQUIRE(run(folder, "sphere.net -o " + output + " --curves --spacing 0.1").status == 0);
    const Run again = run(folder, output + " -o t.ply --spacing 0.1 --report t.json --quiet");
    CHECK(again.err == "");
    auto report = JsonReader(read_file(folder / "t.json")).values;
    CHECK(report["patches"] == "8");
    CHECK(report["euler_characteristic"] == "2");
  }
  CHECK(run(folder, "sphere.net -o s.stl --curves").status == 2);
}

TEST_CASE("an option that this network does not allow is named, not a line of the file") {
  const ScratchFolder folder("command");
  write_file(folder / "sphere.net", sphere_net(8));
  const struct {
    const char* option;
    const char* sentence;
  } cases[] = {
      {"--soft 5", "the cutoff length of soft constraints is more than a tenth of the diagonal"},
      {"--snap 5", "the snapping tolerance is more than a tenth of the diagonal"},
      {"--smooth 5", "the noise stated is too large for the curves"},
  };
  for (const auto& c : cases) {
    CAPTURE(c.option);
    const Run r = run(folder, std::string("sphere.net -o a.obj --report r.json ") + c.option);
    CHECK(r.status == 2);
    CHECK(r.err ==
          "sphere.net: " + std::string(c.option) + ": " + c.sentence + "; the diagonal is 3.46\n");
    auto report = JsonReader(read_file(folder / "r.json")).values;
    CHECK(report["status"] == "bad_argument");
    CHECK(report["place"] == "null");
  }
}

TEST_CASE("signs that contradict each other: the place, and the option that helps") {
  const ScratchFolder folder("command");
  std::string cube = cube_corners();
  for (int i = 0; i < 8; ++i) {  // all to the side of +x
    const int sign = (i & 1) != 0 ? 1 : -1;
    for (int k = 0; k < 3; ++k) {
      cube += (k == 0 ? "vn " : " ") + std::to_string(((i >> k) & 1) != 0 ? sign : -sign);
    }
    cube += "\n";
  }
  write_file(folder / "cube.obj", cube + cube_edges());
  const Run r = run(folder, "cube.obj -o s.obj --spacing 0.2");
  CHECK(r.status == 1);
  CHECK(r.err.find("cube.obj: curve 0, sample 1: the normal points to the other side") == 0);
  CHECK(r.err.find("; try --orient\n") != std::string::npos);
  const Run oriented = run(folder, "cube.obj -o s.obj --spacing 0.2 --orient");
  CHECK(oriented.status == 0);
  CHECK(oriented.out.find(", 6 patches, ") != std::string::npos);
}

TEST_CASE("the summary: every output, what was made, what did nothing") {
  const ScratchFolder folder("command");
  write_file(folder / "ring.obj",
             "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 1\nvn 0 0 1\nvn 0 0 1\nvn 0 0 1\n"
             "g boundary\nl 1 2\nl 2 3\nl 3 4\nl 4 1\n");
  Run r = run(folder, "ring.obj -o a.obj -o b.stl --voids 1 --up x --report r.json");
  CHECK(r.status == 0);
  CHECK(r.out.find("a.obj, b.stl: ") == 0);
  CHECK(r.out.find(" triangles, 1 patch, ") != std::string::npos);
  CHECK(r.out.find("\n--voids had no effect: normals gave the patches") != std::string::npos);
  CHECK(r.out.find("\n--up had no effect") != std::string::npos);
  const std::string report = read_file(folder / "r.json");
  CHECK(report.find("\"outputs\": [\"a.obj\", \"b.stl\"]") != std::string::npos);
  CHECK(report.find("\"idle_options\": [\"--voids\", \"--up\"]") != std::string::npos);
  CHECK(run(folder, "ring.obj -o a.obj --format stl")
            .out.find("\n--format had no effect: it is "
                      "for -o -\n") != std::string::npos);
  r = run(folder, "ring.obj -o a.obj --soft 0.1");
  CHECK(one_line(r.out));
}

TEST_CASE("the summary: a spacing coarser than the curves, columns that were passed over") {
  const ScratchFolder folder("command");
  std::string rows = "x,y,z,w,curve\n";
  const char* corners[] = {"0,0,0", "1,0,0", "1,1,0", "0,1,0", "0,0,0"};
  for (int k = 0; k < 4; ++k) {
    for (int end = 0; end < 2; ++end) {
      rows += std::string(corners[k + end]) + ",7," + std::to_string(k) + "\n";
    }
  }
  write_file(folder / "square.csv", rows);
  const Run r = run(folder, "square.csv -o a.obj --spacing 2");
  CHECK(r.status == 0);
  CHECK(r.out.find("\ncolumns passed over, their names mean nothing here: \"w\"\n") !=
        std::string::npos);
  write_file(folder / "sphere.net", sphere_net(4));
  const Run coarse = run(folder, "sphere.net -o a.obj --spacing 10 --method stanko");
  CHECK(
      coarse.out.find("\nthe spacing, 10, is coarse for these curves: 12 edges on 12 stretches") !=
      std::string::npos);
  CHECK(run(folder, "sphere.net -o a.obj --method stanko").out.find("coarse") == std::string::npos);
}

TEST_CASE("the summary: points in no order are no curve") {
  const ScratchFolder folder("command");
  // On a unit sphere, each far from the one before.
  std::string rows, circle;
  for (int i = 0; i < 40; ++i) {
    const double z = (i * 17 % 40 - 19.5) / 20.0, angle = 2.4 * (i * 17 % 40);
    const double radius = std::sqrt(1.0 - z * z);
    rows += std::to_string(radius * std::cos(angle)) + "," +
            std::to_string(radius * std::sin(angle)) + "," + std::to_string(z) + "\n";
    circle +=
        std::to_string(std::cos(0.157 * i)) + "," + std::to_string(std::sin(0.157 * i)) + ",0\n";
  }
  write_file(folder / "cloud.csv", rows);
  write_file(folder / "circle.csv", circle + circle.substr(0, circle.find('\n') + 1));
  Run r = run(folder, "cloud.csv -o a.ply");
  CHECK(r.status == 0);
  CHECK(r.out.find("\nthe curve of line 1 turns back at ") != std::string::npos);
  r = run(folder, "circle.csv -o a.ply");
  CHECK(r.status == 0);
  CHECK(r.out.find("turns back") == std::string::npos);
}

TEST_CASE("an output folder that is not there is found before the work") {
  const ScratchFolder folder("command");
  write_file(folder / "sphere.net", sphere_net(8));
  const Run r = run(folder, "sphere.net -o missing/s.obj --spacing 1e-5");
  CHECK(r.err.find("missing/s.obj: cannot be written: ") == 0);
}

TEST_CASE("a result on the standard output, the summary then on the standard error") {
  const ScratchFolder folder("command");
  write_file(folder / "sphere.net", sphere_net(8));
  REQUIRE(run(folder, "sphere.net -o s.stl -o s.ply --spacing 0.2 --quiet").status == 0);
  const Run ply = run(folder, "- -o - --spacing 0.2 < sphere.net");
  CHECK(ply.status == 0);
  CHECK(ply.out == read_file(folder / "s.ply"));
  CHECK(ply.err.find("standard output: ") == 0);
  const Run stl = run(folder, "sphere.net -o - --format stl --spacing 0.2 --quiet");
  CHECK(stl.out.size() == read_file(folder / "s.stl").size());
  CHECK(stl.err == "");
  const Run report = run(folder, "sphere.net -o t.ply --report - --spacing 0.2");
  CHECK(JsonReader(report.out).values["status"] == "ok");
  CHECK(folder.file_count() == 4);
}

TEST_CASE("the standard input") {
  const ScratchFolder folder("command");
  write_file(folder / "sphere.net", sphere_net(8));
  CHECK(run(folder, "- -o s.obj --spacing 0.2 < sphere.net").status == 0);
  CHECK(run(folder, "- -o s.obj < /dev/null").err == "-: the file is empty\n");
}

#ifdef __unix__
TEST_CASE("a name with control characters does not break the line of the message") {
  const ScratchFolder folder("command");
  const Run r = run(folder, "\"$(printf 'a\\nb\\033c')\".net -o s.obj");
  CHECK(r.status == 1);
  CHECK(r.err == "a\\nb\\x1bc.net: there is no such file\n");
}

TEST_CASE("a full disk leaves neither file nor remains, nor harms what was there") {
  const ScratchFolder folder("command");
  write_file(folder / "sphere.net", sphere_net(8));
  write_file(folder / "s.obj", "old");
  // Files may not grow beyond a few blocks; the mesh needs more.
  const Run r = run(folder, "sphere.net -o s.obj --report s.json", "ulimit -f 8; ");
  CHECK(r.status == 1);
  CHECK(one_line(r.err));
  CHECK(r.err.find("s.obj: cannot be written: ") == 0);
  CHECK(read_file(folder / "s.obj") == "old");
  CHECK(folder.file_count() == 2);
}

TEST_CASE("a signal cancels, and nothing is left") {
  const ScratchFolder folder("command");
  write_file(folder / "sphere.net", sphere_net(64));
  // So fine a spacing would take minutes.
  const Run r =
      run(folder, "sphere.net -o s.obj --spacing 0.002 & sleep 1; kill -TERM $!; wait $!");
  CHECK(r.status == 1);
  CHECK(r.err.find("sphere.net: cancelled\n") != std::string::npos);
  CHECK(folder.file_count() == 1);
}
#endif

TEST_CASE("the example in C writes the sphere") {
  const ScratchFolder folder("command");
  const std::string target = folder / "sphere.obj";
  REQUIRE(std::system(("'" + std::string(WIRESKIN_THREE_CIRCLES) + "' '" + target + "'").c_str()) ==
          0);
  std::ifstream file(target);
  std::string word;
  size_t vertices = 0, triangles = 0;
  double farthest = 0.0;
  while (file >> word) {
    if (word == "v") {
      double x = 0, y = 0, z = 0;
      file >> x >> y >> z;
      farthest = std::max(farthest, std::fabs(std::sqrt(x * x + y * y + z * z) - 1.0));
      ++vertices;
    } else if (word == "f") {
      ++triangles;
    }
  }
  CHECK(vertices > 500);
  // Euler: a closed surface of genus 0.
  CHECK(triangles == 2 * vertices - 4);
  CHECK(farthest < 0.05);
}

TEST_CASE("surfaces in doubt: loops that might be joined otherwise, normals that are left far") {
  const ScratchFolder folder("command");
  std::string vertices, normals, lines;
  int count = 0;
  const auto ring = [&](const char* group, double radius, double z, int side) {
    lines += "g " + std::string(group) + "\nl";
    for (int k = 0; k < 48; ++k) {
      const double c = std::cos(2 * k_pi * k / 48), s = std::sin(2 * k_pi * k / 48);
      vertices += "v " + std::to_string(radius * c) + " " + std::to_string(radius * s) + " " +
                  std::to_string(z) + "\n";
      normals += "vn " + std::to_string(side * c) + " " + std::to_string(side * s) + " 0\n";
      lines += " " + std::to_string(++count);
    }
    lines += " " + std::to_string(count - 47) + "\n";
  };
  // Two tubes, one in the other.
  ring("boundary_a", 1.0, 0.0, 1);
  ring("middle", 1.0, 1.0, 1);
  ring("boundary_b", 1.0, 2.0, 1);
  ring("boundary_c", 0.6, 0.5, -1);
  ring("boundary_d", 0.6, 1.5, -1);
  write_file(folder / "tubes.obj", vertices + normals + lines);
  const Run r = run(folder, "tubes.obj -o s.obj --report s.json --spacing 0.2");
  REQUIRE(r.status == 0);
  auto report = JsonReader(read_file(folder / "s.json")).values;
  CHECK((report["ambiguous_patches"] == "0") ==
        (r.out.find("might as well be joined otherwise") == std::string::npos));
  CHECK((std::stod(report["normal_deviation_max_deg"]) <= 50.0) ==
        (r.out.find("leaves the normals by up to") == std::string::npos));
  const bool right = report["patches"] == "3" && report["euler_characteristic"] == "0";
  const bool told = r.out.find("otherwise") != std::string::npos ||
                    r.out.find("leaves the normals") != std::string::npos;
  CHECK((right || told));
}

TEST_CASE("from curves alone: ends that meet nothing are told, with what may join them") {
  const ScratchFolder folder("command");
  const std::string short_edge = "v 0.05 0 0\nl 9 2\n";  // instead of the one from 1 to 2
  std::string edges = cube_edges();
  const std::string whole = "l 1 2\n";
  const size_t at = edges.find(whole);
  REQUIRE(at != std::string::npos);
  edges.erase(at, whole.size());
  write_file(folder / "cube.obj", cube_corners() + edges + short_edge);
  Run r = run(folder, "cube.obj -o s.obj --spacing 0.25");
  REQUIRE(r.status == 0);
  CHECK(r.out.find("1 end of a curve meets no other: --snap LENGTH") != std::string::npos);
  r = run(folder, "cube.obj -o s.obj --spacing 0.25 --snap 0.06");
  REQUIRE(r.status == 0);
  CHECK(r.out.find("--snap LENGTH") == std::string::npos);
}

namespace {

// Two circles and four rails, in the format .obj.
std::string can_obj() {
  constexpr int n = 48;
  std::string rows, rings;
  for (int i = 0; i < 2 * n; ++i) {
    char row[100];
    const double a = 2.0 * k_pi * (i % n) / n;
    std::snprintf(row, sizeof row, "v %.17g %.17g %d\n", std::cos(a), std::sin(a), 2 * (i / n));
    rows += row;
    rings += (i % n == 0 ? "l " : " ") + std::to_string(i + 1);
    if (i % n == n - 1) rings += " " + std::to_string(i + 2 - n) + "\n";
  }
  for (int i = 1; i <= n; i += n / 4) {
    rings += "l " + std::to_string(i) + " " + std::to_string(i + n) + "\n";
  }
  return rows + rings;
}

// 6 x 6 x 6 cubes, none of whose faces is flat.
std::string crooked_grid_obj() {
  std::string rows, edges;
  for (int i = 0; i < 343; ++i) {
    const int at[3] = {i % 7, i / 7 % 7, i / 49};
    rows += "v";
    for (int k = 0; k < 3; ++k) {
      rows += " " + std::to_string(at[k] + 0.1 * std::sin(7.0 * i + 2.0 * k));
    }
    rows += "\n";
    for (int k = 0, step = 1; k < 3; ++k, step *= 7) {
      if (at[k] == 6) continue;
      edges += "l " + std::to_string(i + 1) + " " + std::to_string(i + step + 1) + "\n";
    }
  }
  return rows + edges;
}

}  // namespace

TEST_CASE("from curves alone: round ends left open, voids not looked at, the sampling") {
  const ScratchFolder folder("command");
  write_file(folder / "can.obj", can_obj());
  Run r = run(folder, "can.obj -o s.obj --report s.json --spacing 1");
  REQUIRE(r.status == 0);
  CHECK(r.out.find("\n1 round end left open, as of a tube; --lids all closes each\n") !=
        std::string::npos);
  CHECK(r.out.find("no farther apart than the samples, 0.0693\n") != std::string::npos);
  auto report = JsonReader(read_file(folder / "s.json")).values;
  CHECK(report["flow.open_lids"] == "1");
  CHECK(report["flow.flat_faces_skipped"] == "false");
  CHECK(report["flow.untried_voids"] == "0");
  CHECK(std::stod(report["flow.sampling"]) == doctest::Approx(0.02 * std::sqrt(12.0)));
  r = run(folder, "can.obj -o s.obj --report s.json --lids all");
  REQUIRE(r.status == 0);
  CHECK(r.out.find("left open") == std::string::npos);
  CHECK(r.out.find("no farther apart") == std::string::npos);
  report = JsonReader(read_file(folder / "s.json")).values;
  CHECK(report["flow.open_lids"] == "0");
  write_file(folder / "grid.obj", crooked_grid_obj());
  r = run(folder, "grid.obj -o s.obj --report s.json");
  REQUIRE(r.status == 0);
  report = JsonReader(read_file(folder / "s.json")).values;
  CHECK(std::stoi(report["flow.untried_voids"]) >= 16);
  CHECK(r.out.find("\n" + report["flow.untried_voids"] +
                   " voids were not looked at: those of the least ratios\n") != std::string::npos);
}
