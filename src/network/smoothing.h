// Noise taken out of sampled curves and their normals: one smoothing spline over the whole network,
// its weight found by generalised cross validation, separately for positions and normals.
//
// In: thinned samples; those of a node agree and stay one. Out, in place: smoothed positions and
// unit normals, all copies of a node the same bit for bit, and how much noise was found. Where not
// even the least weight pays, or there are too few samples to tell noise from shape, they are left
// as they are. Closed curves are smoothed across their ends. Sharp turns survive where curves end,
// as nothing is asked across an end, and at samples marked as corners; elsewhere they are rounded.
// Scaling the positions by a power of two scales the result exactly. Cost: an analysis
// and some twenty factorisations where there are many samples, a hundred at most.
//
// Sources: P. Craven, G. Wahba, "Smoothing Noisy Data with Spline Functions", 1979; V. Morozov, "On
// the Solution of Functional Equations by the Method of Regularization", 1966, for given noise.
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
};

struct SmoothingReport {
  double sigma_position = 0.0;  // standard deviations of a component as found
  double sigma_normal = 0.0;
  double lambda_position = 0.0;  // weights used, in cubes of the median spacing; 0: untouched
  double lambda_normal = 0.0;
  bool filtered = false;  // spacings were too noisy themselves and have been filtered
};

Status smooth_samples(Context& context, const KeptSamples& samples, const SmoothingOptions& options,
                      SmoothingReport* report);

}  // namespace wireskin::network
