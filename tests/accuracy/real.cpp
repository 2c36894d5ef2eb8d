#include "accuracy/real.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>

#include "io.h"

#ifndef WIRESKIN_TEST_DATA
#define WIRESKIN_TEST_DATA ""
#endif

namespace accuracy {

using namespace networks;  // its operators on points are not found otherwise

std::string data_file(const std::string& name) {
  const char* folder = std::getenv("WIRESKIN_TEST_DATA");
  const std::string root = folder != nullptr && *folder != 0 ? folder : WIRESKIN_TEST_DATA;
  const std::string path = root + "/" + name;
  return !root.empty() && std::filesystem::exists(path) ? path : "";
}

std::vector<RealCase> lilium() {
  const std::string net = data_file("stanko-blendernet/lilium.net");
  const std::string model = data_file("stanko-blendernet/lilium.off");
  if (net.empty() || model.empty()) return {};
  RealCase c;
  c.name = "lilium";
  c.network = read_network(net);
  c.truth = std::make_shared<MeshDistance>(read_off(model));
  c.shift = {-0.1981, -0.2474, 0.1189};
  c.spacing = 0.035;
  double facing = 0.0;
  for (size_t i = 0; i < c.network.positions.size(); ++i) {
    const auto near = c.truth->nearest(c.network.positions[i] + c.shift);
    facing += dot(c.truth->triangle_normal(near.triangle), unit(c.network.normals[i]));
  }
  c.outward = facing > 0.0;
  return {c};
}

struct CutSet {
  const char* file;
  const char* name;
  std::vector<double> x, y, z;
};

static const CutSet k_cuts[] = {
    {"common-meshes/spot.obj",
     "spot",
     {-.142345, .111288},
     {-.248457, .165638, .535735},
     {-.507266}},
    {"common-meshes/spot.obj",
     "spot",
     {-.359745, -.00517618},
     {-.173402, .0828189},
     {-.173402, .256221}},
    {"common-meshes/spot.obj", "spot", {0, .271, -.271}, {-.049, .704}, {-.232, .005, .356}},
    {"libigl-meshes/bumpy-cube.obj",
     "bumpy-cube",
     {-1.30863, 1.02284},
     {-1.83509, .285793, 2.1961},
     {-3.51977}},
    {"libigl-meshes/bumpy-cube.obj",
     "bumpy-cube",
     {-3.42952, -.0300835, 1.38384},
     {2.15097},
     {-.376044, 1.15821}},
    {"libigl-meshes/bumpy-cube.obj",
     "bumpy-cube",
     {-3.32423, -.0300835},
     {-1.44401, -.120334},
     {-1.83509, .330919}},
    {"common-meshes/cheburashka.obj", "cheburashka", {.498085, .617829}, {.393627}, {.436939}},
    {"common-meshes/cheburashka.obj",
     "cheburashka",
     {.514645, .755407},
     {.201272, .462416},
     {.485346}},
    {"common-meshes/cheburashka.obj", "cheburashka", {.478976}, {.614007, .728656}, {.435665}},
    {"libigl-meshes/3holes.off",
     "3holes",
     {.349999, .617986},
     {.400824, .515181, .617986},
     {.51056}},
    {"libigl-meshes/3holes.off", "3holes", {.507095, .621451}, {.511715, .61221}, {.764685}},
    {"libigl-meshes/3holes.off", "3holes", {.10627, .86287}, {.526732}, {.723101}},
};

std::vector<RealCase> cut_meshes() {
  std::vector<RealCase> cases;
  std::string last;
  Mesh mesh;
  std::shared_ptr<MeshDistance> truth;
  int number = 0;
  for (const CutSet& set : k_cuts) {
    const std::string path = data_file(set.file);
    if (path.empty()) continue;
    if (path != last) {
      mesh = path.substr(path.size() - 4) == ".off" ? read_off(path) : read_obj(path);
      truth = std::make_shared<MeshDistance>(mesh);
      last = path;
      number = 0;
    }
    std::vector<Plane> planes;
    for (double offset : set.x) planes.push_back({{1.0, 0.0, 0.0}, offset});
    for (double offset : set.y) planes.push_back({{0.0, 1.0, 0.0}, offset});
    for (double offset : set.z) planes.push_back({{0.0, 0.0, 1.0}, offset});
    RealCase c;
    c.name = set.name + std::string(", cut ") + std::to_string(++number);
    c.network = cut(mesh, planes);
    c.truth = truth;
    cases.push_back(std::move(c));
  }
  return cases;
}

static uint32_t count_sharp_edges(const Result& result) {
  std::map<std::pair<uint32_t, uint32_t>, Point> first;
  uint32_t sharp = 0;
  for (size_t t = 0; t < result.triangles.size(); t += 3) {
    const uint32_t* v = &result.triangles[t];
    const Point& p = result.positions[v[0]];
    const Point normal = cross(result.positions[v[1]] - p, result.positions[v[2]] - p);
    for (size_t i = 0; i < 3; ++i) {
      const uint32_t a = v[i], b = v[(i + 1) % 3];
      const auto [known, added] = first.insert({std::minmax(a, b), normal});
      if (added || (!result.is_free(a) && !result.is_free(b))) continue;
      if (dot(known->second, normal) < 0.0) ++sharp;
    }
  }
  return sharp;
}

RealError real_error(const Result& result, const RealCase& c) {
  RealError error;
  double sum = 0.0;
  size_t count = 0;
  for (size_t v = 0; v < result.positions.size(); ++v) {
    if (!result.is_free(v)) continue;
    const double distance = c.truth->nearest(result.positions[v] + c.shift).distance;
    sum += distance * distance;
    error.max = std::fmax(error.max, distance);
    ++count;
  }
  error.rms = count > 0 ? std::sqrt(sum / static_cast<double>(count)) : 0.0;

  std::vector<double> area(result.report.patches, 0.0), opposed(result.report.patches, 0.0);
  double total = 0.0, total_opposed = 0.0;
  for (size_t t = 0; t < result.patches.size(); ++t) {
    const Point& p = result.positions[result.triangles[3 * t]];
    const Point& q = result.positions[result.triangles[3 * t + 1]];
    const Point& r = result.positions[result.triangles[3 * t + 2]];
    const Point normal = cross(q - p, r - p);
    const auto near = c.truth->nearest((1.0 / 3.0) * (p + q + r) + c.shift);
    const double facing = dot(normal, c.truth->triangle_normal(near.triangle));
    const double size = 0.5 * length(normal);
    const bool against = c.outward ? facing < 0.0 : facing > 0.0;
    area[result.patches[t]] += size;
    total += size;
    if (!against) continue;
    opposed[result.patches[t]] += size;
    total_opposed += size;
  }
  error.opposed = total_opposed / total;
  error.sharp_edges = count_sharp_edges(result);
  for (uint32_t patch = 0; patch < area.size(); ++patch) {
    if (opposed[patch] > 0.5 * area[patch]) error.inside_out.push_back(patch);
    if (opposed[patch] > 0.01 * area[patch]) error.opposing.push_back(patch);
  }
  return error;
}

}  // namespace accuracy
