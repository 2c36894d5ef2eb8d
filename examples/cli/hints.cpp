#include "hints.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <cstdio>
#include <cstring>

#include "summary.h"

namespace wireskin_cli {

struct Reach {
  double diagonal;  // of the bounding box
  double farthest;  // the largest coordinate
};

static Reach reach_of(const Network& network) {
  Reach reach = {0.0, 0.0};
  double square = 0.0;
  for (size_t k = 0; k < 3 && k < network.positions.size(); ++k) {
    double low = network.positions[k], high = low;
    for (size_t i = k; i < network.positions.size(); i += 3) {
      low = std::min(low, network.positions[i]);
      high = std::max(high, network.positions[i]);
    }
    square += (high - low) * (high - low);
    reach.farthest = std::max({reach.farthest, std::fabs(low), std::fabs(high)});
  }
  reach.diagonal = std::sqrt(square);
  return reach;
}

static std::string short_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

static bool speaks_of(const wsk_report& report, const char* what) {
  return std::strstr(report.sentence, what) != nullptr;
}

std::string option_at_fault(const Arguments& arguments, const wsk_report& report) {
  if (report.status != WSK_ERROR_BAD_ARGUMENT) return "";
  if (speaks_of(report, "cutoff length")) return "--soft " + short_number(arguments.soft);
  if (speaks_of(report, "noise")) return "--smooth " + short_number(arguments.noise);
  if (speaks_of(report, "snapping tolerance")) return "--snap " + short_number(arguments.snap);
  return "";
}

// How many triangles the spacing asks for, if the surface is about as large as its box is wide.
static std::string spacing_hint(double spacing, double diagonal) {
  const double triangles = diagonal / spacing * (diagonal / spacing) / 0.433;
  const std::string count = triangles < HUGE_VAL ? short_number(triangles) : "more than 1e308";
  return "; --spacing is " + short_number(spacing) + ", the diagonal of the network " +
         short_number(diagonal) + ": that makes some " + count +
         " triangles (the default, a hundredth of the diagonal, makes some 20000)";
}

static std::string orient_hint(const Arguments& arguments, const wsk_report& report) {
  if (report.status != WSK_ERROR_INCONSISTENT_NORMALS || !speaks_of(report, "orient")) return "";
  return arguments.orient ? "; --orient was given and did not suffice here: the normals themselves "
                            "must be put right"
                          : "; try --orient";
}

// What the sentence of the library says, in terms of files and options.
static std::string remedy(const Arguments& arguments, const Network& network,
                          const BuildResult& result) {
  const wsk_report& report = result.report;
  const Reach reach = reach_of(network);
  if (report.status == WSK_ERROR_MISSING_NORMALS && network.normals.empty()) {
    return "; the file gives no normals at all: --topology flow needs none";
  }
  const bool large =
      report.status == WSK_ERROR_TOO_LARGE || report.status == WSK_ERROR_OUT_OF_MEMORY;
  if (large && arguments.spacing > 0.0) return spacing_hint(arguments.spacing, reach.diagonal);
  if (!option_at_fault(arguments, report).empty()) {
    return "; the diagonal is " + short_number(reach.diagonal);
  }
  // Far from the origin doubles are coarse; what then goes wrong does not look like it.
  const double rounding = reach.farthest * DBL_EPSILON;
  const bool coarse = rounding > 1e-9 * reach.diagonal && std::isfinite(reach.farthest);
  const uint32_t loose = result.prepared_view().after.dangling_ends;
  if (!coarse && report.status == WSK_ERROR_OPEN_NETWORK && loose > 0) {
    return "; " + std::to_string(loose) + (loose == 1 ? " end" : " ends") +
           " of curves meet no other curve: --snap LENGTH joins what misses by less, and the "
           "report lists what was joined";
  }
  if (!coarse && speaks_of(report, "tagged as boundary")) {
    return std::string(
               "; in tables a column boundary tags them, in OBJ a group whose name contains "
               "boundary") +
           (speaks_of(report, "clockwise") ? "; or try --find-borders" : "");
  }
  if (!coarse) return orient_hint(arguments, report);
  return "; the network spans " + short_number(reach.diagonal) + " but lies " +
         short_number(reach.farthest) + " from the origin, where numbers are rounded to about " +
         short_number(rounding) + (speaks_of(report, "origin") ? "" : ": move it to the origin");
}

std::string failure_hint(const Arguments& arguments, const Network& network,
                         const BuildResult& result) {
  if (result.report.status == WSK_ERROR_CANCELLED) return "";
  const std::string ignored = ignored_columns(network);
  return remedy(arguments, network, result) +
         (ignored.empty() ? "" : "; columns passed over: " + ignored);
}

}  // namespace wireskin_cli
