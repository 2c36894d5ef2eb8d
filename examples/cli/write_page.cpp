#include "write_page.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
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
  std::vector<uint32_t> edges;
  if (surface.curve_edges != nullptr) {
    edges.assign(surface.curve_edges,
                 surface.curve_edges + 2 * static_cast<size_t>(surface.curve_edge_count));
  }
  arrays.add_index("edges", edges);
}

// The curves as they were given; vertices that several curves name are nodes.
void add_samples(const Network& network, const Point& origin, Arrays& arrays) {
  std::vector<double> positions, normals, nodes;
  std::vector<uint32_t> start = {0}, closed;
  std::map<uint32_t, size_t> uses;
  for (const NetworkCurve& curve : network.curves) {
    for (const uint32_t v : curve.vertices) {
      ++uses[v];
      const size_t at = 3 * static_cast<size_t>(v);
      positions.insert(positions.end(), &network.positions[at], &network.positions[at] + 3);
      if (network.normals.empty()) continue;
      const double* n = &network.normals[at];
      const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
      for (size_t k = 0; k < 3; ++k) normals.push_back(length > 0.0 ? n[k] / length : 0.0);
    }
    start.push_back(static_cast<uint32_t>(positions.size() / 3));
    closed.push_back(curve.closed ? 1 : 0);
  }
  for (const auto& [v, count] : uses) {
    const size_t at = 3 * static_cast<size_t>(v);
    if (count > 1) nodes.insert(nodes.end(), &network.positions[at], &network.positions[at] + 3);
  }
  arrays.add_float("samples", relative(positions.data(), positions.size(), origin));
  arrays.add_unit("sampleNormals", normals);
  arrays.add_index("curveStart", start);
  arrays.add_index("curveClosed", closed);
  arrays.add_float("nodes", relative(nodes.data(), nodes.size(), origin));
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
  add_samples(input.network, origin, arrays);
  std::string origin_text;
  for (size_t k = 0; k < 3; ++k) {
    if (k > 0) origin_text += ',';
    append_double(origin_text, origin[k]);
  }
  const std::string header = "{\"title\":" + json_string(input.title) +
                             ",\"up\":" + std::to_string(input.up_axis) + ",\"origin\":[" +
                             origin_text + "],\"marks\":[],\"report\":" + input.report +
                             ",\"arrays\":" + arrays.list() + "}";
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
