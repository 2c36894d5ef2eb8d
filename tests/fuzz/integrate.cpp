// libFuzzer target: sensor curves to wsk_integrate.
#include "fuzz/bytes.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  fuzz::Bytes bytes(data, size);
  fuzz::Limits limits;
  const wsk_options options = limits.options();
  std::vector<scenes::SensorCurve> sensors(bytes.count(4, 8));
  std::vector<wsk_sensor_curve> curves;
  for (scenes::SensorCurve& sensor : sensors) {
    const uint32_t count = bytes.count(7, 10) - 1;
    const uint8_t flags = bytes.byte();
    double length = 0.0;
    for (uint32_t i = 0; i < count; ++i) {
      sensor.arc_lengths.push_back(length);
      length += bytes.one_in(8) ? bytes.number() : (1 + bytes.byte()) / 64.0;
      for (int k = 0; k < 3; ++k) sensor.tangents.push_back(bytes.number());
      for (int k = 0; k < 3; ++k)
        sensor.rest.normals.push_back((flags & 1) != 0 ? 1.0 : bytes.number());
      const uint32_t node = bytes.below(12);
      sensor.rest.nodes.push_back(node < 6 ? node : WSK_NONE);
    }
    wsk_sensor_curve curve = {};
    curve.sample_count = count;
    curve.arc_lengths = sensor.arc_lengths.data();
    curve.tangents = sensor.tangents.data();
    curve.normals = (flags & 2) != 0 ? nullptr : sensor.rest.normals.data();
    curve.nodes = (flags & 4) != 0 ? nullptr : sensor.rest.nodes.data();
    curve.closed = (flags & 8) != 0;
    curve.boundary = (flags & 16) != 0;
    curve.tangents_to_next = (flags & 32) != 0;
    curves.push_back(curve);
  }
  wsk_network* network = nullptr;
  if (wsk_integrate(curves.data(), curves.size(), &options, &network, nullptr) == WSK_OK) {
    wsk_network_view view;
    wsk_network_get_view(network, &view, sizeof view);
    fuzz::require(view.curve_count == curves.size());
    for (uint32_t c = 0; c < view.curve_count; ++c) {
      for (size_t i = 0; i < 3 * view.curves[c].sample_count; ++i) {
        fuzz::require(std::isfinite(view.curves[c].positions[i]));
      }
    }
  }
  wsk_network_free(network);
  fuzz::require(limits.allocator.clean());
  return 0;
}
