// The linear system behind a smoothing spline over a whole network: which second differences of the
// samples are asked to be small, and what the smoothed samples are for a given weight of that.
//
// The unknowns are the kept samples, those of a node being one. Every sample that has a neighbour
// on either side gives a row: the second divided difference along its curve times the square root
// of the half of the two spacings, E x. A closed curve has a row at every sample, an open one none
// at its ends, no curve one at its corners. The samples x nearest to the given p with small E x,
//   min |x - p|^2 + lambda |E x|^2,   are   x = p - lambda E^T y,  (I + lambda E E^T) y = E p:
// solved for y, so that samples nearly on top of each other, whose rows are huge, scale rows only,
// and what noise there is comes out to its last digits. Lengths are in units of the median spacing:
// everything but the positions is the same at every scale.
//
// Cost per weight: one sparse factorisation, linear in the samples but for dense networks. The
// trace is exact for up to 16384 rows; beyond, eight fixed probes give it within a percent.
// Sources: C. Reinsch, "Smoothing by Spline Functions", 1967; M. Hutchinson, "A Stochastic
// Estimator of the Trace of the Influence Matrix for Laplacian Smoothing Splines", 1990.
#pragma once

#include "base/in_parts.h"
#include "num/vec.h"
#include "sparse/ldl.h"

namespace wireskin::network {

// The samples of all curves one after the other, and which of them are kept.
struct KeptSamples {
  Span<const uint32_t> start;       // of each curve: its first sample
  Span<const uint32_t> kept_start;  // of which kept[kept_start[c] .. kept_start[c + 1]) are read,
  Span<const uint32_t> kept;        // counted from the curve's first sample, in order along it
  Span<const uint32_t> node;        // of each sample, k_none for ordinary ones
  Span<const uint8_t> corner;       // of each sample: the curve may turn sharply; empty: none
  Span<const uint8_t> closed;       // of each curve
  Span<Vec3> position;
  Span<Vec3> normal;  // unit
};

// What one weight makes of the samples.
struct Residuals {
  double freedom;   // trace of I - H, x = H p: how many samples' worth of freedom the spline took
  double position;  // |x - p|^2
  double normal;
};

class Roughness {
 public:
  // `filtered`: spacings are measured on a copy of the curves smoothed four times by the mask
  // 1/4, 1/2, 1/4, for samples whose noise is not small against their distance.
  Status build(const KeptSamples& samples, bool filtered);

  uint32_t unknowns() const { return unknowns_; }
  uint32_t rows() const { return transposed_.cols; }
  double spacing() const { return spacing_; }  // the median

  // After this the smoothed values are at hand. `residuals` may be null.
  Status smooth(double lambda, Residuals* residuals);
  // Whether they change the extent of any curve by more than the part `tolerated` of it.
  Status compare_sizes(const KeptSamples& samples, double tolerated, bool* change);
  // Writes them to all copies of each sample.
  Status write_positions(const KeptSamples& samples);
  Status write_normals(const KeptSamples& samples);

  explicit Roughness(Context& context)
      : context_(&context),
        pace_(context),
        unknown_(context),
        value_(context),
        residual_(context),
        right_side_(context),
        solution_(context),
        inverse_diagonal_(context),
        transposed_(context),
        product_(context),
        system_(context),
        factor_(context) {}

 private:
  Status number_unknowns(const KeptSamples& samples);
  Status list_rows(const KeptSamples& samples, Span<const double> gaps);
  Status prepare_system();
  Status measure_gaps(const KeptSamples& samples, bool filtered, Array<double>* gaps);
  Status fill_right_side();
  Status find_freedom(double* freedom);
  Status measure_residuals(Residuals* residuals) const;

  static constexpr uint32_t k_columns = 6;  // of position and normal
  static constexpr uint32_t k_probes = 8;

  Context* context_;
  Pace pace_;
  uint32_t unknowns_ = 0;
  double spacing_ = 0.0;
  Array<uint32_t> unknown_;  // of each kept sample
  Array<double> value_;      // six a row, as given
  Array<double> residual_;   // what smoothing takes away from them
  uint32_t probes_ = 0;      // columns of signs behind the six
  Array<double> right_side_, solution_;
  Array<double> inverse_diagonal_;
  sparse::Csc transposed_;  // E^T
  sparse::Csc product_;     // E E^T
  sparse::Csc system_;
  sparse::Ldl factor_;
};

}  // namespace wireskin::network
