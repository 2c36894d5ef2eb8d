// The small files of tests/fuzz/corpus: one for each format and dialect, in a folder named after
// the format.
#pragma once

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "cli/support.h"
#include "formats.h"

namespace cli_test {

struct FormatFolder {
  const char* name;
  wireskin_cli::Format format;
};

constexpr FormatFolder k_format_folders[] = {
    {"net", wireskin_cli::Format::net},         {"rawnet", wireskin_cli::Format::rawnet},
    {"obj", wireskin_cli::Format::obj},         {"ply", wireskin_cli::Format::ply},
    {"table", wireskin_cli::Format::table},     {"points", wireskin_cli::Format::points},
    {"curves", wireskin_cli::Format::curves},   {"curve", wireskin_cli::Format::curve},
    {"contour", wireskin_cli::Format::contour}, {"curf", wireskin_cli::Format::curf},
};

struct CorpusFile {
  std::string path;
  wireskin_cli::Format format;
  std::string bytes;
};

// In the order of their paths.
inline std::vector<CorpusFile> corpus() {
  std::vector<CorpusFile> files;
  for (const FormatFolder& folder : k_format_folders) {
    const size_t first = files.size();
    for (const auto& entry : fs::directory_iterator(fs::path(WIRESKIN_CORPUS) / folder.name)) {
      const std::string path = entry.path().string();
      files.push_back({path, folder.format, read_file(path)});
    }
    std::sort(files.begin() + static_cast<std::ptrdiff_t>(first), files.end(),
              [](const CorpusFile& a, const CorpusFile& b) { return a.path < b.path; });
  }
  return files;
}

inline std::string corpus_file(const std::string& name) {
  const std::string bytes = read_file(std::string(WIRESKIN_CORPUS) + "/" + name);
  if (bytes.empty()) throw std::runtime_error("no corpus file " + name);
  return bytes;
}

}  // namespace cli_test
