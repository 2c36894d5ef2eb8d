// libFuzzer target: raw curves to wsk_connect. The target `pipeline` builds surfaces from what
// comes out of it.
#include "fuzz/curves.h"

static void check_network(const wsk_network* network, const std::vector<scenes::Curve>& given) {
  wsk_network_view view;
  wsk_network_get_view(network, &view, sizeof view);
  for (uint32_t c = 0; c < view.curve_count; ++c) {
    fuzz::require(view.first_sample[c + 1] - view.first_sample[c] == view.curves[c].sample_count);
    for (size_t i = 0; i < 3 * view.curves[c].sample_count; ++i) {
      fuzz::require(std::isfinite(view.curves[c].positions[i]));
    }
  }
  for (uint32_t i = 0; i < view.sample_count; ++i) {
    fuzz::require(view.given_curve[i] < given.size());
    fuzz::require(view.given_sample[i] < given[view.given_curve[i]].size());
    fuzz::require(view.given_part[i] >= 0.0 && view.given_part[i] <= 1.0);
  }
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  fuzz::Bytes bytes(data, size);
  fuzz::Limits limits;
  wsk_options options = limits.options();
  wsk_connect_options how;
  wsk_connect_options_init(&how, sizeof how);
  how.options = &options;
  how.chain = static_cast<wsk_chain>(bytes.below(WSK_CHAIN_COUNT));
  how.orient = bytes.one_in(2);
  if (bytes.one_in(2)) how.snap = bytes.number();
  if (bytes.one_in(4)) how.corner_deg = bytes.byte();
  scenes::Scene scene;
  scene.curves = fuzz::read_curves(bytes, false);
  const std::vector<wsk_curve> curves = scenes::curves_of(scene);
  wsk_network* network = nullptr;
  if (wsk_connect(curves.data(), curves.size(), &how, &network, nullptr) == WSK_OK) {
    check_network(network, scene.curves);
  }
  wsk_network_free(network);
  fuzz::require(limits.allocator.clean());
  return 0;
}
