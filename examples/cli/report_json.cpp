#include "report_json.h"

#include <cmath>
#include <cstdint>

#include "scan.h"

namespace wireskin_cli {

// The length of the well-formed UTF-8 sequence at the start of the text, 0 if there is none. The
// ranges of the second byte keep out overlong forms, surrogates and what lies beyond U+10FFFF.
static size_t utf8_length(std::string_view text) {
  const auto byte = [text](size_t i) {
    return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u;
  };
  const unsigned first = byte(0);
  if (first < 0x80) return 1;
  if (first < 0xC2 || first > 0xF4) return 0;
  const size_t length = first < 0xE0 ? 2 : first < 0xF0 ? 3 : 4;
  const unsigned least = first == 0xE0 ? 0xA0 : first == 0xF0 ? 0x90 : 0x80;
  const unsigned most = first == 0xED ? 0x9F : first == 0xF4 ? 0x8F : 0xBF;
  if (byte(1) < least || byte(1) > most) return 0;
  for (size_t i = 2; i < length; ++i) {
    if (byte(i) < 0x80 || byte(i) > 0xBF) return 0;
  }
  return length;
}

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

std::string place_json(const wsk_report& report) {
  const bool known = report.curve != WSK_NONE || report.sample != WSK_NONE ||
                     report.node != WSK_NONE || report.patch != WSK_NONE;
  if (!known) return "null";
  JsonObject place("  ");
  place.index("curve", report.curve);
  place.index("sample", report.sample);
  place.index("node", report.node);
  place.index("patch", report.patch);
  return place.close();
}

std::string stages_json(const wsk_report& report) {
  JsonObject stages("  ");
  for (wsk_stage stage = 0; stage < WSK_STAGE_COUNT; ++stage) {
    stages.number(wsk_stage_name(stage), report.stage_ms[stage]);
  }
  return stages.close();
}

const char* way_name(uint8_t way) {
  return way == WSK_PATCH_PLANE ? "plane" : "minimal_area";
}

// The patches that were not simply meshed in their plane, those that were left out among them.
std::string patches_json(const wsk_surface_view* surface) {
  std::string list;
  const uint32_t count = surface == nullptr ? 0 : surface->patch_count;
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

}  // namespace

std::string report_json(const Arguments& arguments, const wsk_report& report,
                        const wsk_surface_view* surface) {
  JsonObject json("");
  json.text("version", wsk_version_string());
  json.text("input", arguments.input);
  json.text("output", arguments.output);
  json.text("method", method_name(arguments.method));
  json.text("status", wsk_status_name(report.status));
  json.text("stage", wsk_stage_name(report.stage));
  if (report.status == WSK_OK || report.sentence == nullptr) {
    json.member("sentence", "null");
  } else {
    json.text("sentence", report.sentence);
  }
  json.member("place", place_json(report));
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
  json.count("minimal_area_patches", report.minimal_area_patches);
  json.count("guarded_patches", report.guarded_patches);
  json.count("failed_patches", report.failed_patches);
  json.member("special_patches", patches_json(surface));
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
  return json.close() + "\n";
}

}  // namespace wireskin_cli
