// A curve network as the readers hand it over: vertices, and curves that name them.
//
// Invariants after reading: normals is empty or as long as positions (three numbers a vertex);
// has_normal, nodes and vertex_lines are empty or have one entry a vertex (vertex_lines always
// has); every index is below the number of vertices; a closed curve does not repeat its first
// vertex. Either raw_curves is empty or everything else is, the names of columns apart.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace wireskin_cli {

struct NetworkCurve {
  std::vector<uint32_t> vertices;
  bool closed = false;
  bool boundary = false;
  bool sharp = false;  // a crease; without normals, which its vertices have one of only
  size_t line = 0;     // of the file, from 1
  std::string name;    // what the file calls it, or ""
};

// What an instrument measures along a curve: no positions, these come by integration. `nodes` are
// positions in the list of samples where the curve meets others, `global_nodes` their names: equal
// names are one point. A closed curve ends where it began, with its first node once more.
struct RawCurve {
  bool closed = false;
  bool boundary = false;
  std::vector<uint32_t> nodes;  // from 0
  std::vector<uint32_t> global_nodes;
  std::vector<double> arc_lengths;
  std::vector<double> tangents;  // three a sample
  std::vector<double> normals;   // three a sample
  size_t line = 0;               // of the file, from 1
  std::vector<size_t> sample_lines;
};

struct Network {
  std::vector<double> positions;
  std::vector<double> normals;       // 0 0 0 where there is none
  std::vector<size_t> vertex_lines;  // where each vertex stands in the file, from 1
  std::vector<NetworkCurve> curves;
  // Empty: each vertex has a normal if `normals` is not empty, else none has.
  std::vector<uint8_t> has_normal;
  // Vertices with the same number are the same point. Empty: each is a point of its own.
  std::vector<uint32_t> nodes;
  // Vertices that the surface is to pass through though no curve does.
  std::vector<uint32_t> points;
  std::vector<RawCurve> raw_curves;
  std::vector<std::string> ignored_columns;  // of a table: named, but of no meaning here

  size_t vertex_count() const { return vertex_lines.size(); }
  bool normal_known(uint32_t vertex) const {
    return !normals.empty() && (has_normal.empty() || has_normal[vertex] != 0);
  }
};

// A curve is closed if its first and last vertex are the same; the repeated one goes.
inline void close_if_first_is_last(NetworkCurve& curve) {
  std::vector<uint32_t>& vertices = curve.vertices;
  curve.closed = vertices.size() > 1 && vertices.front() == vertices.back();
  if (curve.closed) vertices.pop_back();
}

// For files that give coordinates instead of indices: vertices whose coordinates are equal in every
// bit are the same point, and curves that end where they began are closed. Of vertices in a row at
// one point the first stays. Curves of a single vertex become points.
void identify_equal_positions(Network& network);

// Loops that bound faces, as curves. Where faces share edges a loop a face would give each such
// edge twice: then each edge becomes a curve of two vertices.
void add_faces(std::vector<NetworkCurve>&& loops, Network& network);

}  // namespace wireskin_cli
