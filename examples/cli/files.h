// Output files that are complete or absent: each is written beside its target under another name,
// and all are renamed together when every one of them is complete.
//
// A target that exists and is no regular file (a terminal, a pipe) is written directly, the
// standard output ("-") at the end. Whatever fails becomes a Failure "FILE: what is wrong", after
// which no new file is left.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace wireskin_cli {

// The extension in lower case with its dot, or "".
std::string extension_of(const std::string& path);

class OutputFiles {
 public:
  OutputFiles() = default;
  OutputFiles(const OutputFiles&) = delete;
  OutputFiles& operator=(const OutputFiles&) = delete;
  ~OutputFiles();

  // Fails if the target's folder is not there: before the work rather than after it.
  static void check_folder(const std::string& target);
  // Writes the bytes under a temporary name.
  void add(const std::string& target, std::string_view bytes);
  // Gives every file its name.
  void commit();

 private:
  struct Pending {
    std::string shown;  // the name that the caller used
    std::string target;
    std::string temporary;
  };
  std::vector<Pending> pending_;
  std::string standard_output_;
};

}  // namespace wireskin_cli
