#include "scan.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "float_chars.h"

namespace wireskin_cli {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

static void append_all(std::FILE* file, const std::string& path, std::string& bytes) {
  char block[1 << 16];
  for (size_t got = 1; got != 0;) {
    got = std::fread(block, 1, sizeof block, file);
    bytes.append(block, got);
  }
  if (std::ferror(file) != 0) {
    throw ReadFailure(k_cannot_read, path, 0,
                      std::string("cannot be read: ") + std::strerror(errno));
  }
}

std::string load_bytes(const std::string& path) {
  std::string bytes;
  if (path == "-") {
    append_all(stdin, path, bytes);
  } else {
    const std::unique_ptr<std::FILE, CloseFile> file(std::fopen(path.c_str(), "rb"));
    if (file == nullptr) {
      const std::string why = errno == ENOENT
                                  ? "there is no such file"
                                  : std::string("cannot be opened: ") + std::strerror(errno);
      throw ReadFailure(k_cannot_read, path, 0, why);
    }
    append_all(file.get(), path, bytes);
  }
  if (bytes.empty()) throw ReadFailure(k_malformed, path, 0, "the file is empty");
  return bytes;
}

void require_text(const std::string& file, std::string& bytes) {
  if (bytes.compare(0, 2, "\xFF\xFE") == 0 || bytes.compare(0, 2, "\xFE\xFF") == 0) {
    throw ReadFailure(k_not_supported, file, 0, "the text is UTF-16: save it as UTF-8 or ASCII");
  }
  if (looks_binary(bytes)) {
    throw ReadFailure(k_malformed, file, 0, "this is a binary file, not text");
  }
  if (bytes.compare(0, 3, "\xEF\xBB\xBF") == 0) bytes.erase(0, 3);
}

std::string load_text(const std::string& path) {
  std::string text = load_bytes(path);
  require_text(path, text);
  return text;
}

bool looks_binary(std::string_view bytes) {
  const std::string_view block = bytes.substr(0, 4096);
  size_t control = 0;
  for (const char c : block) {
    if (c == '\0') return true;
    const bool is_space = c == '\t' || c == '\n' || c == '\r' || c == '\f' || c == '\v';
    if (static_cast<unsigned char>(c) < 32 && !is_space) ++control;
  }
  return control * 20 > block.size();
}

static std::string_view without_plus(std::string_view text) {
  const bool plus = text.size() > 1 && text[0] == '+' && text[1] != '-' && text[1] != '+';
  return plus ? text.substr(1) : text;
}

// The parser tells "out of range" only; which end of the range, the place of the first digit tells.
static bool is_tiny(std::string_view text) {
  const size_t e = text.find_first_of("eE");
  int64_t exponent = 0;
  if (e != std::string_view::npos && !parse_integer(text.substr(e + 1), &exponent)) {
    return text[e + 1] == '-';
  }
  const std::string_view mantissa = text.substr(0, e);
  const size_t digit = mantissa.find_first_of("123456789");
  if (digit == std::string_view::npos) return true;
  const size_t point = std::min(mantissa.find('.'), mantissa.size());
  return exponent < static_cast<int64_t>(digit) - static_cast<int64_t>(point);
}

bool parse_double(std::string_view text, double* value) {
  text = without_plus(text);
  const char* end = text.data() + text.size();
  const std::from_chars_result result = from_chars(text.data(), end, *value);
  if (result.ec == std::errc::result_out_of_range && result.ptr == end) {
    // Too near zero is zero; too large is no double.
    *value = 0.0;
    return is_tiny(text);
  }
  return result.ec == std::errc() && result.ptr == end;
}

bool is_too_large(std::string_view text) {
  double value = 0.0;
  text = without_plus(text);
  const char* end = text.data() + text.size();
  const std::from_chars_result result = from_chars(text.data(), end, value);
  return result.ec == std::errc::result_out_of_range && result.ptr == end && !is_tiny(text);
}

bool parse_integer(std::string_view text, int64_t* value) {
  text = without_plus(text);
  const char* end = text.data() + text.size();
  const std::from_chars_result result = from_chars(text.data(), end, *value);
  return result.ec == std::errc() && result.ptr == end;
}

void append_double(std::string& text, double value) {
  char digits[32];
  const std::to_chars_result result = to_chars(digits, digits + sizeof digits, value);
  text.append(digits, result.ptr);
}

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return lower;
}

size_t utf8_length(std::string_view text) {
  const auto byte = [text](size_t i) {
    return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u;
  };
  const unsigned first = byte(0);
  if (first < 0x80) return 1;
  if (first < 0xC2 || first > 0xF4) return 0;
  const size_t length = first < 0xE0 ? 2 : first < 0xF0 ? 3 : 4;
  const unsigned least = first == 0xE0 ? 0xA0 : first == 0xF0 ? 0x90 : 0x80;
  const unsigned most = first == 0xED ? 0x9F : first == 0xF4 ? 0x8F : 0xBF;
  if (byte(1) < least || byte(1) > most) return 0;
  for (size_t i = 2; i < length; ++i) {
    if (byte(i) < 0x80 || byte(i) > 0xBF) return 0;
  }
  return length;
}

// What a terminal would obey instead of showing it: controls, those of ISO 6429 beyond ASCII too.
static bool is_control(std::string_view text) {
  const unsigned char first = static_cast<unsigned char>(text[0]);
  if (first < 32 || first == 127) return true;
  return first == 0xC2 && static_cast<unsigned char>(text[1]) < 0xA0;
}

std::string in_quotes(std::string_view text) {
  constexpr size_t k_longest = 24;
  std::string result = "\"";
  for (size_t shown = 0; !text.empty() && shown < k_longest; ++shown) {
    const size_t length = utf8_length(text);
    if (length == 0 || is_control(text)) {
      result += '?';
    } else {
      result += text.substr(0, length);
    }
    text.remove_prefix(length == 0 ? 1 : length);
  }
  return result + (text.empty() ? "\"" : "...\"");
}

std::string printable(std::string_view text) {
  constexpr const char* k_hex = "0123456789abcdef";
  std::string result;
  while (!text.empty()) {
    const size_t length = utf8_length(text);
    const unsigned char byte = static_cast<unsigned char>(text[0]);
    const bool shown = length > 0 && !is_control(text);
    if (shown) {
      result += text.substr(0, length);
    } else if (byte == '\n') {
      result += "\\n";
    } else if (byte == '\r') {
      result += "\\r";
    } else if (byte == '\t') {
      result += "\\t";
    } else {
      result += {'\\', 'x', k_hex[byte >> 4], k_hex[byte & 15]};
    }
    text.remove_prefix(shown ? length : 1);
  }
  return result;
}

// Appends the next physical line to current_.
bool LineScanner::take_line() {
  if (at_ >= text_.size()) return false;
  size_t end = text_.find_first_of("\r\n", at_);
  if (end == std::string_view::npos) end = text_.size();
  current_.append(text_.substr(at_, end - at_));
  at_ = end + (text_.substr(end, 2) == "\r\n" ? 2 : 1);
  ++lines_taken_;
  return true;
}

void LineScanner::split(char comment) {
  constexpr const char* k_blanks = " \t\f\v";
  whole_ = current_;
  if (comment != '\0') whole_ = whole_.substr(0, whole_.find(comment));
  std::string_view rest = whole_;
  columns_.clear();
  while (true) {
    const size_t first = rest.find_first_not_of(k_blanks);
    if (first == std::string_view::npos) return;
    rest.remove_prefix(first);
    const size_t length = std::min(rest.find_first_of(k_blanks), rest.size());
    columns_.push_back(rest.substr(0, length));
    rest.remove_prefix(length);
  }
}

bool LineScanner::next(char comment) {
  after_blank_ = false;
  do {
    current_.clear();
    if (!take_line()) {
      line_ = lines_taken_;
      columns_.clear();
      return false;
    }
    line_ = lines_taken_;
    while (join_continued_ && !current_.empty() && current_.back() == '\\') {
      current_.back() = ' ';
      if (!take_line()) break;
    }
    split(comment);
    if (current_.find_first_not_of(" \t\f\v") == std::string::npos) after_blank_ = true;
  } while (columns_.empty());
  return true;
}

double LineScanner::number(size_t column) const {
  double value = 0.0;
  const std::string_view text = columns_[column];
  if (!parse_double(text, &value)) {
    fail(in_quotes(text) + (is_too_large(text) ? " is too large a number" : " is not a number"));
  }
  return value;
}

uint32_t LineScanner::count(size_t column, const char* what) const {
  int64_t value = 0;
  const bool integer = parse_integer(columns_[column], &value);
  if (!integer || value < 0 || value >= 0xffffffffll) {
    fail(in_quotes(columns_[column]) + " is not " + what);
  }
  return static_cast<uint32_t>(value);
}

void LineScanner::fail_at(size_t line, const std::string& what) const {
  throw ReadFailure(k_malformed, file_, line, what);
}

}  // namespace wireskin_cli
