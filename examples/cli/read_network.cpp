#include "read_network.h"

#include "files.h"
#include "scan.h"

namespace wireskin_cli {

Network read_network(const std::string& path) {
  const std::string extension = extension_of(path);
  if (extension != ".net" && extension != ".obj") {
    throw Failure(path + ": unknown format " + in_quotes(extension) + ", known are .net and .obj");
  }
  const std::string text = load_text(path);
  return extension == ".net" ? read_net(path, text) : read_obj(path, text);
}

}  // namespace wireskin_cli
