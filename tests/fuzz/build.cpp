// libFuzzer target: curves to wsk_build. With WIRESKIN_FUZZ_PATCHES the call is cancelled once the
// patches have triangles; without, the whole pipeline runs, by every method. A quarter of the cases
// are raw curves, which wsk_connect joins first.
#include "fuzz/curves.h"

#ifdef WIRESKIN_FUZZ_PATCHES
static constexpr wsk_stage k_last_stage = WSK_STAGE_PATCHES;
#else
static constexpr wsk_stage k_last_stage = WSK_STAGE_COUNT;
#endif

// With fresh limits: joining the curves has had its own, and stages of the same numbers.
static wsk_status build(const wsk_curve* curves, size_t count, const wsk_options& options,
                        fuzz::Limits* limits, wsk_surface** surface) {
  limits->checkpoints = 0;
  limits->stage = WSK_STAGE_INPUT;
  limits->last_stage = k_last_stage;
  return wsk_build(curves, count, &options, surface, nullptr);
}

static wsk_status connect_and_build(const std::vector<wsk_curve>& curves,
                                    const wsk_options& options, fuzz::Limits* limits,
                                    wsk_surface** surface) {
  wsk_connect_options how;
  wsk_connect_options_init(&how, sizeof how);
  how.options = &options;
  wsk_network* network = nullptr;
  wsk_status status = wsk_connect(curves.data(), curves.size(), &how, &network, nullptr);
  if (status == WSK_OK) {
    wsk_network_view view;
    wsk_network_get_view(network, &view, sizeof view);
    status = build(view.curves, view.curve_count, options, limits, surface);
  }
  wsk_network_free(network);
  return status;
}

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
  scenes::Scene scene;
  const bool raw = size > 0 && data[size - 1] % 4 == 0;
  scene.curves = fuzz::read_curves(bytes, !raw);
  options.spacing = fuzz::extent_of(scene.curves) / part / 2;
  if (!std::isfinite(options.spacing)) options.spacing = 0.0;
  wsk_surface* surface = nullptr;
  const std::vector<wsk_curve> curves = scenes::curves_of(scene);
  const wsk_status status = raw ? connect_and_build(curves, options, &limits, &surface)
                                : build(curves.data(), curves.size(), options, &limits, &surface);
  fuzz::check_outcome(status, surface);
  fuzz::require(limits.allocator.clean());
  return 0;
}
