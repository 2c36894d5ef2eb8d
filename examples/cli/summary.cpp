#include "summary.h"

#include <algorithm>
#include <cstdio>

#include "scan.h"
#include "vec.h"

namespace wireskin_cli {

// "1 patch", "2 patches".
static std::string counted(uint32_t count, const char* one, const char* many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

static std::string names_of(const std::vector<std::string>& files) {
  std::string names;
  for (const std::string& file : files) {
    names += (names.empty() ? "" : ", ") + (file == "-" ? "standard output" : printable(file));
  }
  return names;
}

static bool any_normals(const Network& network) {
  return !network.normals.empty() || !network.raw_curves.empty();
}

std::vector<IdleOption> idle_options(const Arguments& arguments, const Network& network,
                                     const BuildResult& result) {
  std::vector<IdleOption> idle;
  const auto check = [&](const char* name, bool does_nothing, const char* reason) {
    if (does_nothing && has_option(arguments, name)) idle.push_back({name, reason});
  };
  const bool flow = result.flow != nullptr;
  const char* by_normals = "normals gave the patches; --topology flow takes the curves alone";
  const char* by_flow = "the curves alone gave the patches";
  check("--voids", !flow, by_normals);
  check("--open-walls", !flow, by_normals);
  check("--lids", !flow, by_normals);
  check("--soft", flow && arguments.soft > 0.0, by_flow);
  check("--partial", flow, by_flow);
  check("--find-borders", flow, by_flow);
  check("--method", flow && !any_normals(network), "without normals surfaces stay as remeshed");
  check("--orient", !any_normals(network), "there are no normals");
  check("--orient", !network.raw_curves.empty(), "measured curves are taken as they are");
  check("--snap", !network.raw_curves.empty(), "measured curves meet where their nodes say so");
  check("--up", arguments.image.empty() && arguments.html.empty(), "it is for --image and --html");
  check("--format", std::count(arguments.outputs.begin(), arguments.outputs.end(), "-") == 0,
        "it is for -o -");
  return idle;
}

// What was left to itself, or not looked at.
static std::string flow_notes(const wsk_flow_view& view, const Arguments& arguments) {
  std::string text;
  if (view.open_lid_count > 0) {
    text += counted(view.open_lid_count, "round end", "round ends") + " left open, as of a tube" +
            (arguments.lids == WSK_LIDS_ALL ? "\n" : "; --lids all closes each\n");
  }
  if (view.faces_skipped != 0) {
    text += "flat faces are too many to be told apart: voids are judged by their ratios alone\n";
  }
  if (view.untried_count > 0) {
    text += counted(view.untried_count, "void was", "voids were") +
            " not looked at: those of the least ratios\n";
  }
  if (arguments.spacing > 1.5 * view.sampling) {
    char sampling[32];
    std::snprintf(sampling, sizeof sampling, "%.3g", view.sampling);
    text +=
        "vertices on the curves are closer than the spacing: no farther apart than the samples, " +
        std::string(sampling) + "\n";
  }
  return text;
}

static std::string flow_lines(const wsk_flow_view& view, int voids_asked) {
  std::string text = "from curves alone: Betti numbers " + std::to_string(view.betti[0]) + " " +
                     std::to_string(view.betti[1]) + " " + std::to_string(view.betti[2]) + ", " +
                     counted(view.open_patch_count, "open patch", "open patches") + ", " +
                     counted(view.bare_count, "bare segment", "bare segments") +
                     (view.manifold != 0 ? "" : ", not a manifold") +
                     (view.smoothed != 0 ? "; shaped by the normals" : "") + "\n";
  if (voids_asked > 0 && view.caged_count < static_cast<uint32_t>(voids_asked)) {
    text += "asked for " + counted(static_cast<uint32_t>(voids_asked), "void", "voids") +
            ", the curves cage " + std::to_string(view.caged_count) + "\n";
  }
  if (view.normals_sentence[0] == 0) return text;
  text += std::string("the normals could not be used: ") + view.normals_sentence;
  if (view.normals_places > 0) text += " (" + counted(view.normals_places, "place", "places") + ")";
  return text + "\n";
}

// Stretches of curve that became one or two edges show nothing of their shape.
static std::string spacing_line(const wsk_surface_view& surface, const wsk_report& report) {
  if (surface.curve_edge_count >= 3 * uint64_t{report.segments} || report.spacing == 0.0) return "";
  char spacing[32];
  std::snprintf(spacing, sizeof spacing, "%.3g", report.spacing);
  return "the spacing, " + std::string(spacing) +
         ", is coarse for these curves: " + counted(surface.curve_edge_count, "edge", "edges") +
         " on " + counted(report.segments, "stretch", "stretches") +
         " between nodes; --spacing LENGTH makes it finer\n";
}

// How often a curve turns back on itself: by more than 100 degrees at a vertex.
static size_t turns_back(const Network& network, const NetworkCurve& curve) {
  constexpr double k_cosine = -0.17364817766693;  // of 100 degrees
  size_t count = 0;
  for (size_t i = 2; i < curve.vertices.size(); ++i) {
    const double* at = network.positions.data();
    const Vec3 a = vec3_at(at, curve.vertices[i - 2]), b = vec3_at(at, curve.vertices[i - 1]);
    const Vec3 c = vec3_at(at, curve.vertices[i]);
    count += dot(unit(b - a), unit(c - b)) < k_cosine;
  }
  return count;
}

// Points in no order that a table passes off as one curve.
static std::string zigzag_line(const Network& network) {
  constexpr size_t k_least = 12;  // vertices; of these more than a fourth
  for (const NetworkCurve& curve : network.curves) {
    const size_t turns = turns_back(network, curve);
    if (curve.vertices.size() < k_least || 4 * turns < curve.vertices.size()) continue;
    return "the curve of line " + std::to_string(curve.line) + " turns back at " +
           std::to_string(turns) + " of its " + std::to_string(curve.vertices.size()) +
           " samples: are they points in no order, or several curves? A column \"curve\" or blank "
           "lines part curves, a file .xyz holds points\n";
  }
  return "";
}

// What tells that patches may not be those that the curves were drawn for.
static std::string doubts(const wsk_report& report) {
  constexpr double k_much = 50.0;  // degrees; bends between curves far apart reach 40
  std::string text;
  if (report.ambiguous_patches > 0) {
    text += counted(report.ambiguous_patches, "patch", "patches") +
            " that might as well be joined otherwise, the first is " +
            std::to_string(report.first_ambiguous_patch) + "\n";
  }
  if (report.normal_deviation_max_deg > k_much) {
    char degrees[32];
    std::snprintf(degrees, sizeof degrees, "%.0f", report.normal_deviation_max_deg);
    text += "the surface leaves the normals by up to " + std::string(degrees) +
            " degrees: where it does, curves are too few or bound another patch than found\n";
  }
  return text;
}

std::string ignored_columns(const Network& network) {
  std::string list;
  for (const std::string& name : network.ignored_columns) {
    list += (list.empty() ? "" : ", ") + in_quotes(name);
  }
  return list;
}

std::string summary(const Arguments& arguments, const Network& network, const BuildResult& result,
                    double seconds) {
  wsk_surface_view surface;
  wsk_surface_get_view(result.surface.get(), &surface, sizeof surface);
  const uint32_t failed = result.report.failed_patches;
  const uint32_t found = result.report.found_borders;
  char time[32];
  std::snprintf(time, sizeof time, "%.2f s", seconds);
  std::string text = names_of(arguments.outputs) + ": " +
                     counted(surface.vertex_count, "vertex", "vertices") + ", " +
                     counted(surface.triangle_count, "triangle", "triangles") + ", " +
                     counted(surface.patch_count - failed, "patch", "patches") + ", " + time + "\n";
  if (failed > 0) {
    text += counted(failed, "patch was", "patches were") + " left out, the report says why\n";
  }
  if (found > 0) text += counted(found, "border was", "borders were") + " found and left open\n";
  if (result.report.inverted_triangles > 0) {
    text += counted(result.report.inverted_triangles, "triangle is", "triangles are") +
            " inverted: the surface is folded at patch " +
            std::to_string(result.report.first_inverted_patch) + "\n";
  }
  if (result.report.coarse_patches > 0) {
    text += counted(result.report.coarse_patches, "patch is", "patches are") +
            " coarser inside than the spacing, the first is " +
            std::to_string(result.report.first_coarse_patch) + "\n";
  }
  if (result.flow != nullptr) text += flow_lines(result.flow->view, arguments.voids);
  if (result.flow != nullptr) text += flow_notes(result.flow->view, arguments);
  const uint32_t loose = result.flow != nullptr ? result.prepared_view().after.dangling_ends : 0;
  if (loose > 0) {
    text += counted(loose, "end of a curve meets", "ends of curves meet") +
            " no other: --snap LENGTH joins what misses by less\n";
  }
  text += doubts(result.report);
  text += zigzag_line(network);
  text += spacing_line(surface, result.report);
  if (!network.ignored_columns.empty()) {
    text +=
        "columns passed over, their names mean nothing here: " + ignored_columns(network) + "\n";
  }
  for (const IdleOption& option : idle_options(arguments, network, result)) {
    text += option.name + " had no effect: " + option.reason + "\n";
  }
  return text;
}

}  // namespace wireskin_cli
