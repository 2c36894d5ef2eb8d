#include "api/report.h"

#include <cstring>

#include "api/options.h"

namespace wireskin::api {

static void report_status(const Status& status, wsk_report* report) {
  report->status = static_cast<wsk_status>(status.code);
  report->sentence = status.sentence;
  report->curve = status.place.curve;
  report->sample = status.place.sample;
  report->node = status.place.node;
  report->patch = status.place.patch;
  report->vertex = status.place.vertex;
  report->triangle = status.place.triangle;
}

void report_counts(const Counts& counts, const Scale& unscale, wsk_report* report) {
  report->curves = counts.curves;
  report->nodes = counts.nodes;
  report->segments = counts.segments;
  report->patches = counts.patches;
  report->vertices = counts.vertices;
  report->free_vertices = counts.free_vertices;
  report->triangles = counts.triangles;
  report->components = counts.components;
  report->boundary_loops = counts.boundary_loops;
  report->euler_characteristic = counts.euler_characteristic;
  report->spacing = unscale(counts.spacing);
  report->min_angle_deg = counts.least_angle;
  report->residual = counts.residual;
  report->noise_position = unscale(counts.noise.sigma_position);
  report->noise_normal = counts.noise.sigma_normal;
  report->cg_iterations = counts.iterations;
  report->minimal_area_patches = counts.minimal_area_patches;
  report->guarded_patches = counts.guarded_patches;
  report->constraint_distance_max = unscale(counts.greatest_distance);
  report->constraint_distance_rms = unscale(std::sqrt(counts.mean_square_distance));
  report->normal_deviation_mean_deg = counts.normal_deviation.mean;
  report->normal_deviation_max_deg = counts.normal_deviation.greatest;
  report->dihedral_mean_deg = counts.dihedral.mean;
  report->dihedral_max_deg = counts.dihedral.greatest;
  report->failed_patches = counts.failed_patches;
  report->ambiguous_patches = counts.ambiguous_patches;
  report->first_ambiguous_patch = counts.first_ambiguous_patch;
  report->found_borders = counts.found_borders;
  report->inverted_triangles = counts.inverted_triangles;
  report->first_inverted_patch = counts.first_inverted_patch;
  report->coarse_patches = counts.coarse_patches;
  report->first_coarse_patch = counts.first_coarse_patch;
}

void report_costs(Context& context, wsk_report* report) {
  context.stop_clock();
  report->stage = static_cast<wsk_stage>(context.stage());
  report->peak_bytes = context.peak_bytes();
  report->factorisations = context.factorisations();
  report->cg_iterations += context.iterations();
  report->solver = context.is_iterative() ? WSK_SOLVER_ITERATIVE : WSK_SOLVER_DIRECT;
  for (int s = 0; s < WSK_STAGE_COUNT; ++s) {
    report->stage_ms[s] = context.milliseconds(s);
    report->total_ms += report->stage_ms[s];
  }
}

wsk_status finish(const Status& status, wsk_report* report, wsk_report* out) {
  report_status(status, report);
  if (out != nullptr) {
    const size_t size = out->size;
    if (size < k_report_size) return WSK_ERROR_BAD_ARGUMENT;
    std::memcpy(out, report, least(size, sizeof *report));
    out->size = size;
  }
  return report->status;
}

}  // namespace wireskin::api
