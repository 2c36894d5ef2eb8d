#include "read_network.h"

#include "files.h"
#include "scan.h"

namespace wireskin_cli {

Network read_network_bytes(const std::string& file, Format format, std::string bytes) {
  if (format != Format::ply) require_text(file, bytes);
  switch (format) {
    case Format::net:
      return read_net(file, bytes);
    case Format::rawnet:
      return read_rawnet(file, bytes);
    case Format::obj:
      return read_obj(file, bytes);
    case Format::ply:
      return read_ply(file, bytes);
    case Format::table:
      return read_table(file, bytes);
    case Format::points:
      return read_points(file, bytes);
    case Format::curves:
      return read_curves(file, bytes);
    case Format::curve:
      return read_curve(file, bytes);
    case Format::contour:
      return read_contour(file, bytes);
    case Format::curf:
      return read_curf(file, bytes);
    case Format::none:
      break;
  }
  throw ReadFailure(k_unknown_format, file, 0,
                    "the content is of no known format and neither is the extension " +
                        in_quotes(extension_of(file)) + ", known are " + known_extensions());
}

Network read_network(const std::string& path) {
  std::string bytes = load_bytes(path);
  const std::string_view mark = "\xEF\xBB\xBF";
  const size_t skipped = bytes.compare(0, 3, mark) == 0 ? 3 : 0;
  if (const char* kind = foreign_kind(std::string_view(bytes).substr(skipped))) {
    throw ReadFailure(k_not_supported, path, 0, kind);
  }
  const Format format = format_of(path, std::string_view(bytes).substr(skipped));
  if (format == Format::none) require_text(path, bytes);
  if (format == Format::ply) bytes.erase(0, skipped);
  return read_network_bytes(path, format, std::move(bytes));
}

}  // namespace wireskin_cli
