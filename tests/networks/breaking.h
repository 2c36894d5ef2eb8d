// Networks broken on purpose, and what must come back: ends moved, curves cut in pieces and
// shuffled, directions reversed, samples thinned.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "raw.h"

namespace breaking {

using namespace networks;  // its operators on points are not found otherwise

inline Point point_at(const raw::Curve& curve, size_t i) {
  return {curve.positions[3 * i], curve.positions[3 * i + 1], curve.positions[3 * i + 2]};
}

inline void append(const raw::Curve& from, size_t i, raw::Curve* to) {
  to->positions.insert(to->positions.end(), &from.positions[3 * i], &from.positions[3 * i] + 3);
  if (!from.normals.empty()) {
    to->normals.insert(to->normals.end(), &from.normals[3 * i], &from.normals[3 * i] + 3);
  }
  to->nodes.push_back(from.nodes[i]);
}

inline double median_edge(const raw::Curves& curves) {
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

inline void forget_numbers(raw::Curves& curves) {
  for (raw::Curve& curve : curves) std::fill(curve.nodes.begin(), curve.nodes.end(), WSK_NONE);
}

inline void reverse(raw::Curve& curve) {
  raw::Curve other = curve;
  other.positions.clear(), other.normals.clear(), other.nodes.clear();
  for (size_t i = curve.size(); i-- > 0;) append(curve, i, &other);
  curve = other;
}

inline void reverse_some(raw::Curves& curves, Random& random) {
  for (raw::Curve& curve : curves) {
    if (random() < 0.0) reverse(curve);
  }
}

// Each curve into pieces of 4 to 24 edges; neighbours repeat the sample where they part.
inline raw::Curves in_pieces(const raw::Curves& curves, Random& random) {
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
inline void move_ends(raw::Curves& curves, double distance, Random& random) {
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
inline raw::Curves thinned(const raw::Curves& curves, size_t step, bool keep_nodes) {
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

inline Built build(const wsk_curve* curves, size_t count, double spacing) {
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

inline Built build(const raw::Curves& curves, double spacing) {
  const std::vector<wsk_curve> views = raw::views_of(curves);
  return build(views.data(), views.size(), spacing);
}

inline void check_same(const Built& whole, const Built& back, uint32_t corners) {
  INFO(back.sentence);
  CHECK(back.status == WSK_OK);
  // A cut at a corner of a curve leaves a node there, which makes one segment two.
  CHECK(back.nodes >= whole.nodes);
  CHECK(back.nodes <= whole.nodes + corners);
  CHECK(back.nodes - whole.nodes == back.segments - whole.segments);
  CHECK(back.patches == whole.patches);
  CHECK(back.euler == whole.euler);
}

inline void check_comes_back(const char* how, const raw::Curves& broken, double snap,
                             const Built& whole, double spacing, uint32_t corners = 0,
                             bool orient = false) {
  CAPTURE(std::string(how));
  const raw::Network network = raw::connect(broken, snap, WSK_CHAIN_AUTO, orient);
  REQUIRE(network != nullptr);
  const wsk_network_view view = raw::view_of(network);
  CHECK(view.after.dangling_ends == 0);
  CHECK(view.after.open_gaps == 0);
  check_same(whole, build(view.curves, view.curve_count, spacing), corners);
}

}  // namespace breaking
