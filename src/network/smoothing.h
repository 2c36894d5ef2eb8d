// Noise taken out of sampled curves and their normals: a smoothing spline over every connected
// component of the network, its weight found by generalised cross validation, separately for
// positions and normals; or one over the whole network where the noise is stated.
//
// In: thinned samples; those of a node agree and stay one. Out, in place: smoothed positions and
// unit normals, and how much noise was found. Components stay as they are where not even the least
// weight pays, where samples are too few to tell noise from shape, and where a curve would change
// its size. Closed curves are smoothed across their ends; sharp turns survive at ends and corners
// only. Cost: an analysis and some twenty factorisations, a hundred at most. Sources: P. Craven, G.
// Wahba, "Smoothing Noisy Data with Spline Functions", 1979; V. Morozov, "On the Solution of
// Functional Equations by the Method of Regularization", 1966, for given noise.
#pragma once

#include "network/roughness.h"

namespace wireskin::network {

enum class Noise {
  estimate,
  none,  // samples are exact: positions and normals stay
  given  // of the positions; that of the normals is still estimated
};

struct SmoothingOptions {
  Noise noise = Noise::estimate;
  double sigma = 0.0;  // standard deviation of each component of the given positions
  // Less noise than this in positions and in normals need not be found: where the least weight
  // bounds it by that, no other is tried and nothing moves.
  double negligible = 0.0, negligible_normal = 0.0;
};

// Of several connected components the mean squares of the noise, and the greatest weights.
struct SmoothingReport {
  double sigma_position = 0.0;  // standard deviations of a coordinate as found
  double sigma_normal = 0.0;
  double lambda_position = 0.0;  // weights used, in cubes of the median spacing; 0: untouched
  double lambda_normal = 0.0;
  bool filtered = false;  // spacings were too noisy themselves and have been filtered
};

// Fails with bad_argument where the noise stated would change the extent of a curve by more than a
// fifth. After a failure some components may be smoothed already.
Status smooth_samples(Context& context, const KeptSamples& samples, const SmoothingOptions& options,
                      SmoothingReport* report);

}  // namespace wireskin::network
