// What each function of the C API refuses in its arguments: one case for each sentence, with the
// place that it names. Every refusal leaves the outputs alone and gives all memory back.
#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>

#include "support/call.h"

using namespace scenes;

namespace {

const double k_infinity = std::numeric_limits<double>::infinity();
const double k_no_number = std::numeric_limits<double>::quiet_NaN();

const Scene& three_circles() {
  static const Scene scene = octants();
  return scene;
}

// The arguments of every function, for a case to change. They point into the scene.
struct Arguments {
  std::vector<wsk_curve> curves;
  std::vector<wsk_sensor_curve> sensors;
  wsk_mesh mesh;
  wsk_options options;
  wsk_connect_options connect;
  wsk_flow_options flow;
  size_t curve_count = 0;  // told to the function instead of that of `curves`, unless 0

  explicit Arguments(const Scene& scene = three_circles())
      : curves(curves_of(scene)), mesh(mesh_of(scene)) {
    wsk_options_init(&options, sizeof options);
    wsk_connect_options_init(&connect, sizeof connect);
    wsk_flow_options_init(&flow, sizeof flow);
    connect.options = &options;
  }
  size_t count(size_t own) const { return curve_count > 0 ? curve_count : own; }
};

using Function = std::function<wsk_status(const Arguments&, wsk_report*)>;

// The sentinel is what an untouched output still holds.
template <typename Handle>
Handle* sentinel() {
  static char place;
  return reinterpret_cast<Handle*>(&place);
}

wsk_status build(const Arguments& a, wsk_report* report) {
  wsk_surface* out = sentinel<wsk_surface>();
  const wsk_status status =
      wsk_build(a.curves.data(), a.count(a.curves.size()), &a.options, &out, report);
  CHECK(out == sentinel<wsk_surface>());
  return status;
}

wsk_status smooth_mesh(const Arguments& a, wsk_report* report) {
  wsk_surface* out = sentinel<wsk_surface>();
  const wsk_status status = wsk_smooth_mesh(&a.mesh, &a.options, &out, report);
  CHECK(out == sentinel<wsk_surface>());
  return status;
}

wsk_status connect(const Arguments& a, wsk_report* report) {
  wsk_network* out = sentinel<wsk_network>();
  const wsk_status status =
      wsk_connect(a.curves.data(), a.count(a.curves.size()), &a.connect, &out, report);
  CHECK(out == sentinel<wsk_network>());
  return status;
}

wsk_status integrate(const Arguments& a, wsk_report* report) {
  wsk_network* out = sentinel<wsk_network>();
  const wsk_status status =
      wsk_integrate(a.sensors.data(), a.count(a.sensors.size()), &a.options, &out, report);
  CHECK(out == sentinel<wsk_network>());
  return status;
}

wsk_status flow_build(const Arguments& a, wsk_report* report) {
  wsk_flow* out = sentinel<wsk_flow>();
  const wsk_status status =
      wsk_flow_build(a.curves.data(), a.count(a.curves.size()), &a.options, &a.flow, &out, report);
  CHECK(out == sentinel<wsk_flow>());
  return status;
}

void refuses(const Function& function, Arguments arguments, wsk_status expected,
             const std::string& sentence, uint32_t curve = WSK_NONE, uint32_t sample = WSK_NONE) {
  CAPTURE(sentence);
  FaultyAllocator allocator;
  if (arguments.options.release == nullptr) allocator.install(&arguments.options);
  if (arguments.connect.options != nullptr) arguments.connect.options = &arguments.options;
  wsk_report report;
  wsk_report_init(&report, sizeof report);
  CHECK(function(arguments, &report) == expected);
  CHECK(report.status == expected);
  CHECK(std::string(report.sentence).find(sentence) != std::string::npos);
  CHECK(report.curve == curve);
  CHECK(report.sample == sample);
  CHECK(allocator.clean());
}

// Two open curves that meet at a node of number 3, as a sensor measures them.
struct Sensed {
  double arc[4] = {0.0, 1.0, 2.0, 3.0};
  double tangents[12] = {1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0};
  uint32_t nodes[4] = {3, WSK_NONE, WSK_NONE, WSK_NONE};
  Arguments arguments;

  Sensed() {
    wsk_sensor_curve curve = {};
    curve.sample_count = 4;
    curve.arc_lengths = arc;
    curve.tangents = tangents;
    curve.nodes = nodes;
    arguments.sensors.assign(2, curve);
  }
};

}  // namespace

TEST_CASE("refused: options of every function") {
  for (const Function& function : {Function(build), Function(smooth_mesh), Function(connect),
                                   Function(integrate), Function(flow_build)}) {
    const auto with = [&](const std::string& sentence, auto change) {
      Sensed sensed;
      change(&sensed.arguments.options);
      refuses(function, sensed.arguments, WSK_ERROR_BAD_ARGUMENT, sentence);
    };
    using Options = wsk_options*;
    with("unknown method", [](Options o) { o->method = WSK_METHOD_COUNT; });
    with("unknown smoothing", [](Options o) { o->smoothing = -1; });
    with("unknown smoothing", [](Options o) { o->smoothing = WSK_SMOOTHING_COUNT; });
    for (const double bad : {-1.0, k_infinity, k_no_number}) {
      with("the spacing is", [bad](Options o) { o->spacing = bad; });
      with("the noise is", [bad](Options o) { o->noise = bad; });
      with("the cutoff length is", [bad](Options o) { o->soft = bad; });
    }
    with("without the other", [](Options o) { o->release = FaultyAllocator::release; });
    with("not initialised", [](Options o) { o->size = 3; });
  }
}

TEST_CASE("refused: options of wsk_connect and of the flow") {
  const auto connect_with = [](const std::string& sentence, auto change) {
    Arguments a;
    change(&a.connect);
    refuses(connect, a, WSK_ERROR_BAD_ARGUMENT, sentence);
  };
  using Connect = wsk_connect_options*;
  connect_with("not initialised", [](Connect o) { o->size = 1; });
  connect_with("way of chaining", [](Connect o) { o->chain = -1; });
  connect_with("way of chaining", [](Connect o) { o->chain = WSK_CHAIN_COUNT; });
  for (const double bad : {-1.0, 180.5, k_no_number}) {
    connect_with("angle of a corner", [bad](Connect o) { o->corner_deg = bad; });
  }
  for (const double bad : {k_infinity, k_no_number}) {
    connect_with("snapping tolerance", [bad](Connect o) { o->snap = bad; });
  }

  const auto flow_with = [](const std::string& sentence, auto change) {
    Arguments a;
    change(&a.flow);
    refuses(flow_build, a, WSK_ERROR_BAD_ARGUMENT, sentence);
  };
  using Flow = wsk_flow_options*;
  flow_with("not initialised", [](Flow o) { o->size = 1; });
  for (const int32_t bad : {-1, int32_t{WSK_LIDS_COUNT}}) {
    flow_with("the lids are none", [bad](Flow o) { o->lids = bad; });
  }
  for (const double bad : {-1.0, k_infinity, k_no_number}) {
    flow_with("the sampling is", [bad](Flow o) { o->sampling = bad; });
    flow_with("the thickness is", [bad](Flow o) { o->thickness = bad; });
  }
  for (const double bad : {-1e-9, 0.1, k_no_number}) {
    flow_with("the jitter is", [bad](Flow o) { o->jitter = bad; });
  }
}

TEST_CASE("refused: counts beyond 32-bit indices") {
  for (const Function& function : {Function(build), Function(connect), Function(flow_build)}) {
    Arguments a;
    a.curves[1].sample_count = 0xffffffffu;
    refuses(function, a, WSK_ERROR_TOO_LARGE, "too many samples", 1);
    a = Arguments();
    a.curve_count = 0xffffffffu;
    refuses(function, a, WSK_ERROR_TOO_LARGE, "too many curves");
  }
  Sensed sensed;
  sensed.arguments.sensors[1].sample_count = 0xffffffffu;
  refuses(integrate, sensed.arguments, WSK_ERROR_TOO_LARGE, "too many samples", 1);
  Arguments a;
  const double position[3] = {};
  const uint32_t triangle[3] = {};
  const uint8_t constrained = 1;
  a.mesh.positions = a.mesh.normals = position;
  a.mesh.constrained = &constrained;
  a.mesh.triangles = triangle;
  a.mesh.vertex_count = 1;
  a.mesh.triangle_count = 0x7fffffffu;
  refuses(smooth_mesh, a, WSK_ERROR_TOO_LARGE, "mesh is too large");
  a.mesh.vertex_count = 0x7fffffffu;
  a.mesh.triangle_count = 1;
  refuses(smooth_mesh, a, WSK_ERROR_TOO_LARGE, "mesh is too large");
}

TEST_CASE("refused: curves without positions, and cutoff lengths that are no numbers") {
  for (const Function& function : {Function(build), Function(connect), Function(flow_build)}) {
    Arguments a;
    a.curves[2].positions = nullptr;
    refuses(function, a, WSK_ERROR_BAD_ARGUMENT, "no positions", 2);
    a = Arguments();
    a.curves[1].sample_count = 0;
    refuses(function, a, WSK_ERROR_TOO_FEW_SAMPLES, "no samples", 1);
  }
  for (const Function& function : {Function(build), Function(connect)}) {
    for (const double bad : {k_infinity, -k_infinity, k_no_number}) {
      Arguments a;
      a.curves[1].soft = bad;
      refuses(function, a, WSK_ERROR_BAD_ARGUMENT, "cutoff length of the curve", 1);
    }
  }
}

TEST_CASE("refused: what a sensor cannot have measured") {
  const auto with = [](wsk_status expected, const std::string& sentence, uint32_t sample,
                       auto change) {
    Sensed sensed;
    change(&sensed);
    const bool curve = sentence != "span";
    refuses(integrate, sensed.arguments, expected, sentence, curve ? 0 : WSK_NONE, sample);
  };
  using Case = Sensed*;
  with(WSK_ERROR_TOO_FEW_SAMPLES, "no samples", WSK_NONE,
       [](Case s) { s->arguments.sensors[0].sample_count = 0; });
  with(WSK_ERROR_TOO_FEW_SAMPLES, "too few", WSK_NONE,
       [](Case s) { s->arguments.sensors[0].sample_count = 1; });
  with(WSK_ERROR_TOO_FEW_SAMPLES, "too few", WSK_NONE, [](Case s) {
    s->arguments.sensors[0].sample_count = 3;
    s->arguments.sensors[0].closed = 1;
  });
  with(WSK_ERROR_BAD_ARGUMENT, "no arc lengths", WSK_NONE,
       [](Case s) { s->arguments.sensors[0].arc_lengths = nullptr; });
  with(WSK_ERROR_BAD_ARGUMENT, "no arc lengths", WSK_NONE,
       [](Case s) { s->arguments.sensors[0].tangents = nullptr; });
  with(WSK_ERROR_NOT_A_NUMBER, "arc length", 2, [](Case s) { s->arc[2] = k_no_number; });
  with(WSK_ERROR_INFINITE, "arc length", 3, [](Case s) { s->arc[3] = k_infinity; });
  with(WSK_ERROR_DUPLICATE_SAMPLES, "does not increase", 2, [](Case s) { s->arc[2] = 1.0; });
  with(WSK_ERROR_BAD_ARGUMENT, "tangent has zero length", 1, [](Case s) { s->tangents[3] = 0.0; });
  with(WSK_ERROR_INFINITE, "span", WSK_NONE, [](Case s) {
    s->arc[0] = -1.5e308;
    s->arc[3] = 1.5e308;
  });
}

TEST_CASE("refused: null pointers and reports without a size") {
  const Sensed sensed;
  const Arguments& a = sensed.arguments;
  wsk_report small;
  wsk_report_init(&small, sizeof small);
  small.size = 8;
  for (const Function& function : {Function(build), Function(smooth_mesh), Function(connect),
                                   Function(integrate), Function(flow_build)}) {
    CHECK(function(a, &small) == WSK_ERROR_BAD_ARGUMENT);
    CHECK(small.size == 8);
    CHECK(small.status == WSK_OK);
  }
  CHECK(wsk_integrate(nullptr, 2, nullptr, nullptr, nullptr) == WSK_ERROR_BAD_ARGUMENT);
  wsk_network* network = nullptr;
  CHECK(wsk_integrate(nullptr, 2, nullptr, &network, nullptr) == WSK_ERROR_BAD_ARGUMENT);
  wsk_flow* flow = nullptr;
  CHECK(wsk_flow_build(nullptr, 2, nullptr, nullptr, &flow, nullptr) == WSK_ERROR_BAD_ARGUMENT);

  wsk_connect_options untouched;
  std::memset(&untouched, 0x5a, sizeof untouched);
  wsk_connect_options_init(nullptr, sizeof untouched);
  wsk_connect_options_init(&untouched, 1);
  wsk_flow_options also;
  std::memset(&also, 0x5a, sizeof also);
  wsk_flow_options_init(nullptr, sizeof also);
  wsk_flow_options_init(&also, 1);
  CHECK(untouched.size == also.size);
  CHECK(untouched.size != sizeof untouched);
}

TEST_CASE("refused: surfaces of a flow") {
  const std::vector<wsk_curve> curves = curves_of(three_circles());
  wsk_flow* flow = nullptr;
  REQUIRE(wsk_flow_build(curves.data(), curves.size(), nullptr, nullptr, &flow, nullptr) == WSK_OK);
  wsk_options options;
  wsk_options_init(&options, sizeof options);
  wsk_flow_options flow_options;
  wsk_flow_options_init(&flow_options, sizeof flow_options);
  wsk_surface* surface = nullptr;
  wsk_report report;
  wsk_report_init(&report, sizeof report);
  CHECK(wsk_flow_surface(flow, nullptr, nullptr, nullptr, &report) == WSK_ERROR_BAD_ARGUMENT);
  CHECK(std::string(report.sentence) == "there is no place for the surface");
  flow_options.thickness = -1.0;
  CHECK(wsk_flow_surface(flow, nullptr, &flow_options, &surface, &report) ==
        WSK_ERROR_BAD_ARGUMENT);
  options.method = 99;
  CHECK(wsk_flow_surface(flow, &options, nullptr, &surface, &report) == WSK_ERROR_BAD_ARGUMENT);
  CHECK(std::string(report.sentence) == "the options name an unknown method");
  report.size = 1;
  CHECK(wsk_flow_surface(flow, nullptr, nullptr, &surface, &report) == WSK_ERROR_BAD_ARGUMENT);
  CHECK(surface == nullptr);
  wsk_flow_free(flow);
}

TEST_CASE("refused: lengths that vanish beside the network's") {
  Scene scene = octants();
  for (Curve& curve : scene.curves) {
    for (double& x : curve.positions) x = std::ldexp(x, 900);
  }
  Arguments a(scene);
  a.flow.sampling = 5e-324;
  refuses(flow_build, a, WSK_ERROR_TOO_LARGE, "the spacing is too small");
  a = Arguments(scene);
  a.options.spacing = 5e-324;
  refuses(flow_build, a, WSK_ERROR_TOO_LARGE, "the spacing is too small");

  const std::vector<wsk_curve> curves = curves_of(scene);
  wsk_flow* flow = nullptr;
  wsk_options options;
  wsk_options_init(&options, sizeof options);
  REQUIRE(wsk_flow_build(curves.data(), curves.size(), &options, nullptr, &flow, nullptr) ==
          WSK_OK);
  options.spacing = 5e-324;
  wsk_surface* surface = nullptr;
  CHECK(wsk_flow_surface(flow, &options, nullptr, &surface, nullptr) == WSK_ERROR_TOO_LARGE);
  CHECK(surface == nullptr);
  wsk_flow_free(flow);
}

TEST_CASE("places of a network: curves, samples and numbers, also those that it made") {
  // Two lines that cross in the middle of edges: the joint has a number that the caller never gave.
  const double a[] = {-1, 0, 0, -0.4, 0, 0, 0.6, 0, 0, 1, 0, 0};
  const double b[] = {0, -1, 0, 0, -0.4, 0, 0, 0.6, 0, 0, 1, 0};
  const uint32_t numbers[] = {5, 6, 7, 8};
  wsk_curve curves[2] = {};
  curves[0].sample_count = curves[1].sample_count = 4;
  curves[0].positions = a;
  curves[1].positions = b;
  curves[0].nodes = numbers;
  wsk_network* network = nullptr;
  REQUIRE(wsk_connect(curves, 2, nullptr, &network, nullptr) == WSK_OK);
  wsk_network_view view;
  wsk_network_get_view(network, &view, sizeof view);
  wsk_report report;
  const auto named = [&](uint32_t curve, uint32_t sample, uint32_t node) {
    wsk_report_init(&report, sizeof report);
    report.curve = curve;
    report.sample = sample;
    report.node = node;
    wsk_network_name_places(network, &report);
  };
  // By a number of the caller's: the sample that carries it, and the number stays.
  named(WSK_NONE, WSK_NONE, 7);
  CHECK(report.node == 7);
  CHECK(report.curve == 0);
  CHECK(report.sample == 2);
  // By the joint's number: a place of the caller's near it, and no number.
  uint32_t joint = WSK_NONE;
  for (uint32_t i = 0; i < view.sample_count; ++i) {
    const uint32_t number = view.curves[0].nodes[i];
    if (number != WSK_NONE && (number < 5 || number > 8)) joint = number;
  }
  REQUIRE(joint != WSK_NONE);
  named(WSK_NONE, WSK_NONE, joint);
  CHECK(report.node == WSK_NONE);
  CHECK(report.curve < 2);
  CHECK(report.sample < 4);
  // A number that occurs nowhere stays as it is.
  named(WSK_NONE, WSK_NONE, 1234567);
  CHECK(report.node == 1234567);
  CHECK(report.curve == WSK_NONE);
  CHECK(report.sample == WSK_NONE);
  // A whole curve; a sample beyond its end counts as its first.
  named(1, WSK_NONE, WSK_NONE);
  CHECK(report.curve == view.given_curve[view.first_sample[1]]);
  CHECK(report.sample == WSK_NONE);
  named(0, 1u << 20, WSK_NONE);
  CHECK(report.sample == view.given_sample[0]);
  // Nothing, null pointers and a report without size: left alone.
  named(WSK_NONE, WSK_NONE, WSK_NONE);
  CHECK(report.curve == WSK_NONE);
  wsk_network_name_places(nullptr, &report);
  wsk_network_name_places(network, nullptr);
  report.size = 2;
  report.curve = 1;
  wsk_network_name_places(network, &report);
  CHECK(report.curve == 1);
  wsk_network_free(network);
}

TEST_CASE("sharp curves keep the normals of both sides when they are joined") {
  const Scene& scene = three_circles();
  std::vector<wsk_curve> curves = curves_of(scene);
  curves[0].sharp = 1;
  curves[0].normals_right = scene.curves[0].normals.data();
  wsk_network* network = nullptr;
  REQUIRE(wsk_connect(curves.data(), curves.size(), nullptr, &network, nullptr) == WSK_OK);
  wsk_network_view view;
  wsk_network_get_view(network, &view, sizeof view);
  size_t sharp = 0;
  for (uint32_t c = 0; c < view.curve_count; ++c) {
    const wsk_curve& curve = view.curves[c];
    if (curve.sharp == 0) continue;
    ++sharp;
    REQUIRE(curve.normals_right != nullptr);
    for (size_t i = 0; i < 3 * curve.sample_count; ++i) {
      CHECK(curve.normals_right[i] == curve.normals[i]);
    }
  }
  CHECK(sharp > 0);
  wsk_network_free(network);
}
