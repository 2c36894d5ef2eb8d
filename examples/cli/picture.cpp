#include "picture.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "camera.h"
#include "corners.h"
#include "raster.h"

namespace wireskin_cli {

namespace {

constexpr int k_view_width = 800;
constexpr int k_least_height = 500;
constexpr int k_greatest_height = 1200;
constexpr int k_margin = 36;
constexpr int k_samples = 3;  // a side of each pixel
constexpr double k_line_radius = 1.7;
constexpr double k_stripe_degrees = 12.0;  // a light and a dark one together
constexpr double k_light_stripe = 0.96;
constexpr double k_dark_stripe = 0.20;

constexpr Rgb k_curve_colour = {224, 64, 32};
constexpr Rgb k_boundary_colour = {24, 104, 204};
constexpr Vec3 k_front_tint = {1.0, 1.0, 1.0};
constexpr Vec3 k_back_tint = {0.98, 0.82, 0.55};

uint8_t byte_of(double value) {
  return static_cast<uint8_t>(255.0 * std::clamp(value, 0.0, 1.0) + 0.5);
}

// The light of the isophotes, the same for both views so that both show the same lines.
Vec3 isophote_direction(const Frame& frame) {
  return unit(frame.toward + 0.45 * frame.up - 0.35 * frame.right);
}

Rgb shade(const Vec3& normal, bool back, const Vec3& isophotes, const Vec3& toward) {
  const double degrees =
      std::acos(std::clamp(dot(normal, isophotes), -1.0, 1.0)) * (180.0 / 3.14159265358979323846);
  const double phase = degrees / k_stripe_degrees;
  const bool light = phase - std::floor(phase) < 0.5;
  const double facing = std::fabs(dot(normal, toward));
  const double grey = (light ? k_light_stripe : k_dark_stripe) * (0.50 + 0.50 * facing);
  const Vec3 tint = back ? k_back_tint : k_front_tint;
  return {byte_of(grey * tint.x), byte_of(grey * tint.y), byte_of(grey * tint.z)};
}

void draw_surface(Canvas& canvas, const Camera& camera, const Vec3& isophotes,
                  const wsk_surface_view& surface) {
  const std::vector<const double*> normals = normals_of_corners(surface);
  for (size_t t = 0; t < surface.triangle_count; ++t) {
    ScreenPoint p[3];
    Vec3 n[3];
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t v = surface.triangles[3 * t + k];
      p[k] = camera.project(vec3_at(surface.positions, v));
      n[k] = vec3_at(normals[3 * t + k], 0);
    }
    // y runs down, so a triangle that is counter-clockwise for the eye turns the other way here.
    const bool back = turn(p[0], p[1], p[2].x, p[2].y) > 0.0;
    fill_triangle(canvas, p, [&](const double(&w)[3]) {
      const Vec3 normal = unit(w[0] * n[0] + w[1] * n[1] + w[2] * n[2]);
      return shade(normal, back, isophotes, camera.frame.toward);
    });
  }
}

// How many triangles each edge has, the lesser vertex first.
std::map<std::pair<uint32_t, uint32_t>, int> triangles_of_edges(const wsk_surface_view& surface) {
  std::map<std::pair<uint32_t, uint32_t>, int> count;
  for (size_t h = 0; h < 3 * static_cast<size_t>(surface.triangle_count); ++h) {
    const uint32_t a = surface.triangles[h];
    const uint32_t b = surface.triangles[h % 3 == 2 ? h - 2 : h + 1];
    ++count[{std::min(a, b), std::max(a, b)}];
  }
  return count;
}

// The curves as the library resampled them lie exactly on the surface; the bias lets the nearer
// half of their width show.
void draw_curves(Canvas& canvas, const Camera& camera, const wsk_surface_view& surface) {
  const double radius = k_line_radius * k_samples;
  auto count = triangles_of_edges(surface);
  for (const bool boundary : {false, true}) {
    for (size_t e = 0; e < surface.curve_edge_count; ++e) {
      const uint32_t from = surface.curve_edges[2 * e];
      const uint32_t to = surface.curve_edges[2 * e + 1];
      if ((count[{std::min(from, to), std::max(from, to)}] == 1) != boundary) continue;
      const ScreenPoint a = camera.project(vec3_at(surface.positions, from));
      const ScreenPoint b = camera.project(vec3_at(surface.positions, to));
      draw_line(canvas, a, b, radius, 2.5 * radius, boundary ? k_boundary_colour : k_curve_colour);
    }
  }
}

// Averages the samples of each pixel into the image, from column x0 on.
void scale_down(const Canvas& canvas, int x0, Image& image) {
  constexpr int k_count = k_samples * k_samples;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < k_view_width; ++x) {
      int r = 0, g = 0, b = 0;
      for (int s = 0; s < k_count; ++s) {
        const Rgb c =
            canvas.colour[canvas.at(x * k_samples + s % k_samples, y * k_samples + s / k_samples)];
        r += c.r;
        g += c.g;
        b += c.b;
      }
      uint8_t* pixel =
          image.rgb.data() + 3 * (static_cast<size_t>(y) * static_cast<size_t>(image.width) +
                                  static_cast<size_t>(x0 + x));
      pixel[0] = static_cast<uint8_t>((r + k_count / 2) / k_count);
      pixel[1] = static_cast<uint8_t>((g + k_count / 2) / k_count);
      pixel[2] = static_cast<uint8_t>((b + k_count / 2) / k_count);
    }
  }
}

// Both views have one scale, so that they can be compared.
double common_scale(const Extent& a, const Extent& b) {
  const double width = std::max(a.width(), b.width());
  const double height = std::max(a.height(), b.height());
  const double across = (k_view_width - 2 * k_margin) / width;
  const double along = (k_greatest_height - 2 * k_margin) / height;
  const double scale = std::min(across, along);
  return std::isfinite(scale) ? scale : 1.0;
}

int image_height(const Extent& a, const Extent& b, double scale) {
  const double height = scale * std::max(a.height(), b.height()) + 2 * k_margin;
  return static_cast<int>(std::clamp(std::ceil(height), static_cast<double>(k_least_height),
                                     static_cast<double>(k_greatest_height)));
}

Camera camera_of(const Frame& frame, const Extent& extent, double scale, int height) {
  Camera camera;
  camera.frame = frame;
  camera.scale = k_samples * scale;
  camera.origin_x =
      k_samples * k_view_width / 2.0 - camera.scale * (extent.left + extent.right) / 2.0;
  camera.origin_y = k_samples * height / 2.0 + camera.scale * (extent.bottom + extent.top) / 2.0;
  return camera;
}

}  // namespace

Image draw_picture(const wsk_surface_view& surface, int up_axis) {
  const std::array<Frame, 2> frames = choose_frames(surface, up_axis);
  const Extent extents[2] = {extent_in(frames[0], surface), extent_in(frames[1], surface)};
  const double scale = common_scale(extents[0], extents[1]);
  const int height = image_height(extents[0], extents[1], scale);
  const Vec3 isophotes = isophote_direction(frames[0]);
  Image image(2 * k_view_width, height, 255);
  for (size_t i = 0; i < 2; ++i) {
    const Camera camera = camera_of(frames[i], extents[i], scale, height);
    Canvas canvas(k_samples * k_view_width, k_samples * height);
    draw_surface(canvas, camera, isophotes, surface);
    draw_curves(canvas, camera, surface);
    scale_down(canvas, static_cast<int>(i) * k_view_width, image);
  }
  return image;
}

}  // namespace wireskin_cli
