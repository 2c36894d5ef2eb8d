#include "network/smoothing.h"

#include "network/kept_parts.h"

namespace wireskin::network {

// The weights tried: quarters of a decade from 1e-4 to 1e6.
static constexpr uint32_t k_weights = 41;

static double weight_of_index(uint32_t k) {
  constexpr double k_quarter[4] = {1.0, 1.7782794100389228, 3.1622776601683795, 5.6234132519034908};
  constexpr double k_decade[11] = {1e-4, 1e-3, 1e-2, 1e-1, 1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6};
  return k_quarter[k % 4] * k_decade[k / 4];
}

// The system and what it gave for each weight so far: positions and normals share the trials.
struct WeightSearch {
  Roughness roughness;
  Residuals trial[k_weights] = {};
  bool tried[k_weights] = {};

  explicit WeightSearch(Context& context) : roughness(context) {}
};

// Positions or normals. `components`: how many of the three show noise. Normals are of length one;
// and noise along a curve is taken for uneven sampling, unless spacings are filtered.
struct Field {
  double Residuals::*residual;
  double components;
};

static constexpr Field k_normals = {&Residuals::normal, 2.0};
static constexpr Field k_positions = {&Residuals::position, 2.0};
static constexpr Field k_filtered_positions = {&Residuals::position, 3.0};

static Status try_weight(WeightSearch* search, uint32_t k) {
  if (search->tried[k]) return {};
  TRY(search->roughness.smooth(weight_of_index(k), &search->trial[k]));
  search->tried[k] = true;
  return {};
}

// The variance of a component as cross validation sees it: what it makes small.
static double score(const WeightSearch& search, uint32_t k, const Field& field) {
  const Residuals& r = search.trial[k];
  return search.roughness.unknowns() * (r.*field.residual) /
         (field.components * r.freedom * r.freedom);
}

static double noise(const Residuals& r, const Field& field) {
  return std::sqrt(r.*field.residual / (field.components * r.freedom));
}

// The weight with the least score. Larger weights must be better by more than rounding: scores of
// flat or tiny networks may all be equal.
static Status look_at_weight(WeightSearch* search, const Field& field, uint32_t k, uint32_t* best) {
  constexpr double k_margin = 1.0 - 1e-6;
  TRY(try_weight(search, k));
  if (score(*search, k, field) < k_margin * score(*search, *best, field)) *best = k;
  return {};
}

// The score is smooth: with many samples every fourth weight shows where to look closer.
static Status cross_validate(WeightSearch* search, const Field& field, uint32_t* best) {
  constexpr uint32_t k_many = 1u << 13;
  uint32_t stride = search->roughness.unknowns() > k_many ? 4 : 1;
  *best = 0;
  for (uint32_t k = 0; k < k_weights; k += stride) TRY(look_at_weight(search, field, k, best));
  for (stride /= 2; stride > 0; stride /= 2) {
    const uint32_t middle = *best;
    if (middle >= stride) TRY(look_at_weight(search, field, middle - stride, best));
    if (middle + stride < k_weights) TRY(look_at_weight(search, field, middle + stride, best));
  }
  return {};
}

// The weight whose noise is the given one: bisection, first on the grid, then between two of its
// weights. Zero where even the least weight takes more away than that.
static Status match_noise(WeightSearch* search, const Field& field, double sigma, double* lambda) {
  constexpr int k_halvings = 8;
  uint32_t low = 0, high = k_weights - 1;
  TRY(try_weight(search, low));
  TRY(try_weight(search, high));
  *lambda = weight_of_index(high);
  if (noise(search->trial[high], field) <= sigma) return {};
  *lambda = 0.0;
  if (noise(search->trial[low], field) >= sigma) return {};
  while (high - low > 1) {
    const uint32_t middle = low + (high - low) / 2;
    TRY(try_weight(search, middle));
    (noise(search->trial[middle], field) < sigma ? low : high) = middle;
  }
  double below = weight_of_index(low), above = weight_of_index(high);
  for (int i = 0; i < k_halvings; ++i) {
    Residuals residuals;
    *lambda = std::sqrt(below * above);
    TRY(search->roughness.smooth(*lambda, &residuals));
    (noise(residuals, field) < sigma ? below : above) = *lambda;
  }
  return {};
}

// The least weight stands for none at all.
static Status estimate_weight(WeightSearch* search, const Field& field, double* lambda,
                              double* sigma, double* best_score) {
  uint32_t best = 0;
  TRY(cross_validate(search, field, &best));
  *lambda = best == 0 ? 0.0 : weight_of_index(best);
  *sigma = noise(search->trial[best], field);
  *best_score = score(*search, best, field);
  return {};
}

// `variance`: of the positions, large even where so much noise went unrecognised that the weight is
// far too small.
static Status choose_weights(WeightSearch* search, const SmoothingOptions& options,
                             const Field& positions, SmoothingReport* report, double* variance) {
  TRY(estimate_weight(search, k_normals, &report->lambda_normal, &report->sigma_normal, variance));
  if (options.noise == Noise::given) {
    report->sigma_position = options.sigma;
    *variance = options.sigma * options.sigma;
    return match_noise(search, positions, options.sigma, &report->lambda_position);
  }
  return estimate_weight(search, positions, &report->lambda_position, &report->sigma_position,
                         variance);
}

// Nothing is written where sizes change: the noise found is then shape, or drowned it.
static Status apply_weights(WeightSearch* search, const KeptSamples& samples,
                            const SmoothingReport& report, bool* keeps_sizes) {
  constexpr double k_tolerated = 0.2;
  bool change = false;
  *keeps_sizes = true;
  if (report.lambda_position > 0.0) {
    TRY(search->roughness.smooth(report.lambda_position, nullptr));
    TRY(search->roughness.compare_sizes(samples, k_tolerated, &change));
    *keeps_sizes = !change;
    if (change) return {};
    TRY(search->roughness.write_positions(samples));
  }
  if (report.lambda_normal > 0.0) {
    TRY(search->roughness.smooth(report.lambda_normal, nullptr));
    TRY(search->roughness.write_normals(samples));
  }
  return {};
}

// The score is a variance divided by a share of the freedom, so the variance at the weight that
// cross validation would choose cannot be more than the score of any other weight.
static Status is_negligible(WeightSearch* search, const SmoothingOptions& options, bool* yes) {
  *yes = false;
  if (options.noise != Noise::estimate || !(options.negligible > 0.0)) return {};
  TRY(try_weight(search, 0));
  *yes = score(*search, 0, k_positions) <= options.negligible * options.negligible &&
         score(*search, 0, k_normals) <= options.negligible_normal * options.negligible_normal;
  return {};
}

// Smooths all the samples with one weight. `unknowns`: how many there are.
static Status smooth_together(Context& context, const KeptSamples& samples,
                              const SmoothingOptions& options, SmoothingReport* report,
                              uint32_t* unknowns) {
  constexpr uint32_t k_least_rows = 8;  // fewer second differences are no statistics
  // From a noise of about .3 spacings on, the spacings are so noisy themselves that the curve looks
  // smooth at its samples, and cross validation finds next to nothing (measured on circles).
  constexpr double k_drowned = 0.25;
  WeightSearch search(context);
  double variance = 0.0;
  TRY(search.roughness.build(samples, false));
  *unknowns = search.roughness.unknowns();
  if (search.roughness.rows() < k_least_rows) return {};
  bool negligible = false;
  TRY(is_negligible(&search, options, &negligible));
  if (negligible) return {};
  TRY(choose_weights(&search, options, k_positions, report, &variance));
  const double most = k_drowned * search.roughness.spacing();
  if (variance > most * most) {
    report->filtered = true;
    for (bool& tried : search.tried) tried = false;
    TRY(search.roughness.build(samples, true));
    TRY(choose_weights(&search, options, k_filtered_positions, report, &variance));
  }
  bool keeps_sizes = false;
  TRY(apply_weights(&search, samples, *report, &keeps_sizes));
  if (keeps_sizes) return {};
  if (options.noise == Noise::given) {
    return fail(Code::bad_argument, "the noise stated is too large for the curves");
  }
  *report = {};
  return {};
}

// Sums of squares, until all parts are in.
static void add_part(const SmoothingReport& part, uint32_t unknowns, SmoothingReport* sum) {
  sum->sigma_position += unknowns * part.sigma_position * part.sigma_position;
  sum->sigma_normal += unknowns * part.sigma_normal * part.sigma_normal;
  if (part.lambda_position > sum->lambda_position) sum->lambda_position = part.lambda_position;
  if (part.lambda_normal > sum->lambda_normal) sum->lambda_normal = part.lambda_normal;
  sum->filtered = sum->filtered || part.filtered;
}

// One weight for all would wipe a tiny part out beside a large one, and leave or invent noise where
// curves were measured differently.
static Status smooth_parts(Context& context, const KeptSamples& samples,
                           const SmoothingOptions& options, SmoothingReport* report) {
  KeptParts parts(context);
  TRY(parts.split(samples));
  double all = 0.0;
  for (uint32_t p = 0; p < parts.count(); ++p) {
    SmoothingReport own;
    uint32_t unknowns = 0;
    TRY(smooth_together(context, parts.part(p), options, &own, &unknowns));
    add_part(own, unknowns, report);
    all += unknowns;
    if (p % 64 == 63) TRY(context.checkpoint());
  }
  if (!(all > 0.0)) return {};
  report->sigma_position = std::sqrt(report->sigma_position / all);
  report->sigma_normal = std::sqrt(report->sigma_normal / all);
  return {};
}

Status smooth_samples(Context& context, const KeptSamples& samples, const SmoothingOptions& options,
                      SmoothingReport* report) {
  *report = {};
  if (options.noise == Noise::none) return {};
  if (options.noise == Noise::estimate) return smooth_parts(context, samples, options, report);
  uint32_t unknowns = 0;
  return smooth_together(context, samples, options, report, &unknowns);
}

}  // namespace wireskin::network
