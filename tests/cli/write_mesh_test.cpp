#include "write_mesh.h"

#include <doctest/doctest.h>

#include <cfloat>
#include <cstring>

#include "cli/support.h"

using namespace wireskin_cli;
using namespace cli_test;

// The number at a byte, least significant byte first.
template <typename T>
static T little(const std::string& bytes, size_t at) {
  unsigned long long bits = 0;
  REQUIRE(at + sizeof(T) <= bytes.size());
  for (size_t i = sizeof(T); i-- > 0;) {
    bits = bits << 8 | static_cast<unsigned char>(bytes[at + i]);
  }
  if (sizeof(T) == 8) {
    T value;
    std::memcpy(&value, &bits, sizeof value);
    return value;
  }
  const auto narrow = static_cast<uint32_t>(bits);
  T value;
  std::memcpy(&value, &narrow, sizeof value);
  return value;
}

TEST_CASE("OBJ: normals beside vertices, one group a patch in order") {
  Square square;
  square.positions[3] = 1.0 / 3.0;
  CHECK(obj_bytes(square.view()) == std::string("# wireskin ") + wsk_version_string() +
                                        "\n"
                                        "v 0 0 0\nv 0.3333333333333333 0 0\nv 1 1 0\nv 0 1 0\n"
                                        "vn 0 0 1\nvn 0 0 1\nvn 0 0 1\nvn 0 0 1\n"
                                        "g patch_0\nf 1//1 3//3 4//4\n"
                                        "g patch_1\nf 1//1 2//2 3//3\n");
}

TEST_CASE("OBJ: corners at creases have the normals of their own side") {
  Square square;
  wsk_surface_view view = square.view();
  const uint32_t corners[] = {0, 2, 3, 4};
  const double normals[] = {1, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0, 0};
  view.crease_corners = corners;
  view.crease_normals = normals;
  view.crease_corner_count = 4;
  CHECK(obj_bytes(view) == std::string("# wireskin ") + wsk_version_string() +
                               "\n"
                               "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
                               "vn 0 0 1\nvn 0 0 1\nvn 0 0 1\nvn 0 0 1\n"
                               "vn 1 0 0\nvn 0 1 0\n"
                               "g patch_0\nf 1//6 3//5 4//4\n"
                               "g patch_1\nf 1//5 2//2 3//5\n");
}

TEST_CASE("OBJ: curves as polylines, a new one where the curve changes or breaks off") {
  Square square;
  const std::string plain = obj_bytes(square.view());
  CHECK(obj_bytes(square.view(), true) == plain + "g curve_0\nl 1 2 3 4\ng curve_1\nl 4 1\n");
  square.curve_edges = {0, 1, 2, 3, 3, 0, 1, 2};
  square.curve_edge_curve = {5, 5, 5, 0};
  CHECK(obj_bytes(square.view(), true) == plain + "g curve_5\nl 1 2\nl 3 4 1\ng curve_0\nl 2 3\n");
}

TEST_CASE("PLY: curves as edges behind the faces") {
  const Square square;
  const std::string plain = ply_bytes(square.view());
  const std::string bytes = ply_bytes(square.view(), true);
  const std::string header =
      "element edge 4\nproperty int vertex1\nproperty int vertex2\nproperty int curve\n";
  CHECK(bytes.find(header) != std::string::npos);
  CHECK(bytes.size() == plain.size() + header.size() + 4 * 12);
  CHECK(bytes.substr(bytes.size() - 12) == std::string("\3\0\0\0\0\0\0\0\1\0\0\0", 12));
}

TEST_CASE("PLY: header and every byte behind it") {
  const Square square;
  const std::string bytes = ply_bytes(square.view());
  const std::string end = "end_header\n";
  const size_t data = bytes.find(end) + end.size();
  const std::string header = bytes.substr(0, data);
  CHECK(header.compare(0, 4, "ply\n") == 0);
  for (const char* line :
       {"format binary_little_endian 1.0\n", "element vertex 4\n", "property double x\n",
        "property double nz\nproperty double mean_curvature\nelement face 2\n",
        "property list uchar int vertex_indices\nproperty int patch\nend_header\n"}) {
    CAPTURE(line);
    CHECK(header.find(line) != std::string::npos);
  }
  REQUIRE(bytes.size() == data + 4 * 7 * 8 + 2 * (1 + 4 * 4));
  for (size_t v = 0; v < 4; ++v) {
    for (size_t k = 0; k < 3; ++k) {
      CHECK(little<double>(bytes, data + 56 * v + 8 * k) == square.positions[3 * v + k]);
      CHECK(little<double>(bytes, data + 56 * v + 24 + 8 * k) == square.normals[3 * v + k]);
    }
    CHECK(little<double>(bytes, data + 56 * v + 48) == square.mean_curvature[v]);
  }
  for (size_t t = 0; t < 2; ++t) {
    const size_t at = data + 4 * 56 + 17 * t;
    CHECK(bytes[at] == 3);
    for (size_t k = 0; k < 3; ++k) {
      CHECK(little<uint32_t>(bytes, at + 1 + 4 * k) == square.triangles[3 * t + k]);
    }
    CHECK(little<uint32_t>(bytes, at + 13) == square.triangle_patch[t]);
  }
}

TEST_CASE("STL: facets with their normals") {
  const Square square;
  const std::string bytes = stl_bytes(square.view(), "f.stl");
  REQUIRE(bytes.size() == 84 + 2 * 50);
  CHECK(bytes.compare(0, 5, "solid") != 0);
  CHECK(little<uint32_t>(bytes, 80) == 2);
  for (size_t t = 0; t < 2; ++t) {
    CHECK(little<float>(bytes, 84 + 50 * t + 8) == 1.0f);
    for (size_t k = 0; k < 3; ++k) {
      const size_t v = square.triangles[3 * t + k];
      for (size_t j = 0; j < 3; ++j) {
        CHECK(static_cast<double>(little<float>(bytes, 84 + 50 * t + 12 + 12 * k + 4 * j)) ==
              square.positions[3 * v + j]);
      }
    }
    CHECK(bytes.substr(84 + 50 * t + 48, 2) == std::string(2, '\0'));
  }
}

TEST_CASE("STL refuses what single precision cannot hold, OBJ and PLY do not") {
  for (const double scale : {1e-150, 1e150}) {
    Square square;
    for (double& x : square.positions) x *= scale;
    CHECK(failure_of([&] { mesh_bytes(square.view(), "big.stl"); }).find("big.stl: ") == 0);
    CHECK(failure_of([&] { mesh_bytes(square.view(), "big.ply"); }) == "");
    CHECK(mesh_bytes(square.view(), "big.obj").find(scale < 1.0 ? "1e-150" : "1e+150") !=
          std::string::npos);
  }
}
