// Networks of measured shapes: lilium with its scanned surface, and meshes cut by planes. Their
// files may not be shipped; they are found in the folder that WIRESKIN_TEST_DATA names.
//
// The planes are the first sets that a random search over axis-parallel planes found under three
// conditions alone: every cycle bounds a disc (Euler's characteristic is the mesh's), there are 12
// to 32 patches, and no border of a patch is shorter than .12 of the diagonal. The offsets were not
// chosen for the results; some patches are folded when seen along their mean normal, but in the
// third set of each mesh, the first such one (for the cow that of examples/data).
#pragma once

#include <memory>
#include <string>

#include "accuracy/measure.h"
#include "accuracy/mesh_distance.h"

namespace accuracy {

// The path of a file below the folder of test data, "" where it does not exist.
std::string data_file(const std::string& name);

struct RealCase {
  std::string name;
  networks::Network network;
  std::shared_ptr<MeshDistance> truth;
  networks::Point shift = {0.0, 0.0, 0.0};  // from the network to the truth
  double spacing = 0.0;
  bool outward = true;  // whether the truth's triangles face as the network's normals do
};

// Empty where the files are missing.
std::vector<RealCase> lilium();
std::vector<RealCase> cut_meshes();

struct RealError {
  double rms = 0.0;  // of free vertices to the mesh
  double max = 0.0;
  double opposed = 0.0;  // share of the area whose triangles face against the mesh next to them
  std::vector<uint32_t> inside_out;  // patches most of whose area does
  std::vector<uint32_t> opposing;    // patches of whose area more than a hundredth does
  // Edges inside patches whose two triangles face against each other: the surface itself is folded.
  uint32_t sharp_edges = 0;
};
RealError real_error(const Result& result, const RealCase& c);

}  // namespace accuracy
