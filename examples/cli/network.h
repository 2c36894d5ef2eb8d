// A curve network as the readers hand it over: shared vertices, and curves that name them.
//
// Invariants after reading: normals is empty or as long as positions (three numbers a vertex);
// every index of a curve is below the number of vertices; a closed curve does not repeat its first
// vertex.
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
};

struct Network {
  std::vector<double> positions;
  std::vector<double> normals;
  std::vector<size_t> vertex_lines;  // where each vertex stands in the file, from 1
  std::vector<NetworkCurve> curves;
};

// A curve is closed if its first and last vertex are the same; the repeated one goes.
inline void close_if_first_is_last(NetworkCurve& curve) {
  std::vector<uint32_t>& vertices = curve.vertices;
  curve.closed = vertices.size() > 1 && vertices.front() == vertices.back();
  if (curve.closed) vertices.pop_back();
}

}  // namespace wireskin_cli
