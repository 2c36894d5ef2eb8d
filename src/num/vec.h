// Vectors of the plane and of space: plain pairs and triples of doubles with the usual products.
//
// Sums run in the order written, from the left; with contraction off the bits are the same
// everywhere.
#pragma once

#include <cmath>

#include "base/platform.h"

namespace wireskin {

// Vec2 goes by reference everywhere: gcc 12 at -O1 and above may take a struct of two doubles that
// is passed by value to an outlined function for zero (its ipa-modref pass; seen in
// predicates.cpp).
struct Vec2 {
  double x = 0.0, y = 0.0;
};

struct Vec3 {
  double x = 0.0, y = 0.0, z = 0.0;
};

inline Vec2 operator+(const Vec2& a, const Vec2& b) {
  return {a.x + b.x, a.y + b.y};
}
inline Vec2 operator-(const Vec2& a, const Vec2& b) {
  return {a.x - b.x, a.y - b.y};
}
inline Vec2 operator*(double s, const Vec2& a) {
  return {s * a.x, s * a.y};
}
inline double dot(const Vec2& a, const Vec2& b) {
  return a.x * b.x + a.y * b.y;
}
inline double cross(const Vec2& a, const Vec2& b) {
  return a.x * b.y - a.y * b.x;
}
inline double length(const Vec2& a) {
  return std::sqrt(dot(a, a));
}

inline Vec3 operator+(const Vec3& a, const Vec3& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Vec3 operator-(const Vec3& a, const Vec3& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Vec3 operator-(const Vec3& a) {
  return {-a.x, -a.y, -a.z};
}
inline Vec3 operator*(double s, const Vec3& a) {
  return {s * a.x, s * a.y, s * a.z};
}
inline Vec3& operator+=(Vec3& a, const Vec3& b) {
  return a = a + b;
}
inline Vec3& operator-=(Vec3& a, const Vec3& b) {
  return a = a - b;
}
inline bool operator==(const Vec3& a, const Vec3& b) {
  return a.x == b.x && a.y == b.y && a.z == b.z;
}
inline bool operator!=(const Vec3& a, const Vec3& b) {
  return !(a == b);
}
inline double dot(const Vec3& a, const Vec3& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(const Vec3& a) {
  return std::sqrt(dot(a, a));
}

// Axis 0, 1 or 2.
inline double coordinate(const Vec3& a, uint32_t axis) {
  return axis == 0 ? a.x : axis == 1 ? a.y : a.z;
}

// The unit vector along `a`; the zero vector stays zero.
inline Vec3 unit(const Vec3& a) {
  const double norm = length(a);
  return norm > 0.0 ? (1.0 / norm) * a : Vec3{};
}

// The component of `a` across the unit vector `n`.
inline Vec3 reject(const Vec3& a, const Vec3& n) {
  return a - dot(a, n) * n;
}

}  // namespace wireskin
