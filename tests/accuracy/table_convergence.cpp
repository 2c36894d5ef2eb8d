// Errors under refinement, and how far the surface of each level lies from the one before: the
// paper's figure 6. The samples stay the same, those of the finest level.
#include <algorithm>

#include "accuracy/cases.h"
#include "accuracy/mesh_distance.h"
#include "accuracy/tables.h"

namespace accuracy {

namespace {

constexpr int k_levels = 4;

// RMS and greatest distance of the vertices of `coarse` from the mesh of `fine`.
Error between_levels(const Result& coarse, const Result& fine) {
  const MeshDistance distance(mesh_of(fine));
  Error error;
  double sum = 0.0;
  for (const auto& p : coarse.positions) {
    const double d = distance.nearest(p).distance;
    sum += d * d;
    error.max = std::max(error.max, d);
  }
  error.rms = std::sqrt(sum / static_cast<double>(coarse.positions.size()));
  return error;
}

// Spacings at the coarsest level.
struct Start {
  size_t of_case;
  double spacing;
};
const Start k_starts[] = {{0, 0.144}, {3, 0.6}, {2, 0.6}, {5, 0.144}, {4, 0.144}, {6, 0.12}};

void refine(Page& page, Bounds& bounds, const Case& c, double start, const Method& m) {
  std::vector<std::string> cells = {c.name, m.name};
  std::vector<std::string> steps;
  Result last;
  double last_rms = 0.0;
  for (int level = 0; level < k_levels; ++level) {
    const double finest = start / (1 << (k_levels - 1));
    Result result = build(c, m.method, finest, start / (1 << level));
    if (m.method == WSK_METHOD_FAIR) bounds.built(c.name + ", refined", result);
    if (result.status != WSK_OK) {
      cells.push_back(wsk_status_name(result.status));
      last.positions.clear();
      continue;
    }
    const double rms = distance_error(result, c.truth).rms;
    cells.push_back(text("%.2e", rms));
    if (!last.positions.empty()) {
      if (!bounds.alone()) {
        const Error step = between_levels(last, result);
        steps.push_back(text("%.1e / %.1e", step.rms, step.max));
      }
      if (m.method == WSK_METHOD_FAIR) {
        bounds.at_most(c.name + text(", growth at level %d", level), rms / last_rms, 1.2);
      }
    }
    last = std::move(result);
    last_rms = rms;
  }
  cells.insert(cells.end(), steps.begin(), steps.end());
  cells.resize(2 + 2 * k_levels - 1);
  page.row(cells);
}

}  // namespace

void convergence_table(Page& page, Bounds& bounds) {
  page.heading("Refinement");
  page.paragraph(
      "RMS to the shape at four spacings, and the distance of each level's vertices from the next "
      "finer surface (RMS / greatest).");
  page.header({"shape", "method", "d", "d / 2", "d / 4", "d / 8", "d to d / 2", "d / 2 to d / 4",
               "d / 4 to d / 8"});
  const std::vector<Case> cases = cases_with_bounds();
  for (const Start& start : k_starts) {
    for (const Method& m : k_methods) {
      if (m.method != WSK_METHOD_STANKO && m.method != WSK_METHOD_FAIR) continue;
      if (bounds.alone() && m.method != WSK_METHOD_FAIR) continue;
      const Case& c = cases[start.of_case];
      Case named = c;
      named.name += text(", d = %g", start.spacing);
      refine(page, bounds, named, start.spacing, m);
    }
  }
  page.end_table();
}

}  // namespace accuracy
