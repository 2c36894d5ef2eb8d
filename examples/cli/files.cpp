#include "files.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "failure.h"
#include "scan.h"

#ifdef _WIN32
#include <fcntl.h>
#include <io.h>
#endif

namespace wireskin_cli {

namespace fs = std::filesystem;

std::string extension_of(const std::string& path) {
  return lower_case(fs::path(path).extension().string());
}

[[noreturn]] static void fail_writing(const std::string& path, int error) {
  throw Failure(path + ": cannot be written: " + std::strerror(error));
}

// Writes, closes and checks both: a full disk may show only when the file is closed.
static void write_and_close(std::FILE* file, std::string_view bytes, const std::string& shown) {
  errno = 0;
  const bool written = std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size();
  const int write_error = errno;
  const bool closed = std::fclose(file) == 0;
  if (!written) fail_writing(shown, write_error);
  if (!closed) fail_writing(shown, errno);
}

// A new file beside the target; never one that exists.
static std::FILE* open_temporary(const std::string& target, std::string* name) {
  std::FILE* file = nullptr;
  for (int attempt = 0; attempt < 100 && file == nullptr; ++attempt) {
    *name = target + ".part" + std::to_string(attempt);
    file = std::fopen(name->c_str(), "wbx");
    if (file == nullptr && errno != EEXIST) break;
  }
  return file;
}

void OutputFiles::check_folder(const std::string& target) {
  const fs::path folder = fs::path(target).parent_path();
  std::error_code ignored;
  if (target.empty() || target == "-" || folder.empty()) return;
  if (!fs::is_directory(folder, ignored)) fail_writing(target, ENOENT);
}

void OutputFiles::add(const std::string& target, std::string_view bytes) {
  if (target == "-") {
    standard_output_.append(bytes);
    return;
  }
  std::error_code ignored;
  const fs::file_status status = fs::status(target, ignored);
  if (fs::is_directory(status)) fail_writing(target, EISDIR);
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    std::FILE* file = std::fopen(target.c_str(), "wb");
    if (file == nullptr) fail_writing(target, errno);
    write_and_close(file, bytes, target);
    return;
  }
  // Behind a symbolic link the file is replaced, not the link.
  std::string real = target;
  if (fs::exists(status)) {
    const fs::path resolved = fs::canonical(target, ignored);
    if (!resolved.empty()) real = resolved.string();
  }
  std::string temporary;
  std::FILE* file = open_temporary(real, &temporary);
  if (file == nullptr) fail_writing(target, errno);
  pending_.push_back({target, real, temporary});
  write_and_close(file, bytes, target);
}

static void write_standard_output(const std::string& bytes) {
  if (bytes.empty()) return;
#ifdef _WIN32
  _setmode(_fileno(stdout), _O_BINARY);
#endif
  errno = 0;
  const bool written = std::fwrite(bytes.data(), 1, bytes.size(), stdout) == bytes.size();
  if (!written || std::fflush(stdout) != 0) fail_writing("standard output", errno);
}

void OutputFiles::commit() {
  write_standard_output(standard_output_);
  for (size_t i = 0; i < pending_.size(); ++i) {
    std::error_code error;
    fs::rename(pending_[i].temporary, pending_[i].target, error);
    if (!error) continue;
    // None is left, rather than some.
    std::error_code ignored;
    for (size_t k = 0; k < i; ++k) fs::remove(pending_[k].target, ignored);
    fail_writing(pending_[i].shown, error.value());
  }
  pending_.clear();
}

OutputFiles::~OutputFiles() {
  std::error_code ignored;
  for (const Pending& file : pending_) fs::remove(file.temporary, ignored);
}

}  // namespace wireskin_cli
