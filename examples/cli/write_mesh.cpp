#include "write_mesh.h"

#include <algorithm>
#include <array>
#include <cfloat>
#include <cmath>
#include <cstring>
#include <map>
#include <vector>

#include "bytes.h"
#include "failure.h"
#include "files.h"
#include "scan.h"
#include "vec.h"

namespace wireskin_cli {

static void append_row(std::string& text, const char* keyword, const double* xyz) {
  text += keyword;
  for (int k = 0; k < 3; ++k) {
    text += ' ';
    append_double(text, xyz[k]);
  }
  text += '\n';
}

// The triangles of each patch in turn, in their order within it.
static std::vector<uint32_t> triangles_by_patch(const wsk_surface_view& surface) {
  std::vector<uint32_t> order(surface.triangle_count);
  for (uint32_t i = 0; i < surface.triangle_count; ++i) order[i] = i;
  const uint32_t* patch = surface.triangle_patch;
  std::stable_sort(order.begin(), order.end(),
                   [patch](uint32_t a, uint32_t b) { return patch[a] < patch[b]; });
  return order;
}

// Edges that follow one another make one polyline.
static void append_curves(std::string& text, const wsk_surface_view& surface) {
  const uint32_t* edges = surface.curve_edges;
  for (uint32_t e = 0; e < surface.curve_edge_count; ++e) {
    const bool same_curve = e > 0 && surface.curve_edge_curve != nullptr &&
                            surface.curve_edge_curve[e] == surface.curve_edge_curve[e - 1];
    if (e == 0 || !same_curve) {
      const uint32_t curve = surface.curve_edge_curve != nullptr ? surface.curve_edge_curve[e] : 0;
      text += (e == 0 ? "g curve_" : "\ng curve_") + std::to_string(curve);
    }
    if (e == 0 || !same_curve || edges[2 * size_t{e} - 1] != edges[2 * size_t{e}]) {
      text += "\nl " + std::to_string(edges[2 * size_t{e}] + 1ull);
    }
    text += " " + std::to_string(edges[2 * size_t{e} + 1] + 1ull);
  }
  if (surface.curve_edge_count != 0) text += "\n";
}

// Which row of normals each corner has, from 1: those of the vertices come first, then those of
// the sides of creases, each once, which are appended to `text`.
static std::vector<size_t> append_crease_normals(std::string& text,
                                                 const wsk_surface_view& surface) {
  std::vector<size_t> row(3 * static_cast<size_t>(surface.triangle_count));
  for (size_t h = 0; h < row.size(); ++h) row[h] = surface.triangles[h] + 1ull;
  std::map<std::array<double, 3>, size_t> rows;
  for (size_t i = 0; i < surface.crease_corner_count; ++i) {
    const double* n = surface.crease_normals + 3 * i;
    const auto added = rows.insert({{n[0], n[1], n[2]}, surface.vertex_count + rows.size() + 1});
    if (added.second) append_row(text, "vn", n);
    row[surface.crease_corners[i]] = added.first->second;
  }
  return row;
}

std::string obj_bytes(const wsk_surface_view& surface, bool curves) {
  std::string text = std::string("# wireskin ") + wsk_version_string() + "\n";
  for (size_t v = 0; v < surface.vertex_count; ++v) {
    append_row(text, "v", surface.positions + 3 * v);
  }
  for (size_t v = 0; v < surface.vertex_count; ++v) {
    append_row(text, "vn", surface.normals + 3 * v);
  }
  const std::vector<size_t> normal_row = append_crease_normals(text, surface);
  uint32_t patch = WSK_NONE;
  for (const uint32_t t : triangles_by_patch(surface)) {
    if (surface.triangle_patch[t] != patch) {
      patch = surface.triangle_patch[t];
      text += "g patch_" + std::to_string(patch) + "\n";
    }
    text += 'f';
    for (size_t k = 0; k < 3; ++k) {
      const size_t h = 3 * size_t{t} + k;
      text += ' ';
      text += std::to_string(surface.triangles[h] + 1ull);
      text += "//";
      text += std::to_string(normal_row[h]);
    }
    text += '\n';
  }
  if (curves) append_curves(text, surface);
  return text;
}

static void append_edges(std::string& bytes, const wsk_surface_view& surface) {
  for (size_t e = 0; e < surface.curve_edge_count; ++e) {
    append_little(bytes, surface.curve_edges[2 * e]);
    append_little(bytes, surface.curve_edges[2 * e + 1]);
    append_little(bytes,
                  surface.curve_edge_curve != nullptr ? surface.curve_edge_curve[e] : uint32_t{0});
  }
}

std::string ply_bytes(const wsk_surface_view& surface, bool curves) {
  std::string bytes = "ply\nformat binary_little_endian 1.0\n";
  bytes += std::string("comment wireskin ") + wsk_version_string() + "\n";
  bytes += "element vertex " + std::to_string(surface.vertex_count) + "\n";
  for (const char* name : {"x", "y", "z", "nx", "ny", "nz", "mean_curvature"}) {
    bytes += std::string("property double ") + name + "\n";
  }
  bytes += "element face " + std::to_string(surface.triangle_count) + "\n";
  bytes += "property list uchar int vertex_indices\nproperty int patch\n";
  if (curves) {
    bytes += "element edge " + std::to_string(surface.curve_edge_count) + "\n";
    bytes += "property int vertex1\nproperty int vertex2\nproperty int curve\n";
  }
  bytes += "end_header\n";
  for (size_t v = 0; v < surface.vertex_count; ++v) {
    for (size_t k = 0; k < 3; ++k) append_little(bytes, surface.positions[3 * v + k]);
    for (size_t k = 0; k < 3; ++k) append_little(bytes, surface.normals[3 * v + k]);
    append_little(bytes, surface.mean_curvature[v]);
  }
  for (size_t t = 0; t < surface.triangle_count; ++t) {
    bytes += '\3';
    for (size_t k = 0; k < 3; ++k) append_little(bytes, surface.triangles[3 * t + k]);
    append_little(bytes, surface.triangle_patch[t]);
  }
  if (curves) append_edges(bytes, surface);
  return bytes;
}

// Single precision must hold the largest coordinate, and the extent well above its least number.
static void check_single_precision(const wsk_surface_view& surface, const std::string& file) {
  double largest = 0.0;
  for (size_t i = 0; i < 3 * size_t{surface.vertex_count}; ++i) {
    largest = std::max(largest, std::fabs(surface.positions[i]));
  }
  if (largest > FLT_MAX || (surface.vertex_count != 0 && largest < 1e6 * FLT_MIN)) {
    throw Failure(file +
                  ": the coordinates do not fit the single precision of STL, use .obj or .ply");
  }
}

static Vec3 facet_normal(const Vec3& a, const Vec3& b, const Vec3& c) {
  // Edges of length one first: products of two lengths, here of single precision, could underflow.
  return unit(cross(unit(b - a), unit(c - a)));
}

std::string stl_bytes(const wsk_surface_view& surface, const std::string& file) {
  check_single_precision(surface, file);
  // A header that begins with "solid" would be taken for text.
  std::string bytes = std::string("binary STL, wireskin ") + wsk_version_string();
  bytes.resize(80, ' ');
  append_little(bytes, surface.triangle_count);
  for (size_t t = 0; t < surface.triangle_count; ++t) {
    Vec3 corner[3];
    for (size_t k = 0; k < 3; ++k) {
      corner[k] = vec3_at(surface.positions, surface.triangles[3 * t + k]);
    }
    const Vec3 rows[4] = {facet_normal(corner[0], corner[1], corner[2]), corner[0], corner[1],
                          corner[2]};
    for (const Vec3& row : rows) {
      append_little(bytes, static_cast<float>(row.x));
      append_little(bytes, static_cast<float>(row.y));
      append_little(bytes, static_cast<float>(row.z));
    }
    append_little(bytes, uint16_t{0});
  }
  return bytes;
}

std::string mesh_bytes(const wsk_surface_view& surface, const std::string& file, bool curves) {
  const std::string extension = extension_of(file);
  if (extension == ".ply") return ply_bytes(surface, curves);
  if (extension == ".stl") return stl_bytes(surface, file);
  return obj_bytes(surface, curves);
}

}  // namespace wireskin_cli
