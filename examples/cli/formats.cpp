#include "formats.h"

#include <algorithm>
#include <vector>

#include "files.h"
#include "scan.h"

namespace wireskin_cli {

namespace {

struct Extension {
  const char* text;
  Format format;
};

constexpr Extension k_extensions[] = {
    {".obj", Format::obj},         {".ply", Format::ply},       {".net", Format::net},
    {".rawnet", Format::rawnet},   {".csv", Format::table},     {".tsv", Format::table},
    {".txt", Format::table},       {".dat", Format::table},     {".asc", Format::table},
    {".xyz", Format::points},      {".curves", Format::curves}, {".curve", Format::curve},
    {".contour", Format::contour}, {".curf", Format::curf},
};

bool is_number(std::string_view text) {
  double ignored = 0.0;
  return parse_double(text, &ignored) || is_too_large(text);
}

bool is_obj_keyword(std::string_view word) {
  constexpr const char* k_words[] = {"v",      "vn",     "vt",  "vp",   "l",   "f",
                                     "p",      "g",      "o",   "s",    "mg",  "usemtl",
                                     "mtllib", "cstype", "deg", "curv", "surf"};
  return std::any_of(std::begin(k_words), std::end(k_words),
                     [word](const char* known) { return word == known; });
}

using Line = std::vector<std::string>;

// The first lines that hold something, as columns.
std::vector<Line> first_lines(std::string_view bytes) {
  constexpr size_t k_lines = 5, k_bytes = 1 << 16;
  LineScanner scanner("", bytes.substr(0, k_bytes), false);
  std::vector<Line> lines;
  while (lines.size() < k_lines && scanner.next('#')) {
    lines.emplace_back(scanner.columns().begin(), scanner.columns().end());
  }
  return lines;
}

// Enough columns for a point, and the first of them a number or not.
bool is_row(const Line& line, bool of_numbers) {
  size_t cells = 0;
  for (const std::string& column : line) {
    std::string_view rest = column;
    for (size_t end = 0; end != std::string_view::npos; ++cells) {
      end = rest.find_first_of(",;");
      if (cells == 0 && is_number(rest.substr(0, end)) != of_numbers) return false;
      if (end != std::string_view::npos) rest.remove_prefix(end + 1);
    }
  }
  return cells >= 3;
}

// Formats that begin with a count tell themselves apart by their second and third line.
Format format_of_counted(const std::vector<Line>& lines) {
  const auto columns = [&](size_t i) { return i < lines.size() ? lines[i].size() : 0; };
  const auto is_flag = [&](size_t i) {
    return columns(i) == 1 && (lines[i][0] == "0" || lines[i][0] == "1");
  };
  if (columns(1) == 6) return Format::net;
  if (is_flag(1) && is_flag(2)) return Format::rawnet;
  if (columns(1) == 4 && columns(2) == 2) return Format::contour;
  if (columns(1) == 3) return Format::curve;
  return Format::none;
}

bool is_keyword_kind(Format format) {
  return format == Format::obj || format == Format::curves || format == Format::curf;
}

}  // namespace

Format format_of_extension(const std::string& path) {
  const std::string extension = extension_of(path);
  for (const Extension& known : k_extensions) {
    if (extension == known.text) return known.format;
  }
  return Format::none;
}

Format format_of_content(std::string_view bytes) {
  if (bytes.substr(0, 3) == "ply" && (bytes.substr(3, 1) == "\n" || bytes.substr(3, 1) == "\r")) {
    return Format::ply;
  }
  if (looks_binary(bytes)) return Format::none;
  const std::vector<Line> lines = first_lines(bytes);
  if (lines.empty()) return Format::none;
  const Line& first = lines[0];
  if (is_obj_keyword(first[0])) {
    const bool counted = first[0] == "v" && first.size() == 2;
    return counted && lines.size() > 1 && is_number(lines[1][0]) ? Format::curves : Format::obj;
  }
  if (first.size() == 1 && is_number(first[0])) return format_of_counted(lines);
  if (lower_case(first[0]) == "curve" && first.size() <= 2) return Format::table;
  // A header of names is followed by numbers.
  const bool header = lines.size() > 1 && is_row(first, false);
  return is_row(lines[header ? 1 : 0], true) ? Format::table : Format::none;
}

Format format_of(const std::string& path, std::string_view bytes) {
  const Format named = format_of_extension(path);
  const Format seen = format_of_content(bytes);
  if (named == Format::none || seen == Format::ply) return seen;
  if (seen == Format::none || named == seen) return named;
  // .curf begins like OBJ.
  if (named == Format::curf && seen == Format::obj) return named;
  if (is_keyword_kind(named) && is_keyword_kind(seen)) return seen;
  const bool same_kind = is_keyword_kind(named) == is_keyword_kind(seen);
  if (named == Format::ply || !same_kind) return seen;
  // A .txt may be anything; all other extensions are believed.
  return named == Format::table ? seen : named;
}

const char* foreign_kind(std::string_view bytes) {
  struct Kind {
    std::string_view start;
    const char* sentence;
  };
  static constexpr Kind k_kinds[] = {
      {"\x1f\x8b", "this is packed by gzip: unpack it first"},
      {"PK\x03\x04", "this is a zip archive or a spreadsheet: unpack it, or save it as CSV"},
      {"\xD0\xCF\x11\xE0", "this is an old spreadsheet: save it as CSV"},
      {"3D Geometry File Format", "this is a Rhino file: export the curves as OBJ"},
      {"BLENDER", "this is a Blender file: export the curves as OBJ"},
      {"Kaydara FBX", "this is an FBX file: export the curves as OBJ"},
      {"ISO-10303-21", "this is a STEP file: export the curves as OBJ"},
      {"solid ", "this is an STL mesh: it holds triangles, and curves are needed"},
      {"<svg", "this is an SVG drawing: curves in space are needed, as OBJ or a table"},
      {"<?xml", "this is XML: curves are needed as OBJ, PLY or a table"},
      {"<!DOCTYPE", "this is a web page: curves are needed as OBJ, PLY or a table"},
      {"{", "this is JSON: curves are needed as OBJ, PLY or a table"},
  };
  for (const Kind& kind : k_kinds) {
    if (bytes.substr(0, kind.start.size()) == kind.start) return kind.sentence;
  }
  return nullptr;
}

std::string known_extensions() {
  std::string list;
  for (const Extension& known : k_extensions)
    list += (list.empty() ? "" : ", ") + std::string(known.text);
  return list;
}

}  // namespace wireskin_cli
