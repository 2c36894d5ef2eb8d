// What the tests of the command share: a scratch folder, files, the message of a failure, a mesh.
#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "failure.h"
#include "wireskin.h"

namespace cli_test {

namespace fs = std::filesystem;

// An empty folder that goes with the object.
class ScratchFolder {
 public:
  explicit ScratchFolder(const std::string& name) : path_(fs::path(WIRESKIN_SCRATCH) / name) {
    fs::remove_all(path_);
    fs::create_directories(path_);
  }
  ~ScratchFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }
  std::string path() const { return path_.string(); }
  size_t file_count() const {
    return static_cast<size_t>(std::distance(fs::directory_iterator(path_), {}));
  }

 private:
  fs::path path_;
};

inline void write_file(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

inline std::string read_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

// The line of the Failure that the call ends with, "" if it ends without one.
template <typename Call>
std::string failure_of(const Call& call) {
  try {
    call();
  } catch (const wireskin_cli::Failure& failure) {
    return failure.what();
  }
  return "";
}

// A unit square in the plane z = 0 as two triangles, each a patch of its own, patch 1 first.
struct Square {
  std::vector<double> positions = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
  std::vector<double> normals = {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1};
  std::vector<double> mean_curvature = {0.5, -0.25, 0, 1};
  std::vector<uint32_t> triangles = {0, 1, 2, 0, 2, 3};
  std::vector<uint32_t> triangle_patch = {1, 0};
  std::vector<uint32_t> curve_edges = {0, 1, 1, 2, 2, 3, 3, 0};
  std::vector<uint32_t> curve_edge_curve = {0, 0, 0, 1};

  wsk_surface_view view() const {
    wsk_surface_view v = {};
    v.size = sizeof v;
    v.vertex_count = 4;
    v.triangle_count = 2;
    v.patch_count = 2;
    v.curve_edge_count = 4;
    v.positions = positions.data();
    v.normals = normals.data();
    v.mean_curvature = mean_curvature.data();
    v.triangles = triangles.data();
    v.triangle_patch = triangle_patch.data();
    v.curve_edges = curve_edges.data();
    v.curve_edge_curve = curve_edge_curve.data();
    return v;
  }
};

}  // namespace cli_test
