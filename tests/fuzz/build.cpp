// libFuzzer target: curves to wsk_build. With WIRESKIN_FUZZ_PATCHES the call is cancelled once the
// patches have triangles; without, the whole pipeline runs, by every method.
#include "fuzz/curves.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  fuzz::Bytes bytes(data, size);
  fuzz::Limits limits;
  wsk_options options = limits.options();
  options.method = static_cast<wsk_method>(bytes.below(WSK_METHOD_COUNT));
  options.smoothing = static_cast<wsk_smoothing>(bytes.below(WSK_SMOOTHING_COUNT));
  options.partial = bytes.one_in(3);
  const double part = (2 + bytes.below(6)) / 2.0;
  if (bytes.one_in(6)) options.noise = bytes.number();
  if (bytes.one_in(6)) options.soft = bytes.number();
#ifdef WIRESKIN_FUZZ_PATCHES
  limits.last_stage = WSK_STAGE_PATCHES;
#endif
  scenes::Scene scene;
  scene.curves = fuzz::read_curves(bytes, true);
  options.spacing = fuzz::extent_of(scene.curves) / part / 2;
  if (!std::isfinite(options.spacing)) options.spacing = 0.0;
  wsk_surface* surface = nullptr;
  fuzz::check_outcome(scenes::run(scene, options, &surface, nullptr), surface);
  fuzz::require(limits.allocator.clean());
  return 0;
}
