// Positions and normals from the caller's arrays, checked one by one, and the power of two by which
// they are scaled.
#pragma once

#include <cstring>

#include "base/array.h"
#include "num/scale.h"
#include "num/vec.h"

namespace wireskin::api {

// Rows of three doubles at any stride, aligned or not.
struct Rows {
  const double* data;
  size_t stride;

  Vec3 operator[](size_t i) const {
    double row[3];
    const size_t step = stride == 0 ? sizeof row : stride;
    std::memcpy(row, reinterpret_cast<const unsigned char*>(data) + i * step, sizeof row);
    return {row[0], row[1], row[2]};
  }
};

inline Place curve_place(size_t curve) {
  Place place;
  place.curve = static_cast<uint32_t>(curve);
  return place;
}

inline Place sample_place(size_t curve, size_t sample) {
  Place place;
  place.curve = static_cast<uint32_t>(curve);
  place.sample = static_cast<uint32_t>(sample);
  return place;
}

double greatest_component(const Vec3& a);

// One position and normal, checked; the normal comes out unit whatever its length was.
Status read_position(const Rows& rows, size_t i, const Place& place, Vec3* position);
Status read_normal(const Rows& rows, size_t i, const Place& place, Vec3* normal);

// The power of two that brings the extent of the points to one half up to one. Fails where that is
// infinite, and where the points lie more than 2^100 times as far out.
Status find_scale(Span<const Vec3> points, int* exponent);

// Far from the origin doubles are coarse, and what then fails does not look like it: the sentence
// of such a status becomes one that says so. `spacing`: zero if it is not known yet.
Status explain_rounding(const Status& status, Span<const Vec3> positions, double spacing);

}  // namespace wireskin::api
