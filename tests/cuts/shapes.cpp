#include "cuts/shapes.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <utility>

namespace cuts {

using networks::Mesh;

using EdgeOf = std::pair<uint32_t, uint32_t>;

// Of each edge, low vertex first, the triangles that run along it and against it.
struct Sides {
  std::vector<uint32_t> along, against;
};

static std::map<EdgeOf, Sides> sides_of_edges(const Mesh& mesh) {
  std::map<EdgeOf, Sides> edges;
  for (uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    for (size_t i = 0; i < 3; ++i) {
      const uint32_t a = mesh.triangles[t][i], b = mesh.triangles[t][(i + 1) % 3];
      Sides& sides = edges[std::minmax(a, b)];
      (a < b ? sides.along : sides.against).push_back(t);
    }
  }
  return edges;
}

static void keep_triangles(Mesh& mesh, const std::vector<bool>& drop) {
  Mesh kept;
  for (size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!drop[t]) kept.triangles.push_back(mesh.triangles[t]);
  }
  mesh.triangles = kept.triangles;
}

static void drop_bad_edges(Mesh& mesh) {
  std::vector<bool> drop(mesh.triangles.size());
  for (const auto& [edge, sides] : sides_of_edges(mesh)) {
    if (sides.along.size() <= 1 && sides.against.size() <= 1) continue;
    for (const uint32_t t : sides.along) drop[t] = true;
    for (const uint32_t t : sides.against) drop[t] = true;
  }
  keep_triangles(mesh, drop);
}

// Knife edges, whose two triangles lie on each other: no normal there says what the surface does.
static void drop_knife_edges(Mesh& mesh) {
  using networks::operator-;
  constexpr double k_least_cosine = -0.2;
  const auto normal = [&mesh](uint32_t t) {
    const auto& v = mesh.triangles[t];
    const networks::Point& a = mesh.positions[v[0]];
    return networks::unit(networks::cross(mesh.positions[v[1]] - a, mesh.positions[v[2]] - a));
  };
  std::vector<bool> drop(mesh.triangles.size());
  for (const auto& [edge, sides] : sides_of_edges(mesh)) {
    if (sides.along.empty() || sides.against.empty()) continue;
    const uint32_t t = sides.along[0], u = sides.against[0];
    if (networks::dot(normal(t), normal(u)) < k_least_cosine) drop[t] = drop[u] = true;
  }
  keep_triangles(mesh, drop);
}

// Whether triangles were dropped, which may have made other such vertices.
static bool drop_pinched_vertices(Mesh& mesh) {
  std::map<uint32_t, int> border_edges;
  for (const auto& [edge, sides] : sides_of_edges(mesh)) {
    if (sides.along.size() + sides.against.size() != 1) continue;
    ++border_edges[edge.first];
    ++border_edges[edge.second];
  }
  std::vector<bool> drop(mesh.triangles.size());
  for (size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const uint32_t v : mesh.triangles[t]) drop[t] = drop[t] || border_edges[v] > 2;
  }
  const size_t before = mesh.triangles.size();
  keep_triangles(mesh, drop);
  return mesh.triangles.size() < before;
}

static void keep_largest_part(Mesh& mesh) {
  std::vector<uint32_t> parent(mesh.triangles.size());
  std::iota(parent.begin(), parent.end(), 0u);
  const auto root = [&parent](uint32_t t) {
    while (parent[t] != t) t = parent[t] = parent[parent[t]];
    return t;
  };
  for (const auto& [edge, sides] : sides_of_edges(mesh)) {
    if (sides.along.empty() || sides.against.empty()) continue;
    parent[root(sides.along[0])] = root(sides.against[0]);
  }
  std::map<uint32_t, size_t> sizes;
  for (uint32_t t = 0; t < parent.size(); ++t) ++sizes[root(t)];
  uint32_t largest = 0;
  for (const auto& [part, size] : sizes) {
    if (size > sizes[largest]) largest = part;
  }
  std::vector<bool> drop(parent.size());
  for (uint32_t t = 0; t < parent.size(); ++t) drop[t] = root(t) != largest;
  keep_triangles(mesh, drop);
}

Mesh read_mesh(const std::string& path) {
  const bool off = path.substr(path.size() - 4) == ".off";
  Mesh mesh = off ? networks::read_off(path) : networks::read_obj(path);
  drop_bad_edges(mesh);
  drop_knife_edges(mesh);
  while (drop_pinched_vertices(mesh)) {
  }
  keep_largest_part(mesh);
  return mesh;
}

std::vector<networks::Plane> planes_along_axes(const Mesh& mesh, const std::vector<double>& x,
                                               const std::vector<double>& y,
                                               const std::vector<double>& z) {
  std::vector<networks::Plane> planes;
  const std::vector<double>* fractions[] = {&x, &y, &z};
  for (size_t axis = 0; axis < 3; ++axis) {
    double low = 1e300, high = -1e300;
    for (const networks::Point& p : mesh.positions) {
      low = std::min(low, p[axis]);
      high = std::max(high, p[axis]);
    }
    networks::Point normal = {0.0, 0.0, 0.0};
    normal[axis] = 1.0;
    for (double f : *fractions[axis]) planes.push_back({normal, low + f * (high - low)});
  }
  return planes;
}

long euler_characteristic(const Mesh& mesh) {
  std::set<uint32_t> vertices;
  for (const auto& t : mesh.triangles) vertices.insert(t.begin(), t.end());
  return static_cast<long>(vertices.size()) - static_cast<long>(sides_of_edges(mesh).size()) +
         static_cast<long>(mesh.triangles.size());
}

}  // namespace cuts
