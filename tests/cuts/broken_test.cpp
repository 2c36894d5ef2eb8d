// Networks cut from measured meshes and broken on purpose: the same topology comes back. The files
// are found in the folder that WIRESKIN_TEST_DATA names.
#include "networks/breaking.h"

#include <doctest/doctest.h>

#include <cstdio>

#include "cuts/shapes.h"

using namespace breaking;

namespace {

struct Case {
  const char* file;
  std::vector<double> x, y, z;  // planes at these fractions of the bounding box
  bool near_borders = false;
};

const std::vector<double> k_three = {0.2517, 0.4931, 0.7483}, k_two = {0.3517, 0.6483};

const Case k_cases[] = {
    {"common-meshes/spot.obj", k_three, k_three, k_three},
    {"libigl-meshes/bumpy-cube.obj", k_three, k_three, k_three},
    {"libigl-meshes/3holes.off", {0.19, 0.41, 0.61, 0.83}, {0.19, 0.41, 0.61, 0.83}, k_two},
    {"libigl-meshes/3holes.off",
     {0.11, 0.29, 0.47, 0.67, 0.87},
     {0.11, 0.29, 0.47, 0.67, 0.87},
     {0.47}},
    {"libigl-meshes/fertility.off",
     {0.11, 0.29, 0.47, 0.67, 0.87},
     {0.11, 0.29, 0.47, 0.67, 0.87},
     {0.11, 0.29, 0.47, 0.67, 0.87}},
    {"pmp-meshes/hemisphere.off", k_three, k_three, {0.513}},
    {"common-meshes/beetle.obj", k_two, k_two, k_two, true},
    {"stability-networks/shell.obj", k_two, k_two, {}},
    {"stability-networks/half_sphere.obj", k_two, k_two, {}},
    {"stability-networks/hill.obj", k_three, k_two, {}},
    {"stability-networks/leaf.obj", k_three, k_two, {}},
};

raw::Curves curves_of(const Case& c, const std::string& path) {
  const Mesh mesh = cuts::read_mesh(path);
  return raw::curves_of(cut(mesh, cuts::planes_along_axes(mesh, c.x, c.y, c.z)));
}

// Whether the same topology comes back. Nodes in the middle of a curve may come and go, each with a
// segment: pieces are cut at corners, and curves one behind the other become one.
bool comes_back(const raw::Curves& broken, double snap, const Built& whole, double spacing) {
  const raw::Network network = raw::connect(broken, snap);
  const wsk_network_view view = raw::view_of(network);
  const Built back = build(view.curves, view.curve_count, spacing);
  return view.after.dangling_ends == 0 && view.after.open_gaps == 0 && back.status == WSK_OK &&
         back.nodes - whole.nodes == back.segments - whole.segments &&
         back.patches == whole.patches && back.euler == whole.euler;
}

// Which samples are nodes: where curves meet, and ends.
std::vector<std::vector<bool>> nodes_of(const raw::Curves& curves) {
  std::map<uint32_t, int> uses;
  for (const raw::Curve& curve : curves) {
    for (uint32_t node : curve.nodes) ++uses[node];
  }
  std::vector<std::vector<bool>> nodes;
  for (const raw::Curve& curve : curves) {
    nodes.emplace_back();
    for (size_t i = 0; i < curve.size(); ++i) {
      const bool end = !curve.closed && (i == 0 || i + 1 == curve.size());
      nodes.back().push_back(end || uses[curve.nodes[i]] > 1);
    }
  }
  return nodes;
}

// The shortest way along a curve from one node to the next.
double shortest_segment(const raw::Curves& curves) {
  const auto nodes = nodes_of(curves);
  double shortest = 1e300;
  for (size_t c = 0; c < curves.size(); ++c) {
    double length = 1e300;
    const size_t n = curves[c].size();
    for (size_t i = 0; i < (curves[c].closed ? 2 * n : n); ++i) {
      if (i > 0) length += distance(point_at(curves[c], (i - 1) % n), point_at(curves[c], i % n));
      if (!nodes[c][i % n]) continue;
      shortest = std::min(shortest, length);
      length = 0.0;
    }
  }
  return shortest;
}

double distance_to_edge(const Point& p, const Point& a, const Point& b) {
  const Point ab = b - a;
  const double t = dot(p - a, ab) / dot(ab, ab);
  return distance(p, a + std::clamp(t, 0.0, 1.0) * ab);
}

// How near stretches from node to node without a common node come to each other.
double least_gap(const raw::Curves& curves) {
  const auto nodes = nodes_of(curves);
  struct Stretch {
    std::vector<Point> points;
    uint32_t from = WSK_NONE, to = WSK_NONE;
  };
  std::vector<Stretch> stretches;
  for (size_t c = 0; c < curves.size(); ++c) {
    const size_t n = curves[c].size(), steps = curves[c].closed ? n + 1 : n;
    size_t first = 0;
    while (first < n && !nodes[c][first]) ++first;
    if (first == n) continue;
    for (size_t k = 0; k < steps; ++k) {
      const size_t i = (first + k) % n;
      if (k > 0) stretches.back().points.push_back(point_at(curves[c], i));
      if (!nodes[c][i]) continue;
      if (k > 0) stretches.back().to = curves[c].nodes[i];
      if (k + 1 < steps) stretches.push_back({{point_at(curves[c], i)}, curves[c].nodes[i], 0});
    }
  }
  double least = 1e300;
  for (const Stretch& a : stretches) {
    for (const Stretch& b : stretches) {
      if (a.from == b.from || a.from == b.to || a.to == b.from || a.to == b.to) continue;
      for (const Point& p : a.points) {
        for (size_t i = 1; i < b.points.size(); ++i) {
          least = std::min(least, distance_to_edge(p, b.points[i - 1], b.points[i]));
        }
      }
    }
  }
  return least;
}

// A fifth of the samples, but all nodes, and at least six between two of them where there were as
// many: fewer would no longer show what lies there.
raw::Curves thinned_between_nodes(const raw::Curves& curves) {
  constexpr size_t k_step = 5, k_least = 6;
  const auto nodes = nodes_of(curves);
  raw::Curves result;
  for (size_t c = 0; c < curves.size(); ++c) {
    const raw::Curve& curve = curves[c];
    const size_t n = curve.size();
    raw::Curve thin;
    thin.closed = curve.closed;
    thin.boundary = curve.boundary;
    size_t first = 0;
    while (first < n && !nodes[c][first]) ++first;
    if (first == n) first = 0;
    for (size_t i = 0; i < n;) {
      append(curve, (first + i) % n, &thin);
      size_t end = i + 1;
      while (end < n && !nodes[c][(first + end) % n]) ++end;
      const size_t inner = end - i - 1;
      const size_t kept = std::min(inner, std::max(k_least, inner / k_step));
      for (size_t k = 1; k <= kept; ++k) {
        append(curve, (first + i + k * (inner + 1) / (kept + 1)) % n, &thin);
      }
      i = end;
    }
    result.push_back(thin);
  }
  return result;
}

size_t samples_of(const raw::Curves& curves) {
  size_t count = 0;
  for (const raw::Curve& curve : curves) count += curve.size();
  return count;
}

}  // namespace

// The beetle is left out where a tolerance is needed: its borders come nearer to each other than
// its samples.
TEST_CASE("cut networks pass bit for bit") {
  for (const Case& c : k_cases) {
    const std::string path = accuracy::data_file(c.file);
    if (path.empty() || c.near_borders) continue;
    CAPTURE(std::string(c.file));
    const raw::Curves curves = curves_of(c, path);
    const raw::Network network = raw::connect(curves);
    CHECK(raw::view_of(network).snap_count == 0);
    CHECK(raw::same_curves(curves, raw::view_of(network)));
  }
}

// Ends are moved where curves and nodes leave them room for a quarter of a median edge.
TEST_CASE("cut networks broken on purpose come back") {
  // Two of the cuts of 3holes, which are dense, do not: at a node of curves that run almost along
  // each other the order changes where one of them was cut, and one end is not joined.
  constexpr int k_open = 2;
  int tried = 0, lost = 0;
  std::printf("%-36s %8s %8s %9s\n", "broken", "samples", "thinned", "tolerance");
  for (const Case& c : k_cases) {
    const std::string path = accuracy::data_file(c.file);
    if (path.empty()) continue;
    CAPTURE(std::string(c.file));
    const raw::Curves curves = curves_of(c, path);
    const double edge = median_edge(curves), spacing = 4.0 * edge;
    // Neither nodes nor curves that do not meet must come to each other.
    const double tolerance =
        std::min({edge, shortest_segment(curves) / 6.0, least_gap(curves) / 3.0});
    const bool has_room = tolerance > 0.25 * edge;
    const double touching = c.near_borders ? 1e-9 : 0.0;
    const raw::Curves thin = thinned_between_nodes(curves);
    std::printf("%-36s %8zu %8zu %8.3f of the median edge%s\n", c.file, samples_of(curves),
                samples_of(thin), tolerance / edge, has_room ? "" : ": ends not moved");
    const Built whole = build(curves, spacing);
    REQUIRE(whole.status == WSK_OK);
    const auto try_one = [&](const char* how, raw::Curves broken, double snap, Random& random) {
      forget_numbers(broken);
      reverse_some(broken, random);
      std::shuffle(broken.begin(), broken.end(), random.engine);
      ++tried;
      if (comes_back(broken, snap, whole, spacing)) return;
      ++lost;
      std::printf("%-36s %s: another topology came back\n", c.file, how);
    };
    for (uint32_t seed = 1; seed <= 3; ++seed) {
      Random random(seed);
      try_one("without numbers", curves, touching, random);
      const raw::Curves pieces = in_pieces(curves, random);
      try_one("in pieces", pieces, touching, random);
      try_one("thinned", thin, tolerance, random);
      if (!has_room) continue;
      raw::Curves apart = pieces;
      move_ends(apart, 0.45 * tolerance, random);
      try_one("ends moved", apart, tolerance, random);
    }
  }
  std::printf("%d of %d networks come back\n", tried - lost, tried);
  CHECK(lost <= k_open);
}
