// Text formats that give each curve as a run of points: those of CASSIE, of cycle discovery, of
// contours in planes, and curves with tangents.
#include <cmath>

#include "read_network.h"
#include "scan.h"

namespace wireskin_cli {

static void require_columns(const LineScanner& scanner, size_t count, const char* what) {
  const size_t given = scanner.columns().size();
  if (given == count) return;
  scanner.fail(std::to_string(given) + (given == 1 ? " column" : " columns") + " where " +
               std::to_string(count) + (count == 1 ? " is" : " are") + " needed: " + what);
}

static void require_next(LineScanner& scanner, uint32_t done, uint32_t all, const char* things) {
  if (scanner.next()) return;
  scanner.fail("the file ends after " + std::to_string(done) + " of " + std::to_string(all) + " " +
               things);
}

static uint32_t add_vertex(const LineScanner& scanner, size_t first_column, Network& network) {
  for (size_t k = 0; k < 3; ++k) network.positions.push_back(scanner.number(first_column + k));
  network.vertex_lines.push_back(scanner.line());
  return static_cast<uint32_t>(network.vertex_count() - 1);
}

static void read_points_of_curve(LineScanner& scanner, uint32_t count, Network& network) {
  NetworkCurve curve;
  curve.line = scanner.line();
  for (uint32_t i = 0; i < count; ++i) {
    require_next(scanner, i, count, "points of a curve");
    require_columns(scanner, 3, "x y z");
    curve.vertices.push_back(add_vertex(scanner, 0, network));
  }
  network.curves.push_back(std::move(curve));
}

Network read_curves(const std::string& file, std::string_view text) {
  LineScanner scanner(file, text, false);
  Network network;
  while (scanner.next()) {
    if (scanner.columns()[0] != "v") scanner.fail("a line \"v N\" is needed before a curve");
    require_columns(scanner, 2, "v and the number of points");
    read_points_of_curve(scanner, scanner.count(1, "the number of points of a curve"), network);
  }
  identify_equal_positions(network);
  return network;
}

// A file that begins with the number of its parts, each of which begins with a line of its own.
template <typename ReadPart>
static Network read_counted(const std::string& file, std::string_view text, const std::string& part,
                            const ReadPart& read_part) {
  LineScanner scanner(file, text, false);
  Network network;
  const std::string parts = part + "s", number = "the number of " + parts;
  if (!scanner.next()) scanner.fail("the file ends before " + number);
  require_columns(scanner, 1, number.c_str());
  const uint32_t count = scanner.count(0, number.c_str());
  for (uint32_t i = 0; i < count; ++i) {
    require_next(scanner, i, count, parts.c_str());
    read_part(scanner, network);
  }
  if (scanner.next()) scanner.fail("text after the last " + part);
  identify_equal_positions(network);
  return network;
}

Network read_curve(const std::string& file, std::string_view text) {
  return read_counted(file, text, "curve", [](LineScanner& scanner, Network& network) {
    require_columns(scanner, 3, "the number of points, a type and a capacity");
    read_points_of_curve(scanner, scanner.count(0, "the number of points of a curve"), network);
  });
}

// One plane: a line of its equation, which the vertices do not need, and its vertices and edges.
static void read_plane(LineScanner& scanner, Network& network) {
  require_columns(scanner, 4, "a plane a b c d");
  for (size_t k = 0; k < 4; ++k) (void)scanner.number(k);
  if (!scanner.next()) scanner.fail("the file ends before the vertices of a plane");
  require_columns(scanner, 2, "the numbers of vertices and edges of a plane");
  const uint32_t vertices = scanner.count(0, "the number of vertices of a plane");
  const uint32_t edges = scanner.count(1, "the number of edges of a plane");
  const uint32_t first = static_cast<uint32_t>(network.vertex_count());
  for (uint32_t i = 0; i < vertices; ++i) {
    require_next(scanner, i, vertices, "vertices of a plane");
    require_columns(scanner, 3, "x y z");
    add_vertex(scanner, 0, network);
  }
  for (uint32_t i = 0; i < edges; ++i) {
    require_next(scanner, i, edges, "edges of a plane");
    require_columns(scanner, 4, "two vertices and two labels");
    NetworkCurve curve;
    curve.line = scanner.line();
    for (size_t k = 0; k < 2; ++k) {
      const uint32_t index = scanner.count(k, "a vertex index, which count from 0");
      if (index >= vertices) {
        scanner.fail("vertex index " + std::to_string(index) + " is out of range, the plane has " +
                     std::to_string(vertices) + " vertices");
      }
      curve.vertices.push_back(first + index);
    }
    network.curves.push_back(std::move(curve));
  }
}

Network read_contour(const std::string& file, std::string_view text) {
  return read_counted(file, text, "plane", read_plane);
}

// v as in OBJ, e with two indices from 1; the vn lines hold tangents, which are not needed.
Network read_curf(const std::string& file, std::string_view text) {
  LineScanner scanner(file, text, false);
  Network network;
  while (scanner.next('#')) {
    const std::string_view keyword = scanner.columns()[0];
    if (keyword == "v") {
      require_columns(scanner, 4, "v x y z");
      add_vertex(scanner, 1, network);
    } else if (keyword == "e") {
      require_columns(scanner, 3, "e and two vertex indices");
      NetworkCurve curve;
      curve.line = scanner.line();
      for (size_t k = 1; k < 3; ++k) {
        const uint32_t index = scanner.count(k, "a vertex index, which count from 1");
        if (index == 0) scanner.fail("vertex indices count from 1 here");
        curve.vertices.push_back(index - 1);
      }
      network.curves.push_back(std::move(curve));
    }
  }
  for (const NetworkCurve& curve : network.curves) {
    for (const uint32_t vertex : curve.vertices) {
      if (vertex < network.vertex_count()) continue;
      scanner.fail_at(curve.line, "vertex index " + std::to_string(vertex + 1ull) +
                                      " is out of range, the file has " +
                                      std::to_string(network.vertex_count()) + " vertices");
    }
  }
  return network;
}

}  // namespace wireskin_cli
