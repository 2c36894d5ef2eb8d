#include "trace.h"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>

namespace networks {

using Point2 = std::array<double, 2>;

// A stretch of curve from node to node, both included.
struct Segment {
  std::vector<uint32_t> vertices;
  bool boundary = false;
};

static std::vector<bool> find_nodes_to_trace(const Network& network) {
  std::vector<int> uses(network.positions.size(), 0);
  for (const Network::Curve& curve : network.curves) {
    for (uint32_t v : curve.vertices) ++uses[v];
    if (!curve.closed) {
      uses[curve.vertices.front()] = 2;
      uses[curve.vertices.back()] = 2;
    }
  }
  std::vector<bool> nodes;
  for (int count : uses) nodes.push_back(count > 1);
  // A closed curve that meets no other gets its first vertex as a node.
  for (const Network::Curve& curve : network.curves) {
    const auto is_node = [&](uint32_t v) { return nodes[v]; };
    if (std::none_of(curve.vertices.begin(), curve.vertices.end(), is_node)) {
      nodes[curve.vertices.front()] = true;
    }
  }
  return nodes;
}

static std::vector<Segment> split(const Network& network, const std::vector<bool>& is_node) {
  std::vector<Segment> segments;
  for (const Network::Curve& curve : network.curves) {
    std::vector<uint32_t> walk = curve.vertices;
    if (curve.closed) {
      const auto first =
          std::find_if(walk.begin(), walk.end(), [&](uint32_t v) { return is_node[v]; });
      std::rotate(walk.begin(), first, walk.end());
      walk.push_back(walk.front());
    }
    Segment segment{{walk[0]}, curve.boundary};
    for (size_t i = 1; i < walk.size(); ++i) {
      segment.vertices.push_back(walk[i]);
      if (!is_node[walk[i]]) continue;
      segments.push_back(segment);
      segment.vertices = {walk[i]};
    }
  }
  return segments;
}

// Half edge 2 s runs along segment s, half edge 2 s + 1 against it.
static uint32_t start_of(const std::vector<Segment>& segments, size_t half) {
  const auto& v = segments[half / 2].vertices;
  return half % 2 == 0 ? v.front() : v.back();
}

static double angle_of(const Network& network, const std::vector<Segment>& segments, size_t half) {
  const auto& v = segments[half / 2].vertices;
  const uint32_t from = half % 2 == 0 ? v[0] : v.back();
  const uint32_t to = half % 2 == 0 ? v[1] : v[v.size() - 2];
  const auto [e, f] = tangent_frame(network.normals[from]);
  const Point chord = network.positions[to] - network.positions[from];
  return std::atan2(dot(chord, f), dot(chord, e));
}

// For every half edge the next one of its cycle: from its twin clockwise round the node.
static std::vector<size_t> link_cycles(const Network& network,
                                       const std::vector<Segment>& segments) {
  struct Spoke {
    uint32_t node;
    double angle;
    size_t half;
    bool operator<(const Spoke& o) const {
      return std::tie(node, angle, half) < std::tie(o.node, o.angle, o.half);
    }
  };
  std::vector<Spoke> spokes;
  for (size_t half = 0; half < 2 * segments.size(); ++half) {
    spokes.push_back({start_of(segments, half), angle_of(network, segments, half), half});
  }
  std::sort(spokes.begin(), spokes.end());
  std::vector<size_t> next(spokes.size());
  for (size_t first = 0, last; first < spokes.size(); first = last) {
    for (last = first; last < spokes.size() && spokes[last].node == spokes[first].node;) ++last;
    for (size_t i = first; i < last; ++i) {
      const size_t clockwise = i == first ? last - 1 : i - 1;
      next[spokes[i].half ^ 1] = spokes[clockwise].half;
    }
  }
  return next;
}

static size_t count_components(const std::vector<Segment>& segments, size_t vertex_count) {
  std::vector<uint32_t> parent(vertex_count);
  std::iota(parent.begin(), parent.end(), 0u);
  const auto root = [&](uint32_t v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (const Segment& s : segments) parent[root(s.vertices.front())] = root(s.vertices.back());
  std::vector<uint32_t> roots;
  for (const Segment& s : segments) roots.push_back(root(s.vertices.front()));
  std::sort(roots.begin(), roots.end());
  return static_cast<size_t>(std::unique(roots.begin(), roots.end()) - roots.begin());
}

static double turn(const Point2& a, const Point2& b, const Point2& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

static bool boxes_apart(const Point2& a, const Point2& b, const Point2& c, const Point2& d) {
  for (size_t k = 0; k < 2; ++k) {
    if (std::max(a[k], b[k]) < std::min(c[k], d[k])) return true;
    if (std::max(c[k], d[k]) < std::min(a[k], b[k])) return true;
  }
  return false;
}

static bool segments_meet(const Point2& a, const Point2& b, const Point2& c, const Point2& d) {
  if (boxes_apart(a, b, c, d)) return false;
  return turn(a, b, c) * turn(a, b, d) <= 0.0 && turn(c, d, a) * turn(c, d, b) <= 0.0;
}

static bool is_simple(const std::vector<Point2>& polygon) {
  const size_t n = polygon.size();
  if (n < 3) return false;
  double area = 0.0;
  for (size_t i = 1; i + 1 < n; ++i) area += turn(polygon[0], polygon[i], polygon[i + 1]);
  if (area <= 0.0) return false;
  for (size_t i = 0; i < n; ++i) {
    for (size_t j = i + 2; j < n; ++j) {
      if (i == 0 && j + 1 == n) continue;
      if (segments_meet(polygon[i], polygon[i + 1], polygon[j], polygon[(j + 1) % n])) return false;
    }
  }
  return true;
}

static bool simple_along(const Network& network, const std::vector<uint32_t>& cycle,
                         const Point& direction) {
  const auto [e, f] = tangent_frame(unit(direction));
  std::vector<Point2> polygon;
  for (uint32_t v : cycle) {
    polygon.push_back({dot(network.positions[v], e), dot(network.positions[v], f)});
  }
  return is_simple(polygon);
}

static void judge(const Network& network, Patch& patch) {
  Point sum = {0.0, 0.0, 0.0};
  for (uint32_t v : patch.vertices) sum = sum + network.normals[v];
  patch.mean_normal = length(sum) / static_cast<double>(patch.vertices.size());
  const Point mean = unit(sum);
  patch.least_facing = 1.0;
  for (uint32_t v : patch.vertices) {
    patch.least_facing = std::min(patch.least_facing, dot(network.normals[v], mean));
  }
  patch.simple = simple_along(network, patch.vertices, mean);
  patch.robust = patch.simple;
  constexpr double k_slope = 0.0875;  // tan of 5 degrees
  for (const Point& side : tangent_frame(mean)) {
    for (const double slope : {k_slope, -k_slope}) {
      patch.robust = patch.robust && simple_along(network, patch.vertices, mean + slope * side);
    }
  }
}

Trace trace(const Network& network) {
  const std::vector<bool> is_node = find_nodes_to_trace(network);
  const std::vector<Segment> segments = split(network, is_node);
  const std::vector<size_t> next = link_cycles(network, segments);
  Trace result;
  result.nodes = static_cast<size_t>(std::count(is_node.begin(), is_node.end(), true));
  result.segments = segments.size();
  result.components = count_components(segments, network.positions.size());
  std::vector<bool> done(next.size(), false);
  for (size_t first = 0; first < next.size(); ++first) {
    Patch patch;
    bool inner = false;
    for (size_t half = first; !done[half]; half = next[half]) {
      done[half] = true;
      const Segment& segment = segments[half / 2];
      inner = inner || !segment.boundary;
      std::vector<uint32_t> run = segment.vertices;
      if (half % 2 != 0) std::reverse(run.begin(), run.end());
      patch.vertices.insert(patch.vertices.end(), run.begin(), run.end() - 1);
    }
    if (!inner) continue;
    judge(network, patch);
    result.patches.push_back(std::move(patch));
  }
  return result;
}

}  // namespace networks
