// What ends the command early: the one line that the person sees and the exit status.
//
// Status 1: something about the files or the network; 2: wrong usage.
#pragma once

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

}  // namespace wireskin_cli
