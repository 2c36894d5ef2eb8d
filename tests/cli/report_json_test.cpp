#include "report_json.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "cli/json.h"

using namespace wireskin_cli;
using namespace cli_test;

static wsk_report filled_report() {
  wsk_report report;
  wsk_report_init(&report, sizeof report);
  report.status = WSK_OK;
  report.stage = WSK_STAGE_RESULT;
  report.sentence = "";
  report.curves = 3;
  report.nodes = 6;
  report.segments = 12;
  report.patches = 8;
  report.vertices = 1000;
  report.free_vertices = 900;
  report.triangles = 1996;
  report.components = 1;
  report.boundary_loops = 0;
  report.euler_characteristic = -2;
  report.spacing = 0.03125;
  report.min_angle_deg = 31.5;
  report.residual = 1e-14;
  report.peak_bytes = 5000000000u;
  for (int i = 0; i < WSK_STAGE_COUNT; ++i) report.stage_ms[i] = 0.5 * i;
  report.total_ms = 14.0;
  return report;
}

TEST_CASE("every value under its name") {
  Arguments arguments;
  arguments.input = "a \"b\"\\c.net";
  arguments.outputs = {"x.ply"};
  wsk_surface_view surface = {};
  const uint8_t guarded[] = {0, 1, 0, 0, 1, 0, 0, 0};
  surface.patch_count = 8;
  surface.patch_guarded = guarded;
  auto values = JsonReader(report_json({arguments, filled_report(), &surface})).values;
  CHECK(values["guarded_patch_list.length"] == "2");
  CHECK(values["guarded_patch_list.0"] == "1");
  CHECK(values["guarded_patch_list.1"] == "4");
  CHECK(values["version"] == wsk_version_string());
  CHECK(values["input"] == arguments.input);
  CHECK(values["output"] == "x.ply");
  CHECK(values["method"] == "fair");
  CHECK(values["status"] == "ok");
  CHECK(values["stage"] == "result");
  CHECK(values["sentence"] == "null");
  CHECK(values["place"] == "null");
  CHECK(values["curves"] == "3");
  CHECK(values["nodes"] == "6");
  CHECK(values["segments"] == "12");
  CHECK(values["patches"] == "8");
  CHECK(values["vertices"] == "1000");
  CHECK(values["free_vertices"] == "900");
  CHECK(values["triangles"] == "1996");
  CHECK(values["components"] == "1");
  CHECK(values["boundary_loops"] == "0");
  CHECK(values["euler_characteristic"] == "-2");
  CHECK(values["spacing"] == "0.03125");
  CHECK(values["min_angle_deg"] == "31.5");
  CHECK(values["residual"] == "1e-14");
  CHECK(values["peak_bytes"] == "5000000000");
  CHECK(values["stage_ms.input"] == "0");
  CHECK(values["stage_ms.factor"] == "2.5");
  CHECK(values["stage_ms.result"] == "3.5");
  CHECK(values["total_ms"] == "14");
}

TEST_CASE("patches that are special are listed") {
  CHECK(JsonReader(report_json({Arguments(), filled_report()})).values["special_patches.length"] ==
        "0");
  wsk_surface_view surface = {};
  const uint8_t way[] = {WSK_PATCH_PLANE, WSK_PATCH_MINIMAL_AREA, WSK_PATCH_PLANE};
  const wsk_status status[] = {WSK_OK, WSK_OK, WSK_ERROR_PATCH_FOLDED};
  const char* const sentence[] = {"", "", "it crosses itself"};
  const uint32_t start[] = {0, 2, 3, 5}, curve[] = {0, 1, 1, 2, 7};
  surface.patch_count = 3;
  surface.patch_way = way;
  surface.patch_status = status;
  surface.patch_sentence = sentence;
  surface.patch_curve_start = start;
  surface.patch_curves = curve;
  auto values = JsonReader(report_json({Arguments(), filled_report(), &surface})).values;
  CHECK(values["special_patches.length"] == "2");
  CHECK(values["special_patches.0.patch"] == "1");
  CHECK(values["special_patches.0.way"] == "minimal_area");
  CHECK(values["special_patches.0.curves.0"] == "1");
  CHECK(values["special_patches.1.patch"] == "2");
  CHECK(values["special_patches.1.status"] == "patch_folded");
  CHECK(values["special_patches.1.sentence"] == "it crosses itself");
  CHECK(values["special_patches.1.curves.length"] == "2");
  CHECK(values["special_patches.1.curves.1"] == "7");
}

TEST_CASE("a failure with its place") {
  wsk_report report = filled_report();
  report.status = WSK_ERROR_ZERO_NORMAL;
  report.stage = WSK_STAGE_INPUT;
  report.sentence = "the normal has zero length";
  report.curve = 3;
  report.sample = 0;
  auto values = JsonReader(report_json({Arguments(), report})).values;
  CHECK(values["guarded_patch_list.length"] == "0");
  CHECK(values["status"] == "zero_normal");
  CHECK(values["stage"] == "input");
  CHECK(values["sentence"] == "the normal has zero length");
  CHECK(values["place.curve"] == "3");
  CHECK(values["place.sample"] == "0");
  CHECK(values["place.node"] == "null");
  CHECK(values["place.patch"] == "null");
}

TEST_CASE("an input that could not be read, with its line") {
  Arguments arguments;
  arguments.input = "a.csv";
  const ReadFailure failure(k_malformed, "a.csv", 7, "\"x\" is not a number");
  auto values = JsonReader(read_failure_json(arguments, failure)).values;
  CHECK(values["status"] == "malformed");
  CHECK(values["stage"] == "reading");
  CHECK(values["sentence"] == "\"x\" is not a number");
  CHECK(values["place.line"] == "7");
  CHECK(values["place.curve"] == "null");
  CHECK(values["curves"] == "0");
  const ReadFailure whole(k_cannot_read, "a.csv", 0, "there is no such file");
  values = JsonReader(read_failure_json(arguments, whole)).values;
  CHECK(values["status"] == "cannot_read");
  CHECK(values["place"] == "null");
}

TEST_CASE("numbers that JSON cannot hold become null") {
  wsk_report report = filled_report();
  report.spacing = std::nan("");
  report.residual = std::numeric_limits<double>::infinity();
  report.stage_ms[0] = -report.residual;
  auto values = JsonReader(report_json({Arguments(), report})).values;
  CHECK(values["spacing"] == "null");
  CHECK(values["residual"] == "null");
  CHECK(values["stage_ms.input"] == "null");
}

TEST_CASE("strings of any bytes") {
  CHECK(json_string("a\tb\n\x1f") == "\"a\\u0009b\\u000a\\u001f\"");
  CHECK(json_string("gr\xc3\xbc\xc3\x9f \xe2\x82\xac \xf0\x9f\x98\x80") ==
        "\"gr\xc3\xbc\xc3\x9f \xe2\x82\xac \xf0\x9f\x98\x80\"");
  // A lone byte, a cut sequence, an overlong form, a surrogate, beyond the last character.
  CHECK(json_string("\xff") == "\"\\ufffd\"");
  CHECK(json_string("\xe2\x82") == "\"\\ufffd\\ufffd\"");
  CHECK(json_string("\xc0\x80") == "\"\\ufffd\\ufffd\"");
  CHECK(json_string("\xed\xa0\x80") == "\"\\ufffd\\ufffd\\ufffd\"");
  CHECK(json_string("\xf4\x90\x80\x80") == "\"\\ufffd\\ufffd\\ufffd\\ufffd\"");
}
