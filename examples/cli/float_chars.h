// std::from_chars and std::to_chars for doubles, also where the standard library lacks them (libc++
// before 14, as emscripten brings it). The command never leaves the C locale, so strtod means the
// same.
#pragma once

#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

namespace wireskin_cli {

#ifdef __cpp_lib_to_chars

using std::from_chars;
using std::to_chars;

#else

using std::from_chars;

inline std::from_chars_result from_chars(const char* first, const char* last, double& value) {
  const std::string text(first, last);
  // What strtod takes and from_chars does not.
  const bool foreign = text.empty() || std::strchr(" \t\n\v\f\r+", text[0]) != nullptr ||
                       text.find_first_of("xX") != std::string::npos;
  if (foreign) return {first, std::errc::invalid_argument};
  char* end = nullptr;
  errno = 0;
  const double read = std::strtod(text.c_str(), &end);
  const char* ptr = first + (end - text.c_str());
  if (ptr == first) return {first, std::errc::invalid_argument};
  if (errno == ERANGE && (read == 0.0 || read > 1.0 || read < -1.0)) {
    return {ptr, std::errc::result_out_of_range};
  }
  value = read;
  return {ptr, std::errc()};
}

inline std::to_chars_result to_chars(char* first, char* last, double value) {
  for (int digits = 15; digits <= 17; ++digits) {
    const int length =
        std::snprintf(first, static_cast<size_t>(last - first), "%.*g", digits, value);
    if (digits == 17 || std::strtod(first, nullptr) == value) return {first + length, std::errc()};
  }
  return {last, std::errc::value_too_large};
}

#endif

}  // namespace wireskin_cli
