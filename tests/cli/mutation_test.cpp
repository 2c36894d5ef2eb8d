// Every file of the corpus, damaged in a thousand ways: the readers end with a network that keeps
// its invariants or with a complaint of one line.
#include <doctest/doctest.h>

#include <random>

#include "cli/corpus.h"
#include "cli/network_checks.h"
#include "read_network.h"

using namespace wireskin_cli;
using namespace cli_test;

namespace {

class Mutator {
 public:
  explicit Mutator(uint64_t seed) : random_(seed) {}

  std::string mutate(std::string bytes, const std::string& other) {
    for (size_t i = 1 + below(4); i > 0; --i) change(bytes, other);
    return bytes;
  }

 private:
  size_t below(size_t limit) { return limit == 0 ? 0 : random_() % limit; }

  void change(std::string& bytes, const std::string& other) {
    static const char* const k_words[] = {
        "nan", "-inf",  "1e999",     "-1",           "0",     "4000000000", "99999999999999999999",
        "1,5", "\\",    "#",         "\r",           "\n\n",  ";",          "\t",
        "v",   "l 1 2", "f 1 2 3 4", "end_header\n", "CURVE", "1e-320",     "/"};
    const size_t at = below(bytes.size() + 1);
    const size_t length = below(std::min<size_t>(bytes.size() - at, 40) + 1);
    switch (below(8)) {
      case 0:
        bytes.resize(at);
        break;
      case 1:
        bytes.erase(at, length);
        break;
      case 2:
        bytes.insert(at, bytes.substr(at, length));
        break;
      case 3:
        bytes.insert(at, k_words[below(std::size(k_words))]);
        break;
      case 4:
        bytes.replace(at, length, k_words[below(std::size(k_words))]);
        break;
      case 5:
        bytes.insert(at, other.substr(below(other.size()), 40));
        break;
      case 6:
        bytes.insert(at, 1, static_cast<char>(below(256)));
        break;
      default:
        if (at < bytes.size()) bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8)));
    }
  }

  std::mt19937_64 random_;
};

// "" for a network or a complaint that are as they should be.
std::string outcome(Format format, const std::string& bytes) {
  try {
    return broken_invariant(read_network_bytes("a.b", format, bytes));
  } catch (const ReadFailure& failure) {
    const std::string line = failure.what();
    const bool one_line = line.find('\n') == std::string::npos && line.size() < 400;
    return one_line && line.find("a.b:") == 0 ? "" : line;
  }
}

}  // namespace

TEST_CASE("files of the corpus are read and recognised") {
  size_t count = 0;
  for (const CorpusFile& file : corpus()) {
    CAPTURE(file.path);
    CHECK(format_of(file.path, file.bytes) == file.format);
    const Network network = read_network(file.path);
    CHECK(broken_invariant(network) == "");
    CHECK(network.curves.size() + network.points.size() + network.raw_curves.size() > 0);
    ++count;
  }
  CHECK(count >= 25);
}

TEST_CASE("damaged files") {
  const std::vector<CorpusFile> files = corpus();
  Mutator mutator(20260101);
  size_t read = 0, refused = 0;
  for (size_t i = 0; i < files.size(); ++i) {
    for (size_t round = 0; round < 1000; ++round) {
      const std::string& other = files[(i + round) % files.size()].bytes;
      const std::string bytes = mutator.mutate(files[i].bytes, other);
      const std::string wrong = outcome(files[i].format, bytes);
      if (wrong != "") FAIL_CHECK(files[i].path << " round " << round << ": " << wrong);
      // By content too: whatever is found, it is read the same way.
      const Format format = format_of("a.dat", bytes);
      const std::string as_guessed = outcome(format, bytes);
      if (as_guessed != "") FAIL_CHECK(files[i].path << " guessed " << round << ": " << as_guessed);
      try {
        read_network_bytes("a.b", files[i].format, bytes);
        ++read;
      } catch (const ReadFailure&) {
        ++refused;
      }
    }
  }
  // Both happen often, or the mutations are too wild or too tame to mean anything.
  CHECK(read > files.size() * 50);
  CHECK(refused > files.size() * 100);
}

TEST_CASE("every file cut at every byte") {
  for (const CorpusFile& file : corpus()) {
    for (size_t length = 1; length < file.bytes.size(); ++length) {
      const std::string wrong = outcome(file.format, file.bytes.substr(0, length));
      if (wrong != "") FAIL_CHECK(file.path << " cut at " << length << ": " << wrong);
    }
  }
}
