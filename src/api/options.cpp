#include "api/options.h"

#include <cstdlib>

namespace wireskin::api {

static void* allocate_by_malloc(size_t bytes, void*) {
  return std::malloc(bytes);
}
static void release_by_free(void* memory, size_t, void*) {
  std::free(memory);
}

Status read_options(const wsk_options* given, wsk_options* options) {
  wsk_options_init(options, sizeof *options);
  TRY(read_struct(given, k_options_size,
                  "the options are not initialised: call wsk_options_init first", options));
  if (options->method < 0 || options->method >= WSK_METHOD_COUNT) {
    return fail(Code::bad_argument, "the options name an unknown method");
  }
  if (!finite_and_not_negative(options->spacing)) {
    return fail(Code::bad_argument, "the spacing is negative or not finite");
  }
  if (options->smoothing < 0 || options->smoothing >= WSK_SMOOTHING_COUNT) {
    return fail(Code::bad_argument, "the options name an unknown smoothing");
  }
  if (!finite_and_not_negative(options->noise)) {
    return fail(Code::bad_argument, "the noise is negative or not finite");
  }
  if (!finite_and_not_negative(options->soft)) {
    return fail(Code::bad_argument, "the cutoff length is negative or not finite");
  }
  if ((options->allocate == nullptr) != (options->release == nullptr)) {
    return fail(Code::bad_argument, "the options have an allocate or a release without the other");
  }
  return {};
}

Allocator allocator_of(const wsk_options& options) {
  if (options.allocate == nullptr) return {allocate_by_malloc, release_by_free, nullptr};
  return {options.allocate, options.release, options.allocator_user};
}

Callbacks callbacks_of(const wsk_options& options) {
  return {options.cancel, options.cancel_user, options.progress,     options.progress_user,
          options.now,    options.now_user,    options.parallel_for, options.parallel_for_user};
}

network::SmoothingOptions smoothing_of(const wsk_options& options, const Scale& scale) {
  const bool automatic =
      options.smoothing == WSK_SMOOTHING_AUTO ||
      (options.smoothing == WSK_SMOOTHING_DEFAULT && options.method == WSK_METHOD_FAIR);
  if (automatic) return {network::Noise::estimate, 0.0};
  if (options.smoothing == WSK_SMOOTHING_GIVEN && options.noise > 0.0) {
    return {network::Noise::given, scale(options.noise)};
  }
  return {network::Noise::none, 0.0};
}

}  // namespace wireskin::api
