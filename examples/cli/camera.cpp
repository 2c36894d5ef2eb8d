#include "camera.h"

#include <cmath>

namespace wireskin_cli {

static constexpr double k_degree = 3.14159265358979323846 / 180.0;

static double largest_coordinate(const wsk_surface_view& surface) {
  double largest = 0.0;
  for (size_t i = 0; i < 3 * size_t{surface.vertex_count}; ++i) {
    largest = std::max(largest, std::fabs(surface.positions[i]));
  }
  return largest;
}

// The sum of the triangles' area vectors over the sum of their areas: of length 1 for a flat sheet,
// 0 for a closed surface.
static Vec3 mean_normal(const wsk_surface_view& surface) {
  // Coordinates of at most one: products of tiny or huge ones would leave the range of a double.
  const double largest = largest_coordinate(surface);
  const auto corner = [&](size_t i) {
    const Vec3 p = vec3_at(surface.positions, surface.triangles[i]);
    return Vec3{p.x / largest, p.y / largest, p.z / largest};
  };
  Vec3 sum;
  double area = 0.0;
  for (size_t i = 0; i < 3 * size_t{surface.triangle_count}; i += 3) {
    const Vec3 a = corner(i);
    const Vec3 normal = cross(corner(i + 1) - a, corner(i + 2) - a);
    sum = sum + normal;
    area += length(normal);
  }
  return area > 0.0 ? (1.0 / area) * sum : Vec3{};
}

// Azimuth from the x axis and elevation above the ground, in degrees; `sky` is 1, or -1 to look
// with z down.
static Frame frame_at(double azimuth, double elevation, double sky) {
  const double a = azimuth * k_degree;
  const double e = elevation * k_degree;
  const Vec3 up = {0.0, 0.0, sky};
  Frame frame;
  frame.toward = {std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), sky * std::sin(e)};
  frame.right = unit(cross(up, frame.toward));
  frame.up = cross(frame.toward, frame.right);
  return frame;
}

std::array<Frame, 2> choose_frames(const wsk_surface_view& surface) {
  constexpr double k_azimuth = -60.0;
  const Vec3 mean = mean_normal(surface);
  const double openness = length(mean);
  if (openness < 0.15) return {frame_at(k_azimuth, 28, 1), frame_at(k_azimuth + 180, -18, 1)};
  if (std::fabs(mean.z) > 0.6 * openness) {
    const double sky = mean.z > 0.0 ? 1.0 : -1.0;
    return {frame_at(k_azimuth, 50, sky), frame_at(k_azimuth + 115, 28, sky)};
  }
  const double facing = std::atan2(mean.y, mean.x) / k_degree;
  return {frame_at(facing + 30, 20, 1), frame_at(facing - 45, 30, 1)};
}

Extent extent_in(const Frame& frame, const wsk_surface_view& surface) {
  const double infinity = std::numeric_limits<double>::infinity();
  Extent extent = {infinity, -infinity, infinity, -infinity};
  for (size_t v = 0; v < surface.vertex_count; ++v) {
    const Vec3 p = vec3_at(surface.positions, v);
    extent.left = std::min(extent.left, dot(p, frame.right));
    extent.right = std::max(extent.right, dot(p, frame.right));
    extent.bottom = std::min(extent.bottom, dot(p, frame.up));
    extent.top = std::max(extent.top, dot(p, frame.up));
  }
  return extent;
}

}  // namespace wireskin_cli
