// Which format a file has: by its extension, and by its content where that says nothing or cannot
// be true.
#pragma once

#include <string>
#include <string_view>

namespace wireskin_cli {

enum class Format {
  none,
  net,
  rawnet,
  obj,
  ply,
  table,   // .csv .tsv .txt .dat .asc
  points,  // .xyz
  curves,
  curve,
  contour,
  curf,
};

Format format_of_extension(const std::string& path);
Format format_of_content(std::string_view bytes);

// The extension counts among formats that are alike, rows of numbers or lines that begin with a
// keyword; between the two kinds the content does.
Format format_of(const std::string& path, std::string_view bytes);

// What a file of another kind is, told by its first bytes, and what to do with it: "this is packed
// by gzip: unpack it first"; null where nothing is recognised.
const char* foreign_kind(std::string_view bytes);

// ".net, .rawnet, ..." for messages.
std::string known_extensions();

}  // namespace wireskin_cli
