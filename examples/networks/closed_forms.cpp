#include "closed_forms.h"

#include <algorithm>
#include <utility>

namespace networks {

using Path = std::function<Point(double)>;

static const double k_pi = 3.14159265358979323846;

// {cos, sin} of an angle in degrees; exact on the axes, so that curves in coordinate planes stay
// there and nodes on the axes have exact zeros.
static std::array<double, 2> cos_sin(double degrees) {
  const double turns = std::floor(degrees / 90.0 + 0.5);
  const double rest = (degrees - 90.0 * turns) * (k_pi / 180.0);
  const double c = std::cos(rest);
  const double s = std::sin(rest);
  switch ((static_cast<long>(turns) % 4 + 4) % 4) {
    case 0:
      return {c, s};
    case 1:
      return {-s, c};
    case 2:
      return {-c, -s};
    default:
      return {s, -c};
  }
}

// ---- Surfaces

Surface sphere_surface(double radius) {
  Surface s;
  s.value = [radius](const Point& p) { return length(p) - radius; };
  s.gradient = [](const Point& p) { return unit(p); };
  s.onto = [radius](const Point& p) { return radius * unit(p); };
  s.is_distance = true;
  return s;
}

// The unit vector from the z axis to p.
static Point radial(const Point& p) {
  return unit({p[0], p[1], 0.0});
}

Surface torus_surface(double major_radius, double minor_radius) {
  Surface s;
  const auto from_core = [=](const Point& p) { return p - major_radius * radial(p); };
  s.value = [=](const Point& p) { return length(from_core(p)) - minor_radius; };
  s.gradient = [=](const Point& p) { return unit(from_core(p)); };
  s.onto = [=](const Point& p) {
    return major_radius * radial(p) + minor_radius * unit(from_core(p));
  };
  s.is_distance = true;
  return s;
}

Surface cylinder_surface(double radius) {
  Surface s;
  s.value = [radius](const Point& p) { return std::sqrt(p[0] * p[0] + p[1] * p[1]) - radius; };
  s.gradient = [](const Point& p) { return radial(p); };
  s.onto = [radius](const Point& p) { return radius * radial(p) + Point{0.0, 0.0, p[2]}; };
  s.is_distance = true;
  return s;
}

Surface ellipsoid_surface(double a, double b, double c) {
  Surface s;
  const auto level = [=](const Point& p) {
    return p[0] * p[0] / (a * a) + p[1] * p[1] / (b * b) + p[2] * p[2] / (c * c);
  };
  s.value = [=](const Point& p) { return level(p) - 1.0; };
  s.gradient = [=](const Point& p) {
    return Point{2.0 * p[0] / (a * a), 2.0 * p[1] / (b * b), 2.0 * p[2] / (c * c)};
  };
  s.onto = [=](const Point& p) { return (1.0 / std::sqrt(level(p))) * p; };
  return s;
}

static double bumpy_radius(const Point& d) {
  const double y = 3.75 * d[0] * d[1] * d[2] + 1.2 * (d[0] * d[0] - d[1] * d[1]) * d[2] +
                   0.5 * std::sin(3.0 * d[0]) * d[1];
  return 1.0 + 0.15 * y;
}

// d - .15 (I - d d^T) grad Y(d) / |p|, the gradient of |p| - r(p / |p|), with d = p / |p|.
static Point bumpy_gradient(const Point& p) {
  const Point d = unit(p);
  const Point slope = {3.75 * d[1] * d[2] + 2.4 * d[0] * d[2] + 1.5 * std::cos(3.0 * d[0]) * d[1],
                       3.75 * d[0] * d[2] - 2.4 * d[1] * d[2] + 0.5 * std::sin(3.0 * d[0]),
                       3.75 * d[0] * d[1] + 1.2 * (d[0] * d[0] - d[1] * d[1])};
  return d - (0.15 / length(p)) * (slope - dot(slope, d) * d);
}

Surface bumpy_surface() {
  Surface s;
  s.value = [](const Point& p) { return length(p) - bumpy_radius(unit(p)); };
  s.gradient = bumpy_gradient;
  s.onto = [](const Point& p) { return bumpy_radius(unit(p)) * unit(p); };
  return s;
}

Surface saddle_surface() {
  Surface s;
  const auto height = [](const Point& p) { return 0.5 * (p[0] * p[0] - p[1] * p[1]); };
  s.value = [=](const Point& p) { return p[2] - height(p); };
  s.gradient = [](const Point& p) { return Point{-p[0], p[1], 1.0}; };
  s.onto = [=](const Point& p) { return Point{p[0], p[1], height(p)}; };
  return s;
}

// A point on the z axis is taken to the side of positive x.
static Point radial_or_x(const Point& p) {
  return p[0] == 0.0 && p[1] == 0.0 ? Point{1.0, 0.0, 0.0} : radial(p);
}

Surface catenoid_surface(double waist) {
  Surface s;
  const auto radius = [=](double z) { return waist * std::cosh(z / waist); };
  s.value = [=](const Point& p) { return std::sqrt(p[0] * p[0] + p[1] * p[1]) - radius(p[2]); };
  s.gradient = [=](const Point& p) {
    return radial_or_x(p) - Point{0.0, 0.0, std::sinh(p[2] / waist)};
  };
  s.onto = [=](const Point& p) { return radius(p[2]) * radial_or_x(p) + Point{0.0, 0.0, p[2]}; };
  return s;
}

Surface cone_surface(double radius, double slope) {
  Surface s;
  const double scale = 1.0 / std::sqrt(1.0 + slope * slope);
  s.value = [=](const Point& p) {
    return scale * (std::sqrt(p[0] * p[0] + p[1] * p[1]) - radius - slope * p[2]);
  };
  s.gradient = [=](const Point& p) { return scale * (radial_or_x(p) - Point{0.0, 0.0, slope}); };
  s.onto = [=](const Point& p) {
    return (radius + slope * p[2]) * radial_or_x(p) + Point{0.0, 0.0, p[2]};
  };
  s.is_distance = true;  // as long as the apex is far
  return s;
}

Surface hump_surface(double height, double deviation) {
  Surface s;
  const double k = 1.0 / (deviation * deviation);
  const auto z = [=](const Point& p) {
    return height * std::exp(-0.5 * k * (p[0] * p[0] + p[1] * p[1]));
  };
  s.value = [=](const Point& p) { return p[2] - z(p); };
  s.gradient = [=](const Point& p) { return Point{k * p[0] * z(p), k * p[1] * z(p), 1.0}; };
  s.onto = [=](const Point& p) { return Point{p[0], p[1], z(p)}; };
  return s;
}

Point normal_at(const Surface& surface, const Point& point) {
  return unit(surface.gradient(point));
}

// The Newton step in the tangent plane at q for half the squared distance to the point q + offset:
// its Hessian is I + height W with the shape operator W, which central differences of the gradient
// give well enough, since the limit depends on the gradient alone. Where it is not safely positive
// the plain gradient step stands in.
static Point newton_step(const Surface& surface, const Point& q, const Point& offset) {
  const Point gradient = surface.gradient(q);
  const Point n = unit(gradient);
  const auto [e, f] = tangent_frame(n);
  const double height = dot(offset, n);
  const double r[2] = {dot(offset, e), dot(offset, f)};
  constexpr double k_difference = 1e-5;
  const double scale = height / (2.0 * k_difference * length(gradient));
  const Point along_e =
      scale * (surface.gradient(q + k_difference * e) - surface.gradient(q - k_difference * e));
  const Point along_f =
      scale * (surface.gradient(q + k_difference * f) - surface.gradient(q - k_difference * f));
  const double a = 1.0 + dot(along_e, e);
  const double b = 0.5 * (dot(along_e, f) + dot(along_f, e));
  const double c = 1.0 + dot(along_f, f);
  const double det = a * c - b * b;
  if (a + c <= 0.0 || det <= 0.01) return r[0] * e + r[1] * f;
  return ((c * r[0] - b * r[1]) / det) * e + ((a * r[1] - b * r[0]) / det) * f;
}

Point closest_point(const Surface& surface, const Point& point) {
  Point q = surface.onto(point);
  for (int round = 0; round < 100; ++round) {
    Point step = newton_step(surface, q, point - q);
    const double size = length(step);
    if (size <= 1e-15 * (1.0 + length(q))) break;
    Point next = surface.onto(q + step);
    // Below this size Newton converges quadratically and rounding hides the decrease.
    if (size > 1e-6) {
      for (int half = 0; half < 40 && distance(next, point) >= distance(q, point); ++half) {
        step = 0.5 * step;
        next = surface.onto(q + step);
      }
    }
    q = next;
  }
  return q;
}

double signed_distance(const Surface& surface, const Point& point) {
  const double value = surface.value(point);
  if (surface.is_distance) return value;
  return std::copysign(distance(point, closest_point(surface, point)), value);
}

// ---- Networks

// Numbers t_0 = from .. t_n = to that divide the path evenly by arc length, which is measured on a
// polygon of k_steps chords: exact for constant speed, good to about 1e-6 of a piece otherwise.
struct Division {
  std::vector<double> lengths;
  double from, to;

  Division(const Path& path, double start, double end) : lengths{0.0}, from(start), to(end) {
    constexpr int k_steps = 4096;
    Point last = path(from);
    for (int i = 1; i <= k_steps; ++i) {
      const Point next = path(from + (to - from) * i / k_steps);
      lengths.push_back(lengths.back() + distance(last, next));
      last = next;
    }
  }

  unsigned pieces(double spacing) const {
    return std::max(1u, static_cast<unsigned>(std::lround(lengths.back() / spacing)));
  }

  double at(double fraction) const {
    const double wanted = fraction * lengths.back();
    const auto above = std::upper_bound(lengths.begin() + 1, lengths.end() - 1, wanted);
    const double begin = above[-1];
    const double index = static_cast<double>(above - lengths.begin() - 1);
    const double steps = static_cast<double>(lengths.size() - 1);
    return from + (to - from) * (index + (wanted - begin) / (*above - begin)) / steps;
  }
};

class Builder {
 public:
  explicit Builder(Surface surface) : surface_(std::move(surface)) {}

  uint32_t add(const Point& p) {
    network_.positions.push_back(p);
    network_.normals.push_back(normal_at(surface_, p));
    return static_cast<uint32_t>(network_.positions.size() - 1);
  }

  void begin_curve(uint32_t node, bool boundary = false) {
    network_.curves.push_back({{node}, false, boundary});
  }

  // Goes on from the curve's last vertex, which lies at path(from), to the node at path(to).
  void go_to(uint32_t node, const Path& path, double from, double to, double spacing) {
    const Division division(path, from, to);
    go_to(node, path, division, division.pieces(spacing));
  }
  void go_to(uint32_t node, const Path& path, const Division& division, unsigned pieces) {
    std::vector<uint32_t>& vertices = network_.curves.back().vertices;
    for (unsigned i = 1; i < pieces; ++i) {
      vertices.push_back(add(path(division.at(static_cast<double>(i) / pieces))));
    }
    vertices.push_back(node);
  }

  // Once round, through the nodes at the angles (increasing, in degrees).
  void circle(const std::vector<uint32_t>& nodes, const std::vector<double>& angles,
              const Path& path, double spacing, bool boundary = false) {
    begin_curve(nodes[0], boundary);
    for (size_t i = 0; i < nodes.size(); ++i) {
      const bool last = i + 1 == nodes.size();
      go_to(nodes[last ? 0 : i + 1], path, angles[i], last ? angles[0] + 360.0 : angles[i + 1],
            spacing);
    }
    close_curve();
  }

  void close_curve() {
    network_.curves.back().vertices.pop_back();
    network_.curves.back().closed = true;
  }

  Network take() { return std::move(network_); }

 private:
  Surface surface_;
  Network network_;
};

// Closed curves in the three coordinate planes through the six points where the axes pierce the
// surface. `per_quarter` counts the pieces of a quarter; where it is 0 the spacing does.
static Network octants(const Surface& surface, const Path& xy, const Path& yz, const Path& zx,
                       double spacing, unsigned per_quarter) {
  Builder builder(surface);
  uint32_t axis[3][2];
  const Path* paths[3] = {&xy, &yz, &zx};
  for (int i = 0; i < 3; ++i) {
    axis[i][0] = builder.add((*paths[i])(0.0));
    axis[i][1] = builder.add((*paths[i])(180.0));
  }
  for (int i = 0; i < 3; ++i) {
    const uint32_t(&other)[2] = axis[(i + 1) % 3];
    const uint32_t nodes[5] = {axis[i][0], other[0], axis[i][1], other[1], axis[i][0]};
    builder.begin_curve(nodes[0]);
    for (int quarter = 0; quarter < 4; ++quarter) {
      const Division division(*paths[i], 90.0 * quarter, 90.0 * (quarter + 1));
      const unsigned pieces = per_quarter != 0 ? per_quarter : division.pieces(spacing);
      builder.go_to(nodes[quarter + 1], *paths[i], division, pieces);
    }
    builder.close_curve();
  }
  return builder.take();
}

// The path through the surface above the direction cos t e_axis + sin t e_(axis + 1).
static Path section(size_t axis, std::function<Point(const Point&)> lift) {
  return [axis, lift = std::move(lift)](double t) {
    Point direction = {0.0, 0.0, 0.0};
    direction[axis] = cos_sin(t)[0];
    direction[(axis + 1) % 3] = cos_sin(t)[1];
    return lift(direction);
  };
}

Network sphere_great_circles(unsigned segments_per_quarter) {
  const auto lift = [](const Point& d) { return d; };
  return octants(sphere_surface(1.0), section(0, lift), section(1, lift), section(2, lift), 0.0,
                 segments_per_quarter);
}

Network ellipsoid(double a, double b, double c, double spacing) {
  const auto lift = [=](const Point& d) { return Point{a * d[0], b * d[1], c * d[2]}; };
  return octants(ellipsoid_surface(a, b, c), section(0, lift), section(1, lift), section(2, lift),
                 spacing, 0);
}

Network bumpy_sphere(double spacing) {
  const auto lift = [](const Point& d) { return bumpy_radius(d) * d; };
  return octants(bumpy_surface(), section(0, lift), section(1, lift), section(2, lift), spacing, 0);
}

Network sphere_meridians(unsigned count, const std::vector<double>& latitudes, double spacing) {
  Builder builder(sphere_surface(1.0));
  const auto at = [](double longitude, double latitude) {
    const auto [cu, su] = cos_sin(longitude);
    const auto [cv, sv] = cos_sin(latitude);
    return Point{cv * cu, cv * su, sv};
  };
  const uint32_t south = builder.add(at(0.0, -90.0));
  const uint32_t north = builder.add(at(0.0, 90.0));
  std::vector<double> longitudes;
  for (unsigned i = 0; i < count; ++i) longitudes.push_back(360.0 * i / count);
  std::vector<std::vector<uint32_t>> nodes(latitudes.size());
  for (size_t j = 0; j < latitudes.size(); ++j) {
    for (double u : longitudes) nodes[j].push_back(builder.add(at(u, latitudes[j])));
  }
  for (size_t i = 0; i < count; ++i) {
    const Path path = [=](double v) { return at(longitudes[i], v); };
    double v = -90.0;
    builder.begin_curve(south);
    for (size_t j = 0; j < latitudes.size(); v = latitudes[j++]) {
      builder.go_to(nodes[j][i], path, v, latitudes[j], spacing);
    }
    builder.go_to(north, path, v, 90.0, spacing);
  }
  for (size_t j = 0; j < latitudes.size(); ++j) {
    builder.circle(
        nodes[j], longitudes, [=](double u) { return at(u, latitudes[j]); }, spacing);
  }
  return builder.take();
}

Network torus(double major_radius, double minor_radius, const std::vector<double>& meridians,
              const std::vector<double>& parallels, double spacing) {
  Builder builder(torus_surface(major_radius, minor_radius));
  const auto at = [=](double u, double v) {
    const auto [cu, su] = cos_sin(u);
    const auto [cv, sv] = cos_sin(v);
    const double rho = major_radius + minor_radius * cv;
    return Point{rho * cu, rho * su, minor_radius * sv};
  };
  std::vector<std::vector<uint32_t>> on_meridian(meridians.size());
  std::vector<std::vector<uint32_t>> on_parallel(parallels.size());
  for (size_t i = 0; i < meridians.size(); ++i) {
    for (size_t j = 0; j < parallels.size(); ++j) {
      const uint32_t node = builder.add(at(meridians[i], parallels[j]));
      on_meridian[i].push_back(node);
      on_parallel[j].push_back(node);
    }
  }
  for (size_t i = 0; i < meridians.size(); ++i) {
    const Path path = [=](double v) { return at(meridians[i], v); };
    builder.circle(on_meridian[i], parallels, path, spacing);
  }
  for (size_t j = 0; j < parallels.size(); ++j) {
    const Path path = [=](double u) { return at(u, parallels[j]); };
    builder.circle(on_parallel[j], meridians, path, spacing);
  }
  return builder.take();
}

Network sphere_sections(const Point& offsets, double spacing) {
  Builder builder(sphere_surface(1.0));
  // node[k][side]: on the circles of the two axes other than k.
  uint32_t node[3][2];
  for (size_t k = 0; k < 3; ++k) {
    Point p = offsets;
    p[k] = 0.0;
    const double rest = std::sqrt(1.0 - dot(p, p));
    for (size_t side = 0; side < 2; ++side) {
      p[k] = side == 0 ? rest : -rest;
      node[k][side] = builder.add(p);
    }
  }
  for (size_t k = 0; k < 3; ++k) {
    const size_t i = (k + 1) % 3, j = (k + 2) % 3;
    const double radius = std::sqrt(1.0 - offsets[k] * offsets[k]);
    const Path path = [=](double t) {
      Point p;
      p[k] = offsets[k];
      p[i] = radius * cos_sin(t)[0];
      p[j] = radius * cos_sin(t)[1];
      return p;
    };
    // Towards +i lies the crossing with the circle of axis j, and so on round.
    const double turn_i = std::asin(offsets[i] / radius) * (180.0 / k_pi);
    const double turn_j = std::asin(offsets[j] / radius) * (180.0 / k_pi);
    builder.circle({node[i][0], node[j][0], node[i][1], node[j][1]},
                   {turn_j, 90.0 - turn_i, 180.0 - turn_j, 270.0 + turn_i}, path, spacing);
  }
  return builder.take();
}

Network graph(const Surface& surface, const std::vector<double>& xs, const std::vector<double>& ys,
              double spacing) {
  Builder builder(surface);
  std::vector<std::vector<uint32_t>> node(xs.size());
  for (size_t i = 0; i < xs.size(); ++i) {
    for (double y : ys) node[i].push_back(builder.add(surface.onto({xs[i], y, 0.0})));
  }
  for (size_t i = 0; i < xs.size(); ++i) {
    const Path path = [&](double y) { return surface.onto({xs[i], y, 0.0}); };
    builder.begin_curve(node[i][0], i == 0 || i + 1 == xs.size());
    for (size_t j = 1; j < ys.size(); ++j) {
      builder.go_to(node[i][j], path, ys[j - 1], ys[j], spacing);
    }
  }
  for (size_t j = 0; j < ys.size(); ++j) {
    const Path path = [&](double x) { return surface.onto({x, ys[j], 0.0}); };
    builder.begin_curve(node[0][j], j == 0 || j + 1 == ys.size());
    for (size_t i = 1; i < xs.size(); ++i) {
      builder.go_to(node[i][j], path, xs[i - 1], xs[i], spacing);
    }
  }
  return builder.take();
}

Network saddle(double spacing) {
  return graph(saddle_surface(), {-1.0, 0.0, 1.0}, {-1.0, 0.0, 1.0}, spacing);
}

static Point on_cylinder(double radius, double degrees, double z) {
  const auto [c, s] = cos_sin(degrees);
  return {radius * c, radius * s, z};
}

Network revolution_band(const Surface& surface, double low, double high, unsigned lines,
                        double spacing) {
  Builder builder(surface);
  std::vector<double> angles;
  for (unsigned i = 0; i < lines; ++i) angles.push_back(360.0 * i / lines);
  std::vector<uint32_t> ends[2];
  for (int top = 0; top < 2; ++top) {
    const double z = top == 0 ? low : high;
    const Path path = [&](double u) { return surface.onto(on_cylinder(1.0, u, z)); };
    for (double u : angles) ends[top].push_back(builder.add(path(u)));
    builder.circle(ends[top], angles, path, spacing, true);
  }
  for (unsigned i = 0; i < lines; ++i) {
    const Path path = [&](double z) { return surface.onto(on_cylinder(1.0, angles[i], z)); };
    builder.begin_curve(ends[0][i]);
    builder.go_to(ends[1][i], path, low, high, spacing);
  }
  return builder.take();
}

Network cylinder_band(double radius, double half_height, unsigned lines, double spacing) {
  return revolution_band(cylinder_surface(radius), -half_height, half_height, lines, spacing);
}

// Uniform in [-1, 1): the high bits of a linear congruential generator (Knuth's MMIX constants).
static double next_random(uint64_t& state) {
  state = state * 6364136223846793005u + 1442695040888963407u;
  return static_cast<double>(state >> 11) * 0x1p-52 - 1.0;
}

BandMesh band_mesh(double radius, double half_height, double spacing, double tilt, double jitter,
                   unsigned seed) {
  const auto around =
      static_cast<uint32_t>(std::max(3l, std::lround(2.0 * k_pi * radius / spacing)));
  const double row_height = spacing * std::sqrt(0.75);
  const auto rows = static_cast<uint32_t>(std::max(1l, std::lround(2 * half_height / row_height)));
  const auto [ct, st] = cos_sin(tilt);
  BandMesh mesh;
  uint64_t state = seed;
  for (uint32_t row = 0; row <= rows; ++row) {
    const bool end = row == 0 || row == rows;
    for (uint32_t i = 0; i < around; ++i) {
      double z = row == rows ? half_height : -half_height + 2.0 * half_height * row / rows;
      double degrees = 360.0 * (i + 0.5 * (row % 2)) / around;
      if (!end) {
        degrees += jitter * spacing * next_random(state) / radius * (180.0 / k_pi);
        z += jitter * spacing * next_random(state);
      }
      const Point outward = on_cylinder(1.0, degrees, 0.0);
      const Point axial = {0.0, 0.0, row == 0 ? -st : st};
      mesh.positions.push_back(on_cylinder(radius, degrees, z));
      mesh.normals.push_back(end ? ct * outward + axial : outward);
      mesh.constrained.push_back(end ? 1 : 0);
    }
  }
  for (uint32_t row = 0; row < rows; ++row) {
    for (uint32_t i = 0; i < around; ++i) {
      const uint32_t next = (i + 1) % around;
      const uint32_t low = row * around;
      const uint32_t high = low + around;
      // Odd rows are shifted forward by half a step.
      const uint32_t shift = row % 2;
      mesh.triangles.push_back({low + i, low + next, high + (shift != 0 ? next : i)});
      mesh.triangles.push_back({high + i, (shift != 0 ? low + i : low + next), high + next});
    }
  }
  return mesh;
}

}  // namespace networks
