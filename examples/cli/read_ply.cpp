// PLY in text, little-endian and big-endian form. G. Turk, "The PLY Polygon File Format", 1994.
#include <algorithm>
#include <array>
#include <cstring>

#include "read_network.h"
#include "scan.h"

namespace wireskin_cli {

namespace {

enum class PlyCoding { text, little, big };

struct PlyType {
  const char* name;
  const char* other_name;
  size_t size;
  char kind;  // signed, unsigned or floating
};

constexpr PlyType k_types[] = {
    {"char", "int8", 1, 's'},     {"uchar", "uint8", 1, 'u'},    {"short", "int16", 2, 's'},
    {"int", "int32", 4, 's'},     {"ushort", "uint16", 2, 'u'},  {"uint", "uint32", 4, 'u'},
    {"float", "float32", 4, 'f'}, {"double", "float64", 8, 'f'},
};

struct PlyProperty {
  std::string name;
  const PlyType* type = nullptr;
  const PlyType* count_type = nullptr;  // of a list; null: a single value
};

struct PlyElement {
  std::string name;
  uint64_t count = 0;
  std::vector<PlyProperty> properties;

  // The place of a property, or that of none.
  size_t find(const char* property) const {
    size_t i = 0;
    while (i < properties.size() && properties[i].name != property) ++i;
    return i;
  }
};

struct PlyHeader {
  PlyCoding coding = PlyCoding::text;
  std::vector<PlyElement> elements;
  size_t lines = 0;
  size_t length = 0;  // bytes, up to the first of the data
};

const PlyType& type_of(const LineScanner& scanner, std::string_view name) {
  for (const PlyType& type : k_types) {
    if (name == type.name || name == type.other_name) return type;
  }
  scanner.fail(in_quotes(name) + " is not a type of PLY");
}

void read_format(const LineScanner& scanner, PlyHeader& header) {
  const auto& columns = scanner.columns();
  const std::string_view name = columns.size() > 1 ? columns[1] : "";
  if (name == "ascii") {
    header.coding = PlyCoding::text;
  } else if (name == "binary_little_endian") {
    header.coding = PlyCoding::little;
  } else if (name == "binary_big_endian") {
    header.coding = PlyCoding::big;
  } else {
    scanner.fail(in_quotes(name) +
                 " is not a format of PLY: ascii, binary_little_endian or binary_big_endian");
  }
}

void read_element(const LineScanner& scanner, PlyHeader& header) {
  const auto& columns = scanner.columns();
  if (columns.size() != 3) scanner.fail("an element needs a name and a number");
  PlyElement element;
  element.name = columns[1];
  element.count = scanner.count(2, "the number of elements");
  header.elements.push_back(std::move(element));
}

void read_property(const LineScanner& scanner, PlyHeader& header) {
  const auto& columns = scanner.columns();
  if (header.elements.empty()) scanner.fail("a property before any element");
  PlyProperty property;
  const bool list = columns.size() > 1 && columns[1] == "list";
  if (columns.size() != (list ? 5u : 3u)) {
    scanner.fail(list ? "a list needs the types of its count and its values, and a name"
                      : "a property needs a type and a name");
  }
  if (list) {
    property.count_type = &type_of(scanner, columns[2]);
    if (property.count_type->kind == 'f') scanner.fail("the count of a list is not an integer");
  }
  property.type = &type_of(scanner, columns[list ? 3 : 1]);
  property.name = columns[list ? 4 : 2];
  header.elements.back().properties.push_back(std::move(property));
}

// Where the line that says end_header is over; 0 if there is none.
size_t header_length(std::string_view bytes) {
  // Where lines end with CR alone, a LF after the last one is data.
  const size_t first_end = std::min(bytes.find_first_of("\r\n"), bytes.size());
  const size_t crlf = bytes.substr(first_end, 2) == "\r\n" ? 2 : 1;
  for (size_t at = 0; at < bytes.size();) {
    const size_t end = std::min(bytes.find_first_of("\r\n", at), bytes.size());
    std::string_view line = bytes.substr(at, end - at);
    line = line.substr(0, line.find_last_not_of(" \t") + 1);
    at = end + (bytes.substr(end, 2) == "\r\n" ? crlf : 1);
    if (line == "end_header") return std::min(at, bytes.size());
  }
  return 0;
}

PlyHeader read_header(const std::string& file, std::string_view bytes) {
  PlyHeader header;
  header.length = header_length(bytes);
  if (header.length == 0) {
    throw ReadFailure(k_malformed, file, 0, "the header of this PLY file has no end_header");
  }
  LineScanner scanner(file, bytes.substr(0, header.length), false);
  bool format_known = false;
  while (scanner.next()) {
    const std::string_view keyword = scanner.columns()[0];
    if (keyword == "format") {
      read_format(scanner, header);
      format_known = true;
    } else if (keyword == "element") {
      read_element(scanner, header);
    } else if (keyword == "property") {
      read_property(scanner, header);
    } else if (keyword != "ply" && keyword != "comment" && keyword != "obj_info" &&
               keyword != "end_header") {
      scanner.fail(in_quotes(keyword) + " is not a line of a PLY header");
    }
  }
  header.lines = scanner.line();
  if (!format_known) throw ReadFailure(k_malformed, file, 0, "the PLY header names no format");
  return header;
}

// The values of one element after the other, whatever the coding. Counts of the header are not
// believed: nothing is reserved for them, and the data end where they end.
class PlyData {
 public:
  PlyData(const std::string& file, std::string_view bytes, const PlyHeader& header)
      : file_(file),
        coding_(header.coding),
        header_lines_(header.lines),
        bytes_(bytes.substr(header.length)),
        scanner_(file, bytes_, false) {}

  void begin(const PlyElement& element, uint64_t index) {
    element_ = &element;
    index_ = index;
    column_ = 0;
    if (coding_ == PlyCoding::text && !scanner_.next()) fail_ended();
  }
  // The line of the current element; its number from 1 where there are no lines.
  size_t line() const {
    return coding_ == PlyCoding::text ? header_lines_ + scanner_.line()
                                      : static_cast<size_t>(index_) + 1;
  }

  double number(const PlyType& type) {
    if (coding_ == PlyCoding::text) {
      double value = 0.0;
      const std::string_view text = next_column();
      if (!parse_double(text, &value)) {
        fail(in_quotes(text) +
             (is_too_large(text) ? " is too large a number" : " is not a number"));
      }
      return value;
    }
    const uint64_t bits = next_bits(type.size);
    if (type.kind == 'u') return static_cast<double>(bits);
    if (type.kind == 's') return static_cast<double>(signed_value(bits, type.size));
    if (type.size == 8) return from_bits<double>(bits);
    return static_cast<double>(from_bits<float>(static_cast<uint32_t>(bits)));
  }

  uint32_t count(const PlyType& type, const char* what) {
    int64_t value = -1;
    std::string shown;
    if (coding_ == PlyCoding::text) {
      const std::string_view text = next_column();
      shown = in_quotes(text);
      if (!parse_integer(text, &value)) value = -1;
    } else {
      const uint64_t bits = next_bits(type.size);
      value = type.kind == 's' ? signed_value(bits, type.size) : static_cast<int64_t>(bits);
      shown = std::to_string(value);
    }
    if (value < 0 || value >= 0xffffffffll) fail(shown + " is not " + what);
    return static_cast<uint32_t>(value);
  }

  void skip(const PlyProperty& property) {
    const uint32_t length =
        property.count_type != nullptr ? count(*property.count_type, "the length of a list") : 1;
    for (uint32_t i = 0; i < length; ++i) number(*property.type);
  }

  void end() {
    if (coding_ != PlyCoding::text || column_ == scanner_.columns().size()) return;
    fail(std::to_string(scanner_.columns().size()) + " values where the header wants " +
         std::to_string(column_));
  }

  [[noreturn]] void fail_whole(const std::string& what) const {
    throw ReadFailure(k_malformed, file_, 0, what);
  }
  [[noreturn]] void fail(const std::string& what) const {
    if (coding_ == PlyCoding::text) throw ReadFailure(k_malformed, file_, line(), what);
    throw ReadFailure(k_malformed, file_, 0, place() + ": " + what);
  }

 private:
  template <typename T, typename Bits>
  static T from_bits(Bits bits) {
    T value;
    static_assert(sizeof value == sizeof bits, "the same size");
    std::memcpy(&value, &bits, sizeof value);
    return value;
  }
  static int64_t signed_value(uint64_t bits, size_t size) {
    const uint64_t sign = uint64_t{1} << (8 * size - 1);
    return static_cast<int64_t>((bits ^ sign)) - static_cast<int64_t>(sign);
  }
  std::string place() const { return element_->name + " " + std::to_string(index_); }
  [[noreturn]] void fail_ended() const {
    throw ReadFailure(k_malformed, file_, 0,
                      "the file ends after " + std::to_string(index_) + " of " +
                          std::to_string(element_->count) + " elements " +
                          in_quotes(element_->name));
  }
  std::string_view next_column() {
    if (column_ == scanner_.columns().size()) {
      fail(std::to_string(column_) + " values, more are needed");
    }
    return scanner_.columns()[column_++];
  }
  uint64_t next_bits(size_t size) {
    if (bytes_.size() - at_ < size) fail_ended();
    uint64_t bits = 0;
    for (size_t i = 0; i < size; ++i) {
      const size_t from = coding_ == PlyCoding::big ? i : size - 1 - i;
      bits = bits << 8 | static_cast<unsigned char>(bytes_[at_ + from]);
    }
    at_ += size;
    return bits;
  }

  const std::string& file_;
  PlyCoding coding_;
  size_t header_lines_;
  std::string_view bytes_;
  LineScanner scanner_;
  size_t at_ = 0;
  const PlyElement* element_ = nullptr;
  uint64_t index_ = 0;
  size_t column_ = 0;
};

void read_vertices(PlyData& data, const PlyElement& element, Network& network) {
  constexpr const char* k_names[6] = {"x", "y", "z", "nx", "ny", "nz"};
  std::array<size_t, 6> place;
  for (size_t k = 0; k < 6; ++k) place[k] = element.find(k_names[k]);
  const auto all = [&](size_t first) {
    for (size_t k = first; k < first + 3; ++k) {
      const bool given = place[k] < element.properties.size();
      if (!given || element.properties[place[k]].count_type != nullptr) return false;
    }
    return true;
  };
  const bool with_normals = all(3);
  if (network.vertex_count() != 0) data.fail_whole("a second element vertex");
  for (uint64_t i = 0; i < element.count; ++i) {
    data.begin(element, i);
    if (!all(0)) data.fail("the vertices have no x, y and z");
    double values[6] = {};
    for (size_t p = 0; p < element.properties.size(); ++p) {
      size_t k = 0;
      while (k < 6 && place[k] != p) ++k;
      if (k == 6 || (k >= 3 && !with_normals)) {
        data.skip(element.properties[p]);
      } else {
        values[k] = data.number(*element.properties[p].type);
      }
    }
    data.end();
    network.positions.insert(network.positions.end(), values, values + 3);
    if (with_normals) network.normals.insert(network.normals.end(), values + 3, values + 6);
    network.vertex_lines.push_back(data.line());
  }
}

// Properties boundary and sharp, where an edge or a face has them, are what they are elsewhere.
void read_curves(PlyData& data, const PlyElement& element, bool edges,
                 std::vector<NetworkCurve>& curves) {
  for (uint64_t i = 0; i < element.count; ++i) {
    data.begin(element, i);
    NetworkCurve curve;
    uint32_t ends[2] = {0xffffffffu, 0xffffffffu};
    for (const PlyProperty& p : element.properties) {
      const bool list = p.count_type != nullptr;
      if (!list && p.name == "boundary") {
        curve.boundary = data.number(*p.type) != 0.0;
      } else if (!list && p.name == "sharp") {
        curve.sharp = data.number(*p.type) != 0.0;
      } else if (edges && !list && (p.name == "vertex1" || p.name == "vertex2")) {
        ends[p.name == "vertex2"] = data.count(*p.type, "a vertex index");
      } else if (!edges && list && (p.name == "vertex_indices" || p.name == "vertex_index")) {
        const uint32_t count = data.count(*p.count_type, "the length of a list");
        for (uint32_t k = 0; k < count; ++k) {
          curve.vertices.push_back(data.count(*p.type, "a vertex index"));
        }
      } else {
        data.skip(p);
      }
    }
    data.end();
    curve.line = data.line();
    curve.closed = !edges;
    if (edges) curve.vertices = {ends[0], ends[1]};
    if (edges && (ends[0] == 0xffffffffu || ends[1] == 0xffffffffu)) {
      data.fail("the edges have no vertex1 and vertex2");
    }
    if (!edges && curve.vertices.size() < 3) data.fail("a face needs at least three vertices");
    curves.push_back(std::move(curve));
  }
}

void check_indices(const std::string& file, const std::vector<NetworkCurve>& curves,
                   const char* thing, size_t vertex_count) {
  for (size_t i = 0; i < curves.size(); ++i) {
    for (const uint32_t vertex : curves[i].vertices) {
      if (vertex < vertex_count) continue;
      throw ReadFailure(k_malformed, file, 0,
                        std::string(thing) + " " + std::to_string(i) + ": vertex index " +
                            std::to_string(vertex) + " is out of range, the file has " +
                            std::to_string(vertex_count) + " vertices, which count from 0 in PLY");
    }
  }
}

// A binary file has no lines: those of the elements, which messages were made of, are wiped out.
void forget_lines(Network& network) {
  for (size_t& line : network.vertex_lines) line = 0;
  for (NetworkCurve& curve : network.curves) curve.line = 0;
}

}  // namespace

Network read_ply(const std::string& file, std::string_view bytes) {
  const PlyHeader header = read_header(file, bytes);
  PlyData data(file, bytes, header);
  Network network;
  std::vector<NetworkCurve> faces;
  for (const PlyElement& element : header.elements) {
    if (element.name == "vertex") {
      read_vertices(data, element, network);
    } else if (element.name == "edge") {
      read_curves(data, element, true, network.curves);
    } else if (element.name == "face") {
      read_curves(data, element, false, faces);
    } else if (!element.properties.empty()) {
      for (uint64_t i = 0; i < element.count; ++i) {
        data.begin(element, i);
        for (const PlyProperty& property : element.properties) data.skip(property);
        data.end();
      }
    }
  }
  check_indices(file, network.curves, "edge", network.vertex_count());
  check_indices(file, faces, "face", network.vertex_count());
  if (network.curves.empty() && !faces.empty()) {
    bool large = false;
    for (const NetworkCurve& face : faces) large = large || face.vertices.size() > 3;
    if (!large) {
      throw ReadFailure(k_not_supported, file, 0,
                        "a mesh of triangles without curves: the curves must be given as the "
                        "element edge");
    }
    add_faces(std::move(faces), network);
  }
  if (network.curves.empty()) {
    for (uint32_t v = 0; v < network.vertex_count(); ++v) network.points.push_back(v);
  }
  if (network.points.empty() && network.curves.empty()) {
    throw ReadFailure(k_malformed, file, 0, "no vertex in this file");
  }
  if (header.coding != PlyCoding::text) forget_lines(network);
  return network;
}

}  // namespace wireskin_cli
