// A Markdown page, written to standard output and to a file as it grows.
#pragma once

#include <cstdarg>
#include <cstdio>
#include <string>
#include <vector>

namespace accuracy {

// printf into a string.
inline std::string text(const char* format, ...) {
  char buffer[512];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(buffer, sizeof buffer, format, arguments);
  va_end(arguments);
  return buffer;
}

class Page {
 public:
  // `path` may be null.
  explicit Page(const char* path) : file_(path != nullptr ? std::fopen(path, "w") : nullptr) {
    failed_ = path != nullptr && file_ == nullptr;
  }
  ~Page() {
    if (file_ != nullptr) std::fclose(file_);
  }
  Page(const Page&) = delete;
  Page& operator=(const Page&) = delete;

  bool failed() const { return failed_; }

  void paragraph(const std::string& words) { put(words + "\n\n"); }
  void heading(const std::string& words) { put("## " + words + "\n\n"); }

  // The first column is left-aligned, the others right.
  void header(const std::vector<std::string>& names) {
    row(names);
    std::string rule = "|---|";
    for (size_t i = 1; i < names.size(); ++i) rule += "--:|";
    put(rule + "\n");
  }
  void row(const std::vector<std::string>& cells) {
    std::string line = "|";
    for (const std::string& cell : cells) line += " " + cell + " |";
    put(line + "\n");
  }
  void end_table() { put("\n"); }

 private:
  void put(const std::string& s) {
    std::fputs(s.c_str(), stdout);
    std::fflush(stdout);
    if (file_ != nullptr) std::fputs(s.c_str(), file_);
  }

  std::FILE* file_;
  bool failed_ = false;
};

}  // namespace accuracy
