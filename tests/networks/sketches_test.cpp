// The fifteen sketches of the literature: read, chained, snapped; what they were and what they
// are is printed as a table. They stand outside the repository.
#include <cstdio>
#include <filesystem>
#include <map>

#include "raw.h"

namespace {

const char* const k_sketches[] = {"bathtub",
                                  "box",
                                  "car",
                                  "car_1",
                                  "doghead",
                                  "ellipsetorus",
                                  "expresso_teaser_spoon",
                                  "guitar",
                                  "iron",
                                  "ok_hand",
                                  "phone_flowrep",
                                  "sewing_machine",
                                  "spaceship",
                                  "spherecylinder",
                                  "torus"};

void print_header() {
  std::printf("%-22s %-7s %7s %7s %5s %5s %5s %5s | %5s %5s %5s | %8s %8s\n", "sketch", "",
              "curves", "samples", "nodes", "ends", "comp", "gaps", "e-e", "e-i", "i-i", "tol/diag",
              "max/tol");
}

void print_counts(const char* name, const char* when, const wsk_network_counts& n) {
  std::printf("%-22s %-7s %7u %7u %5u %5u %5u %5u", name, when, n.curves, n.samples, n.nodes,
              n.dangling_ends, n.components, n.open_gaps);
}

double diagonal_of(const raw::Curves& curves) {
  networks::Point low = {1e300, 1e300, 1e300}, high = {-1e300, -1e300, -1e300};
  for (const raw::Curve& curve : curves) {
    for (size_t i = 0; i < curve.positions.size(); ++i) {
      low[i % 3] = std::fmin(low[i % 3], curve.positions[i]);
      high[i % 3] = std::fmax(high[i % 3], curve.positions[i]);
    }
  }
  return networks::distance(low, high);
}

void print_row(const char* name, const raw::Curves& curves, const wsk_network_view& view) {
  uint32_t kinds[3] = {};
  double greatest = 0.0;
  for (uint32_t k = 0; k < view.snap_count; ++k) {
    ++kinds[view.snaps[k].kind];
    greatest = std::fmax(greatest, view.snaps[k].distance);
  }
  print_counts(name, "before", view.before);
  std::printf(" |\n");
  print_counts("", "after", view.after);
  std::printf(" | %5u %5u %5u | %8.5f %8.3f\n", kinds[0], kinds[1], kinds[2],
              view.tolerance / diagonal_of(curves), greatest / view.tolerance);
}

// Every given sample that is left lies where it was.
bool positions_kept(const raw::Curves& curves, const wsk_network_view& view) {
  for (uint32_t c = 0; c < view.curve_count; ++c) {
    for (uint32_t i = 0; i < view.curves[c].sample_count; ++i) {
      const uint32_t k = view.first_sample[c] + i;
      const raw::Curve& from = curves[view.given_curve[k]];
      for (int x = 0; x < 3; ++x) {
        if (view.curves[c].positions[3 * i + static_cast<uint32_t>(x)] !=
            from.positions[3 * view.given_sample[k] + static_cast<uint32_t>(x)]) {
          return false;
        }
      }
    }
  }
  return true;
}

}  // namespace

TEST_CASE("sketches: counts before and after") {
  const std::string folder = std::string(WIRESKIN_TEST_DATA) + "/vns-sketches";
  if (!std::filesystem::exists(folder)) {
    MESSAGE("skipped: no vns-sketches under WIRESKIN_TEST_DATA");
    return;
  }
  print_header();
  for (const char* name : k_sketches) {
    CAPTURE(name);
    const raw::Curves curves = raw::read_obj_curves(folder + "/" + name + ".obj");
    const raw::Network network = raw::connect(curves);
    REQUIRE(network != nullptr);
    const wsk_network_view view = raw::view_of(network);
    print_row(name, curves, view);
    CHECK(view.after.dangling_ends <= view.before.dangling_ends);
    CHECK(view.after.open_gaps <= view.before.open_gaps);
    const std::string sketch = name;
    if (sketch == "doghead" || sketch == "phone_flowrep") {
      CHECK(view.snap_count == 0);
      CHECK(positions_kept(curves, view));
      CHECK(view.after.dangling_ends == 0);
      CHECK(view.after.components == 1);
    }
  }
}

// Those whose curves close bodies. The dog's ears part its inside in three; one wall there stays
// open.
TEST_CASE("sketches: bodies from curves alone") {
  struct Body {
    const char* name;
    uint32_t betti[3];
    uint32_t most_open;
  };
  const Body bodies[] = {{"box", {1, 0, 1}, 0},
                         {"doghead", {1, 0, 3}, 1},
                         {"ellipsetorus", {1, 0, 1}, 0},
                         {"phone_flowrep", {1, 0, 2}, 0},
                         {"sewing_machine", {1, 2, 1}, 0},
                         {"spherecylinder", {1, 0, 1}, 0},
                         {"torus", {1, 2, 1}, 0}};
  const std::string folder = std::string(WIRESKIN_TEST_DATA) + "/vns-sketches";
  if (!std::filesystem::exists(folder)) {
    MESSAGE("skipped: no vns-sketches under WIRESKIN_TEST_DATA");
    return;
  }
  for (const Body& body : bodies) {
    CAPTURE(body.name);
    const raw::Network network =
        raw::connect(raw::read_obj_curves(folder + "/" + body.name + ".obj"));
    REQUIRE(network != nullptr);
    const wsk_network_view curves = raw::view_of(network);
    wsk_flow* flow = nullptr;
    REQUIRE(wsk_flow_build(curves.curves, curves.curve_count, nullptr, nullptr, &flow, nullptr) ==
            WSK_OK);
    wsk_surface* surface = nullptr;
    REQUIRE(wsk_flow_surface(flow, nullptr, nullptr, &surface, nullptr) == WSK_OK);
    wsk_flow_view view;
    wsk_flow_get_view(flow, &view, sizeof view);
    for (int k = 0; k < 3; ++k) CHECK(static_cast<uint32_t>(view.betti[k]) == body.betti[k]);
    CHECK(view.open_patch_count <= body.most_open);
    CHECK(view.bare_count == 0);
    wsk_surface_free(surface);
    wsk_flow_free(flow);
  }
}
