#include "accuracy/mesh_distance.h"

#include <algorithm>
#include <numeric>

namespace accuracy {

using namespace networks;  // its operators on points are not found otherwise

static double distance_to_segment(const Point& p, const Point& a, const Point& b) {
  const Point d = b - a;
  const double t = std::clamp(dot(p - a, d) / dot(d, d), 0.0, 1.0);
  return distance(p, a + t * d);
}

double distance_to_triangle(const Point& p, const Point& a, const Point& b, const Point& c) {
  const Point n = unit(cross(b - a, c - a));
  const double height = dot(p - a, n);
  const Point q = p - height * n;
  const auto left_of = [&](const Point& from, const Point& to) {
    return dot(cross(to - from, q - from), n) >= 0.0;
  };
  if (left_of(a, b) && left_of(b, c) && left_of(c, a)) return std::fabs(height);
  return std::min(
      {distance_to_segment(p, a, b), distance_to_segment(p, b, c), distance_to_segment(p, c, a)});
}

static double distance_to_box(const Point& p, const Point& low, const Point& high) {
  Point outside;
  for (size_t k = 0; k < 3; ++k) {
    outside[k] = std::max({low[k] - p[k], 0.0, p[k] - high[k]});
  }
  return length(outside);
}

MeshDistance::MeshDistance(const Mesh& mesh) : mesh_(mesh), order_(mesh.triangles.size()) {
  std::iota(order_.begin(), order_.end(), 0u);
  split(0, static_cast<uint32_t>(order_.size()));
}

uint32_t MeshDistance::split(uint32_t first, uint32_t count) {
  Box box = {{1e300, 1e300, 1e300}, {-1e300, -1e300, -1e300}, first, count, 0};
  for (uint32_t i = first; i < first + count; ++i) {
    for (uint32_t v : mesh_.triangles[order_[i]]) {
      for (size_t k = 0; k < 3; ++k) {
        box.low[k] = std::min(box.low[k], mesh_.positions[v][k]);
        box.high[k] = std::max(box.high[k], mesh_.positions[v][k]);
      }
    }
  }
  const auto index = static_cast<uint32_t>(boxes_.size());
  boxes_.push_back(box);
  if (count <= 4) return index;
  const Point size = box.high - box.low;
  const auto axis = static_cast<size_t>(std::max_element(size.begin(), size.end()) - size.begin());
  const auto centre = [&](uint32_t t) {
    const auto& corners = mesh_.triangles[t];
    return mesh_.positions[corners[0]][axis] + mesh_.positions[corners[1]][axis] +
           mesh_.positions[corners[2]][axis];
  };
  const uint32_t half = count / 2;
  std::nth_element(order_.begin() + first, order_.begin() + first + half,
                   order_.begin() + first + count,
                   [&](uint32_t a, uint32_t b) { return centre(a) < centre(b); });
  split(first, half);
  const uint32_t second = split(first + half, count - half);
  boxes_[index].second = second;
  return index;
}

void MeshDistance::search(uint32_t index, const Point& p, Nearest& best) const {
  const Box& box = boxes_[index];
  if (box.second == 0) {
    for (uint32_t i = box.first; i < box.first + box.count; ++i) {
      const auto& t = mesh_.triangles[order_[i]];
      const double found = distance_to_triangle(p, mesh_.positions[t[0]], mesh_.positions[t[1]],
                                                mesh_.positions[t[2]]);
      if (found < best.distance) best = {found, order_[i]};
    }
    return;
  }
  uint32_t child[2] = {index + 1, box.second};
  double reach[2];
  for (int k = 0; k < 2; ++k) {
    reach[k] = distance_to_box(p, boxes_[child[k]].low, boxes_[child[k]].high);
  }
  const int nearer = reach[1] < reach[0] ? 1 : 0;
  for (int k : {nearer, 1 - nearer}) {
    if (reach[k] < best.distance) search(child[k], p, best);
  }
}

MeshDistance::Nearest MeshDistance::nearest(const Point& p) const {
  Nearest best = {1e300, 0};
  if (!order_.empty()) search(0, p, best);
  return best;
}

Point MeshDistance::triangle_normal(uint32_t triangle) const {
  const auto& t = mesh_.triangles[triangle];
  const Point& a = mesh_.positions[t[0]];
  return unit(cross(mesh_.positions[t[1]] - a, mesh_.positions[t[2]] - a));
}

double MeshDistance::diagonal() const {
  return distance(boxes_[0].low, boxes_[0].high);
}

}  // namespace accuracy
