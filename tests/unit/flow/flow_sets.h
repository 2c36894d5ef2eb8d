// Point sets for the tests of the flow complex: samples of networks whose voids are known, and the
// plain rows of the reference data.
#pragma once

#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "support/context.h"

namespace unit {

using Points = std::vector<Vec3>;

inline void add_segment(const Vec3& a, const Vec3& b, int pieces, Points* points) {
  for (int i = 0; i <= pieces; ++i) {
    const double s = static_cast<double>(i) / pieces;
    points->push_back((1.0 - s) * a + s * b);
  }
}

// Of radius one, in the plane spanned by u and v.
inline void add_circle(const Vec3& centre, const Vec3& u, const Vec3& v, int pieces,
                       Points* points) {
  for (int i = 0; i < pieces; ++i) {
    const double t = 6.283185307179586 * i / pieces;
    points->push_back(centre + std::cos(t) * u + std::sin(t) * v);
  }
}

// All pairs of corners at the least distance are joined.
inline Points frame(const Points& corners, int pieces) {
  double least = HUGE_VAL;
  for (size_t i = 0; i < corners.size(); ++i) {
    for (size_t k = 0; k < i; ++k) least = std::min(least, length(corners[i] - corners[k]));
  }
  Points points;
  for (size_t i = 0; i < corners.size(); ++i) {
    for (size_t k = 0; k < i; ++k) {
      if (length(corners[i] - corners[k]) < 1.01 * least) {
        add_segment(corners[i], corners[k], pieces, &points);
      }
    }
  }
  return points;
}

inline Points cube_corners() {
  Points p;
  for (int i = 0; i < 8; ++i) p.push_back({double(i & 1), double(i >> 1 & 1), double(i >> 2)});
  return p;
}
inline Points tetrahedron_corners() {
  return {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
}
inline Points octahedron_corners() {
  return {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
}

inline Points great_circles(int pieces) {
  Points p;
  add_circle({}, {1, 0, 0}, {0, 1, 0}, pieces, &p);
  add_circle({}, {0, 1, 0}, {0, 0, 1}, pieces, &p);
  add_circle({}, {0, 0, 1}, {1, 0, 0}, pieces, &p);
  return p;
}
inline Points coaxial_circles(double gap, int pieces) {
  Points p;
  add_circle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, pieces, &p);
  add_circle({0, 0, gap}, {1, 0, 0}, {0, 1, 0}, pieces, &p);
  return p;
}

inline Points random_points(size_t count, Random& random) {
  Points p;
  for (size_t i = 0; i < count; ++i) {
    const double x = random(), y = random(), z = random();
    p.push_back({x, y, z});
  }
  return p;
}

// Rows `x y z`, or the `v` lines of an OBJ file; empty where the file is missing.
inline Points read_points(const std::string& path) {
  Points points;
  std::ifstream file(path);
  const bool obj = path.size() > 4 && path.substr(path.size() - 4) == ".obj";
  for (std::string line; std::getline(file, line);) {
    std::istringstream row(line);
    std::string word;
    Vec3 p;
    if (obj && (!(row >> word) || word != "v")) continue;
    if (row >> p.x >> p.y >> p.z) points.push_back(p);
  }
  return points;
}

// The fields of the rows of a file of comma-separated values, without its title row.
inline std::vector<std::vector<std::string>> read_table(const std::string& path) {
  std::vector<std::vector<std::string>> rows;
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::vector<std::string> fields;
    if (!line.empty() && line.back() == '\r') line.pop_back();
    std::istringstream row(line);
    for (std::string field; std::getline(row, field, ',');) fields.push_back(field);
    rows.push_back(fields);
  }
  return rows;
}

}  // namespace unit
