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

namespace {

// Curves of a bumpy square: `across` lines each way that miss each other by `gap`, and in each cell
// a hole with `corners` straight sides that comes within `room` of the lines.
raw::Curves grid_with_holes(int across, double gap, int corners, double room, double turn) {
  raw::Curves curves;
  const auto add = [&curves](double x, double y, double off) {
    const double z = 0.2 * std::sin(3 * x) * std::cos(2 * y);
    Point normal = {-0.6 * std::cos(3 * x) * std::cos(2 * y),
                    0.4 * std::sin(3 * x) * std::sin(2 * y), 1.0};
    normal = (1.0 / networks::length(normal)) * normal;
    const Point at = Point{x, y, z} + off * normal;
    curves.back().positions.insert(curves.back().positions.end(), at.begin(), at.end());
    curves.back().normals.insert(curves.back().normals.end(), normal.begin(), normal.end());
    curves.back().nodes.push_back(WSK_NONE);
  };
  const int cells = across - 1, edges = 7 * cells;
  for (int line = 0; line < 2 * across; ++line) {
    const double at = static_cast<double>(line / 2) / cells;
    curves.push_back({});
    curves.back().boundary = line < 2 || line >= 2 * cells;
    for (int k = 0; k <= edges; ++k) {
      const double t = static_cast<double>(k) / edges;
      line % 2 == 0 ? add(at, t, 0.0) : add(t, at, gap);
    }
  }
  const double radius = 0.5 / cells - room;
  for (int cell = 0; cell < cells * cells; ++cell) {
    curves.push_back({});
    curves.back().boundary = curves.back().closed = true;
    const auto corner = [&](int k, double* x, double* y) {
      const double a = turn - 6.283185307179586 * k / corners;
      *x = (cell / cells + 0.5) / cells + radius * std::cos(a);
      *y = (cell % cells + 0.5) / cells + radius * std::sin(a);
    };
    const int steps = 24 / corners;
    for (int k = 0; k < corners * steps; ++k) {
      double ax, ay, bx, by;
      corner(k / steps, &ax, &ay), corner(k / steps + 1, &bx, &by);
      const double t = static_cast<double>(k % steps) / steps;
      add((1 - t) * ax + t * bx, (1 - t) * ay + t * by, 0.0);
    }
  }
  return curves;
}

}  // namespace

TEST_CASE("holes beside the borders of their patches stay holes, however near they are") {
  const int across = 7, cells = (across - 1) * (across - 1);
  Random random(7);
  for (const double gap : {0.0, 0.002, 0.008}) {
    for (const int corners : {3, 4, 6, 12}) {
      for (const double room : {0.0015, 0.006, 0.04}) {
        CAPTURE(gap);
        CAPTURE(corners);
        CAPTURE(room);
        const raw::Curves curves = grid_with_holes(across, gap, corners, room, 0.3 * random());
        for (const bool pieces : {false, true}) {
          const raw::Curves given = pieces ? in_pieces(curves, random) : curves;
          const raw::Network network = raw::connect(given, 0.012);
          const wsk_network_view view = raw::view_of(network);
          CHECK(view.after.components == 1u + static_cast<uint32_t>(cells));
          CHECK(view.after.open_gaps == 0);
          const Built built = build(view.curves, view.curve_count, 0.02);
          INFO(built.sentence);
          CHECK(built.status == WSK_OK);
          CHECK(built.patches == static_cast<uint32_t>(cells));
          CHECK(built.euler == 1 - cells);
        }
      }
    }
  }
}
