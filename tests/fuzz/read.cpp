// libFuzzer target: the bytes are a file of the format WIRESKIN_FUZZ_FORMAT. A reader ends with a
// network that keeps its invariants or with a complaint of one line.
#include <cstdint>
#include <cstdlib>
#include <string>

#include "cli/network_checks.h"
#include "failure.h"
#include "read_network.h"

using namespace wireskin_cli;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  std::string bytes(reinterpret_cast<const char*>(data), size);
  // What follows from the content alone must hold for any bytes too.
  const Format seen = format_of_content(bytes);
  const Format format = seen == Format::none ? Format::WIRESKIN_FUZZ_FORMAT : seen;
  for (const Format one : {Format::WIRESKIN_FUZZ_FORMAT, format}) {
    try {
      if (cli_test::broken_invariant(read_network_bytes("a.b", one, bytes)) != "") std::abort();
    } catch (const ReadFailure& failure) {
      const std::string line = failure.what();
      if (line.find('\n') != std::string::npos || line.size() > 400) std::abort();
    }
    if (one == format) break;
  }
  return 0;
}
