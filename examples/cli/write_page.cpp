#include "write_page.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <map>
#include <stdexcept>
#include <vector>

#include "bytes.h"
#include "report_json.h"
#include "scan.h"

namespace wireskin_cli {

namespace {

using Point = std::array<double, 3>;

// The arrays behind the header, and how the header names them.
class Arrays {
 public:
  void add_float(const char* name, const std::vector<float>& values) {
    begin(name, "f32", values.size());
    for (const float value : values) append_little(bytes_, value);
  }
  void add_index(const char* name, const std::vector<uint32_t>& values) {
    begin(name, "u32", values.size());
    for (const uint32_t value : values) append_little(bytes_, value);
  }
  // Components of unit vectors.
  void add_unit(const char* name, const std::vector<double>& values) {
    begin(name, "i16", values.size());
    for (const double value : values) {
      const double scaled = std::isfinite(value) ? std::clamp(value, -1.0, 1.0) * 32767.0 : 0.0;
      append_little(bytes_, static_cast<int16_t>(std::lround(scaled)));
    }
    while (bytes_.size() % 4 != 0) bytes_ += '\0';
  }
  const std::string& bytes() const { return bytes_; }
  std::string list() const { return '[' + list_ + ']'; }

 private:
  void begin(const char* name, const char* type, size_t count) {
    if (!list_.empty()) list_ += ',';
    list_ += std::string("{\"name\":\"") + name + "\",\"type\":\"" + type +
             "\",\"offset\":" + std::to_string(bytes_.size()) +
             ",\"count\":" + std::to_string(count) + '}';
  }

  std::string bytes_;
  std::string list_;
};

Point middle_of(const wsk_surface_view& surface) {
  Point low, high;
  low.fill(std::numeric_limits<double>::infinity());
  high.fill(-std::numeric_limits<double>::infinity());
  for (size_t i = 0; i < 3 * static_cast<size_t>(surface.vertex_count); ++i) {
    low[i % 3] = std::min(low[i % 3], surface.positions[i]);
    high[i % 3] = std::max(high[i % 3], surface.positions[i]);
  }
  Point middle{};
  for (size_t k = 0; k < 3; ++k) {
    if (low[k] <= high[k]) middle[k] = low[k] + (high[k] - low[k]) / 2.0;
  }
  return middle;
}

std::vector<float> relative(const double* values, size_t count, const Point& origin) {
  std::vector<float> result(count);
  for (size_t i = 0; i < count; ++i) result[i] = static_cast<float>(values[i] - origin[i % 3]);
  return result;
}

void add_surface(const wsk_surface_view& surface, const Point& origin, Arrays& arrays) {
  const size_t n = surface.vertex_count;
  const size_t m = surface.triangle_count;
  arrays.add_float("positions", relative(surface.positions, 3 * n, origin));
  arrays.add_unit("normals", {surface.normals, surface.normals + 3 * n});
  arrays.add_float("curvature", {surface.mean_curvature, surface.mean_curvature + n});
  arrays.add_index("triangles", {surface.triangles, surface.triangles + 3 * m});
  arrays.add_index("patch", {surface.triangle_patch, surface.triangle_patch + m});
  const size_t corners = surface.crease_corner_count;
  std::vector<uint32_t> crease_corners;
  std::vector<double> crease_normals;
  if (corners > 0) {
    crease_corners.assign(surface.crease_corners, surface.crease_corners + corners);
    crease_normals.assign(surface.crease_normals, surface.crease_normals + 3 * corners);
  }
  arrays.add_index("creaseCorners", crease_corners);
  arrays.add_unit("creaseNormals", crease_normals);
  std::vector<uint32_t> edges;
  if (surface.curve_edges != nullptr) {
    edges.assign(surface.curve_edges,
                 surface.curve_edges + 2 * static_cast<size_t>(surface.curve_edge_count));
  }
  arrays.add_index("edges", edges);
}

// The curves as they were given; samples that several curves name are nodes. Where only tangents
// were measured, as they were integrated.
void add_samples(const BuildResult& result, const Point& origin, Arrays& arrays) {
  std::vector<wsk_curve> curves = result.given.curves;
  if (curves.empty()) {
    const wsk_network_view prepared = result.prepared_view();
    curves.assign(prepared.curves, prepared.curves + prepared.curve_count);
  }
  std::vector<double> positions, normals, nodes;
  std::vector<uint32_t> start = {0}, closed;
  std::map<uint32_t, size_t> uses;
  for (const wsk_curve& curve : curves) {
    for (size_t i = 0; i < curve.sample_count; ++i) {
      const double* p = curve.positions + 3 * i;
      positions.insert(positions.end(), p, p + 3);
      const double zero[3] = {0.0, 0.0, 0.0};
      const double* n = curve.normals == nullptr ? zero : curve.normals + 3 * i;
      const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
      for (size_t k = 0; k < 3; ++k) normals.push_back(length > 0.0 ? n[k] / length : 0.0);
      const uint32_t node = curve.nodes == nullptr ? WSK_NONE : curve.nodes[i];
      if (node != WSK_NONE && ++uses[node] == 2) nodes.insert(nodes.end(), p, p + 3);
    }
    start.push_back(static_cast<uint32_t>(positions.size() / 3));
    closed.push_back(curve.closed != 0 ? 1 : 0);
  }
  arrays.add_float("samples", relative(positions.data(), positions.size(), origin));
  arrays.add_unit("sampleNormals", normals);
  arrays.add_index("curveStart", start);
  arrays.add_index("curveClosed", closed);
  arrays.add_float("nodes", relative(nodes.data(), nodes.size(), origin));
}

// What the report complains of, at its place.
class Marks {
 public:
  explicit Marks(const Point& origin) : origin_(origin) {}

  void add(const std::string& text, const double* place) {
    json_ += json_.empty() ? "{\"text\":" : ",{\"text\":";
    json_ += json_string(text) + ",\"at\":[";
    for (size_t k = 0; k < 3; ++k) {
      if (k > 0) json_ += ',';
      append_double(json_, place[k] - origin_[k]);
    }
    json_ += "]}";
  }
  std::string list() const { return '[' + json_ + ']'; }

 private:
  Point origin_;
  std::string json_;
};

std::string length_text(double length) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", length);
  return text;
}

void mark_preparation(const wsk_network_view& prepared, Marks& marks) {
  for (uint32_t i = 0; i < prepared.snap_count; ++i) {
    const wsk_snap& snap = prepared.snaps[i];
    marks.add("curves " + std::to_string(snap.a.curve) + " and " + std::to_string(snap.b.curve) +
                  " joined over " + length_text(snap.distance),
              snap.a.position);
  }
  for (uint32_t i = 0; i < prepared.contradiction_count; ++i) {
    const wsk_contradiction& pair = prepared.contradictions[i];
    marks.add("normals of curves " + std::to_string(pair.a.curve) + " and " +
                  std::to_string(pair.b.curve) + " contradict each other",
              pair.a.position);
  }
}

// The corner of the patch's first triangle stands for the patch.
void mark_patch(const wsk_surface_view& surface, uint32_t patch, const std::string& text,
                Marks& marks) {
  for (size_t t = 0; t < surface.triangle_count; ++t) {
    if (surface.triangle_patch[t] != patch) continue;
    double middle[3] = {0.0, 0.0, 0.0};
    for (size_t c = 0; c < 9; ++c) {
      const size_t v = surface.triangles[3 * t + c / 3];
      middle[c % 3] += surface.positions[3 * v + c % 3] / 3.0;
    }
    marks.add(text, middle);
    return;
  }
}

// Patches that the surface was held back on. Those that were left out have no triangles to stand
// on.
void mark_patches(const wsk_surface_view& surface, Marks& marks) {
  for (uint32_t p = 0; surface.patch_guarded != nullptr && p < surface.patch_count; ++p) {
    if (surface.patch_guarded[p] == 0) continue;
    mark_patch(surface, p,
               "patch " + std::to_string(p) + " was held back: its last steps went astray", marks);
  }
}

// Ends of curves that meet nothing.
void mark_ends(const wsk_network_view& prepared, Marks& marks) {
  std::map<uint32_t, size_t> uses;
  for (uint32_t c = 0; c < prepared.curve_count; ++c) {
    const wsk_curve& curve = prepared.curves[c];
    for (size_t i = 0; curve.nodes != nullptr && i < curve.sample_count; ++i)
      ++uses[curve.nodes[i]];
  }
  for (uint32_t c = 0; c < prepared.curve_count; ++c) {
    const wsk_curve& curve = prepared.curves[c];
    if (curve.closed != 0 || curve.sample_count < 2) continue;
    for (const size_t end : {size_t{0}, curve.sample_count - 1}) {
      const uint32_t node = curve.nodes == nullptr ? WSK_NONE : curve.nodes[end];
      if (node != WSK_NONE && uses[node] > 1) continue;
      const uint32_t given = prepared.given_curve[prepared.first_sample[c] + end];
      marks.add("curve " + std::to_string(given) + " ends here and meets no other",
                curve.positions + 3 * end);
    }
  }
}

void mark_flow(const wsk_surface_view& surface, const FlowSummary& flow, Marks& marks) {
  for (uint32_t p = 0; p < flow.patches.size(); ++p) {
    if (flow.patches[p].open == 0) continue;
    mark_patch(surface, p,
               "patch " + std::to_string(p) + " is open: part of its border is no curve", marks);
  }
}

std::string base64(std::string_view bytes) {
  constexpr char k_digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve(bytes.size() / 3 * 4 + 8);
  for (size_t i = 0; i < bytes.size(); i += 3) {
    uint32_t group = 0;
    for (size_t k = 0; k < 3; ++k) {
      group = group << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    }
    for (size_t k = 0; k < 4; ++k) {
      const bool padding = i + k > bytes.size();
      text += padding ? '=' : k_digits[group >> (18 - 6 * k) & 63u];
    }
  }
  return text;
}

std::string html_text(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (static_cast<unsigned char>(c) >= 32)
      result += c;
  }
  return result;
}

void replace_mark(std::string& page, std::string_view mark, const std::string& text) {
  const size_t at = page.find(mark);
  if (at == std::string::npos) throw std::logic_error("the page has lost its marks");
  page.replace(at, mark.size(), text);
}

}  // namespace

std::string page_bytes(const PageInput& input) {
  const Point origin = middle_of(input.surface);
  Arrays arrays;
  add_surface(input.surface, origin, arrays);
  add_samples(input.result, origin, arrays);
  Marks marks(origin);
  mark_preparation(input.result.prepared_view(), marks);
  mark_ends(input.result.prepared_view(), marks);
  mark_patches(input.surface, marks);
  if (input.result.flow != nullptr) mark_flow(input.surface, *input.result.flow, marks);
  std::string origin_text;
  for (size_t k = 0; k < 3; ++k) {
    if (k > 0) origin_text += ',';
    append_double(origin_text, origin[k]);
  }
  const std::string header = "{\"title\":" + json_string(input.title) +
                             ",\"up\":" + std::to_string(input.up_axis) + ",\"origin\":[" +
                             origin_text + "],\"marks\":" + marks.list() +
                             ",\"report\":" + input.report + ",\"arrays\":" + arrays.list() + "}";
  std::string scene;
  append_little(scene, static_cast<uint32_t>(header.size()));
  scene += header;
  while (scene.size() % 4 != 0) scene += ' ';
  scene += arrays.bytes();
  std::string page(k_page);
  replace_mark(page, "<!--title-->", html_text(input.title));
  replace_mark(page, "<!--scene-->", base64(scene));
  return page;
}

}  // namespace wireskin_cli
