// Curves for the fuzz targets, drawn from bytes: half of them sound networks (polyhedra on a ball,
// grids on a saddle, rings round a tube) that the bytes then damage, the others curves between
// nodes at random. Sound ones get past the first checks, damaged ones to where checks are rare.
#pragma once

#include <array>

#include "fuzz/bytes.h"

namespace fuzz {

using Point = std::array<double, 3>;

inline double norm(const Point& p) {
  return std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
}

// Straight ways between nodes, laid onto a surface: a curve for each.
struct Frame {
  enum class Kind { ball, saddle, tube };
  struct Path {
    std::vector<uint32_t> nodes;
    bool closed = false;
    bool boundary = false;
  };

  Kind kind = Kind::ball;
  std::vector<Point> nodes;
  std::vector<Path> paths;

  // The point of the surface nearest to p, more or less, and the normal there.
  Point onto(Point p, Point* normal) const {
    if (kind == Kind::saddle) {
      p[2] = (p[0] * p[0] - p[1] * p[1]) / 4;
      *normal = {-p[0] / 2, p[1] / 2, 1.0};
      return p;
    }
    const double z = p[2];
    if (kind == Kind::tube) p[2] = 0.0;
    const double size = norm(p);
    for (double& x : p) x /= size > 0.0 ? size : 1.0;
    *normal = p;
    if (kind == Kind::tube) p[2] = z;
    return p;
  }
};

// A tetrahedron, an octahedron or a cube.
inline Frame read_polyhedron(Bytes& bytes) {
  Frame frame;
  const uint32_t shape = bytes.below(3), count = shape == 0 ? 4 : shape == 1 ? 6 : 8;
  for (uint32_t i = 0; i < count; ++i) {
    const double a = (i & 1) != 0 ? -1.0 : 1.0, b = (i & 2) != 0 ? -1.0 : 1.0;
    Point p = {a, b, shape == 0 ? a * b : (i & 4) != 0 ? -1.0 : 1.0};
    if (shape == 1) {
      p = {0.0, 0.0, 0.0};
      p[i / 2] = a;
    }
    frame.nodes.push_back(p);
  }
  for (uint32_t i = 0; i < count; ++i) {
    for (uint32_t j = i + 1; j < count; ++j) {
      const uint32_t bits = i ^ j;
      if (shape == 1 && bits == 1 && i % 2 == 0) continue;
      if (shape == 2 && (bits & (bits - 1)) != 0) continue;
      frame.paths.push_back({{i, j}, false, false});
    }
  }
  return frame;
}

// Rows and columns of nodes, the outer ones boundary. A tube has rows closed to rings, and perhaps
// no columns.
inline Frame read_grid(Bytes& bytes, bool tube) {
  Frame frame;
  frame.kind = tube ? Frame::Kind::tube : Frame::Kind::saddle;
  const uint32_t rows = 2 + bytes.below(3), columns = 2 + bytes.below(3) + tube;
  const bool bare = tube && bytes.one_in(4);
  for (uint32_t i = 0; i < rows * columns; ++i) {
    const double x = i % columns, y = i / columns;
    const double angle = 6.283185307179586 * x / columns;
    frame.nodes.push_back(tube ? Point{std::cos(angle), std::sin(angle), y} : Point{x - 1, y - 1});
  }
  for (uint32_t r = 0; r < rows; ++r) {
    Frame::Path row = {{}, tube, r == 0 || r + 1 == rows};
    for (uint32_t c = 0; c < columns; ++c) row.nodes.push_back(r * columns + c);
    frame.paths.push_back(row);
  }
  for (uint32_t c = 0; c < columns && !bare; ++c) {
    Frame::Path column = {{}, false, !tube && (c == 0 || c + 1 == columns)};
    for (uint32_t r = 0; r < rows; ++r) column.nodes.push_back(r * columns + c);
    frame.paths.push_back(column);
  }
  return frame;
}

inline scenes::Curve lay(const Frame& frame, const Frame::Path& path, uint32_t segments) {
  scenes::Curve curve;
  curve.closed = path.closed;
  curve.boundary = path.boundary;
  const size_t ways = path.nodes.size() - (path.closed ? 0 : 1);
  for (size_t i = 0; i <= ways * segments; ++i) {
    if (path.closed && i == ways * segments) break;
    const size_t way = i / segments;
    const double t = static_cast<double>(i % segments) / segments;
    const uint32_t node = path.nodes[way % path.nodes.size()];
    const uint32_t next = path.nodes[(way + 1) % path.nodes.size()];
    Point p, normal;
    for (size_t k = 0; k < 3; ++k) {
      p[k] = frame.nodes[node][k];
      if (t > 0.0) p[k] += t * (frame.nodes[next][k] - p[k]);
    }
    p = frame.onto(p, &normal);
    curve.positions.insert(curve.positions.end(), p.begin(), p.end());
    curve.normals.insert(curve.normals.end(), normal.begin(), normal.end());
    curve.nodes.push_back(t > 0.0 ? WSK_NONE : node);
  }
  return curve;
}

inline void turn_round(scenes::Curve* curve) {
  const size_t n = curve->size();
  for (size_t i = 0; i < n / 2; ++i) {
    for (size_t k = 0; k < 3; ++k) {
      std::swap(curve->positions[3 * i + k], curve->positions[3 * (n - 1 - i) + k]);
      if (curve->normals.empty()) continue;
      std::swap(curve->normals[3 * i + k], curve->normals[3 * (n - 1 - i) + k]);
    }
    std::swap(curve->nodes[i], curve->nodes[n - 1 - i]);
  }
}

// From a place on a curve into the open, or a point beside it; it is not joined to anything where
// it has no node.
inline scenes::Curve read_spur(Bytes& bytes, const scenes::Curve& from) {
  scenes::Curve spur;
  const size_t i = bytes.below(static_cast<uint32_t>(from.size()));
  const uint32_t samples = 1 + bytes.below(4);
  for (uint32_t s = 0; s < samples; ++s) {
    for (size_t k = 0; k < 3; ++k) {
      const double aside = s == 0 && samples > 1 ? 0.0 : bytes.number() / 16;
      spur.positions.push_back(from.positions[3 * i + k] + aside);
      spur.normals.push_back(from.normals.empty() ? 0.0 : from.normals[3 * i + k]);
    }
    spur.nodes.push_back(s == 0 && samples > 1 ? from.nodes[i] : WSK_NONE);
  }
  spur.closed = samples > 2 && bytes.one_in(4);
  return spur;
}

inline void damage(Bytes& bytes, std::vector<scenes::Curve>* curves) {
  const size_t c = bytes.below(static_cast<uint32_t>(curves->size()));
  scenes::Curve& curve = (*curves)[c];
  const size_t sample = bytes.below(static_cast<uint32_t>(curve.size()));
  switch (bytes.below(12)) {
    case 0:
      if (curves->size() > 1) curves->erase(curves->begin() + static_cast<ptrdiff_t>(c));
      break;
    case 1:
      curve.boundary = !curve.boundary;
      break;
    case 2:
      for (double& x : curve.normals) x = -x;
      break;
    case 3:
      for (size_t k = 0; k < 3; ++k) curve.positions[3 * sample + k] += bytes.number() / 16;
      break;
    case 4:
      for (size_t k = 0; k < 3 && !curve.normals.empty(); ++k) {
        curve.normals[3 * sample + k] = bytes.number();
      }
      break;
    case 5:
      curve.sharp = true;
      if (bytes.one_in(2)) curve.normals.clear();
      if (bytes.one_in(2)) curve.normals_right = curve.normals;
      break;
    case 6:
      curve.soft = bytes.number();
      break;
    case 7:
    case 8: {
      const scenes::Curve spur = read_spur(bytes, curve);
      curves->push_back(spur);
      break;
    }
    case 9:
      turn_round(&curve);
      break;
    case 10: {
      const scenes::Curve again = curve;
      curves->push_back(again);
      break;
    }
    default:
      curve.nodes[sample] = bytes.one_in(2) ? WSK_NONE : bytes.below(8);
  }
}

// What a hand or a sensor gives: no numbers, ends that miss each other by a little.
inline void make_raw(Bytes& bytes, std::vector<scenes::Curve>* curves) {
  const double miss = std::ldexp(1.0, -2 - static_cast<int>(bytes.below(16)));
  const bool numbered = bytes.one_in(8);
  for (scenes::Curve& curve : *curves) {
    for (size_t i = 0; i < curve.size(); ++i) {
      if (curve.nodes[i] == WSK_NONE || numbered) continue;
      curve.nodes[i] = WSK_NONE;
      for (size_t k = 0; k < 3; ++k)
        curve.positions[3 * i + k] += miss * (bytes.byte() % 16 / 16.0);
    }
  }
}

inline std::vector<scenes::Curve> read_sound_curves(Bytes& bytes, bool always_nodes) {
  const uint32_t shape = bytes.below(4);
  const Frame frame = shape < 2 ? read_polyhedron(bytes) : read_grid(bytes, shape == 3);
  const uint32_t segments = bytes.count(3, 6);
  std::vector<scenes::Curve> curves;
  for (const Frame::Path& path : frame.paths) curves.push_back(lay(frame, path, segments));
  for (uint32_t i = bytes.below(5); i > 0; --i) damage(bytes, &curves);
  if (!always_nodes) make_raw(bytes, &curves);
  const double stretch = bytes.one_in(4) ? bytes.number() : 1.0;
  for (scenes::Curve& curve : curves) {
    for (size_t i = 0; i < curve.size(); ++i) curve.positions[3 * i + 2] *= stretch;
  }
  return curves;
}

// Curves between a few nodes, with samples near the straight line between them.
inline std::vector<scenes::Curve> read_any_curves(Bytes& bytes, bool always_nodes) {
  const uint32_t node_count = 1 + bytes.count(5, 9);
  std::vector<double> nodes;
  for (uint32_t i = 0; i < 3 * node_count; ++i) nodes.push_back(bytes.number());
  std::vector<scenes::Curve> curves(bytes.count(6, 12));
  for (scenes::Curve& curve : curves) {
    const uint8_t flags = bytes.byte();
    const uint32_t from = bytes.below(node_count), to = bytes.below(node_count);
    const uint32_t segments = bytes.count(3, 6);
    const bool straight = (flags & 1) != 0, numbered = always_nodes || (flags & 2) != 0;
    curve.closed = (flags & 12) == 12;
    curve.boundary = (flags & 16) != 0;
    curve.sharp = (flags & 0xe0) == 0x40;
    if ((flags & 0xe0) == 0x60) curve.soft = bytes.number();
    double normal[3] = {0, 0, 1};
    for (uint32_t i = 0; i <= segments; ++i) {
      const double t = static_cast<double>(i) / segments;
      const bool inside = i > 0 && i < segments;
      for (size_t k = 0; k < 3; ++k) {
        double x = nodes[3 * from + k] + t * (nodes[3 * to + k] - nodes[3 * from + k]);
        if (i == segments) x = nodes[3 * to + k];
        if (inside && !straight) x += bytes.number() / 4;
        curve.positions.push_back(x);
      }
      if (!straight && bytes.one_in(4)) {
        for (double& n : normal) n = bytes.number();
      }
      curve.normals.insert(curve.normals.end(), normal, normal + 3);
      const uint32_t node = i == 0 ? from : to;
      curve.nodes.push_back(inside || !numbered ? WSK_NONE : node);
    }
    if ((flags & 0xe0) == 0x80) curve.normals.clear();
  }
  return curves;
}

inline std::vector<scenes::Curve> read_curves(Bytes& bytes, bool always_nodes) {
  return bytes.one_in(2) ? read_sound_curves(bytes, always_nodes)
                         : read_any_curves(bytes, always_nodes);
}

// The greatest of the finite coordinates less the least.
inline double extent_of(const std::vector<scenes::Curve>& curves) {
  double low = 0.0, high = 0.0;
  bool any = false;
  for (const scenes::Curve& curve : curves) {
    for (const double x : curve.positions) {
      if (!std::isfinite(x)) continue;
      low = any ? std::fmin(low, x) : x;
      high = any ? std::fmax(high, x) : x;
      any = true;
    }
  }
  return high - low;
}

}  // namespace fuzz
