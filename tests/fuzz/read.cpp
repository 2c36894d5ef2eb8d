// libFuzzer target: the bytes are a file of the format WIRESKIN_FUZZ_FORMAT. A reader ends with a
// network that keeps its invariants or with a complaint of one line. Half of the mutations are the
// fuzzer's own; the others move, copy, drop and replace whole words and lines, so that what comes
// out still has the form of the format.
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

#include "cli/network_checks.h"
#include "failure.h"
#include "read_network.h"

using namespace wireskin_cli;

extern "C" size_t LLVMFuzzerMutate(uint8_t* data, size_t size, size_t max_size);

namespace {

struct Piece {
  size_t first, size;
};

std::vector<Piece> pieces_between(const std::string& bytes, const char* separators) {
  std::vector<Piece> pieces;
  size_t first = bytes.find_first_not_of(separators);
  while (first != std::string::npos) {
    const size_t end = std::min(bytes.find_first_of(separators, first), bytes.size());
    pieces.push_back({first, end - first});
    first = bytes.find_first_not_of(separators, end);
  }
  return pieces;
}

void change_words(std::string& bytes, std::minstd_rand& random) {
  static const char* const k_words[] = {
      "0",     "1",       "2",    "-1",     "3",  "0.5",
      "1e999", "nan",     "-inf", "1e-320", "1,", "4294967295",
      "65536", "1 2 3",   "\\",   "\r",     "#",  "99999999999999999999",
      "\t",    "\n0 0 0", "1//1", "1/1/1",  ";",  "0x1p3"};
  const bool lines = random() % 3 == 0;
  const std::vector<Piece> pieces = pieces_between(bytes, lines ? "\n" : " \t\r\n,;/");
  if (pieces.empty()) return;
  const Piece a = pieces[random() % pieces.size()], b = pieces[random() % pieces.size()];
  const std::string text = bytes.substr(b.first, b.size);
  switch (random() % 5) {
    case 0:
      bytes.replace(a.first, a.size, text);
      break;
    case 1:
      bytes.insert(a.first, text + (lines ? "\n" : " "));
      break;
    case 2:
      bytes.erase(a.first, a.size + 1);
      break;
    case 3:
      bytes.replace(a.first, a.size, k_words[random() % std::size(k_words)]);
      break;
    default:
      // A count or an index that is off by a little.
      bytes.replace(a.first, a.size,
                    std::to_string(std::atoi(text.c_str()) % 100000 + int(random() % 5) - 2));
  }
}

}  // namespace

extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t max_size,
                                          unsigned seed) {
  std::minstd_rand random(seed);
  if (random() % 2 == 0) return LLVMFuzzerMutate(data, size, max_size);
  std::string bytes(reinterpret_cast<const char*>(data), size);
  for (unsigned i = 1 + random() % 3; i > 0; --i) change_words(bytes, random);
  bytes.resize(std::min(bytes.size(), max_size));
  std::copy(bytes.begin(), bytes.end(), data);
  return bytes.size();
}

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
