// What noise on the curves, and curves taken away and put back, change in a surface from curves
// alone; and closed curves that no disk spans without more ado. For the table and for the tests.
#pragma once

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "flow/run.h"
#include "flow/unseen.h"

namespace flow_tests {

struct Shape {
  std::string name;
  Net net;
  int32_t voids;
};

// The networks made here, and those of a folder with expected.csv that are neither known to be hard
// nor large.
inline std::vector<Shape> robust_shapes(const std::string& folder) {
  std::vector<Shape> shapes;
  for (const Expected& e : unseen_networks()) shapes.push_back({e.name, e.net, e.voids});
  std::ifstream in(folder + "/expected.csv");
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    const bool left_out = line.find("KNOWN") != std::string::npos;
    const bool large = line.find("torus_dense") == 0 || line.find("torus_big") == 0;
    if (left_out || large) continue;
    const std::string file = line.substr(0, line.find(','));
    // The seventh field; none before it is quoted.
    size_t field = 0;
    for (int k = 0; k < 6; ++k) field = line.find(',', field) + 1;
    const int32_t voids = line.compare(field, 4, "auto") == 0 ? -1 : std::atoi(&line[field]);
    shapes.push_back({file, read_obj(folder + "/" + file), voids});
  }
  return shapes;
}

// ---- Noise --------------------------------------------------------------------------------------

// Straight curves of two vertices get vertices to be noisy at, a fiftieth of the diagonal apart.
inline Net refined(const Net& net) {
  Net fine;
  fine.vertex = net.vertex;
  const double step = 0.02 * diagonal_of(net);
  for (const auto& curve : net.curve) {
    std::vector<uint32_t> path = {curve[0]};
    for (size_t i = 1; i < curve.size(); ++i) {
      const Vec3 a = net.vertex[curve[i - 1]], b = net.vertex[curve[i]];
      const int pieces = std::max(1, int(length(b - a) / step));
      for (int k = 1; k < pieces; ++k) path.push_back(fine.add(a + (double(k) / pieces) * (b - a)));
      path.push_back(curve[i]);
    }
    fine.curve.push_back(path);
  }
  return fine;
}

// Every vertex by a Gaussian of that standard deviation, a part of the diagonal, along each axis.
inline Net noisy(const Net& net, double sigma, uint32_t seed) {
  Net result = refined(net);
  unit::Random random(seed);
  const auto gaussian = [&] {
    double sum = 0.0;
    for (int i = 0; i < 12; ++i) sum += 0.5 * random();
    return sum;
  };
  const double size = sigma * diagonal_of(net);
  for (Vec3& p : result.vertex) {
    p.x += size * gaussian();
    p.y += size * gaussian();
    p.z += size * gaussian();
  }
  return result;
}

inline bool same_topology(const Run& a, const Run& b) {
  return std::equal(a.betti, a.betti + 3, b.betti) && a.patches == b.patches &&
         a.annuli == b.annuli;
}

// Noise as it is, found and taken out, stated and taken out.
enum class Smoothed { no, found, stated };

inline bool keeps_topology(const Shape& shape, const Run& clean, double sigma, Smoothed smoothed,
                           uint32_t seed) {
  RunOptions options = {0.02, 0, shape.voids, false, false};
  if (smoothed == Smoothed::found) options.smoothing.noise = wireskin::network::Noise::estimate;
  if (smoothed == Smoothed::stated) {
    options.smoothing.noise = wireskin::network::Noise::given;
    options.smoothing.sigma = sigma * diagonal_of(shape.net);
  }
  try {
    return same_topology(clean, run(noisy(shape.net, sigma, seed), options));
  } catch (const std::exception&) {
    return false;
  }
}

// ---- Curves taken away and put back -------------------------------------------------------------

inline double distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 d = b - a;
  const double square = dot(d, d);
  const double t = square > 0.0 ? std::max(0.0, std::min(1.0, dot(p - a, d) / square)) : 0.0;
  return length(p - a - t * d);
}

inline double distance_to_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 n = cross(b - a, c - a);
  const double square = dot(n, n);
  const bool inside = square > 0.0 && dot(cross(b - a, p - a), n) >= 0.0 &&
                      dot(cross(c - b, p - b), n) >= 0.0 && dot(cross(a - c, p - c), n) >= 0.0;
  if (inside) return std::fabs(dot(p - a, n)) / std::sqrt(square);
  return std::min(
      {distance_to_segment(p, a, b), distance_to_segment(p, b, c), distance_to_segment(p, c, a)});
}

struct PatchShape {
  double area = 0.0;
  Vec3 middle;
  std::vector<Corners> triangles;
  bool matched = false;
};

inline std::vector<PatchShape> patch_shapes(const Run& r) {
  std::vector<PatchShape> patches(r.patches);
  for (size_t t = 0; t < r.raw_triangle.size(); ++t) {
    const Corners& c = r.raw_triangle[t];
    const Vec3 &p = r.raw_position[c[0]], &q = r.raw_position[c[1]], &s = r.raw_position[c[2]];
    const double area = 0.5 * length(cross(q - p, s - p));
    PatchShape& patch = patches[r.raw_patch[t]];
    patch.area += area;
    patch.middle += (area / 3.0) * (p + q + s);
    patch.triangles.push_back(c);
  }
  for (PatchShape& p : patches) p.middle = (p.area > 0.0 ? 1.0 / p.area : 0.0) * p.middle;
  return patches;
}

// Patches of both that lie at the same place with the same area, to 2 %, are the same.
inline void match_patches(double diagonal, std::vector<PatchShape>* a, std::vector<PatchShape>* b) {
  for (PatchShape& p : *a) {
    for (PatchShape& q : *b) {
      if (q.matched || std::fabs(p.area - q.area) > 0.02 * p.area) continue;
      if (length(p.middle - q.middle) > 0.01 * diagonal) continue;
      p.matched = q.matched = true;
      break;
    }
  }
}

// Of points on the unmatched patches of one surface that lie farther than 1 % of the diagonal from
// those of the other, the greatest distance from the curve.
inline double reach_of_changes(const Run& r, const std::vector<PatchShape>& own, const Run& s,
                               const std::vector<PatchShape>& other, const std::vector<Vec3>& curve,
                               double diagonal) {
  double reach = 0.0;
  for (const PatchShape& patch : own) {
    if (patch.matched) continue;
    for (const Corners& c : patch.triangles) {
      for (int i = 1; i < 6; ++i) {
        for (int k = 1; i + k < 6; ++k) {
          const Vec3 p = (i / 6.0) * r.raw_position[c[0]] + (k / 6.0) * r.raw_position[c[1]] +
                         ((6 - i - k) / 6.0) * r.raw_position[c[2]];
          double from = std::numeric_limits<double>::max();
          for (size_t v = 0; v + 1 < curve.size(); ++v) {
            from = std::min(from, distance_to_segment(p, curve[v], curve[v + 1]));
          }
          if (from <= reach) continue;
          bool near = false;
          for (const PatchShape& q : other) {
            if (q.matched) continue;
            for (const Corners& d : q.triangles) {
              near = near || distance_to_triangle(p, s.raw_position[d[0]], s.raw_position[d[1]],
                                                  s.raw_position[d[2]]) < 0.01 * diagonal;
              if (near) break;
            }
            if (near) break;
          }
          if (!near) reach = from;
        }
      }
    }
  }
  return reach;
}

struct Change {
  size_t without = 0;   // patches without the curve that are not among those with it
  size_t with = 0;      // and the other way round
  double reach = 0.0;   // distance of the farthest change from the curve
  double length = 0.0;  // of the curve
};

inline Change compare(const Run& with, const Run& without, const std::vector<Vec3>& curve,
                      double diagonal) {
  std::vector<PatchShape> a = patch_shapes(with), b = patch_shapes(without);
  match_patches(diagonal, &a, &b);
  Change change;
  for (const PatchShape& p : a) change.with += !p.matched;
  for (const PatchShape& p : b) change.without += !p.matched;
  for (size_t v = 0; v + 1 < curve.size(); ++v) change.length += length(curve[v + 1] - curve[v]);
  change.reach = std::max(reach_of_changes(with, a, without, b, curve, diagonal),
                          reach_of_changes(without, b, with, a, curve, diagonal));
  return change;
}

inline std::vector<Vec3> points_of(const Net& net, const std::vector<uint32_t>& curve) {
  std::vector<Vec3> points;
  for (const uint32_t v : curve) points.push_back(net.vertex[v]);
  return points;
}

// Each curve taken away in turn, which is the same as putting it back. The number of voids is found
// anew each time, but where the shape's own is given.
inline std::vector<Change> changes_by_removal(const Shape& shape) {
  const RunOptions options = {0.02, 0, shape.voids, false, false};
  const Run whole = run(shape.net, options);
  std::vector<Change> changes;
  for (size_t c = 0; c < shape.net.curve.size(); ++c) {
    Net less = shape.net;
    less.curve.erase(less.curve.begin() + std::ptrdiff_t(c));
    changes.push_back(compare(whole, run(less, options), points_of(shape.net, shape.net.curve[c]),
                              diagonal_of(shape.net)));
  }
  return changes;
}

// A small circle, a twentieth of the diagonal across, somewhere in the box, not within its own
// diameter of a curve.
inline Change change_by_circle(const Shape& shape, const Run& whole, uint32_t seed) {
  const double diagonal = diagonal_of(shape.net), radius = 0.025 * diagonal;
  unit::Random random(seed);
  Vec3 low = shape.net.vertex[shape.net.curve[0][0]], high = low;
  for (const auto& curve : shape.net.curve) {
    for (const uint32_t v : curve) {
      const Vec3& p = shape.net.vertex[v];
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
  }
  const auto between = [&](double a, double b) { return a + (0.5 + 0.5 * random()) * (b - a); };
  Vec3 middle;
  for (int tries = 0; tries < 1000; ++tries) {
    middle = {between(low.x, high.x), between(low.y, high.y), between(low.z, high.z)};
    double least = std::numeric_limits<double>::max();
    for (const auto& curve : shape.net.curve) {
      for (size_t i = 0; i + 1 < curve.size(); ++i) {
        least = std::min(least, distance_to_segment(middle, shape.net.vertex[curve[i]],
                                                    shape.net.vertex[curve[i + 1]]));
      }
    }
    if (least > 3.0 * radius) break;
  }
  const Vec3 axis = wireskin::unit(Vec3{random(), random(), random()});
  const Vec3 other = std::fabs(axis.x) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const Vec3 u = wireskin::unit(cross(axis, other)), v = cross(axis, u);
  Net more = shape.net;
  add_circle(more, middle, radius * u, radius * v, 24, {});
  const RunOptions options = {0.02, 0, shape.voids, false, false};
  return compare(run(more, options), whole, points_of(more, more.curve.back()), diagonal);
}

// ---- Closed curves (figure 20) ------------------------------------------------------------------

struct ClosedCurve {
  const char* name;
  Net net;
};

template <typename Point>
void add_loop(const Point& at, int pieces, Net* net) {
  std::vector<uint32_t> curve;
  for (int i = 0; i < pieces; ++i) curve.push_back(net->add(at(2 * k_pi * i / pieces)));
  curve.push_back(curve.front());
  net->curve.push_back(curve);
}

inline std::vector<ClosedCurve> closed_curves() {
  const auto torus_knot = [](int p, int q) {
    return [p, q](double t) {
      const double r = 1.0 + 0.4 * std::cos(q * t);
      return Vec3{r * std::cos(p * t), r * std::sin(p * t), 0.4 * std::sin(q * t)};
    };
  };
  std::vector<ClosedCurve> curves(8);
  curves[0].name = "bat-wing (a saddle of four lobes)";
  add_loop(
      [](double t) {
        return Vec3{std::cos(t), std::sin(t), 0.6 * std::cos(2 * t)};
      },
      120, &curves[0].net);
  curves[1].name = "folded, unknotted (a figure eight in space)";
  add_loop(
      [](double t) {
        return Vec3{std::cos(t), 0.6 * std::sin(2 * t), 0.25 * std::sin(t)};
      },
      160, &curves[1].net);
  curves[2].name = "folded, unknotted (twice round)";
  add_loop(
      [](double t) {
        const double r = 1.0 + 0.35 * std::cos(t);
        return Vec3{r * std::cos(2 * t), r * std::sin(2 * t), 0.35 * std::sin(t)};
      },
      240, &curves[2].net);
  curves[3].name = "tennis ball";
  add_loop(
      [](double t) {
        return Vec3{0.7 * std::cos(t) + 0.3 * std::cos(3 * t),
                    0.7 * std::sin(t) - 0.3 * std::sin(3 * t), 0.9 * std::sin(2 * t)};
      },
      200, &curves[3].net);
  curves[4].name = "linked circles";
  add_loop([](double t) { return Vec3{std::cos(t), std::sin(t), 0}; }, 96, &curves[4].net);
  add_loop([](double t) { return Vec3{1 + std::cos(t), 0, std::sin(t)}; }, 96, &curves[4].net);
  curves[5].name = "trefoil knot";
  add_loop(torus_knot(2, 3), 240, &curves[5].net);
  curves[6].name = "knot (2, 5)";
  add_loop(torus_knot(2, 5), 360, &curves[6].net);
  curves[7].name = "figure-eight knot";
  add_loop(
      [](double t) {
        const double r = 2.0 + std::cos(2 * t);
        return Vec3{r * std::cos(3 * t), r * std::sin(3 * t), 1.2 * std::sin(4 * t)};
      },
      360, &curves[7].net);
  return curves;
}

}  // namespace flow_tests
