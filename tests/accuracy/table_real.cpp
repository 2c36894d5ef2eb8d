// Measured shapes: lilium against its scanned surface, and meshes cut by planes.
#include <algorithm>

#include "accuracy/noise.h"
#include "accuracy/real.h"
#include "accuracy/tables.h"

namespace accuracy {

namespace {

std::string list(const std::vector<uint32_t>& patches) {
  std::string words;
  for (uint32_t p : patches) words += (words.empty() ? "" : " ") + std::to_string(p);
  return words.empty() ? "none" : words;
}

struct RealRow {
  bool built = false;
  RealError error;
  Deviation curve_normals;
};

// `stanko` is what the ratio refers to.
RealRow real_row(Page& page, const RealCase& c, const Method& m, double stanko) {
  const Result result = build(c.network, m.method, c.spacing);
  RealRow row;
  if (result.status != WSK_OK) {
    page.row({c.name, m.name, text("%u", result.report.patches), wsk_status_name(result.status), "",
              "", "", "", "", "", "", "", ""});
    return row;
  }
  row.built = true;
  row.error = real_error(result, c);
  row.curve_normals = curve_normal_deviation(result);
  const double size = 1000.0 / diagonal(c.network);
  page.row({c.name, m.name, text("%u", result.report.patches),
            text("%u", result.report.free_vertices), text("%.2f", size * row.error.rms),
            text("%.1f", size * row.error.max),
            stanko > 0.0 ? text("%.2f", row.error.rms / stanko) : "",
            text("%.2f / %.1f", row.curve_normals.mean, row.curve_normals.max),
            text("%u", row.error.sharp_edges), list(row.error.opposing), list(row.error.inside_out),
            list(result.guarded), text("%.0f", result.report.total_ms)});
  return row;
}

struct Ratios {
  double log_sum = 0.0, worst = 0.0;
  int count = 0;

  void add(double ratio) {
    log_sum += std::log(ratio);
    worst = std::max(worst, ratio);
    ++count;
  }
  double mean() const { return count > 0 ? std::exp(log_sum / count) : 0.0; }
};

}  // namespace

void real_table(Page& page, Bounds& bounds) {
  page.heading("Measured shapes");
  const std::vector<RealCase> lily = lilium();
  std::vector<RealCase> cases = cut_meshes();
  if (lily.empty() && cases.empty()) {
    page.paragraph("Skipped: WIRESKIN_TEST_DATA is not set.");
    return;
  }
  page.paragraph(
      "RMS and greatest distance in thousandths of the diagonal of the network, and the RMS over "
      "that of stanko. Sharp edges: inside patches, between triangles that face against each "
      "other. "
      "Opposing: patches with more than a hundredth of their area facing against the model next to "
      "them, as where they leave out a feature of it; inside out: more than half.");
  page.header({"network", "method", "patches", "free", "RMS", "max", "over stanko", "curve normals",
               "sharp edges", "opposing", "inside out", "guarded patches", "ms"});
  Ratios fair_ratios, iterated_ratios;
  cases.insert(cases.begin(), lily.begin(), lily.end());
  for (const RealCase& c : cases) {
    double stanko = 0.0;
    for (const Method& m : {k_methods[3], k_methods[0], k_methods[4], k_methods[5]}) {
      const bool bound = m.method == WSK_METHOD_STANKO || m.method == WSK_METHOD_FAIR;
      if (bounds.alone() && !bound) continue;
      const RealRow row = real_row(page, c, m, stanko);
      if (m.method == WSK_METHOD_STANKO) stanko = row.error.rms;
      const bool cut = c.name != "lilium";
      if (cut && row.built && stanko > 0.0 && m.method == WSK_METHOD_ITERATED) {
        iterated_ratios.add(row.error.rms / stanko);
      }
      if (m.method != WSK_METHOD_FAIR) continue;
      bounds.at_most(c.name + ", not built", row.built ? 0.0 : 1.0, 0.0);
      if (!row.built) continue;
      bounds.at_most(c.name + ", inside-out patches",
                     static_cast<double>(row.error.inside_out.size()), 0.0);
      bounds.at_most(c.name + ", folds", row.error.sharp_edges, 0.0);
      if (!cut) {
        bounds.at_most("lilium, RMS", row.error.rms, 0.023);
        bounds.at_most("lilium, mean curve normals", row.curve_normals.mean, 1.5);
      } else if (stanko > 0.0) {
        fair_ratios.add(row.error.rms / stanko);
      }
    }
  }
  page.end_table();
  page.paragraph(
      text("Cuts, RMS over stanko: fair %.2f in the geometric mean, at most %.2f; "
           "iterated %.2f, at most %.2f.",
           fair_ratios.mean(), fair_ratios.worst, iterated_ratios.mean(), iterated_ratios.worst));
  if (fair_ratios.count > 0) {
    bounds.at_most("cuts, geometric mean over stanko", fair_ratios.mean(), 0.5);
    bounds.at_most("cuts, worst over stanko", fair_ratios.worst, 1.1);
  }
}

}  // namespace accuracy
