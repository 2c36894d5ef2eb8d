// Curve networks with exact normals on surfaces of closed form, and the distance to those surfaces:
// what examples show and what accuracy is measured against.
//
// Points shared by curves are one vertex, computed once. Samples divide every stretch of curve
// between two nodes evenly by arc length, into length / spacing pieces, rounded. Angles are in
// degrees, whose multiples of 90 have exact sines. The bumpy sphere is r = 1 + .15 Y with
// Y = 3.75 xyz + 1.2 (x^2 - y^2) z + .5 sin(3x) y on unit directions; the saddle is
// z = (x^2 - y^2) / 2 with its normals up.
#pragma once

#include <functional>

#include "network.h"

namespace networks {

// A surface as a level set: `value` is zero on it and positive outside (above), `onto` gives some
// point of the surface near its argument. Where is_distance holds, value is the signed distance.
struct Surface {
  std::function<double(const Point&)> value;
  std::function<Point(const Point&)> gradient;
  std::function<Point(const Point&)> onto;
  bool is_distance = false;
};

Surface sphere_surface(double radius);
Surface torus_surface(double major_radius, double minor_radius);  // around the z axis
Surface cylinder_surface(double radius);                          // around the z axis, endless
Surface ellipsoid_surface(double a, double b, double c);
Surface bumpy_surface();
Surface saddle_surface();                               // endless
Surface catenoid_surface(double waist);                 // around the z axis, endless
Surface cone_surface(double radius, double slope);      // radius + slope z around the z axis
Surface hump_surface(double height, double deviation);  // a Gaussian over the plane, normals up

// The outer unit normal at a point of the surface.
Point normal_at(const Surface& surface, const Point& point);

// The point of the surface next to `point`, by Newton's method in the tangent plane with step
// control; for points nearer than the least radius of curvature it is the global one.
Point closest_point(const Surface& surface, const Point& point);

// Exact where is_distance holds, otherwise the distance to closest_point with the sign of value.
double signed_distance(const Surface& surface, const Point& point);

// Unit sphere, three great circles in the coordinate planes.
Network sphere_great_circles(unsigned segments_per_quarter);

// Unit sphere, `count` half-circles from pole to pole, evenly spread, and circles of latitude.
Network sphere_meridians(unsigned count, const std::vector<double>& latitudes, double spacing);

// (R + r cos v)(cos u, sin u), r sin v: meridians at the angles u, parallels at the angles v.
Network torus(double major_radius, double minor_radius, const std::vector<double>& meridians,
              const std::vector<double>& parallels, double spacing);

// The three principal sections.
Network ellipsoid(double a, double b, double c, double spacing);

// The sections with the coordinate planes.
Network bumpy_sphere(double spacing);

// Unit sphere, the circles x, y, z = offset; offsets of which any two lie within the sphere.
Network sphere_sections(const Point& offsets, double spacing);

// A graph over the plane: its curves above the given x and y (at least two of each, increasing).
// The first and the last are open boundary curves that meet in corners.
Network graph(const Surface& surface, const std::vector<double>& xs, const std::vector<double>& ys,
              double spacing);

// Over [-1, 1]^2, with the lines x = 0 and y = 0.
Network saddle(double spacing);

// A surface of revolution between two boundary circles at the heights low and high, cut by `lines`
// meridians.
Network revolution_band(const Surface& surface, double low, double high, unsigned lines,
                        double spacing);

// Two boundary circles z = -half_height and z = half_height, joined by `lines` straight lines.
Network cylinder_band(double radius, double half_height, unsigned lines, double spacing);

// The same band as a triangle mesh whose two circles are constrained: rows of staggered vertices,
// moved at random (by `seed`) by up to jitter * spacing. `tilt` turns the normals of the circles
// from radial towards the nearer end (positive: a barrel) or the middle (negative: a bottleneck).
struct BandMesh {
  std::vector<Point> positions;
  std::vector<Point> normals;  // at constrained vertices tilted, elsewhere radial
  std::vector<uint8_t> constrained;
  std::vector<std::array<uint32_t, 3>> triangles;
};
BandMesh band_mesh(double radius, double half_height, double spacing, double tilt,
                   double jitter = 0.12, unsigned seed = 1);

}  // namespace networks
