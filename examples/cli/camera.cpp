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

// Two axes of the ground and the one upwards, right-handed.
struct Ground {
  Vec3 first;
  Vec3 second;
  Vec3 up;
};

static Ground ground_of(int up_axis) {
  constexpr Vec3 k_axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  return {k_axes[(up_axis + 1) % 3], k_axes[(up_axis + 2) % 3], k_axes[up_axis]};
}

// Azimuth from the ground's first axis and elevation above it, in degrees; `sky` is 1, or -1 to
// look with the axis upwards pointing down.
static Frame frame_at(const Ground& ground, double azimuth, double elevation, double sky) {
  const double a = azimuth * k_degree;
  const double e = elevation * k_degree;
  const Vec3 up = sky * ground.up;
  Frame frame;
  frame.toward =
      std::cos(e) * (std::cos(a) * ground.first + std::sin(a) * ground.second) + std::sin(e) * up;
  frame.right = unit(cross(up, frame.toward));
  frame.up = cross(frame.toward, frame.right);
  return frame;
}

std::array<Frame, 2> choose_frames(const wsk_surface_view& surface, int up_axis) {
  constexpr double k_azimuth = -60.0;
  const Ground ground = ground_of(up_axis);
  const Vec3 mean = mean_normal(surface);
  const double openness = length(mean);
  if (openness < 0.15) {
    return {frame_at(ground, k_azimuth, 28, 1), frame_at(ground, k_azimuth + 180, -18, 1)};
  }
  const double rise = dot(mean, ground.up);
  if (std::fabs(rise) > 0.6 * openness) {
    const double sky = rise > 0.0 ? 1.0 : -1.0;
    return {frame_at(ground, k_azimuth, 50, sky), frame_at(ground, k_azimuth + 115, 28, sky)};
  }
  const double facing = std::atan2(dot(mean, ground.second), dot(mean, ground.first)) / k_degree;
  return {frame_at(ground, facing + 30, 20, 1), frame_at(ground, facing - 45, 30, 1)};
}

Extent extent_in(const Frame& frame, const wsk_surface_view& surface) {
  if (surface.vertex_count == 0) return {-1.0, 1.0, -1.0, 1.0};  // an empty picture
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
