// Open surfaces whose border no one tagged.
#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "support/scenes.h"
#include "wireskin.h"

namespace {

constexpr double k_turn = 6.283185307179586;

scenes::Scene without_tags(scenes::Scene scene) {
  for (scenes::Curve& curve : scene.curves) curve.boundary = false;
  return scene;
}

// Flat circles round the z axis, normals up; or upright, normals outward.
scenes::Curve circle(double radius, double z, bool upright) {
  scenes::Curve curve;
  curve.closed = true;
  for (int k = 0; k < 48; ++k) {
    const double c = std::cos(k_turn * k / 48), s = std::sin(k_turn * k / 48);
    curve.positions.insert(curve.positions.end(), {radius * c, radius * s, z});
    curve.normals.insert(curve.normals.end(),
                         {upright ? c : 0.0, upright ? s : 0.0, upright ? 0.0 : 1.0});
    curve.nodes.push_back(WSK_NONE);
  }
  return curve;
}

struct Built {
  wsk_report report;
  scenes::Result result;

  Built(scenes::Scene scene, bool find_borders) {
    scene.find_borders = find_borders;
    wsk_surface* surface = nullptr;
    wsk_report_init(&report, sizeof report);
    scenes::run(scene, scenes::options_of(scene), &surface, &report);
    if (surface != nullptr) result = scenes::copy_of(surface);
    wsk_surface_free(surface);
  }
};

}  // namespace

TEST_CASE("found borders: the same surface as with tags, and an error without the option") {
  const scenes::Scene bare = without_tags(scenes::saddle());
  const Built tagged(scenes::saddle(), false), found(bare, true), neither(bare, false);
  REQUIRE(tagged.report.status == WSK_OK);
  REQUIRE_MESSAGE(found.report.status == WSK_OK, std::string(found.report.sentence));
  CHECK(tagged.report.found_borders == 0);
  CHECK(found.report.found_borders == 1);
  CHECK(found.report.boundary_loops == 1);
  CHECK(found.report.patches == tagged.report.patches);
  CHECK(found.report.segments == tagged.report.segments);
  CHECK(scenes::hash_of(found.result) == scenes::hash_of(tagged.result));
  CHECK(neither.report.status == WSK_ERROR_PATCH_WITHOUT_PLANE);
  CHECK(std::string(neither.report.sentence).find("clockwise") != std::string::npos);
}

TEST_CASE("found borders: nothing is left open on a closed surface") {
  const Built with(scenes::octants(), true), without(scenes::octants(), false);
  REQUIRE(with.report.status == WSK_OK);
  CHECK(with.report.found_borders == 0);
  CHECK(scenes::hash_of(with.result) == scenes::hash_of(without.result));
}

TEST_CASE("found borders: the inner one of two rings in a plane is a curve of the disc") {
  scenes::Scene rings;
  rings.curves = {circle(2.0, 0.0, false), circle(1.0, 0.0, false)};
  const Built b(rings, true);
  REQUIRE_MESSAGE(b.report.status == WSK_OK, std::string(b.report.sentence));
  CHECK(b.report.found_borders == 1);
  CHECK(b.report.patches == 2);
  CHECK(b.report.euler_characteristic == 1);
}

TEST_CASE("found borders: the ends of a tube do not tell, and stay closed") {
  scenes::Scene tube;
  tube.curves = {circle(1.0, -1.0, true), circle(1.0, 0.0, true), circle(1.0, 1.0, true)};
  const Built with(tube, true), without(tube, false);
  REQUIRE_MESSAGE(with.report.status == WSK_OK, std::string(with.report.sentence));
  CHECK(with.report.found_borders == 0);
  CHECK(scenes::hash_of(with.result) == scenes::hash_of(without.result));
}

TEST_CASE("found borders: a curve that only the outside holds is not lost without a word") {
  scenes::Scene scene = without_tags(scenes::saddle());
  scenes::Curve antenna;  // leaves the node at (1, 0, 1/2) to the outside
  const scenes::Curve* side = nullptr;
  for (const scenes::Curve& curve : scene.curves) {
    for (size_t i = 0; i < curve.size(); ++i) {
      const double* p = &curve.positions[3 * i];
      if (p[0] != 1.0 || p[1] != 0.0 || curve.nodes[i] == WSK_NONE) continue;
      side = &curve;
      antenna.positions = {p[0], p[1], p[2]};
      antenna.normals.assign(&curve.normals[3 * i], &curve.normals[3 * i] + 3);
      antenna.nodes = {curve.nodes[i]};
    }
  }
  REQUIRE(side != nullptr);
  for (int k = 1; k <= 4; ++k) {
    antenna.positions.insert(antenna.positions.end(), {1.0 + 0.1 * k, 0.0, 0.5 + 0.1 * k});
    for (int i = 0; i < 3; ++i) antenna.normals.push_back(antenna.normals[static_cast<size_t>(i)]);
    antenna.nodes.push_back(k == 4 ? 9999 : WSK_NONE);
  }
  const uint32_t own = static_cast<uint32_t>(scene.curves.size());
  scene.curves.push_back(antenna);
  const Built b(scene, true);
  CHECK(b.report.status == WSK_ERROR_OPEN_NETWORK);
  CHECK(b.report.curve == own);
  CHECK(b.report.sample == 0);
  CHECK(std::string(b.report.sentence) ==
        "this curve leads away from a border, out to where there is no surface");
  CHECK(b.report.found_borders == 0);
  // So it does where the border is tagged.
  scenes::Scene tagged = scenes::saddle();
  tagged.curves.push_back(antenna);
  const Built t(tagged, false);
  CHECK(t.report.status == WSK_ERROR_OPEN_NETWORK);
  CHECK(t.report.curve == own);
  CHECK(t.report.sample == 0);
  CHECK(std::string(t.report.sentence) ==
        "this curve leads away from a border, out to where there is no surface");
}
