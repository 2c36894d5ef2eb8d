#include "golden/golden.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <iterator>

#include "support/scenes.h"

TEST_CASE("the reference scenes have the committed bits") {
  size_t found = 0;
  const std::vector<scenes::Scene> all = scenes::all();
  CHECK(all.size() >= 24);
  for (const scenes::Scene& scene : all) {
    CAPTURE(scene.name);
    const scenes::Result result = scenes::result_of(scene);
    REQUIRE(!result.triangles.empty());
    for (const Golden& golden : k_golden) {
      if (scene.name != golden.scene || scene.method != golden.method) continue;
      ++found;
      CHECK_MESSAGE(scenes::hash_of(result) == golden.hash, "the arrays now:\n"
                                                                << scenes::hashes_by_array(result));
    }
  }
  CHECK(found == all.size());
  CHECK(std::size(k_golden) == all.size());
}

TEST_CASE("the hash sees every array") {
  const std::vector<scenes::Scene> all = scenes::all();
  const auto creased = std::find_if(all.begin(), all.end(),
                                    [](const scenes::Scene& scene) { return scene.name == "box"; });
  REQUIRE(creased != all.end());
  const scenes::Result whole = scenes::result_of(*creased);
  const uint64_t hash = scenes::hash_of(whole);
  for (std::vector<double> scenes::Result::*array :
       {&scenes::Result::positions, &scenes::Result::normals, &scenes::Result::mean_curvature,
        &scenes::Result::constraint_normals, &scenes::Result::crease_normals}) {
    scenes::Result changed = whole;
    REQUIRE(!(changed.*array).empty());
    double& last = (changed.*array).back();
    last = last == 0.0 ? 5e-324 : -last;
    CHECK(scenes::hash_of(changed) != hash);
  }
  for (std::vector<uint32_t> scenes::Result::*array :
       {&scenes::Result::vertex_curve, &scenes::Result::triangles, &scenes::Result::triangle_patch,
        &scenes::Result::curve_edges, &scenes::Result::curve_edge_curve,
        &scenes::Result::crease_corners}) {
    scenes::Result changed = whole;
    REQUIRE(!(changed.*array).empty());
    (changed.*array).back() ^= 1;
    CHECK(scenes::hash_of(changed) != hash);
  }
}
