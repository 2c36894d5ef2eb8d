// What an instrument measured: for each curve the length so far, tangent and normal of each sample.
#include "read_network.h"
#include "scan.h"

namespace wireskin_cli {

static void next_line(LineScanner& scanner, const std::string& ended, size_t columns,
                      const std::string& what) {
  if (!scanner.next()) scanner.fail(ended);
  const size_t given = scanner.columns().size();
  if (given == columns) return;
  scanner.fail(std::to_string(given) + (given == 1 ? " column" : " columns") + " where " +
               std::to_string(columns) + (columns == 1 ? " is" : " are") + " needed: " + what);
}

static bool read_flag(LineScanner& scanner, const std::string& ended, const char* what) {
  next_line(scanner, ended, 1, what);
  const std::string_view flag = scanner.columns()[0];
  if (flag != "0" && flag != "1") scanner.fail(in_quotes(flag) + " is not " + what);
  return flag == "1";
}

// The node count stands alone, then come a line of places and a line of names.
static void read_nodes(LineScanner& scanner, const std::string& ended, RawCurve& curve) {
  next_line(scanner, ended, 1, "the number of nodes");
  const uint32_t count = scanner.count(0, "the number of nodes");
  if (count == 0) return;
  next_line(scanner, ended, count, "the sample of each node, counted from 1");
  for (size_t k = 0; k < count; ++k) {
    const uint32_t place = scanner.count(k, "a sample, which count from 1 here");
    if (place == 0) scanner.fail("samples count from 1 here");
    if (k > 0 && place <= curve.nodes.back() + 1)
      scanner.fail("the samples of nodes must increase");
    curve.nodes.push_back(place - 1);
  }
  next_line(scanner, ended, count, "the number of each node");
  for (size_t k = 0; k < count; ++k) {
    curve.global_nodes.push_back(scanner.count(k, "the number of a node"));
  }
}

static void read_samples(LineScanner& scanner, const std::string& ended, RawCurve& curve) {
  next_line(scanner, ended, 1, "the number of samples");
  const uint32_t count = scanner.count(0, "the number of samples");
  if (!curve.nodes.empty() && curve.nodes.back() >= count) {
    scanner.fail("a node lies on sample " + std::to_string(curve.nodes.back() + 1ull) + " of " +
                 std::to_string(count));
  }
  for (uint32_t i = 0; i < count; ++i) {
    next_line(scanner,
              "the file ends after " + std::to_string(i) + " of " + std::to_string(count) +
                  " samples of a curve",
              7, "length tx ty tz nx ny nz");
    const double length = scanner.number(0);
    if (i > 0 && !(length > curve.arc_lengths.back())) {
      scanner.fail("the length along the curve does not increase");
    }
    curve.arc_lengths.push_back(length);
    for (size_t k = 1; k < 4; ++k) curve.tangents.push_back(scanner.number(k));
    for (size_t k = 4; k < 7; ++k) curve.normals.push_back(scanner.number(k));
    curve.sample_lines.push_back(scanner.line());
  }
}

Network read_rawnet(const std::string& file, std::string_view text) {
  LineScanner scanner(file, text, false);
  Network network;
  next_line(scanner, "the file ends before the number of curves", 1, "the number of curves");
  const uint32_t count = scanner.count(0, "the number of curves");
  for (uint32_t i = 0; i < count; ++i) {
    const std::string ended =
        "the file ends after " + std::to_string(i) + " of " + std::to_string(count) + " curves";
    RawCurve curve;
    curve.boundary = read_flag(scanner, ended, "0 or 1 (1: boundary)");
    curve.line = scanner.line();
    curve.closed = read_flag(scanner, ended, "0 or 1 (1: closed)");
    read_nodes(scanner, ended, curve);
    read_samples(scanner, ended, curve);
    network.raw_curves.push_back(std::move(curve));
  }
  if (scanner.next()) scanner.fail("text after the last curve");
  return network;
}

}  // namespace wireskin_cli
