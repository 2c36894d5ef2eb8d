// The caller's curves for wsk_build: checked, and copied into arrays of our own, one curve after
// the other, still in his units.
#pragma once

#include "api/input.h"
#include "surface.h"
#include "wireskin.h"

namespace wireskin::api {

struct CurveStorage {
  Array<uint32_t> start;
  Array<Vec3> position, normal;
  Array<uint32_t> number;
  Array<uint8_t> closed, boundary;
  Array<double> soft;
  Array<uint8_t> sharp;  // empty where no curve is
  Array<Vec3> right;

  explicit CurveStorage(Context& context)
      : start(context),
        position(context),
        normal(context),
        number(context),
        closed(context),
        boundary(context),
        soft(context),
        sharp(context),
        right(context) {}
};

Status read_curves(const wsk_curve* curves, size_t count, CurveStorage* storage);

}  // namespace wireskin::api
