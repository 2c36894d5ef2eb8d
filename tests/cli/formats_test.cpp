#include "formats.h"

#include <doctest/doctest.h>

#include <cstdio>
#include <cstdlib>

#include "cli/corpus.h"
#include "cli/network_checks.h"
#include "cli/support.h"
#include "read_network.h"

using namespace wireskin_cli;
using namespace cli_test;

TEST_CASE("files of other kinds are told by their first bytes") {
  CHECK(std::string(foreign_kind("\x1f\x8b\x08")) == "this is packed by gzip: unpack it first");
  CHECK(foreign_kind("PK\x03\x04 and so on") != nullptr);
  CHECK(foreign_kind("ISO-10303-21;\n") != nullptr);
  CHECK(foreign_kind("solid name\n") != nullptr);
  for (const char* ours : {"", "v 0 0 0\n", "ply\n", "# 3\n", "3\n0 0 0\n", "x,y,z\n", "PK"}) {
    CHECK(foreign_kind(ours) == nullptr);
  }
}

TEST_CASE("files without or with a wrong extension are known by their content") {
  for (const CorpusFile& file : corpus()) {
    CAPTURE(file.path);
    const std::string extension = fs::path(file.path).extension().string();
    const Format seen = format_of("file", file.bytes.substr(file.bytes[0] == '\xEF' ? 3 : 0));
    // Points look like a curve, and the format with tangents begins like OBJ.
    const bool like = file.format == Format::points || file.format == Format::curf;
    if (!like) CHECK(seen == file.format);
    CHECK(format_of("file" + extension, file.bytes) == file.format);
  }
  const std::string obj = "# x\nv 0 0 0\nv 1 0 0\nl 1 2\n";
  for (const char* name : {"a.net", "a.csv", "a.ply", "a.curves", "a", "-"}) {
    CHECK(format_of(name, obj) == Format::obj);
  }
  CHECK(format_of("a.obj", "2\n0 0 0 0 0 1\n1 0 0 0 0 1\n1\n0\n0 1\n") == Format::net);
  CHECK(format_of("a.xyz", "1 2 3\n") == Format::points);
  CHECK(format_of("a.obj", "x,y,z\n1,2,3\n") == Format::table);
  CHECK(format_of("a.net", "ply\nformat ascii 1.0\n") == Format::ply);
  // A damaged file keeps the format that its name says.
  CHECK(format_of("a.net", "3\n1 2 3 4\n") == Format::net);
  for (const char* text : {"<svg/>", "OFF\n8 6 0\n1 2 3\n", "5\n3\n8 0 0\n", "1 2\n3 4\n", "#\n"}) {
    CHECK(format_of("a.what", text) == Format::none);
  }
}

TEST_CASE("text in UTF-16 is refused by name") {
  const ScratchFolder scratch("formats");
  const std::string path = scratch / "a.csv";
  write_file(path, std::string("\xFF\xFE\x31\0", 4));
  CHECK(failure_of([&] { read_network(path); }) ==
        path + ": the text is UTF-16: save it as UTF-8 or ASCII");
}

// ---- Real files
// ----------------------------------------------------------------------------------

static std::string data_folder() {
  const char* folder = std::getenv("WIRESKIN_TEST_DATA");
  return folder != nullptr && *folder != 0 ? folder : WIRESKIN_TEST_DATA;
}

static bool have(const std::string& path) {
  if (data_folder() != "" && fs::exists(data_folder() + "/" + path)) return true;
  std::printf("skipped: %s is not in WIRESKIN_TEST_DATA\n", path.c_str());
  return false;
}

struct RealFile {
  const char* path;
  size_t vertices;
  size_t curves;
  size_t points;
  bool normals;
};

TEST_CASE("real files of every set hold what their authors say") {
  const RealFile files[] = {
      {"stanko-blendernet/lilium.net", 401, 3, 0, true},
      {"vns-sketches/box.obj", 2906, 2910, 0, false},
      {"vns-sketches/doghead.obj", 2779, 2813, 0, false},
      {"stability-networks/hill_3.txt", 217, 3, 0, false},
      {"stability-networks/roof_75.txt", 0, 75, 0, false},
      {"stability-networks/shell_100.txt", 0, 60, 0, false},
      {"contours/ringc.contour", 0, 0, 0, false},
      {"contours/newliver.contour", 0, 0, 0, false},
      {"contours/Bermano.contour", 0, 0, 0, false},
      {"nnvipss-normals/torus_n50.xyz", 50, 0, 50, true},
      {"nnvipss-normals/torus_wires.xyz", 991, 0, 991, true},
      {"vipss-points/bathtub.xyz", 800, 0, 800, false},
      {"smi16-extrinsic/drawcurveIn.curf", 150, 149, 0, false},
      {"flow-tests/cube.obj", 8, 12, 0, false},
  };
  for (const RealFile& file : files) {
    if (!have(file.path)) continue;
    CAPTURE(file.path);
    const Network network = read_network(data_folder() + "/" + file.path);
    CHECK(broken_invariant(network) == "");
    if (file.vertices != 0) CHECK(network.vertex_count() == file.vertices);
    if (file.curves != 0) CHECK(network.curves.size() == file.curves);
    CHECK(network.points.size() == file.points);
    CHECK(network.normals.empty() != file.normals);
    CHECK(network.curves.size() + network.points.size() > 0);
  }
}

TEST_CASE("all sketches and all scenes of the flow complex can be read") {
  for (const char* set : {"vns-sketches", "flow-tests"}) {
    if (!have(set)) continue;
    size_t count = 0;
    for (const auto& entry : fs::directory_iterator(data_folder() + "/" + set)) {
      if (entry.path().extension() != ".obj") continue;
      CAPTURE(entry.path().string());
      const Network network = read_network(entry.path().string());
      CHECK(broken_invariant(network) == "");
      CHECK(network.curves.size() + network.points.size() > 0);
      ++count;
    }
    CHECK(count >= 15);
  }
}

TEST_CASE("the measurements of lilium and its network agree") {
  if (!have("stanko-blendernet/lilium.rawnet")) return;
  const std::string folder = data_folder() + "/stanko-blendernet/";
  const Network raw = read_network(folder + "lilium.rawnet");
  const Network net = read_network(folder + "lilium.net");
  REQUIRE(raw.raw_curves.size() == 3);
  CHECK(raw.raw_curves[0].closed);
  CHECK(raw.raw_curves[0].boundary);
  CHECK(raw.raw_curves[0].arc_lengths.size() == 187);
  CHECK(raw.raw_curves[0].nodes == std::vector<uint32_t>{0, 45, 91, 138, 186});
  CHECK(raw.raw_curves[1].global_nodes == std::vector<uint32_t>{2, 3, 4});
  // Global node 0 is vertex 0 of the network: the same normal stands in both files.
  for (size_t k = 0; k < 3; ++k) CHECK(raw.raw_curves[0].normals[k] == net.normals[k]);
}
