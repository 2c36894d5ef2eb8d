#include "read_network.h"
#include "scan.h"

namespace wireskin_cli {

// What the lines read so far have said.
struct ObjState {
  Network network;
  bool under_boundary = false;
  bool under_sharp = false;
  size_t faces = 0;
  size_t freeform_curves = 0;
  size_t normals = 0;

  size_t vertex_count() const { return network.vertex_lines.size(); }
};

static void read_triple(const LineScanner& scanner, const char* things,
                        std::vector<double>& values) {
  const size_t given = scanner.columns().size() - 1;
  if (given < 3) {
    scanner.fail(std::to_string(given) + " " + things + " where 3 are needed");
  }
  // A weight or a colour may follow.
  for (size_t k = 1; k <= 3; ++k) values.push_back(scanner.number(k));
}

// Indices count from 1, or backwards from the last vertex so far; what follows a slash is texture.
// Those beyond the vertices so far may still come, so the end of the file checks them.
static uint32_t read_index(const LineScanner& scanner, size_t column, size_t vertex_count) {
  const std::string_view text = scanner.columns()[column];
  int64_t index = 0;
  const bool integer = parse_integer(text.substr(0, text.find('/')), &index);
  if (!integer || index == 0 || index > 0xfffffffell) {
    scanner.fail(in_quotes(text) + " is not a vertex index, which count from 1 in OBJ");
  }
  if (index > 0) return static_cast<uint32_t>(index - 1);
  if (-index > static_cast<int64_t>(vertex_count)) {
    scanner.fail("vertex index " + std::to_string(index) + " is out of range, only " +
                 std::to_string(vertex_count) + " vertices stand before it");
  }
  return static_cast<uint32_t>(static_cast<int64_t>(vertex_count) + index);
}

static void read_polyline(const LineScanner& scanner, ObjState& state) {
  NetworkCurve curve;
  curve.line = scanner.line();
  curve.boundary = state.under_boundary;
  curve.sharp = state.under_sharp;
  const size_t count = scanner.columns().size();
  if (count < 3) scanner.fail("a curve (l) needs at least two vertex indices");
  for (size_t k = 1; k < count; ++k) {
    curve.vertices.push_back(read_index(scanner, k, state.vertex_count()));
  }
  close_if_first_is_last(curve);
  state.network.curves.push_back(std::move(curve));
}

// The latest g or o names what follows.
static void read_name(const LineScanner& scanner, ObjState& state) {
  state.under_boundary = state.under_sharp = false;
  for (size_t k = 1; k < scanner.columns().size(); ++k) {
    const std::string name = lower_case(scanner.columns()[k]);
    if (name.find("boundary") != std::string::npos) state.under_boundary = true;
    if (name.find("sharp") != std::string::npos) state.under_sharp = true;
  }
}

static void read_statement(const LineScanner& scanner, ObjState& state) {
  const std::string_view keyword = scanner.columns()[0];
  if (keyword == "v") {
    read_triple(scanner, "coordinates", state.network.positions);
    state.network.vertex_lines.push_back(scanner.line());
  } else if (keyword == "vn") {
    read_triple(scanner, "components of a normal", state.network.normals);
    ++state.normals;
  } else if (keyword == "l") {
    read_polyline(scanner, state);
  } else if (keyword == "g" || keyword == "o") {
    read_name(scanner, state);
  } else if (keyword == "f") {
    ++state.faces;
  } else if (keyword == "curv") {
    ++state.freeform_curves;
  }
}

static void check_indices(const LineScanner& scanner, const ObjState& state) {
  for (const NetworkCurve& curve : state.network.curves) {
    for (const uint32_t vertex : curve.vertices) {
      if (vertex < state.vertex_count()) continue;
      scanner.fail_at(curve.line, "vertex index " + std::to_string(vertex + 1ull) +
                                      " is out of range, the file has " +
                                      std::to_string(state.vertex_count()) +
                                      " vertices, which count from 1 in OBJ");
    }
  }
}

static void check_whole(const std::string& file, const ObjState& state) {
  if (state.network.curves.empty()) {
    if (state.faces != 0) {
      throw Failure(file + ": a mesh (f) without curves: the curves must be given as l");
    }
    if (state.freeform_curves != 0) {
      throw Failure(file + ": free-form curves (curv) are not read: write them as polylines (l)");
    }
    throw Failure(file + ": no curve (l) in this file");
  }
  if (state.normals != 0 && state.normals != state.vertex_count()) {
    throw Failure(file + ": " + std::to_string(state.normals) + " normals (vn) for " +
                  std::to_string(state.vertex_count()) +
                  " vertices (v): each vertex needs one, in the same order");
  }
}

Network read_obj(const std::string& file, std::string_view text) {
  LineScanner scanner(file, text, true);
  ObjState state;
  while (scanner.next('#')) read_statement(scanner, state);
  check_indices(scanner, state);
  check_whole(file, state);
  return std::move(state.network);
}

}  // namespace wireskin_cli
