// The closed forms on which accuracy is measured: networks and bands, their surfaces, and the
// bounds that the method `fair` is held to.
//
// A case is built with one of three mesh seeds. The mesher has no random numbers, so a seed turns
// the network by a fixed rotation and changes the spacing by 3 percent; the meshes of bands are
// shaken by another sequence. Results are turned back, so they compare with the same surface.
#pragma once

#include <string>

#include "accuracy/measure.h"

namespace accuracy {

struct Case {
  std::string name;
  networks::Surface truth;
  double spacing = 0.0;
  // Given a spacing: a network, or where that is null the mesh of a band.
  std::function<networks::Network(double)> network;
  std::function<networks::BandMesh(double, unsigned)> band;
  double must = 0.0;         // the bound on the RMS of `fair`; 0: none
  double expected = 0.0;     // the RMS that the prototype of the method reached; 0: not known
  double over_stanko = 1.0;  // the bound on the RMS of `fair` over that of stanko
};

constexpr unsigned k_seeds = 3;

// Those with a bound come first.
std::vector<Case> cases_with_bounds();
// More that the method's constants were chosen with.
std::vector<Case> cases_seen();
// And those that they were not chosen with.
std::vector<Case> cases_unseen();

// `samples` is the spacing of the network's samples (0: the case's), `spacing` that of the mesh.
Result build(const Case& c, wsk_method method, unsigned seed = 0);
Result build(const Case& c, wsk_method method, double samples, double spacing);

}  // namespace accuracy
