#include "scan.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "float_chars.h"

namespace wireskin_cli {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

std::string load_text(const std::string& path) {
  const std::unique_ptr<std::FILE, CloseFile> file(std::fopen(path.c_str(), "rb"));
  if (file == nullptr) {
    if (errno == ENOENT) throw Failure(path + ": there is no such file");
    throw Failure(path + ": cannot be opened: " + std::strerror(errno));
  }
  std::string text;
  char block[1 << 16];
  for (size_t got = 1; got != 0;) {
    got = std::fread(block, 1, sizeof block, file.get());
    text.append(block, got);
  }
  if (std::ferror(file.get()) != 0) {
    throw Failure(path + ": cannot be read: " + std::strerror(errno));
  }
  if (text.empty()) throw Failure(path + ": the file is empty");
  if (looks_binary(text)) throw Failure(path + ": this is a binary file, not text");
  if (text.compare(0, 3, "\xEF\xBB\xBF") == 0) text.erase(0, 3);
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

bool parse_double(std::string_view text, double* value) {
  text = without_plus(text);
  const char* end = text.data() + text.size();
  const std::from_chars_result result = from_chars(text.data(), end, *value);
  if (result.ec == std::errc::result_out_of_range && result.ptr == end) {
    // Too near zero is zero; too large is no double.
    *value = 0.0;
    return lower_case(text).find("e-") != std::string::npos;
  }
  return result.ec == std::errc() && result.ptr == end;
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

std::string in_quotes(std::string_view text) {
  constexpr size_t k_longest = 24;
  std::string result = "\"";
  for (const char c : text.substr(0, k_longest)) result += c >= 32 && c < 127 ? c : '?';
  return result + (text.size() > k_longest ? "...\"" : "\"");
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
  std::string_view rest = current_;
  if (comment != '\0') rest = rest.substr(0, rest.find(comment));
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
  } while (columns_.empty());
  return true;
}

double LineScanner::number(size_t column) const {
  double value = 0.0;
  if (!parse_double(columns_[column], &value))
    fail(in_quotes(columns_[column]) + " is not a number");
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
  throw Failure(file_ + ":" + std::to_string(line) + ": " + what);
}

}  // namespace wireskin_cli
