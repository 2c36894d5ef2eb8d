#include <algorithm>

#include "obj_freeform.h"
#include "read_network.h"
#include "scan.h"

namespace wireskin_cli {

constexpr uint32_t k_none = 0xffffffffu;

// "f 3//7" says that vertex 3 has normal 7.
struct NamedNormal {
  uint32_t vertex;
  uint32_t normal;
  size_t line;
};

// What the lines read so far have said.
struct ObjState {
  Network network;
  std::string name;
  bool under_boundary = false;
  bool under_sharp = false;
  std::vector<NetworkCurve> faces;
  bool has_large_face = false;
  std::vector<double> normals;  // as the vn lines give them
  std::vector<NamedNormal> named_normals;
  FreeformReader freeform;

  size_t vertex_count() const { return network.vertex_count(); }
  size_t normal_count() const { return normals.size() / 3; }
};

static void read_triple(const LineScanner& scanner, const char* things,
                        std::vector<double>& values) {
  const size_t given = scanner.columns().size() - 1;
  if (given < 3) {
    scanner.fail(std::to_string(given) + " " + things + " where 3 are needed");
  }
  for (size_t k = 1; k <= 3; ++k) values.push_back(scanner.number(k));
}

static void read_vertex(const LineScanner& scanner, ObjState& state) {
  read_triple(scanner, "coordinates", state.network.positions);
  state.network.vertex_lines.push_back(scanner.line());
  // A single fourth number is the weight; three more are a colour.
  const bool weighted = scanner.columns().size() == 5;
  state.freeform.add_weight(weighted ? scanner.number(4) : 1.0);
}

// Indices count from 1, or backwards from the last one so far. Those beyond the ones so far may
// still come, so the end of the file checks them.
static uint32_t resolve_index(const LineScanner& scanner, std::string_view text, size_t count,
                              const std::string& thing) {
  int64_t index = 0;
  const bool integer = parse_integer(text, &index);
  if (!integer || index == 0 || index > 0xfffffffell) {
    scanner.fail(in_quotes(text) + " is not a " + thing + " index, which count from 1 in OBJ");
  }
  if (index > 0) return static_cast<uint32_t>(index - 1);
  if (index < -static_cast<int64_t>(count)) {
    const char* things = thing == "vertex" ? "vertices" : "normals";
    scanner.fail(thing + " index " + std::to_string(index) + " is out of range, only " +
                 std::to_string(count) + " " + things + " stand before it");
  }
  return static_cast<uint32_t>(static_cast<int64_t>(count) + index);
}

// "vertex", "vertex/texture", "vertex//normal" or "vertex/texture/normal".
static uint32_t read_corner(const LineScanner& scanner, size_t column, ObjState& state) {
  const std::string_view text = scanner.columns()[column];
  const size_t slash = text.find('/');
  if (slash == 0) resolve_index(scanner, text, 0, "vertex");  // fails, and quotes all of it
  const uint32_t vertex =
      resolve_index(scanner, text.substr(0, slash), state.vertex_count(), "vertex");
  if (slash == std::string_view::npos) return vertex;
  const size_t second = text.find('/', slash + 1);
  if (second == std::string_view::npos || second + 1 == text.size()) return vertex;
  const uint32_t normal =
      resolve_index(scanner, text.substr(second + 1), state.normal_count(), "normal");
  state.named_normals.push_back({vertex, normal, scanner.line()});
  return vertex;
}

static NetworkCurve read_corners(const LineScanner& scanner, size_t first, ObjState& state) {
  NetworkCurve curve;
  curve.line = scanner.line();
  curve.name = state.name;
  curve.boundary = state.under_boundary;
  curve.sharp = state.under_sharp;
  for (size_t k = first; k < scanner.columns().size(); ++k) {
    curve.vertices.push_back(read_corner(scanner, k, state));
  }
  return curve;
}

static void read_polyline(const LineScanner& scanner, ObjState& state) {
  if (scanner.columns().size() < 3) scanner.fail("a curve (l) needs at least two vertex indices");
  NetworkCurve curve = read_corners(scanner, 1, state);
  close_if_first_is_last(curve);
  state.network.curves.push_back(std::move(curve));
}

static void read_face(const LineScanner& scanner, ObjState& state) {
  if (scanner.columns().size() < 4) scanner.fail("a face (f) needs at least three vertex indices");
  NetworkCurve loop = read_corners(scanner, 1, state);
  loop.closed = true;
  state.has_large_face = state.has_large_face || loop.vertices.size() > 3;
  state.faces.push_back(std::move(loop));
}

static void read_points(const LineScanner& scanner, ObjState& state) {
  const NetworkCurve points = read_corners(scanner, 1, state);
  std::vector<uint32_t>& all = state.network.points;
  all.insert(all.end(), points.vertices.begin(), points.vertices.end());
}

static void read_freeform_curve(const LineScanner& scanner, ObjState& state) {
  if (scanner.columns().size() < 5) {
    scanner.fail("a curve (curv) needs its range and at least two vertex indices");
  }
  state.freeform.begin_curve(scanner, read_corners(scanner, 3, state));
}

// The latest g or o names what follows.
static void read_name(const LineScanner& scanner, ObjState& state) {
  state.under_boundary = state.under_sharp = false;
  state.name.clear();
  for (size_t k = 1; k < scanner.columns().size(); ++k) {
    const std::string name = lower_case(scanner.columns()[k]);
    if (name.find("boundary") != std::string::npos) state.under_boundary = true;
    if (name.find("sharp") != std::string::npos) state.under_sharp = true;
    state.name += (state.name.empty() ? "" : " ") + std::string(scanner.columns()[k]);
  }
}

static void read_statement(const LineScanner& scanner, ObjState& state) {
  const std::string_view keyword = scanner.columns()[0];
  if (keyword == "v") {
    read_vertex(scanner, state);
  } else if (keyword == "vn") {
    read_triple(scanner, "components of a normal", state.normals);
  } else if (keyword == "l") {
    read_polyline(scanner, state);
  } else if (keyword == "f" || keyword == "fo") {
    read_face(scanner, state);
  } else if (keyword == "p") {
    read_points(scanner, state);
  } else if (keyword == "g" || keyword == "o") {
    read_name(scanner, state);
  } else if (keyword == "curv") {
    read_freeform_curve(scanner, state);
  } else {
    state.freeform.read_statement(scanner);
  }
}

static void check_index(const LineScanner& scanner, size_t line, uint32_t index, size_t count,
                        const char* thing, const char* things) {
  if (index < count) return;
  scanner.fail_at(line, std::string(thing) + " index " + std::to_string(index + 1ull) +
                            " is out of range, the file has " + std::to_string(count) + " " +
                            things + ", which count from 1 in OBJ");
}

static void check_indices(const LineScanner& scanner, const ObjState& state) {
  const auto check_curves = [&](const std::vector<NetworkCurve>& curves) {
    for (const NetworkCurve& curve : curves) {
      for (const uint32_t vertex : curve.vertices) {
        check_index(scanner, curve.line, vertex, state.vertex_count(), "vertex", "vertices");
      }
    }
  };
  check_curves(state.network.curves);
  check_curves(state.faces);
  state.freeform.check(check_curves);
  for (const uint32_t vertex : state.network.points) {
    check_index(scanner, 0, vertex, state.vertex_count(), "vertex", "vertices");
  }
  for (const NamedNormal& named : state.named_normals) {
    check_index(scanner, named.line, named.normal, state.normal_count(), "normal", "normals");
  }
}

// Where faces or curves name normals, a vertex has the one named, unless they disagree: that is an
// edge of the mesh, where the surface's normal is not known.
static void take_named_normals(ObjState& state) {
  Network& network = state.network;
  network.normals.assign(3 * state.vertex_count(), 0.0);
  network.has_normal.assign(state.vertex_count(), 0);
  std::vector<uint32_t> normal_of(state.vertex_count(), k_none);
  for (const NamedNormal& named : state.named_normals) {
    const double* n = &state.normals[3 * size_t{named.normal}];
    double* given = &network.normals[3 * size_t{named.vertex}];
    uint32_t& known = normal_of[named.vertex];
    if (known == k_none) {
      std::copy_n(n, 3, given);
      network.has_normal[named.vertex] = 1;
    } else if (known != named.normal && !std::equal(n, n + 3, given)) {
      network.has_normal[named.vertex] = 0;
    }
    if (known == k_none) known = named.normal;
  }
  for (size_t v = 0; v < state.vertex_count(); ++v) {
    if (network.has_normal[v] == 0) std::fill_n(&network.normals[3 * v], 3, 0.0);
  }
}

static void take_normals(const std::string& file, ObjState& state) {
  if (state.normals.empty()) return;
  // Equal counts may be chance: faces that say otherwise know better.
  const bool in_order =
      std::all_of(state.named_normals.begin(), state.named_normals.end(),
                  [](const NamedNormal& named) { return named.vertex == named.normal; });
  if (state.normal_count() == state.vertex_count() && in_order) {
    state.network.normals = std::move(state.normals);
  } else if (!state.named_normals.empty()) {
    take_named_normals(state);
  } else {
    throw ReadFailure(k_malformed, file, 0,
                      std::to_string(state.normal_count()) + " normals (vn) for " +
                          std::to_string(state.vertex_count()) +
                          " vertices (v): each vertex needs one, in the same order");
  }
}

static void take_faces(const std::string& file, ObjState& state) {
  if (!state.network.curves.empty() || state.faces.empty()) return;
  if (!state.has_large_face) {
    throw ReadFailure(k_not_supported, file, 0,
                      "a mesh of triangles (f) without curves: the curves must be given as l");
  }
  add_faces(std::move(state.faces), state.network);
}

Network read_obj(const std::string& file, std::string_view text) {
  LineScanner scanner(file, text, true);
  ObjState state;
  while (scanner.next('#')) read_statement(scanner, state);
  check_indices(scanner, state);
  take_normals(file, state);
  state.freeform.sample_all(scanner, state.network);
  take_faces(file, state);
  if (state.network.curves.empty() && state.network.points.empty()) {
    throw ReadFailure(k_malformed, file, 0, "no curve (l, curv or f) in this file");
  }
  return std::move(state.network);
}

}  // namespace wireskin_cli
