#include "picture.h"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "camera.h"
#include "cli/support.h"
#include "raster.h"

using namespace wireskin_cli;
using namespace cli_test;

TEST_CASE("a triangle covers the pixels whose centres it holds") {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> place(-5.0, 25.0);
  for (int round = 0; round < 200; ++round) {
    Canvas canvas(20, 20);
    ScreenPoint p[3];
    for (ScreenPoint& q : p) q = {place(random), place(random), 1.0};
    fill_triangle(canvas, p, [](const double(&)[3]) { return Rgb{1, 2, 3}; });
    for (int y = 0; y < 20; ++y) {
      for (int x = 0; x < 20; ++x) {
        const double a = turn(p[0], p[1], x + 0.5, y + 0.5);
        const double b = turn(p[1], p[2], x + 0.5, y + 0.5);
        const double c = turn(p[2], p[0], x + 0.5, y + 0.5);
        const bool inside = (a > 0 && b > 0 && c > 0) || (a < 0 && b < 0 && c < 0);
        REQUIRE((canvas.colour[canvas.at(x, y)].r == 1) == inside);
      }
    }
  }
}

TEST_CASE("the nearer one wins, in either order, and lines hide behind it") {
  const ScreenPoint far_away[3] = {{0, 0, 1}, {20, 0, 1}, {0, 20, 1}};
  const ScreenPoint near_by[3] = {{0, 0, 2}, {20, 0, 2}, {0, 20, 2}};
  const auto one = [](const double(&)[3]) { return Rgb{1, 0, 0}; };
  const auto two = [](const double(&)[3]) { return Rgb{2, 0, 0}; };
  for (const bool near_first : {false, true}) {
    Canvas canvas(20, 20);
    if (near_first) fill_triangle(canvas, near_by, two);
    fill_triangle(canvas, far_away, one);
    if (!near_first) fill_triangle(canvas, near_by, two);
    CHECK(canvas.colour[canvas.at(5, 5)].r == 2);
    draw_line(canvas, {0, 5.5, 1}, {19, 5.5, 1}, 1.0, 0.5, Rgb{3, 0, 0});
    CHECK(canvas.colour[canvas.at(5, 5)].r == 2);
    CHECK(canvas.colour[canvas.at(18, 5)].r == 3);
    draw_line(canvas, {0, 5.5, 1}, {19, 5.5, 1}, 1.0, 1.5, Rgb{3, 0, 0});
    CHECK(canvas.colour[canvas.at(5, 5)].r == 3);
    CHECK(canvas.colour[canvas.at(5, 7)].r == 2);
  }
}

TEST_CASE("points far outside and points that are none do no harm") {
  Canvas canvas(4, 4);
  const double huge = 1e300;
  const ScreenPoint p[3] = {{-huge, -huge, 0}, {huge, -huge, 0}, {0, huge, 0}};
  fill_triangle(canvas, p, [](const double(&)[3]) { return Rgb{}; });
  draw_line(canvas, {-1e9, 0, 0}, {1e9, 2, 0}, 1.0, 0.0, Rgb{7, 0, 0});
  CHECK(canvas.colour[canvas.at(1, 1)].r == 7);
}

TEST_CASE("frames are right-handed, and look at the outer side of a sheet") {
  Square square;
  for (const double sign : {1.0, -1.0}) {
    if (sign < 0) square.triangles = {0, 2, 1, 0, 3, 2};
    for (const int up_axis : {0, 1, 2}) {
      for (const Frame& frame : choose_frames(square.view(), up_axis)) {
        const Vec3 c = cross(frame.right, frame.up);
        CHECK(dot(c, frame.toward) == doctest::Approx(1.0));
        CHECK(dot(frame.right, frame.up) == doctest::Approx(0.0));
        CHECK(sign * frame.toward.z > 0.0);
        // The square lies on the ground if z is up; otherwise it stands.
        const double up[3] = {frame.up.x, frame.up.y, frame.up.z};
        CHECK((up_axis == 2 ? sign : 1.0) * up[up_axis] > 0.0);
      }
    }
  }
}

static bool is_colour(const Image& image, size_t pixel, int r, int g, int b) {
  const uint8_t* p = image.rgb.data() + 3 * pixel;
  return p[0] == r && p[1] == g && p[2] == b;
}

TEST_CASE("a picture has a white border, stripes, and both kinds of curves") {
  Square square;
  // Normals that spread out, so that the square shows stripes.
  square.normals = {-0.6, -0.6, 0.53, 0.6, -0.6, 0.53, 0.6, 0.6, 0.53, -0.6, 0.6, 0.53};
  square.curve_edges = {0, 1, 1, 2, 3, 0, 0, 2};  // the last one lies inside
  const Image image = draw_picture(square.view(), 2);
  REQUIRE(image.width == 1600);
  REQUIRE(image.height >= 500);
  REQUIRE(image.height <= 1200);
  const size_t width = static_cast<size_t>(image.width);
  const size_t pixels = width * static_cast<size_t>(image.height);
  for (size_t x = 0; x < width; ++x) {
    REQUIRE(is_colour(image, x, 255, 255, 255));
    REQUIRE(is_colour(image, pixels - 1 - x, 255, 255, 255));
  }
  size_t dark = 0, light = 0, inner = 0, boundary = 0;
  for (size_t i = 0; i < pixels; ++i) {
    const uint8_t* p = image.rgb.data() + 3 * i;
    const bool grey = p[0] == p[1] && p[1] == p[2];
    dark += grey && p[0] < 64 ? 1 : 0;
    light += grey && p[0] > 128 && p[0] < 255 ? 1 : 0;
    inner += is_colour(image, i, 224, 64, 32) ? 1 : 0;
    boundary += is_colour(image, i, 24, 104, 204) ? 1 : 0;
  }
  CHECK(dark > 10000);
  CHECK(light > 10000);
  CHECK(inner > 1000);
  CHECK(boundary > 300);
}

TEST_CASE("the picture does not depend on the size or the place of the surface") {
  Square square;
  const Image image = draw_picture(square.view(), 2);
  for (double& x : square.positions) x *= 0x1p-300;
  CHECK(draw_picture(square.view(), 2).rgb == image.rgb);
}
