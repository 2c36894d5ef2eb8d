#include "report_json.h"

#include <cmath>
#include <cstdint>

#include "scan.h"

namespace wireskin_cli {

std::string json_string(std::string_view text) {
  constexpr const char* k_hex = "0123456789abcdef";
  std::string result = "\"";
  while (!text.empty()) {
    const size_t length = utf8_length(text);
    const char c = text[0];
    if (length == 0) {
      result += "\\ufffd";
    } else if (c == '"' || c == '\\') {
      result += {'\\', c};
    } else if (length == 1 && static_cast<unsigned char>(c) < 32) {
      result += std::string("\\u00") + k_hex[c >> 4] + k_hex[c & 15];
    } else {
      result += text.substr(0, length);
    }
    text.remove_prefix(length == 0 ? 1 : length);
  }
  return result + '"';
}

namespace {

// One object, a member a line.
class JsonObject {
 public:
  explicit JsonObject(const char* indent) : indent_(indent) {}

  void member(std::string_view key, const std::string& json) {
    text_ += text_.empty() ? "{\n" : ",\n";
    text_ += indent_;
    text_ += "  " + json_string(key) + ": " + json;
  }
  void text(const char* key, std::string_view value) { member(key, json_string(value)); }
  void number(const char* key, double value) {
    std::string json;
    if (std::isfinite(value)) append_double(json, value);
    member(key, json.empty() ? "null" : json);
  }
  void count(const char* key, long long value) { member(key, std::to_string(value)); }
  void index(const char* key, uint32_t value) {
    member(key, value == WSK_NONE ? "null" : std::to_string(value));
  }
  std::string close() const { return text_ + "\n" + indent_ + "}"; }

 private:
  std::string indent_;
  std::string text_;
};

std::string place_json(const wsk_report& report, size_t line) {
  const bool known = report.curve != WSK_NONE || report.sample != WSK_NONE ||
                     report.node != WSK_NONE || report.patch != WSK_NONE || line != 0;
  if (!known) return "null";
  JsonObject place("  ");
  place.index("curve", report.curve);
  place.index("sample", report.sample);
  place.index("node", report.node);
  place.index("patch", report.patch);
  place.member("line", line == 0 ? "null" : std::to_string(line));
  return place.close();
}

std::string stages_json(const wsk_report& report) {
  JsonObject stages("  ");
  for (wsk_stage stage = 0; stage < WSK_STAGE_COUNT; ++stage) {
    stages.number(wsk_stage_name(stage), report.stage_ms[stage]);
  }
  return stages.close();
}

std::string network_counts_json(const wsk_network_counts& counts) {
  JsonObject json("    ");
  json.count("curves", counts.curves);
  json.count("samples", counts.samples);
  json.count("nodes", counts.nodes);
  json.count("dangling_ends", counts.dangling_ends);
  json.count("components", counts.components);
  json.count("open_gaps", counts.open_gaps);
  return json.close();
}

std::string place_json(const wsk_place& place, bool with_point) {
  std::string json = "{\"curve\": " + std::to_string(place.curve) +
                     ", \"sample\": " + std::to_string(place.sample) + ", \"part\": ";
  append_double(json, place.part);
  if (with_point) {
    for (int k = 0; k < 3; ++k) {
      json += k == 0 ? ", \"point\": [" : ", ";
      append_double(json, place.position[k]);
    }
    json += ']';
  }
  return json + '}';
}

// A list of objects, one a line.
std::string list_json(const std::vector<std::string>& items) {
  std::string json = "[";
  for (size_t i = 0; i < items.size(); ++i) json += (i == 0 ? "\n      " : ",\n      ") + items[i];
  return json + (items.empty() ? "]" : "\n    ]");
}

std::string preparation_json(const wsk_network_view& prepared) {
  constexpr const char* k_kinds[] = {"end_end", "end_inside", "inside_inside"};
  std::vector<std::string> snaps, contradictions;
  for (uint32_t i = 0; i < prepared.snap_count; ++i) {
    const wsk_snap& snap = prepared.snaps[i];
    std::string json = "{\"kind\": \"" + std::string(k_kinds[snap.kind]) + "\", \"distance\": ";
    append_double(json, snap.distance);
    json += ", \"a\": " + place_json(snap.a, true) + ", \"b\": " + place_json(snap.b, true) + '}';
    snaps.push_back(json);
  }
  for (uint32_t i = 0; i < prepared.contradiction_count; ++i) {
    const wsk_contradiction& pair = prepared.contradictions[i];
    std::string json = "{\"angle_deg\": ";
    append_double(json, pair.angle_deg);
    json += ", \"a\": " + place_json(pair.a, false) + ", \"b\": " + place_json(pair.b, false) + '}';
    contradictions.push_back(json);
  }
  JsonObject json("  ");
  json.number("tolerance", prepared.tolerance);
  json.member("before", network_counts_json(prepared.before));
  json.member("after", network_counts_json(prepared.after));
  json.count("filled_normals", prepared.filled_normals);
  json.count("turned_normals", prepared.turned_normals);
  json.count("curves_without_normals", prepared.curves_without_normals);
  json.member("snaps", list_json(snaps));
  json.member("contradictions", list_json(contradictions));
  return json.close();
}

// The voids that stand out a little at least; there may be thousands of others.
std::string voids_json(const FlowSummary& flow) {
  constexpr double k_least_ratio = 1.001;
  std::string list;
  for (const wsk_void& v : flow.voids) {
    if (v.ratio < k_least_ratio && v.chosen == 0) continue;
    JsonObject object("      ");
    object.number("ratio", v.ratio);
    object.number("creation", v.creation);
    object.number("filling", v.filling);
    object.member("chosen", v.chosen != 0 ? "true" : "false");
    list += (list.empty() ? "" : ", ") + object.close();
  }
  return "[" + list + "]";
}

const char* normals_name(wsk_flow_normals normals) {
  constexpr const char* k_names[WSK_FLOW_NORMALS_COUNT] = {
      "none",        "used",          "incomplete", "not_manifold",
      "free_border", "contradicting", "crossing",   "too_thin"};
  return k_names[normals];
}

std::string flow_json(const FlowSummary& flow) {
  const wsk_flow_view& view = flow.view;
  JsonObject object("  ");
  object.member("betti", "[" + std::to_string(view.betti[0]) + ", " +
                             std::to_string(view.betti[1]) + ", " + std::to_string(view.betti[2]) +
                             "]");
  object.count("samples", view.sample_count);
  object.count("tetrahedra", view.tetrahedron_count);
  object.count("patches", view.patch_count);
  object.count("open_patches", view.open_patch_count);
  object.count("bare_segments", view.bare_count);
  object.count("branching_edges", view.branch_count);
  object.count("crossings", view.crossing_count);
  object.member("manifold", view.manifold != 0 ? "true" : "false");
  object.member("smoothed", view.smoothed != 0 ? "true" : "false");
  object.text("normals", normals_name(view.normals));
  object.count("normals_places", view.normals_places);
  object.member("normals_sentence",
                view.normals_sentence[0] == 0 ? "null" : json_string(view.normals_sentence));
  object.count("caged_voids", view.caged_count);
  object.number("sampling", view.sampling);
  object.count("open_lids", view.open_lid_count);
  object.member("flat_faces_skipped", view.faces_skipped != 0 ? "true" : "false");
  object.count("untried_voids", view.untried_count);
  object.member("voids", voids_json(flow));
  uint32_t between = 0;  // a wall between two voids makes its curves bound more than two patches
  for (const wsk_flow_patch& p : flow.patches) {
    between += p.front != 0 && p.back != 0 && p.front != p.back;
  }
  object.count("patches_between_voids", between);
  std::string open;
  for (size_t p = 0; p < flow.patches.size(); ++p) {
    if (flow.patches[p].open == 0) continue;
    open += (open.empty() ? "" : ", ") + std::to_string(p);
  }
  object.member("open_patch_numbers", "[" + open + "]");
  return object.close();
}

// The indices of the patches that were held back.
std::string guarded_list(const wsk_surface_view* surface) {
  std::string list;
  const bool known = surface != nullptr && surface->patch_guarded != nullptr;
  for (uint32_t p = 0; known && p < surface->patch_count; ++p) {
    if (surface->patch_guarded[p]) list += (list.empty() ? "" : ", ") + std::to_string(p);
  }
  return "[" + list + "]";
}

const char* way_name(uint8_t way) {
  return way == WSK_PATCH_PLANE ? "plane" : "minimal_area";
}

// The patches that were not simply meshed in their plane, those that were left out among them.
std::string patches_json(const wsk_surface_view* surface) {
  std::string list;
  const bool known = surface != nullptr && surface->patch_status != nullptr;
  const uint32_t count = known ? surface->patch_count : 0;
  for (uint32_t p = 0; p < count; ++p) {
    const bool made = surface->patch_status[p] == WSK_OK;
    if (made && surface->patch_way[p] == WSK_PATCH_PLANE) continue;
    JsonObject patch("    ");
    patch.index("patch", p);
    patch.text("status", wsk_status_name(surface->patch_status[p]));
    if (made) {
      patch.text("way", way_name(surface->patch_way[p]));
    } else {
      patch.text("sentence", surface->patch_sentence[p]);
    }
    std::string curves;
    for (uint32_t i = surface->patch_curve_start[p]; i < surface->patch_curve_start[p + 1]; ++i) {
      curves += (curves.empty() ? "" : ", ") + std::to_string(surface->patch_curves[i]);
    }
    patch.member("curves", "[" + curves + "]");
    list += (list.empty() ? "\n    " : ",\n    ") + patch.close();
  }
  return list.empty() ? "[]" : "[" + list + "\n  ]";
}

std::string strings_json(const std::vector<std::string>& strings) {
  std::string list;
  for (const std::string& text : strings) list += (list.empty() ? "" : ", ") + json_string(text);
  return "[" + list + "]";
}

// What the command itself knows stands beside the report.
struct Outcome {
  const char* status;
  const char* stage;
  std::string sentence;  // "" for none
};

std::string outcome_json(const ReportInput& input, const Outcome& outcome) {
  const Arguments& arguments = input.arguments;
  const wsk_report& report = input.report;
  JsonObject json("");
  json.text("version", wsk_version_string());
  json.text("input", arguments.input);
  json.text("output", arguments.outputs.empty() ? "" : arguments.outputs.front());
  json.member("outputs", strings_json(arguments.outputs));
  json.member("idle_options", strings_json(input.idle_options));
  json.text("method", method_name(arguments.method));
  json.text("status", outcome.status);
  json.text("stage", outcome.stage);
  json.member("sentence", outcome.sentence.empty() ? "null" : json_string(outcome.sentence));
  json.member("place", place_json(report, input.line));
  json.count("curves", report.curves);
  json.count("nodes", report.nodes);
  json.count("segments", report.segments);
  json.count("patches", report.patches);
  json.count("vertices", report.vertices);
  json.count("free_vertices", report.free_vertices);
  json.count("triangles", report.triangles);
  json.count("components", report.components);
  json.count("boundary_loops", report.boundary_loops);
  json.count("euler_characteristic", report.euler_characteristic);
  json.number("spacing", report.spacing);
  json.number("min_angle_deg", report.min_angle_deg);
  json.number("residual", report.residual);
  json.count("factorisations", report.factorisations);
  json.count("cg_iterations", report.cg_iterations);
  json.text("solver", report.solver == WSK_SOLVER_ITERATIVE ? "iterative" : "direct");
  json.count("minimal_area_patches", report.minimal_area_patches);
  json.count("guarded_patches", report.guarded_patches);
  json.member("guarded_patch_list", guarded_list(input.surface));
  json.count("failed_patches", report.failed_patches);
  json.count("ambiguous_patches", report.ambiguous_patches);
  json.index("first_ambiguous_patch", report.first_ambiguous_patch);
  json.count("found_borders", report.found_borders);
  json.count("inverted_triangles", report.inverted_triangles);
  json.index("first_inverted_patch", report.first_inverted_patch);
  json.count("coarse_patches", report.coarse_patches);
  json.index("first_coarse_patch", report.first_coarse_patch);
  json.member("special_patches", patches_json(input.surface));
  json.number("noise_position", report.noise_position);
  json.number("noise_normal", report.noise_normal);
  json.number("constraint_distance_max", report.constraint_distance_max);
  json.number("constraint_distance_rms", report.constraint_distance_rms);
  json.number("normal_deviation_mean_deg", report.normal_deviation_mean_deg);
  json.number("normal_deviation_max_deg", report.normal_deviation_max_deg);
  json.number("dihedral_mean_deg", report.dihedral_mean_deg);
  json.number("dihedral_max_deg", report.dihedral_max_deg);
  json.count("peak_bytes", static_cast<long long>(report.peak_bytes));
  json.member("stage_ms", stages_json(report));
  json.number("total_ms", report.total_ms);
  if (input.prepared != nullptr) json.member("preparation", preparation_json(*input.prepared));
  if (input.flow != nullptr) json.member("flow", flow_json(*input.flow));
  return json.close() + "\n";
}

}  // namespace

std::string report_json(const ReportInput& input) {
  const wsk_report& report = input.report;
  const bool silent = report.status == WSK_OK || report.sentence == nullptr;
  return outcome_json(input, {wsk_status_name(report.status), wsk_stage_name(report.stage),
                              silent ? "" : report.sentence});
}

std::string read_failure_json(const Arguments& arguments, const ReadFailure& failure) {
  wsk_report report;
  wsk_report_init(&report, sizeof report);
  return outcome_json({arguments, report, nullptr, nullptr, nullptr, failure.line(), {}},
                      {failure.status(), "reading", failure.sentence()});
}

}  // namespace wireskin_cli
