// Networks broken on purpose come back: ends moved, curves cut in pieces and shuffled, directions
// reversed, samples thinned, signs of normals mixed. And what is whole stays as it is.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <random>

#include "closed_forms.h"
#include "io.h"
#include "raw.h"

namespace {

using namespace networks;  // its operators on points are not found otherwise

const char* const k_shipped[] = {"sphere.net",   "torus.net", "saddle.obj",
                                 "cylinder.net", "bumpy.net", "spot.net"};

raw::Curves shipped(const char* file) {
  return raw::curves_of(networks::read_network(std::string(NETWORKS_DATA) + "/" + file));
}

Point point_at(const raw::Curve& curve, size_t i) {
  return {curve.positions[3 * i], curve.positions[3 * i + 1], curve.positions[3 * i + 2]};
}

void append(const raw::Curve& from, size_t i, raw::Curve* to) {
  to->positions.insert(to->positions.end(), &from.positions[3 * i], &from.positions[3 * i] + 3);
  if (!from.normals.empty()) {
    to->normals.insert(to->normals.end(), &from.normals[3 * i], &from.normals[3 * i] + 3);
  }
  to->nodes.push_back(from.nodes[i]);
}

double median_edge(const raw::Curves& curves) {
  std::vector<double> lengths;
  for (const raw::Curve& curve : curves) {
    for (size_t i = 1; i < curve.size(); ++i) {
      lengths.push_back(networks::distance(point_at(curve, i - 1), point_at(curve, i)));
    }
  }
  std::nth_element(lengths.begin(), lengths.begin() + static_cast<long>(lengths.size() / 2),
                   lengths.end());
  return lengths[lengths.size() / 2];
}

struct Random {
  std::mt19937 engine;
  explicit Random(uint32_t seed) : engine(seed) {}
  double operator()() { return engine() / 2147483648.0 - 1.0; }
  size_t below(size_t n) { return engine() % n; }
};

// ---- What is done to networks -------------------------------------------------------------------

void forget_numbers(raw::Curves& curves) {
  for (raw::Curve& curve : curves) std::fill(curve.nodes.begin(), curve.nodes.end(), WSK_NONE);
}

void reverse(raw::Curve& curve) {
  raw::Curve other = curve;
  other.positions.clear(), other.normals.clear(), other.nodes.clear();
  for (size_t i = curve.size(); i-- > 0;) append(curve, i, &other);
  curve = other;
}

void reverse_some(raw::Curves& curves, Random& random) {
  for (raw::Curve& curve : curves) {
    if (random() < 0.0) reverse(curve);
  }
}

// Each curve into pieces of 4 to 24 edges; neighbours repeat the sample where they part.
raw::Curves in_pieces(const raw::Curves& curves, Random& random) {
  raw::Curves pieces;
  for (const raw::Curve& curve : curves) {
    const size_t edges = curve.size() - (curve.closed ? 0 : 1);
    for (size_t at = 0; at < edges;) {
      size_t end = at + 4 + random.below(21);
      if (end + 4 > edges) end = edges;
      raw::Curve piece;
      piece.boundary = curve.boundary;
      for (size_t i = at; i <= end; ++i) append(curve, i % curve.size(), &piece);
      pieces.push_back(piece);
      at = end;
    }
  }
  std::shuffle(pieces.begin(), pieces.end(), random.engine);
  return pieces;
}

// Every end goes somewhere within `distance`, and its curve with it, fading out.
void move_ends(raw::Curves& curves, double distance, Random& random) {
  for (raw::Curve& curve : curves) {
    if (curve.closed) continue;
    for (int end = 0; end < 2; ++end) {
      Point shift = {random(), random(), random()};
      shift = (distance * std::fabs(random()) / networks::length(shift)) * shift;
      const size_t n = curve.size(), fade = std::min<size_t>(n - 1, 8);
      for (size_t k = 0; k < fade; ++k) {
        const size_t i = end == 0 ? k : n - 1 - k;
        const double part = 1.0 - static_cast<double>(k) / static_cast<double>(fade);
        for (size_t x = 0; x < 3; ++x) {
          curve.positions[3 * i + x] += part * part * (3 - 2 * part) * shift[x];
        }
      }
    }
  }
}

// Every step-th sample, the last, and the nodes if they are to be kept.
raw::Curves thinned(const raw::Curves& curves, size_t step, bool keep_nodes) {
  std::map<uint32_t, int> uses;
  for (const raw::Curve& curve : curves) {
    for (uint32_t node : curve.nodes) ++uses[node];
  }
  raw::Curves result;
  for (const raw::Curve& curve : curves) {
    raw::Curve thin;
    thin.closed = curve.closed;
    thin.boundary = curve.boundary;
    for (size_t i = 0; i < curve.size(); ++i) {
      const bool last = !curve.closed && i + 1 == curve.size();
      if (i % step == 0 || last || (keep_nodes && uses[curve.nodes[i]] > 1))
        append(curve, i, &thin);
    }
    result.push_back(thin);
  }
  return result;
}

// ---- What comes back ----------------------------------------------------------------------------

struct Built {
  wsk_status status = WSK_OK;
  std::string sentence;
  uint32_t nodes = 0, segments = 0, patches = 0;
  int32_t euler = 0;
};

Built build(const wsk_curve* curves, size_t count, double spacing) {
  wsk_options options;
  wsk_options_init(&options, sizeof options);
  options.method = WSK_METHOD_BIHARMONIC;
  options.spacing = spacing;
  wsk_report report;
  wsk_report_init(&report, sizeof report);
  wsk_surface* surface = nullptr;
  Built built;
  built.status = wsk_build(curves, count, &options, &surface, &report);
  wsk_surface_free(surface);
  built.sentence = report.sentence;
  built.nodes = report.nodes;
  built.segments = report.segments;
  built.patches = report.patches;
  built.euler = report.euler_characteristic;
  return built;
}

Built build(const raw::Curves& curves, double spacing) {
  const std::vector<wsk_curve> views = raw::views_of(curves);
  return build(views.data(), views.size(), spacing);
}

void check_same(const Built& whole, const Built& back, uint32_t corners) {
  INFO(back.sentence);
  CHECK(back.status == WSK_OK);
  // A cut at a corner of a curve leaves a node there, which makes one segment two.
  CHECK(back.nodes >= whole.nodes);
  CHECK(back.nodes <= whole.nodes + corners);
  CHECK(back.nodes - whole.nodes == back.segments - whole.segments);
  CHECK(back.patches == whole.patches);
  CHECK(back.euler == whole.euler);
}

void check_comes_back(const char* how, const raw::Curves& broken, double snap, const Built& whole,
                      double spacing, uint32_t corners = 0, bool orient = false) {
  CAPTURE(std::string(how));
  const raw::Network network = raw::connect(broken, snap, WSK_CHAIN_AUTO, orient);
  REQUIRE(network != nullptr);
  const wsk_network_view view = raw::view_of(network);
  CHECK(view.after.dangling_ends == 0);
  CHECK(view.after.open_gaps == 0);
  check_same(whole, build(view.curves, view.curve_count, spacing), corners);
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
