// The caller's arrays for wsk_connect and wsk_integrate: checked, and copied into the structure
// that src/network works on, still in his units.
#pragma once

#include "api/input.h"
#include "network/wires.h"
#include "wireskin.h"

namespace wireskin::api {

Status read_raw_curves(const wsk_curve* curves, size_t count, network::Wires* wires);

// Curves without positions: arc length and unit tangent of each sample.
struct SensorCurves {
  network::Wires wires;
  Array<double> arc;
  Array<Vec3> tangent;
  Array<uint8_t> to_next;  // of each curve: tangents point to the next sample

  explicit SensorCurves(Context& context)
      : wires(context), arc(context), tangent(context), to_next(context) {}
};

Status read_sensor_curves(const wsk_sensor_curve* curves, size_t count, SensorCurves* sensor);

}  // namespace wireskin::api
