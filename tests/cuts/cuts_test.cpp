// Networks cut by planes from measured meshes: every one must be surfaced with the Euler
// characteristic of its mesh; the distances to it are reported in a table. The files are found in
// the folder that WIRESKIN_TEST_DATA names.
#include <doctest/doctest.h>

#include <cstdio>
#include <string>

#include "cuts/shapes.h"

using namespace accuracy;
using namespace networks;

namespace {

// Planes at these fractions of the bounding box along x, y and z.
struct Cuts {
  const char* file;
  std::vector<double> x, y, z;
};

const std::vector<double> k_three = {0.2517, 0.4931, 0.7483}, k_four = {0.19, 0.41, 0.61, 0.83};
const std::vector<double> k_two = {0.3517, 0.6483}, k_five = {0.11, 0.29, 0.47, 0.67, 0.87};

const Cuts k_cuts[] = {
    {"common-meshes/spot.obj", k_three, k_three, k_three},
    {"common-meshes/spot.obj", k_two, k_four, k_four},
    {"libigl-meshes/bumpy-cube.obj", k_three, k_three, k_three},
    {"libigl-meshes/bumpy-cube.obj", k_two, k_two, k_two},
    {"libigl-meshes/3holes.off", k_four, k_four, k_two},
    {"libigl-meshes/3holes.off", k_five, k_five, {0.47}},
    {"libigl-meshes/fertility.off", k_five, k_five, k_five},
    {"pmp-meshes/hemisphere.off", k_two, k_two, {}},
    {"pmp-meshes/hemisphere.off", k_three, k_three, {0.513}},
    {"common-meshes/beetle.obj", k_two, k_two, k_two},
    {"stability-networks/shell.obj", k_two, k_two, {}},
    {"stability-networks/half_sphere.obj", k_two, k_two, {}},
    {"stability-networks/hill.obj", k_three, k_two, {}},
    {"stability-networks/leaf.obj", k_three, k_two, {}},
};

}  // namespace

TEST_CASE("networks cut by planes are surfaced as the mesh they come from") {
  size_t found = 0;
  std::printf("%-36s %7s %7s %6s %9s %9s %9s\n", "mesh", "curves", "patches", "Euler", "in space",
              "RMS/1000", "max/1000");
  for (const Cuts& planes : k_cuts) {
    const std::string path = data_file(planes.file);
    if (path.empty()) continue;
    ++found;
    CAPTURE(std::string(planes.file));
    const Mesh mesh = cuts::read_mesh(path);
    RealCase c;
    c.network = cut(mesh, cuts::planes_along_axes(mesh, planes.x, planes.y, planes.z));
    c.truth = std::make_shared<MeshDistance>(mesh);
    const double size = c.truth->diagonal();
    const Result result = build(c.network, WSK_METHOD_FAIR, size / 60.0);
    CAPTURE(std::string(result.report.sentence));
    CAPTURE(result.report.curve);
    CAPTURE(result.report.patch);
    CHECK(result.status == WSK_OK);
    if (result.status != WSK_OK) {
      std::printf("%-36s %7zu %s\n", planes.file, c.network.curves.size(), result.report.sentence);
      continue;
    }
    const RealError error = real_error(result, c);
    std::printf("%-36s %7zu %7u %6d %9u %9.2f %9.1f\n", planes.file, c.network.curves.size(),
                result.report.patches, result.report.euler_characteristic,
                result.report.minimal_area_patches, 1000.0 * error.rms / size,
                1000.0 * error.max / size);
    CHECK(result.report.euler_characteristic == cuts::euler_characteristic(mesh));
    CHECK(error.inside_out.empty());
    CHECK(error.rms < 0.03 * size);
  }
  if (found == 0) std::printf("skipped: WIRESKIN_TEST_DATA is not set\n");
}
