// Networks with creases for the C API, as owned arrays, and what their tests measure.
#pragma once

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "wireskin.h"

namespace crease_nets {

struct P {
  double x, y, z;
};
inline P operator+(P a, P b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline P operator-(P a, P b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline P operator*(double s, P a) {
  return {s * a.x, s * a.y, s * a.z};
}
inline double dot(P a, P b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

using Field = std::function<P(double)>;

struct Line {
  std::vector<double> positions, normals, right;
  std::vector<uint32_t> nodes;
  bool closed = false, boundary = false, sharp = false;
};

struct Net {
  std::vector<Line> lines;

  // Samples point(t) at `intervals` + 1 even t in [0, 1]; the ends are the nodes a and b.
  Line& add(int intervals, uint32_t a, uint32_t b, const Field& point, const Field& normal,
            const Field& right = nullptr) {
    Line line;
    for (int i = 0; i <= intervals; ++i) {
      const double t = static_cast<double>(i) / intervals;
      push(point(t), &line.positions);
      if (normal) push(normal(t), &line.normals);
      if (right) push(right(t), &line.right);
      line.nodes.push_back(i == 0 ? a : i == intervals ? b : WSK_NONE);
    }
    lines.push_back(line);
    return lines.back();
  }
  // The same, tagged sharp; either field may be null.
  Line& add_sharp(int intervals, uint32_t a, uint32_t b, const Field& point, const Field& left,
                  const Field& right) {
    Line& line = add(intervals, a, b, point, left, right);
    line.sharp = true;
    return line;
  }

  std::vector<wsk_curve> curves() const {
    std::vector<wsk_curve> result;
    for (const Line& line : lines) {
      wsk_curve c = {};
      c.sample_count = line.nodes.size();
      c.positions = line.positions.data();
      c.normals = line.normals.empty() ? nullptr : line.normals.data();
      c.nodes = line.nodes.data();
      c.closed = line.closed;
      c.boundary = line.boundary;
      c.sharp = line.sharp;
      c.normals_right = line.right.empty() ? nullptr : line.right.data();
      result.push_back(c);
    }
    return result;
  }

 private:
  static void push(P p, std::vector<double>* values) {
    values->insert(values->end(), {p.x, p.y, p.z});
  }
};

inline Field constant(P p) {
  return [p](double) { return p; };
}
inline Field straight(P a, P b) {
  return [a, b](double t) { return (1 - t) * a + t * b; };
}
// Round the z axis: radius, height, from and to angle in quarter turns; `normal` gives the field
// radial * x + z.
inline P round(double radius, double z, double quarters) {
  const double angle = quarters * std::acos(0.0);
  return {radius * std::cos(angle), radius * std::sin(angle), z};
}
inline Field arc(double radius, double z, double from, double to) {
  return [=](double t) { return round(radius, z, from + t * (to - from)); };
}

struct Built {
  wsk_status status = WSK_OK;
  wsk_report report;
  std::vector<P> position, normal, constraint;
  std::vector<double> curvature;
  std::vector<uint32_t> curve, triangle, patch;
  std::vector<uint32_t> crease_corner;
  std::vector<P> crease_normal;  // of each
  bool is_free(size_t v) const { return curve[v] == WSK_NONE; }
};

inline Built build(const Net& net, wsk_method method, double spacing) {
  Built b;
  wsk_options options;
  wsk_options_init(&options, sizeof options);
  wsk_report_init(&b.report, sizeof b.report);
  options.method = method;
  options.spacing = spacing;
  wsk_surface* surface = nullptr;
  const std::vector<wsk_curve> curves = net.curves();
  b.status = wsk_build(curves.data(), curves.size(), &options, &surface, &b.report);
  if (b.status != WSK_OK) return b;
  wsk_surface_view view;
  wsk_surface_get_view(surface, &view, sizeof view);
  for (uint32_t v = 0; v < view.vertex_count; ++v) {
    const auto at = [&](const double* a) { return P{a[3 * v], a[3 * v + 1], a[3 * v + 2]}; };
    b.position.push_back(at(view.positions));
    b.normal.push_back(at(view.normals));
    b.constraint.push_back(at(view.constraint_normals));
    b.curvature.push_back(view.mean_curvature[v]);
    b.curve.push_back(view.vertex_curve[v]);
  }
  b.triangle.assign(view.triangles, view.triangles + 3 * view.triangle_count);
  for (uint32_t i = 0; i < view.crease_corner_count; ++i) {
    const double* n = view.crease_normals + 3 * i;
    b.crease_corner.push_back(view.crease_corners[i]);
    b.crease_normal.push_back({n[0], n[1], n[2]});
  }
  b.patch.assign(view.triangle_patch, view.triangle_patch + view.triangle_count);
  wsk_surface_free(surface);
  return b;
}

// Greatest and root mean square of |distance| over the free vertices that `select` takes.
struct Error {
  double rms = 0, max = 0;
  int count = 0;
};
inline Error error_of(const Built& b, const std::function<double(P)>& distance,
                      const std::function<bool(P)>& select = nullptr) {
  Error e;
  for (size_t v = 0; v < b.position.size(); ++v) {
    if (!b.is_free(v) || (select && !select(b.position[v]))) continue;
    const double d = std::fabs(distance(b.position[v]));
    e.rms += d * d;
    e.max = std::fmax(e.max, d);
    ++e.count;
  }
  e.rms = std::sqrt(e.rms / (e.count ? e.count : 1));
  return e;
}

// An even rotation with awkward entries.
inline P turn(P p) {
  const double c = std::cos(0.3), s = std::sin(0.3), d = std::cos(1.1), t = std::sin(1.1);
  const P q = {c * p.x - s * p.y, s * p.x + c * p.y, p.z};
  return {q.x, d * q.y - t * q.z, t * q.y + d * q.z};
}
inline P turn_back(P p) {
  const double c = std::cos(0.3), s = std::sin(0.3), d = std::cos(1.1), t = std::sin(1.1);
  const P q = {p.x, d * p.y + t * p.z, -t * p.y + d * p.z};
  return {c * q.x + s * q.y, -s * q.x + c * q.y, q.z};
}

// The cube [-1, 1]^3, turned, its twelve edges sharp; with_normals: bit 0 left, bit 1 right.
inline Net cube(int with_normals, int samples = 4) {
  Net net;
  const auto corner = [](uint32_t i) {
    return P{i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0, i & 4 ? 1.0 : -1.0};
  };
  for (uint32_t i = 0; i < 8; ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      const uint32_t j = i | (1u << axis);
      if (j == i) continue;
      // f and g are the normals of the two faces; f's face is on the left where f x d points into
      // it, which is away from g.
      const P a = corner(i), b = corner(j), d = 0.5 * (b - a);
      P f{0, 0, 0}, g{0, 0, 0};
      const int u = (axis + 1) % 3, v = (axis + 2) % 3;
      (u == 0 ? f.x : u == 1 ? f.y : f.z) = (i >> u & 1) ? 1 : -1;
      (v == 0 ? g.x : v == 1 ? g.y : g.z) = (i >> v & 1) ? 1 : -1;
      const P left{f.y * d.z - f.z * d.y, f.z * d.x - f.x * d.z, f.x * d.y - f.y * d.x};
      const bool f_left = dot(left, g) < 0;
      net.add_sharp(samples, i, j, straight(turn(a), turn(b)),
                    with_normals & 1 ? constant(turn(f_left ? f : g)) : Field(),
                    with_normals & 2 ? constant(turn(f_left ? g : f)) : Field());
    }
  }
  return net;
}

// What a circle of a network is: a smooth curve, the border, or a crease with normals or without.
enum class Rim { smooth, border, crease, bare_crease };

// Adds the circle of `radius` at height z, counter-clockwise seen from above, as four arcs between
// the nodes first .. first + 3; normals are tilted from the radial direction to the z axis by the
// angles (radians) given for the sides above (left) and below (right).
inline void add_circle(double radius, double z, uint32_t first, Rim rim, double above, double below,
                       int samples, Net* net) {
  for (uint32_t k = 0; k < 4; ++k) {
    const auto tilted = [=](double angle) {
      return Field([=](double t) { return round(std::cos(angle), std::sin(angle), k + t); });
    };
    const Field point = arc(radius, z, k, k + 1);
    const uint32_t a = first + k, b = first + (k + 1) % 4;
    if (rim == Rim::crease) {
      net->add_sharp(samples, a, b, point, tilted(above), tilted(below));
    } else if (rim == Rim::bare_crease) {
      net->add_sharp(samples, a, b, point, nullptr, nullptr);
    } else {
      net->add(samples, a, b, point, tilted(above)).boundary = rim == Rim::border;
    }
  }
}

// Adds four curves between the nodes `from` + k and `to` + k in the half-planes of k quarter turns:
// radius, height and tilt of the normal from the radial direction as functions of t.
inline void add_meridians(uint32_t from, uint32_t to, bool to_pole,
                          const std::function<P(double)>& profile, int samples, Net* net) {
  for (uint32_t k = 0; k < 4; ++k) {
    net->add(
        samples, from + k, to_pole ? to : to + k,
        [=](double t) {
          const P p = profile(t);
          return round(p.x, p.y, k);
        },
        [=](double t) {
          const P p = profile(t);
          return round(std::cos(p.z), std::sin(p.z), k);
        });
  }
}

constexpr double k_quarter = 1.5707963267948966;

// The cylinder of radius 1 between z = -1 and 1, cut by four lines, with flat lids or without.
inline Net can(Rim rim, int samples) {
  Net net;
  const bool lids = rim != Rim::border;
  add_circle(1, -1, 0, rim, 0, -k_quarter, samples, &net);
  add_circle(1, 1, 4, rim, lids ? k_quarter : 0, 0, samples, &net);
  add_meridians(
      0, 4, false,
      [](double t) {
        return P{1, 2 * t - 1, 0};
      },
      samples, &net);
  return net;
}

// A cylinder of radius 1 from z = -1 to 0 with a cap of a sphere of the given radius (at least 1)
// above, which meets it at the angle whose sine is the square root of 1 - 1 / radius^2; `parts`: 1
// the cap, 2 the cylinder.
inline Net capped(double radius, Rim joint, int parts, int samples) {
  Net net;
  const double tilt = std::acos(1 / radius), low = -std::sqrt(radius * radius - 1);
  const auto cap = [=](double t) {
    const double angle = tilt + t * (k_quarter - tilt);
    return P{radius * std::cos(angle), low + radius * std::sin(angle), angle};
  };
  add_circle(1, 0, 0, joint, parts == 2 ? 0 : tilt, 0, samples, &net);
  if (parts & 1) add_meridians(0, 8, true, cap, samples, &net);
  if (parts & 2) {
    add_circle(1, -1, 4, Rim::border, 0, 0, samples, &net);
    add_meridians(
        4, 0, false,
        [](double t) {
          return P{1, t - 1, 0};
        },
        samples, &net);
  }
  return net;
}

// Two planes z = -|x| slope over [-1, 1]^2 with a sharp ridge along y; the border is smooth curves.
inline Net roof(double slope, int ridge_normals) {
  Net net;
  const P corner[6] = {{-1, -1, -slope}, {0, -1, 0}, {1, -1, -slope},
                       {1, 1, -slope},   {0, 1, 0},  {-1, 1, -slope}};
  const P left = {-slope, 0, 1}, right = {slope, 0, 1};
  for (uint32_t k = 0; k < 6; ++k) {
    net.add(5, k, (k + 1) % 6, straight(turn(corner[k]), turn(corner[(k + 1) % 6])),
            constant(turn(k == 1 || k == 2 || k == 3 ? right : left)))
        .boundary = true;
  }
  net.add_sharp(5, 1, 4, straight(turn(corner[1]), turn(corner[4])),
                ridge_normals & 1 ? constant(turn(left)) : Field(),
                ridge_normals & 2 ? constant(turn(right)) : Field());
  return net;
}

// z = -|x| max(y, 0)^2 / 2 over [-1, 1]^2: the crease x = 0, y > 0 dies at the origin. The line y =
// 0 is a smooth curve; so is x = 0, y < 0, where `goes_on`.
inline double fading_height(double x, double y) {
  return y > 0 ? -0.5 * std::fabs(x) * y * y : 0.0;
}
inline Net fading(bool goes_on, bool with_normals, int samples) {
  Net net;
  const auto point = [](double x, double y) { return P{x, y, fading_height(x, y)}; };
  const auto normal = [](double x, double y, double side) {
    return y > 0 ? P{0.5 * side * y * y, std::fabs(x) * y, 1} : P{0, 0, 1};
  };
  const auto edge = [&](uint32_t a, uint32_t b, P from, P to) -> Line& {
    const double side = from.x + to.x < 0 ? -1 : 1;
    return net.add(
        samples, a, b,
        [=](double t) {
          const P p = (1 - t) * from + t * to;
          return point(p.x, p.y);
        },
        [=](double t) {
          const P p = (1 - t) * from + t * to;
          return normal(p.x, p.y, side);
        });
  };
  const P corner[8] = {{-1, -1, 0}, {0, -1, 0}, {1, -1, 0}, {1, 0, 0},
                       {1, 1, 0},   {0, 1, 0},  {-1, 1, 0}, {-1, 0, 0}};
  if (goes_on) {
    edge(0, 1, corner[0], corner[1]).boundary = true;
    edge(1, 2, corner[1], corner[2]).boundary = true;
    edge(1, 8, corner[1], {0, 0, 0});
  } else {
    edge(0, 2, corner[0], corner[2]).boundary = true;
  }
  for (uint32_t k = 2; k < 8; ++k)
    edge(k, (k + 1) % 8, corner[k], corner[(k + 1) % 8]).boundary = true;
  edge(7, 8, corner[7], {0, 0, 0});
  edge(8, 3, {0, 0, 0}, corner[3]);
  const auto side = [=](double s) {
    return with_normals ? Field([=](double t) { return normal(0, t, s); }) : Field();
  };
  net.add_sharp(
      samples, 8, 5, [=](double t) { return point(0, t); }, side(-1), side(1));
  return net;
}

}  // namespace crease_nets
