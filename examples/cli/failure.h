// What ends the command early: the one line that the person sees and the exit status.
//
// Status 1: something about the files or the network; 2: wrong usage. A ReadFailure says more, for
// the report: a short name of what is wrong with the input, the line, the sentence without place.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>

namespace wireskin_cli {

class Failure : public std::runtime_error {
 public:
  explicit Failure(const std::string& line, int exit_status = 1)
      : std::runtime_error(line), exit_status_(exit_status) {}
  int exit_status() const { return exit_status_; }

 private:
  int exit_status_;
};

// The names that a ReadFailure uses.
constexpr const char* k_cannot_read = "cannot_read";
constexpr const char* k_unknown_format = "unknown_format";
constexpr const char* k_malformed = "malformed";
constexpr const char* k_not_supported = "not_supported";

class ReadFailure : public Failure {
 public:
  // Line 0: the file as a whole.
  ReadFailure(const char* status, const std::string& file, size_t line, const std::string& sentence)
      : Failure(file + (line == 0 ? "" : ":" + std::to_string(line)) + ": " + sentence),
        status_(status),
        line_(line),
        sentence_(sentence) {}
  const char* status() const { return status_; }
  size_t line() const { return line_; }
  const std::string& sentence() const { return sentence_; }

 private:
  const char* status_;
  size_t line_;
  std::string sentence_;
};

}  // namespace wireskin_cli
