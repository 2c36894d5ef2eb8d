// Positions from arc lengths and tangents: what a sensor that knows its direction, but not its
// place, measures along the curves of a network.
//
// In: curves whose samples have points (network/wires.h), arc length and unit tangent; a closed
// curve repeats its first sample. Out: positions such that the sum over all steps of
// |step - step of the circular arc with these tangents|^2 / length is least, the first sample of
// every component being the origin: a Laplacian over the points, so samples of one point coincide
// exactly. Cost: one sparse factorisation, whose fill stays small because most points have two
// neighbours.
//
// Source: T. Stanko, S. Hahmann, G.-P. Bonneau, N. Saguin-Sprynski, "Shape from sensors: Curve
// networks on surfaces from 3D orientations", 2017.
#pragma once

#include "network/wires.h"

namespace wireskin::network {

struct SensorSamples {
  Span<const uint32_t> start;  // curve c has the samples start[c] .. start[c + 1)
  Span<const uint32_t> point;  // of each sample
  uint32_t points = 0;
  Span<const double> arc;    // ascending along each curve
  Span<const Vec3> tangent;  // unit
  // Of each curve: its tangents are the directions to the next samples, not those at the samples.
  Span<const uint8_t> to_next;
};

// `residual`: the root mean square of the steps' misfit, per sample.
Status integrate_tangents(Context& context, const SensorSamples& samples, Span<Vec3> position,
                          double* residual);

}  // namespace wireskin::network
