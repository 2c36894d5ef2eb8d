#include "read_network.h"
#include "scan.h"

namespace wireskin_cli {

// "17 of 401 vertices", for files that end too early.
static std::string part_of(size_t done, size_t all, const char* things) {
  return std::to_string(done) + " of " + std::to_string(all) + " " + things;
}

static uint32_t read_count(LineScanner& scanner, const char* things) {
  const std::string what = std::string("the number of ") + things;
  if (!scanner.next()) scanner.fail("the file ends before " + what);
  if (scanner.columns().size() != 1) {
    scanner.fail(std::to_string(scanner.columns().size()) + " columns where " + what +
                 " should stand alone");
  }
  return scanner.count(0, what.c_str());
}

static void read_vertices(LineScanner& scanner, uint32_t count, Network& network) {
  for (uint32_t i = 0; i < count; ++i) {
    if (!scanner.next()) scanner.fail("the file ends after " + part_of(i, count, "vertices"));
    if (scanner.columns().size() != 6) {
      scanner.fail(std::to_string(scanner.columns().size()) +
                   " columns where 6 are needed: x y z nx ny nz");
    }
    for (size_t k = 0; k < 3; ++k) network.positions.push_back(scanner.number(k));
    for (size_t k = 3; k < 6; ++k) network.normals.push_back(scanner.number(k));
    network.vertex_lines.push_back(scanner.line());
  }
}

static uint32_t read_index(const LineScanner& scanner, size_t column, size_t vertex_count) {
  const uint32_t index = scanner.count(column, "a vertex index, which count from 0");
  if (index >= vertex_count) {
    scanner.fail("vertex index " + std::to_string(index) + " is out of range, the file has " +
                 std::to_string(vertex_count) + " vertices");
  }
  return index;
}

static NetworkCurve read_curve(LineScanner& scanner, size_t vertex_count,
                               const std::string& ended) {
  NetworkCurve curve;
  if (!scanner.next()) scanner.fail(ended);
  const std::vector<std::string_view>& tag = scanner.columns();
  if (tag.size() != 1 || (tag[0] != "0" && tag[0] != "1")) {
    scanner.fail("a line with 0 or 1 (boundary) is needed before the indices of a curve");
  }
  curve.boundary = tag[0] == "1";
  if (!scanner.next()) scanner.fail(ended);
  curve.line = scanner.line();
  const size_t count = scanner.columns().size();
  if (count < 2) scanner.fail("a curve needs at least two vertex indices");
  for (size_t k = 0; k < count; ++k) {
    curve.vertices.push_back(read_index(scanner, k, vertex_count));
  }
  close_if_first_is_last(curve);
  return curve;
}

Network read_net(const std::string& file, std::string_view text) {
  LineScanner scanner(file, text, false);
  Network network;
  const uint32_t vertex_count = read_count(scanner, "vertices");
  read_vertices(scanner, vertex_count, network);
  const uint32_t curve_count = read_count(scanner, "curves");
  for (uint32_t i = 0; i < curve_count; ++i) {
    const std::string ended = "the file ends after " + part_of(i, curve_count, "curves");
    network.curves.push_back(read_curve(scanner, vertex_count, ended));
  }
  if (scanner.next()) scanner.fail("text after the last curve");
  return network;
}

}  // namespace wireskin_cli
