// Null pointers, struct sizes and options out of range, for every function of the C API.
#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <set>

#include "support/call.h"

using namespace scenes;

TEST_CASE("init functions write the defaults and leave bad pointers and sizes alone") {
  wsk_options_init(nullptr, sizeof(wsk_options));
  wsk_report_init(nullptr, sizeof(wsk_report));

  wsk_options options;
  std::memset(&options, 0x5a, sizeof options);
  const wsk_options before = options;
  wsk_options_init(&options, 0);
  wsk_options_init(&options, sizeof(size_t));
  CHECK(std::memcmp(&options, &before, sizeof options) == 0);
  wsk_options_init(&options, sizeof options);
  CHECK(options.size == sizeof options);
  CHECK(options.method == WSK_METHOD_STANKO);
  CHECK(options.spacing == 0.0);
  CHECK(options.memory_cap == 0);
  CHECK_FALSE(bool(options.allocate));
  CHECK_FALSE(bool(options.release));
  CHECK_FALSE(bool(options.cancel));
  CHECK_FALSE(bool(options.progress));
  CHECK_FALSE(bool(options.now));

  wsk_report report;
  std::memset(&report, 0x5a, sizeof report);
  const wsk_report report_before = report;
  wsk_report_init(&report, 4);
  CHECK(std::memcmp(&report, &report_before, sizeof report) == 0);
  wsk_report_init(&report, sizeof report);
  CHECK(report.size == sizeof report);
  CHECK(report.status == WSK_OK);
  CHECK(std::strcmp(report.sentence, "") == 0);
  for (const uint32_t place :
       {report.curve, report.sample, report.node, report.patch, report.vertex, report.triangle}) {
    CHECK(place == WSK_NONE);
  }
}

// A caller that was compiled against a later version has longer structs: what this version does not
// know is zero after init, which is how later versions spell their defaults, and left alone then.
template <typename T>
struct Longer {
  T known;
  unsigned char later[32];
};

template <typename T>
static Longer<T> longer() {
  Longer<T> value;
  std::memset(&value, 0xa5, sizeof value);
  return value;
}

template <typename T>
static bool tail_is(const Longer<T>& value, unsigned char expected) {
  for (const unsigned char byte : value.later) {
    if (byte != expected) return false;
  }
  return true;
}

TEST_CASE("structs of a newer caller") {
  const Scene scene = octants();
  const std::vector<wsk_curve> curves = curves_of(scene);
  auto options = longer<wsk_options>();
  auto report = longer<wsk_report>();
  auto view = longer<wsk_surface_view>();
  wsk_options_init(&options.known, sizeof options);
  wsk_report_init(&report.known, sizeof report);
  CHECK(tail_is(options, 0));
  CHECK(tail_is(report, 0));
  CHECK(options.known.method == WSK_METHOD_STANKO);
  options.known.spacing = scene.spacing;
  std::memset(options.later, 0x77, sizeof options.later);
  std::memset(report.later, 0x77, sizeof report.later);
  wsk_surface* surface = nullptr;
  REQUIRE(wsk_build(curves.data(), curves.size(), &options.known, &surface, &report.known) ==
          WSK_OK);
  CHECK(report.known.vertices > 0);
  CHECK(report.known.size == sizeof report);
  CHECK(tail_is(report, 0x77));
  wsk_surface_get_view(surface, &view.known, sizeof view);
  CHECK(view.known.vertex_count == report.known.vertices);
  CHECK(tail_is(view, 0));
  wsk_surface_free(surface);
}

TEST_CASE("a view of smaller size is filled as far as it reaches") {
  const Scene scene = octants();
  const wsk_options options = options_of(scene);
  wsk_surface* surface = nullptr;
  REQUIRE(run(scene, options, &surface, nullptr) == WSK_OK);
  wsk_surface_view whole, part;
  std::memset(&part, 0x5a, sizeof part);
  wsk_surface_get_view(surface, &whole, sizeof whole);
  const size_t size = offsetof(wsk_surface_view, normals);
  wsk_surface_get_view(surface, &part, size);
  CHECK(part.vertex_count == whole.vertex_count);
  CHECK(part.positions == whole.positions);
  const unsigned char* bytes = reinterpret_cast<const unsigned char*>(&part);
  for (size_t i = size; i < sizeof part; ++i) CHECK(bytes[i] == 0x5a);
  wsk_surface_free(surface);
}

TEST_CASE("null surfaces and views") {
  wsk_surface_free(nullptr);
  wsk_surface_view view;
  std::memset(&view, 0x5a, sizeof view);
  wsk_surface_get_view(nullptr, &view, sizeof view);
  CHECK(view.vertex_count == 0);
  CHECK(view.triangle_count == 0);
  CHECK(view.positions == nullptr);
  CHECK(view.triangles == nullptr);
  wsk_surface_get_view(nullptr, nullptr, sizeof view);

  const Scene scene = octants();
  wsk_surface* surface = nullptr;
  const wsk_options options = options_of(scene);
  REQUIRE(run(scene, options, &surface, nullptr) == WSK_OK);
  wsk_surface_get_view(surface, nullptr, sizeof view);
  wsk_surface_free(surface);
}

TEST_CASE("options and report may be null") {
  const Scene scene = saddle();
  const std::vector<wsk_curve> curves = curves_of(scene);
  wsk_surface* surface = nullptr;
  REQUIRE(wsk_build(curves.data(), curves.size(), nullptr, &surface, nullptr) == WSK_OK);
  wsk_surface_free(surface);

  const Scene tube = band();
  const wsk_mesh mesh = mesh_of(tube);
  REQUIRE(wsk_smooth_mesh(&mesh, nullptr, &surface, nullptr) == WSK_OK);
  wsk_surface_free(surface);
}

TEST_CASE("null where none is allowed") {
  const Scene scene = octants(), tube = band();
  const std::vector<wsk_curve> curves = curves_of(scene);
  const wsk_mesh mesh = mesh_of(tube);
  wsk_report report;
  wsk_report_init(&report, sizeof report);
  CHECK(wsk_build(curves.data(), curves.size(), nullptr, nullptr, &report) ==
        WSK_ERROR_BAD_ARGUMENT);
  CHECK(report.status == WSK_ERROR_BAD_ARGUMENT);
  CHECK(wsk_smooth_mesh(&mesh, nullptr, nullptr, &report) == WSK_ERROR_BAD_ARGUMENT);

  const wsk_options options = options_of(scene);
  CHECK(watched(options, [&](const wsk_options* o, wsk_surface** s, wsk_report* r) {
          return wsk_build(nullptr, 3, o, s, r);
        }).status == WSK_ERROR_BAD_ARGUMENT);
  CHECK(watched(options, [&](const wsk_options* o, wsk_surface** s, wsk_report* r) {
          return wsk_build(nullptr, 0, o, s, r);
        }).status == WSK_ERROR_EMPTY);
  CHECK(watched(options, [&](const wsk_options* o, wsk_surface** s, wsk_report* r) {
          return wsk_smooth_mesh(nullptr, o, s, r);
        }).status == WSK_ERROR_BAD_ARGUMENT);

  std::vector<wsk_curve> without = curves;
  without[1].positions = nullptr;
  const Call call = watched_build(without, options);
  CHECK(call.status == WSK_ERROR_BAD_ARGUMENT);
  CHECK(call.report.curve == 1);
}

TEST_CASE("null arrays of a mesh") {
  const Scene tube = band();
  const wsk_options options = options_of(tube);
  const auto status_without = [&](auto wsk_mesh::*array) {
    wsk_mesh mesh = mesh_of(tube);
    mesh.*array = nullptr;
    return watched(options, [&](const wsk_options* o, wsk_surface** s,
                                wsk_report* r) { return wsk_smooth_mesh(&mesh, o, s, r); })
        .status;
  };
  CHECK(status_without(&wsk_mesh::positions) == WSK_ERROR_BAD_ARGUMENT);
  CHECK(status_without(&wsk_mesh::triangles) == WSK_ERROR_BAD_ARGUMENT);
  CHECK(status_without(&wsk_mesh::constrained) == WSK_ERROR_BAD_ARGUMENT);
  CHECK(status_without(&wsk_mesh::normals) == WSK_ERROR_MISSING_NORMALS);
}

TEST_CASE("options out of range") {
  const Scene scene = octants();
  const auto status_with = [&](auto change) {
    wsk_options options = options_of(scene);
    change(options);
    return watched_scene(scene, options).status;
  };
  const double infinity = std::numeric_limits<double>::infinity();
  CHECK(status_with([](wsk_options& o) { o.method = -1; }) == WSK_ERROR_BAD_ARGUMENT);
  CHECK(status_with([](wsk_options& o) { o.method = WSK_METHOD_COUNT; }) == WSK_ERROR_BAD_ARGUMENT);
  CHECK(status_with([](wsk_options& o) { o.spacing = -0.1; }) == WSK_ERROR_BAD_ARGUMENT);
  CHECK(status_with([](wsk_options& o) { o.spacing = std::nan(""); }) == WSK_ERROR_BAD_ARGUMENT);
  CHECK(status_with([&](wsk_options& o) { o.spacing = infinity; }) == WSK_ERROR_BAD_ARGUMENT);
  CHECK(status_with([](wsk_options& o) { o.size = 0; }) == WSK_ERROR_BAD_ARGUMENT);
  CHECK(status_with([](wsk_options& o) { o.size = 8; }) == WSK_ERROR_BAD_ARGUMENT);
  CHECK(status_with([](wsk_options& o) { o.allocate = FaultyAllocator::allocate; }) ==
        WSK_ERROR_BAD_ARGUMENT);
  CHECK(status_with([](wsk_options& o) { o.release = FaultyAllocator::release; }) ==
        WSK_ERROR_BAD_ARGUMENT);
  CHECK(status_with([](wsk_options& o) { o.spacing = 1e-12; }) == WSK_ERROR_TOO_LARGE);
  CHECK(status_with([](wsk_options& o) { o.spacing = 5e-324; }) == WSK_ERROR_TOO_LARGE);
  CHECK(status_with([](wsk_options& o) { o.spacing = 1e300; }) == WSK_OK);
}

TEST_CASE("names are distinct static texts in lower case") {
  std::set<std::string> names;
  for (wsk_status status = WSK_OK; status <= WSK_ERROR_NOT_POSITIVE_DEFINITE; ++status) {
    const std::string name = wsk_status_name(status);
    CHECK(names.insert(name).second);
    CHECK(name.find_first_not_of("abcdefghijklmnopqrstuvwxyz_") == std::string::npos);
  }
  CHECK(names.count("unknown") == 0);
  CHECK(std::string(wsk_status_name(WSK_OK)) == "ok");
  CHECK(std::string(wsk_status_name(WSK_ERROR_ZERO_NORMAL)) == "zero_normal");
  CHECK(std::string(wsk_status_name(-1)) == "unknown");
  CHECK(std::string(wsk_status_name(25)) == "unknown");
  CHECK(std::string(wsk_status_name(INT32_MIN)) == "unknown");

  names.clear();
  for (wsk_stage stage = 0; stage < WSK_STAGE_COUNT; ++stage) {
    CHECK(names.insert(wsk_stage_name(stage)).second);
  }
  CHECK(std::string(wsk_stage_name(WSK_STAGE_CURVES)) == "curves");
  CHECK(std::string(wsk_stage_name(WSK_STAGE_COUNT)) == "unknown");
  CHECK(std::string(wsk_stage_name(-1)) == "unknown");
  CHECK(std::string(wsk_version_string()) == WIRESKIN_VERSION_STRING);
}
