#include "cut.h"

#include <algorithm>
#include <fstream>
#include <locale>
#include <map>
#include <sstream>
#include <stdexcept>
#include <tuple>
#include <utility>

namespace networks {

static const uint32_t k_none = 0xffffffffu;

static uint32_t read_corner(const std::string& word, size_t vertex_count) {
  const long index = std::stol(word);  // stops at the slash
  const long count = static_cast<long>(vertex_count);
  const long vertex = index < 0 ? count + index : index - 1;
  if (vertex < 0 || vertex >= count) throw std::runtime_error("a face names no vertex: " + word);
  return static_cast<uint32_t>(vertex);
}

Mesh read_obj(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error(path + ": cannot be opened");
  file.imbue(std::locale::classic());
  Mesh mesh;
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    words.imbue(std::locale::classic());
    std::string word;
    words >> word;
    if (word == "v") {
      Point p;
      if (!(words >> p[0] >> p[1] >> p[2])) throw std::runtime_error(path + ": bad vertex " + line);
      mesh.positions.push_back(p);
    } else if (word == "f") {
      std::vector<uint32_t> corners;
      while (words >> word) corners.push_back(read_corner(word, mesh.positions.size()));
      for (size_t i = 2; i < corners.size(); ++i) {
        mesh.triangles.push_back({corners[0], corners[i - 1], corners[i]});
      }
    }
  }
  return mesh;
}

Mesh read_off(const std::string& path) {
  std::ifstream file(path);
  file.imbue(std::locale::classic());
  std::string magic;
  size_t vertices = 0, faces = 0, edges = 0;
  if (!(file >> magic >> vertices >> faces >> edges) || magic != "OFF") {
    throw std::runtime_error(path + ": no OFF file");
  }
  Mesh mesh;
  mesh.positions.resize(vertices);
  for (Point& p : mesh.positions) file >> p[0] >> p[1] >> p[2];
  for (size_t f = 0; f < faces && file; ++f) {
    size_t count = 0;
    file >> count;
    std::vector<uint32_t> corners(count < 1000 ? count : 0);
    for (uint32_t& corner : corners) {
      file >> corner;
      if (corner >= vertices) throw std::runtime_error(path + ": a face names no vertex");
    }
    for (size_t i = 2; i < corners.size(); ++i) {
      mesh.triangles.push_back({corners[0], corners[i - 1], corners[i]});
    }
  }
  if (!file) throw std::runtime_error(path + ": ends early");
  return mesh;
}

std::vector<Point> vertex_normals(const Mesh& mesh) {
  std::vector<Point> normals(mesh.positions.size(), Point{0.0, 0.0, 0.0});
  for (const auto& t : mesh.triangles) {
    for (size_t i = 0; i < 3; ++i) {
      const Point& p = mesh.positions[t[i]];
      const Point a = mesh.positions[t[(i + 1) % 3]] - p;
      const Point b = mesh.positions[t[(i + 2) % 3]] - p;
      const Point n = cross(a, b);
      normals[t[i]] = normals[t[i]] + std::atan2(length(n), dot(a, b)) * unit(n);
    }
  }
  for (Point& n : normals) n = unit(n);
  return normals;
}

// An undirected edge, low < high, and the triangles to its left seen from low and from high.
struct Edge {
  uint32_t low, high;
  uint32_t left = k_none, right = k_none;
};

struct Edges {
  std::vector<Edge> edges;
  std::vector<std::array<uint32_t, 3>> of_triangle;  // edge i is opposite corner i
};

static Edges find_edges(const Mesh& mesh) {
  Edges result;
  result.of_triangle.resize(mesh.triangles.size());
  std::map<std::pair<uint32_t, uint32_t>, uint32_t> known;
  for (uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    for (size_t i = 0; i < 3; ++i) {
      const uint32_t a = mesh.triangles[t][(i + 1) % 3];
      const uint32_t b = mesh.triangles[t][(i + 2) % 3];
      if (a == b) throw std::runtime_error("a triangle names a vertex twice");
      const auto next = static_cast<uint32_t>(result.edges.size());
      const auto [found, added] = known.insert({std::minmax(a, b), next});
      if (added) result.edges.push_back({std::min(a, b), std::max(a, b)});
      Edge& edge = result.edges[found->second];
      uint32_t& side = a < b ? edge.left : edge.right;
      if (side != k_none) throw std::runtime_error("the mesh is no oriented manifold");
      side = t;
      result.of_triangle[t][i] = found->second;
    }
  }
  return result;
}

class Cutter {
 public:
  Cutter(const Mesh& mesh, const std::vector<Plane>& planes)
      : mesh_(mesh), normals_(vertex_normals(mesh)), edges_(find_edges(mesh)) {
    Point low = {1e300, 1e300, 1e300};
    Point high = {-1e300, -1e300, -1e300};
    for (const Point& p : mesh.positions) {
      for (size_t k = 0; k < 3; ++k) {
        low[k] = std::min(low[k], p[k]);
        high[k] = std::max(high[k], p[k]);
      }
    }
    tiny_ = mesh.positions.empty() ? 0.0 : 1e-9 * distance(low, high);
    for (const Plane& plane : planes) add_heights(plane);
  }

  Network run() {
    for (uint32_t plane = 0; plane < heights_.size(); ++plane) cross_edges(plane);
    for (uint32_t plane = 0; plane < heights_.size(); ++plane) trace_plane(plane);
    trace_borders();
    for (Point& n : network_.normals) n = unit(n);
    return std::move(network_);
  }

 private:
  // Where a plane crosses an edge: the fraction from its low end, and the network's vertex.
  struct Crossing {
    double fraction;
    uint32_t vertex;
  };
  struct Chord {
    uint32_t triangle, from, to;  // edges
  };

  // Heights above the plane. Raised vertices are raised by another amount for each plane, so that
  // two planes through the same vertex still cross in one point.
  void add_heights(const Plane& plane) {
    const double scale = 1.0 / length(plane.normal);
    const double raised = tiny_ * (1.0 + 0.37 * static_cast<double>(heights_.size()));
    std::vector<double> heights;
    for (const Point& p : mesh_.positions) {
      const double height = scale * (dot(plane.normal, p) - plane.offset);
      heights.push_back(std::fabs(height) < tiny_ ? raised : height);
    }
    heights_.push_back(std::move(heights));
  }

  bool above(uint32_t plane, uint32_t vertex) const { return heights_[plane][vertex] > 0.0; }

  uint32_t add_vertex(const Point& position, const Point& normal) {
    network_.positions.push_back(position);
    network_.normals.push_back(normal);
    return static_cast<uint32_t>(network_.positions.size() - 1);
  }

  void cross_edges(uint32_t plane) {
    for (uint32_t e = 0; e < edges_.edges.size(); ++e) {
      const Edge& edge = edges_.edges[e];
      if (above(plane, edge.low) == above(plane, edge.high)) continue;
      const double low = heights_[plane][edge.low];
      const double t = low / (low - heights_[plane][edge.high]);
      const auto between = [&](const std::vector<Point>& values) {
        return (1.0 - t) * values[edge.low] + t * values[edge.high];
      };
      crossings_[{e, plane}] = {t, add_vertex(between(mesh_.positions), between(normals_))};
    }
  }

  // Whether the crossing of `plane` with edge e lies above plane `other`. On an edge that both
  // cross the order of the crossings decides, so both planes and both triangles get consistent
  // answers.
  bool crossing_above(uint32_t e, uint32_t plane, uint32_t other) const {
    const Edge& edge = edges_.edges[e];
    const auto also = crossings_.find({e, other});
    if (also == crossings_.end()) return above(other, edge.low);
    const double mine = crossings_.at({e, plane}).fraction;
    const double theirs = also->second.fraction;
    const bool before = mine < theirs || (mine == theirs && plane < other);
    return above(other, before ? edge.low : edge.high);
  }

  double height_of_crossing(uint32_t e, uint32_t plane, uint32_t other) const {
    const Edge& edge = edges_.edges[e];
    const double t = crossings_.at({e, plane}).fraction;
    return (1.0 - t) * heights_[other][edge.low] + t * heights_[other][edge.high];
  }

  // How far along the chord it meets plane `other`.
  double fraction_along(const Chord& chord, uint32_t plane, uint32_t other) const {
    const double from = height_of_crossing(chord.from, plane, other);
    const double to = height_of_crossing(chord.to, plane, other);
    // Rounding may give both ends the same side although the order on the edges says otherwise.
    if (from == to) return 0.5;
    return std::clamp(from / (from - to), 0.0, 1.0);
  }

  uint32_t node_at(const Chord& chord, uint32_t plane, uint32_t other, double fraction) {
    const auto key =
        std::make_tuple(chord.triangle, std::min(plane, other), std::max(plane, other));
    const auto known = nodes_.find(key);
    if (known != nodes_.end()) return known->second;
    const uint32_t a = crossings_.at({chord.from, plane}).vertex;
    const uint32_t b = crossings_.at({chord.to, plane}).vertex;
    const auto between = [&](const std::vector<Point>& values) {
      return (1.0 - fraction) * values[a] + fraction * values[b];
    };
    const Point position = between(network_.positions);
    // Three planes may meet in one point: then it is one node.
    const auto first = nodes_.lower_bound({chord.triangle, 0, 0});
    for (auto i = first; i != nodes_.end() && std::get<0>(i->first) == chord.triangle; ++i) {
      if (distance(network_.positions[i->second], position) < 100.0 * tiny_) {
        return nodes_[key] = i->second;
      }
    }
    return nodes_[key] = add_vertex(position, between(network_.normals));
  }

  // Appends the nodes inside the chord's triangle and the crossing at its far end.
  void follow(const Chord& chord, uint32_t plane, std::vector<uint32_t>& vertices) {
    std::vector<std::pair<double, uint32_t>> others;
    for (uint32_t other = 0; other < heights_.size(); ++other) {
      if (other == plane ||
          crossing_above(chord.from, plane, other) == crossing_above(chord.to, plane, other)) {
        continue;
      }
      others.push_back({fraction_along(chord, plane, other), other});
    }
    std::sort(others.begin(), others.end());
    for (const auto& [fraction, other] : others) {
      const uint32_t node = node_at(chord, plane, other, fraction);
      if (vertices.back() != node) vertices.push_back(node);
    }
    vertices.push_back(crossings_.at({chord.to, plane}).vertex);
  }

  // The chord of the plane in the triangle, from the given edge.
  Chord chord_in(uint32_t triangle, uint32_t plane, uint32_t from) const {
    for (uint32_t to : edges_.of_triangle[triangle]) {
      if (to != from && crossings_.count({to, plane}) != 0) return {triangle, from, to};
    }
    throw std::logic_error("a plane crosses a single edge of a triangle");
  }

  // The curve that enters `triangle` through edge `start`, to the border or back to the start. The
  // plane's upper side stays on one side of it, so it never meets itself.
  void walk(uint32_t plane, uint32_t start, uint32_t triangle, std::vector<bool>& done) {
    Network::Curve curve;
    curve.vertices.push_back(crossings_.at({start, plane}).vertex);
    uint32_t e = start;
    done[e] = true;
    while (triangle != k_none) {
      const Chord chord = chord_in(triangle, plane, e);
      follow(chord, plane, curve.vertices);
      e = chord.to;
      done[e] = true;
      if (e == start) break;
      const Edge& edge = edges_.edges[e];
      triangle = edge.left == triangle ? edge.right : edge.left;
    }
    curve.closed = e == start;
    if (curve.closed) curve.vertices.pop_back();
    network_.curves.push_back(std::move(curve));
  }

  void trace_plane(uint32_t plane) {
    std::vector<bool> done(edges_.edges.size(), false);
    for (const bool border : {true, false}) {
      for (uint32_t e = 0; e < edges_.edges.size(); ++e) {
        if (done[e] || crossings_.count({e, plane}) == 0) continue;
        const Edge& edge = edges_.edges[e];
        if (border && edge.left != k_none && edge.right != k_none) continue;
        walk(plane, e, edge.left != k_none ? edge.left : edge.right, done);
      }
    }
  }

  // The crossings on border edge e in the direction from vertex `from`.
  std::vector<uint32_t> crossings_from(uint32_t e, uint32_t from) const {
    std::vector<std::pair<double, uint32_t>> on_edge;
    for (auto i = crossings_.lower_bound({e, 0}); i != crossings_.end() && i->first.first == e;
         ++i) {
      on_edge.push_back({i->second.fraction, i->second.vertex});
    }
    std::sort(on_edge.begin(), on_edge.end());
    if (from != edges_.edges[e].low) std::reverse(on_edge.begin(), on_edge.end());
    std::vector<uint32_t> vertices;
    for (const auto& crossing : on_edge) vertices.push_back(crossing.second);
    return vertices;
  }

  // Cuts a border loop into curves at its corners; corners[i] speaks of vertices[i].
  void add_border(std::vector<uint32_t> vertices, std::vector<bool> corners) {
    const auto count = std::count(corners.begin(), corners.end(), true);
    if (count < 2) {
      network_.curves.push_back({std::move(vertices), true, true});
      return;
    }
    const auto first = std::find(corners.begin(), corners.end(), true) - corners.begin();
    std::rotate(vertices.begin(), vertices.begin() + first, vertices.end());
    std::rotate(corners.begin(), corners.begin() + first, corners.end());
    vertices.push_back(vertices[0]);
    corners.push_back(true);
    for (size_t i = 0; i < vertices.size(); ++i) {
      if (i != 0) network_.curves.back().vertices.push_back(vertices[i]);
      if (corners[i] && i + 1 < vertices.size()) {
        network_.curves.push_back({{vertices[i]}, false, true});
      }
    }
  }

  // `loop` holds the border edges in order, each with the mesh vertex that it starts from. Where a
  // plane passes through a border vertex, the crossing takes its place.
  void add_loop(const std::vector<std::pair<uint32_t, uint32_t>>& loop) {
    std::vector<uint32_t> vertices;
    std::vector<bool> corners;
    const auto at_back = [&](const Point& p) {
      return !vertices.empty() && distance(network_.positions[vertices.back()], p) < 100.0 * tiny_;
    };
    for (size_t i = 0; i < loop.size(); ++i) {
      const auto [e, from] = loop[i];
      const Point& here = mesh_.positions[from];
      const Point& before = mesh_.positions[loop[(i + loop.size() - 1) % loop.size()].second];
      const Point& after = mesh_.positions[loop[(i + 1) % loop.size()].second];
      const bool corner = dot(unit(here - before), unit(after - here)) < 0.766;  // cos 40 degrees
      if (at_back(here)) {
        corners.back() = corner;
      } else {
        vertices.push_back(add_vertex(here, normals_[from]));
        corners.push_back(corner);
      }
      for (uint32_t vertex : crossings_from(e, from)) {
        if (at_back(network_.positions[vertex])) {
          vertices.back() = vertex;
        } else {
          vertices.push_back(vertex);
          corners.push_back(false);
        }
      }
    }
    if (at_back(network_.positions[vertices.front()])) {
      vertices.front() = vertices.back();
      vertices.pop_back();
      corners.pop_back();
    }
    add_border(std::move(vertices), std::move(corners));
  }

  void trace_borders() {
    std::map<uint32_t, std::pair<uint32_t, uint32_t>> next;  // from a vertex: edge, other end
    for (uint32_t e = 0; e < edges_.edges.size(); ++e) {
      const Edge& edge = edges_.edges[e];
      if (edge.left != k_none && edge.right != k_none) continue;
      const bool forward = edge.left != k_none;
      const uint32_t from = forward ? edge.low : edge.high;
      if (!next.insert({from, {e, forward ? edge.high : edge.low}}).second) {
        throw std::runtime_error("two borders of the mesh meet in one vertex");
      }
    }
    while (!next.empty()) {
      std::vector<std::pair<uint32_t, uint32_t>> loop;
      uint32_t vertex = next.begin()->first;
      for (auto i = next.find(vertex); i != next.end(); i = next.find(vertex)) {
        loop.push_back({i->second.first, vertex});
        vertex = i->second.second;
        next.erase(i);
      }
      add_loop(loop);
    }
  }

  const Mesh& mesh_;
  std::vector<Point> normals_;
  Edges edges_;
  double tiny_ = 0.0;
  std::vector<std::vector<double>> heights_;
  std::map<std::pair<uint32_t, uint32_t>, Crossing> crossings_;  // by edge, plane
  std::map<std::tuple<uint32_t, uint32_t, uint32_t>, uint32_t> nodes_;
  Network network_;
};

static std::vector<bool> find_nodes(const Network& network) {
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
  return nodes;
}

static void thin_curve(const Network& network, const std::vector<bool>& is_node, double thin,
                       Network::Curve& curve) {
  std::vector<uint32_t> walk = curve.vertices;
  if (curve.closed) {
    const auto first =
        std::find_if(walk.begin(), walk.end(), [&](uint32_t v) { return is_node[v]; });
    std::rotate(walk.begin(), first == walk.end() ? walk.begin() : first, walk.end());
    walk.push_back(walk.front());
  }
  double total = 0.0;
  for (size_t i = 1; i < walk.size(); ++i) {
    total += distance(network.positions[walk[i - 1]], network.positions[walk[i]]);
  }
  const double least = thin * total / static_cast<double>(walk.size() - 1);
  std::vector<uint32_t> kept = {walk.front()};
  const auto near = [&](uint32_t v) {
    return distance(network.positions[kept.back()], network.positions[v]) < least;
  };
  for (size_t i = 1; i < walk.size(); ++i) {
    const uint32_t v = walk[i];
    if (is_node[v] || i + 1 == walk.size()) {
      while (kept.size() > 1 && !is_node[kept.back()] && near(v)) kept.pop_back();
      kept.push_back(v);
    } else if (!near(v)) {
      kept.push_back(v);
    }
  }
  if (curve.closed) kept.pop_back();
  curve.vertices = std::move(kept);
}

// Numbers the vertices in the order in which the curves use them and forgets the others.
static Network compact(const Network& network) {
  Network result;
  std::vector<uint32_t> number(network.positions.size(), k_none);
  for (Network::Curve curve : network.curves) {
    for (uint32_t& v : curve.vertices) {
      if (number[v] == k_none) {
        number[v] = static_cast<uint32_t>(result.positions.size());
        result.positions.push_back(network.positions[v]);
        result.normals.push_back(network.normals[v]);
      }
      v = number[v];
    }
    result.curves.push_back(std::move(curve));
  }
  return result;
}

Network cut(const Mesh& mesh, const std::vector<Plane>& planes, double thin) {
  Network network = Cutter(mesh, planes).run();
  const std::vector<bool> is_node = find_nodes(network);
  for (Network::Curve& curve : network.curves) thin_curve(network, is_node, thin, curve);
  return compact(network);
}

}  // namespace networks
