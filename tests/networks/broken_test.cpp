// Networks broken on purpose come back: ends moved, curves cut in pieces and shuffled, directions
// reversed, samples thinned, signs of normals mixed. And what is whole stays as it is.
#include "breaking.h"
#include "closed_forms.h"
#include "io.h"

namespace {

using namespace breaking;

const char* const k_shipped[] = {"sphere.net",   "torus.net", "saddle.obj",
                                 "cylinder.net", "bumpy.net", "spot.net"};

raw::Curves shipped(const char* file) {
  return raw::curves_of(networks::read_network(std::string(NETWORKS_DATA) + "/" + file));
}

}  // namespace

TEST_CASE("connected networks pass bit for bit") {
  for (const char* file : k_shipped) {
    CAPTURE(std::string(file));
    const raw::Curves curves = shipped(file);
    for (const double snap : {0.0, -1.0, 0.02}) {
      const raw::Network network = raw::connect(curves, snap);
      const wsk_network_view view = raw::view_of(network);
      CHECK(raw::same_curves(curves, view));
      CHECK(view.snap_count == 0);
    }
    const raw::Network oriented = raw::connect(curves, 0.0, WSK_CHAIN_AUTO, true);
    CHECK(raw::same_curves(curves, raw::view_of(oriented)));
    CHECK(raw::view_of(oriented).contradiction_count == 0);
  }
}

TEST_CASE("broken networks come back") {
  for (const char* file : k_shipped) {
    CAPTURE(std::string(file));
    const raw::Curves curves = shipped(file);
    const double edge = median_edge(curves), spacing = 4.0 * edge;
    const Built whole = build(curves, spacing);
    REQUIRE(whole.status == WSK_OK);
    const uint32_t corners = std::string(file) == "spot.net" ? 5 : 0;  // it has turns of 60 degrees
    for (uint32_t seed = 1; seed <= 6; ++seed) {
      CAPTURE(seed);
      Random random(seed);
      // Loops without shared numbers that pass each other at common points.
      raw::Curves broken = curves;
      forget_numbers(broken);
      reverse_some(broken, random);
      std::shuffle(broken.begin(), broken.end(), random.engine);
      check_comes_back("without numbers", broken, 0.0, whole, spacing);
      // Pieces, first touching, then with gaps of up to the tolerance, automatic and given.
      raw::Curves pieces = in_pieces(curves, random);
      forget_numbers(pieces);
      reverse_some(pieces, random);
      check_comes_back("pieces", pieces, 0.0, whole, spacing, corners);
      raw::Curves apart = pieces;
      move_ends(apart, 0.45 * edge, random);
      check_comes_back("gaps", apart, 0.0, whole, spacing, corners);
      if (corners != 0) continue;  // its features are not wider than the gaps below
      apart = pieces;
      move_ends(apart, edge, random);
      check_comes_back("wide gaps", apart, 2.0 * edge, whole, spacing, 1);
    }
  }
}

TEST_CASE("samples thinned to a fifth, numbers lost") {
  for (const char* file : k_shipped) {
    CAPTURE(std::string(file));
    const raw::Curves curves = shipped(file);
    const double spacing = 4.0 * median_edge(curves);
    const Built whole = build(curves, spacing);
    for (uint32_t seed = 1; seed <= 4; ++seed) {
      CAPTURE(seed);
      Random random(seed);
      // A fifth of its samples would no longer show the cow's horns, and its curves are polygons:
      // between their samples they do not meet.
      const bool cow = std::string(file) == "spot.net";
      raw::Curves broken = thinned(curves, cow ? 2 : 5, cow);
      forget_numbers(broken);
      reverse_some(broken, random);
      std::shuffle(broken.begin(), broken.end(), random.engine);
      check_comes_back("thinned", broken, 0.0, whole, spacing);
    }
  }
}

TEST_CASE("signs of normals mixed") {
  for (const char* file : k_shipped) {
    CAPTURE(std::string(file));
    const raw::Curves curves = shipped(file);
    for (uint32_t seed = 1; seed <= 4; ++seed) {
      CAPTURE(seed);
      Random random(seed);
      raw::Curves mixed = curves;
      for (raw::Curve& curve : mixed) {
        for (size_t i = 0; i < curve.normals.size(); i += 3) {
          if (random() > -0.6) continue;  // a fifth of them, so the majority decides
          for (size_t x = 0; x < 3; ++x) curve.normals[i + x] = -curve.normals[i + x];
        }
      }
      const raw::Network network = raw::connect(mixed, 0.0, WSK_CHAIN_AUTO, true);
      CHECK(raw::same_curves(curves, raw::view_of(network)));
      CHECK(raw::view_of(network).contradiction_count == 0);
      CHECK(raw::view_of(network).turned_normals > 0);
    }
  }
}

TEST_CASE("half of the signs wrong: the outer side is away from the middle") {
  const raw::Curves curves = shipped("sphere.net");
  raw::Curves mixed = curves;
  for (raw::Curve& curve : mixed) {
    for (size_t i = 0; i < curve.normals.size(); ++i) {
      if (i / 3 % 2 == 0) curve.normals[i] = -curve.normals[i];
    }
  }
  const raw::Network network = raw::connect(mixed, 0.0, WSK_CHAIN_AUTO, true);
  CHECK(raw::same_curves(curves, raw::view_of(network)));
}

TEST_CASE("normals at every tenth sample are filled in") {
  const raw::Curves curves = shipped("sphere.net");
  raw::Curves sparse = curves;
  for (raw::Curve& curve : sparse) {
    for (size_t i = 0; i < curve.normals.size(); ++i) {
      if (i / 3 % 10 != 3) curve.normals[i] = 0.0;
    }
  }
  const raw::Network network = raw::connect(sparse);
  const wsk_network_view view = raw::view_of(network);
  REQUIRE(view.curve_count == curves.size());
  CHECK(view.curves_without_normals == 0);
  CHECK(view.filled_normals > 0);
  double worst = 0.0;
  for (size_t c = 0; c < curves.size(); ++c) {
    for (size_t k = 0; k < curves[c].normals.size(); ++k) {
      worst = std::fmax(worst, std::fabs(view.curves[c].normals[k] - curves[c].positions[k]));
    }
  }
  CHECK(worst < 1e-12);  // on the unit sphere the normal is the point
}
