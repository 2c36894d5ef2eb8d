// How the reconstruction bears noise, curves added and taken away, and knots: writes a table, in a
// few minutes.
//
//     flow_table FILE.md [FOLDER]
//
// FOLDER holds networks (.obj with l) and expected.csv; the shapes made in unseen.h are always in.
#include <cstdio>

#include "flow/robustness.h"

using namespace flow_tests;

namespace {

constexpr uint32_t k_draws = 2, k_circles = 3;
constexpr size_t k_most_curves = 16;

void write_noise(std::FILE* file, const std::vector<Shape>& shapes) {
  std::fprintf(file, "%s",
               "## Noise\n\nEvery vertex of the curves is moved by a Gaussian of that part of the "
               "diagonal along each axis; straight curves\nhave vertices every fiftieth of the "
               "diagonal for that. Kept: Betti numbers, patches and annuli are those without "
               "noise,\nover two draws of it. Found: `--smooth auto`, the default; stated: "
               "`--smooth SIGMA`.\n\n| noise | kept, found | kept, stated | kept, `--smooth 0` | "
               "of | lost when stated |\n|---|---|---|---|---|---|\n");
  std::vector<Run> clean;
  for (const Shape& s : shapes) clean.push_back(run(s.net, {0.02, 0, s.voids, false, false}));
  for (const double sigma : {0.0, 0.001, 0.002, 0.006, 0.02, 0.1}) {
    int kept[3] = {};
    std::string lost;
    for (size_t i = 0; i < shapes.size(); ++i) {
      for (uint32_t draw = 0; draw < k_draws; ++draw) {
        for (int k = 0; k < 3; ++k) {
          const Smoothed smoothed = Smoothed(k);
          const bool keeps = keeps_topology(shapes[i], clean[i], sigma, smoothed, 17 + draw);
          kept[k] += keeps;
          if (k == 2 && draw == 0 && !keeps && sigma < 0.01) lost += shapes[i].name + ", ";
        }
      }
    }
    if (!lost.empty()) lost.resize(lost.size() - 2);
    std::fprintf(file, "| %.1f %% | %d | %d | %d | %zu | %s |\n", 100 * sigma, kept[1], kept[2],
                 kept[0], k_draws * shapes.size(), lost.c_str());
    std::fflush(file);
  }
}

struct Sum {
  size_t with = 0, without = 0, most_with = 0, most_without = 0, local = 0;
  double reach = 0.0, most = 0.0;

  void add(const Change& c) {
    with += c.with;
    without += c.without;
    most_with = std::max(most_with, c.with);
    most_without = std::max(most_without, c.without);
    local += c.reach <= c.length;
    reach += c.reach / c.length;
    most = std::max(most, c.reach / c.length);
  }
};

void write_curves(std::FILE* file, const std::vector<Shape>& shapes) {
  std::fprintf(
      file, "%s",
      "\n## Curves taken away and put back\n\nEach curve of each network of 3 to 16 in turn, the "
      "number of voids found anew.\nPatches that differ: without the curve, those that the whole "
      "network has\nnot; with it, "
      "those that the network without it has not (same: the same area to 2 %, the same middle to 1 "
      "% of the diagonal).\nFarthest: the distance of the farthest place that moved by more than 1 "
      "% of the diagonal from the curve, in lengths of the\ncurve; local: it is less than one. "
      "Circles: a circle, a twentieth of the diagonal across, put somewhere in the box, "
      "three\ntimes "
      "each: how often a patch of the network was not there any more, and how often farther than "
      "half the diagonal.\n\n| network | curves | patches | without: differ, mean | most | with: "
      "differ, mean | most | farthest, mean | most | local | circles: differ | far |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  size_t all = 0, local = 0, circles = 0, changed = 0, far = 0;
  for (const Shape& shape : shapes) {
    const size_t n = shape.net.curve.size();
    if (n > k_most_curves || n < 3) continue;
    Sum sum;
    for (const Change& c : changes_by_removal(shape)) sum.add(c);
    const Run whole = run(shape.net, {0.02, 0, shape.voids, false, false});
    size_t differ = 0, distant = 0;
    for (uint32_t seed = 1; seed <= k_circles; ++seed) {
      const Change c = change_by_circle(shape, whole, seed);
      differ += c.without > 0;
      distant += c.reach > 0.5 * diagonal_of(shape.net);
    }
    std::fprintf(file,
                 "| %s | %zu | %u | %.1f | %zu | %.1f | %zu | %.2f | %.2f | %zu | %zu | %zu |\n",
                 shape.name.c_str(), n, whole.patches, double(sum.without) / double(n),
                 sum.most_without, double(sum.with) / double(n), sum.most_with,
                 sum.reach / double(n), sum.most, sum.local, differ, distant);
    std::fflush(file);
    all += n;
    local += sum.local;
    circles += k_circles;
    changed += differ;
    far += distant;
  }
  std::fprintf(
      file,
      "\nOf %zu curves %zu change the surface only nearer to them than their own length. Of "
      "%zu circles %zu change a patch,\n%zu something beyond half the diagonal.\n",
      all, local, circles, changed, far);
}

void write_closed(std::FILE* file) {
  std::fprintf(file, "%s",
               "\n## Closed curves, knotted and linked\n\nOne curve, or two, sampled at a fiftieth "
               "and a hundredth of the diagonal; walls that end at other walls kept\n"
               "(`--open-walls`) or not.\n\n| curve | sampling | open walls | Betti numbers | "
               "patches | annuli | open patches | bare segments | crossings |\n"
               "|---|---|---|---|---|---|---|---|---|\n");
  for (const ClosedCurve& curve : closed_curves()) {
    for (const double eps : {0.02, 0.01}) {
      for (const bool walls : {false, true}) {
        const Run r = run(curve.net, {eps, 0, -1, walls, true});
        std::fprintf(file, "| %s | %.0f %% | %s | %u %u %u | %u | %u | %u | %zu | %zu |\n",
                     curve.name, 100 * eps, walls ? "kept" : "no", r.betti[0], r.betti[1],
                     r.betti[2], r.patches, r.annuli, r.open, r.bare,
                     count_crossings(r.position, r.triangle));
      }
    }
    std::fflush(file);
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: flow_table FILE.md [FOLDER]\n");
    return 2;
  }
  const std::string folder = argc > 2 ? argv[2] : std::string(WIRESKIN_TEST_DATA) + "/flow-tests";
  std::FILE* const file = std::fopen(argv[1], "w");
  if (file == nullptr) {
    std::fprintf(stderr, "cannot write %s\n", argv[1]);
    return 1;
  }
  std::fprintf(file,
               "# Surfaces from curves alone: noise, curves taken away, knots\n\nWritten by "
               "`flow_table tests/flow/tables.md FOLDER`, FOLDER holding the networks of the "
               "paper's kind with their expected\nnumbers; the shapes of `tests/flow/unseen.h` are "
               "always in.\n\n");
  const std::vector<Shape> shapes = robust_shapes(folder);
  write_noise(file, shapes);
  write_curves(file, shapes);
  write_closed(file);
  return std::fclose(file) == 0 ? 0 : 1;
}
