// libFuzzer target: curves and points to wsk_flow_build and two surfaces of the same flow.
#include "fuzz/curves.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  fuzz::Bytes bytes(data, size);
  fuzz::Limits limits;
  wsk_options options = limits.options();
  // Curves that nearly coincide are sampled finely, long before the number of tetrahedra ends it.
  options.memory_cap = size_t{1} << 20;
  wsk_flow_options how;
  wsk_flow_options_init(&how, sizeof how);
  how.most_tetrahedra = 5000;
  how.seed = bytes.byte();
  how.raw = bytes.one_in(2);
  how.open_walls = bytes.one_in(4);
  how.voids = static_cast<int32_t>(bytes.below(5)) - 1;
  if (bytes.one_in(8)) how.jitter = bytes.number();
  if (bytes.one_in(8)) how.thickness = bytes.number();
  options.method = static_cast<wsk_method>(bytes.below(WSK_METHOD_COUNT));
  const double parts = 3.0 + bytes.below(8);
  const bool normals = bytes.one_in(3);
  scenes::Scene scene;
  scene.curves = fuzz::read_curves(bytes, false);
  for (scenes::Curve& curve : scene.curves) {
    if (!normals) curve.normals.clear();
  }
  how.sampling = fuzz::extent_of(scene.curves) / parts;
  if (!std::isfinite(how.sampling)) how.sampling = 0.0;
  const std::vector<wsk_curve> curves = scenes::curves_of(scene);
  wsk_flow* flow = nullptr;
  if (wsk_flow_build(curves.data(), curves.size(), &options, &how, &flow, nullptr) == WSK_OK) {
    for (int round = 0; round < 2; ++round) {
      limits.checkpoints = 0;
      wsk_surface* surface = nullptr;
      const wsk_status status = wsk_flow_surface(flow, &options, &how, &surface, nullptr);
      fuzz::check_outcome(status, surface, true);
      how.voids = 1;
    }
  }
  wsk_flow_free(flow);
  fuzz::require(limits.allocator.clean());
  return 0;
}
