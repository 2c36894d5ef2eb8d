// Reading text files: the whole file at once, then lines, then columns.
//
// Numbers mean the same under every locale. Each complaint is a Failure "FILE:LINE: what is wrong",
// with what the file says quoted in printable, shortened form. Line ends are LF, CR LF or CR.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "failure.h"

namespace wireskin_cli {

// The bytes of a file, "-" being the standard input. A Failure if it cannot be read or is empty.
std::string load_bytes(const std::string& path);

// Takes a UTF-8 byte order mark away. A Failure if the bytes are no text, or UTF-16.
void require_text(const std::string& file, std::string& bytes);

// Both in one.
std::string load_text(const std::string& path);

// Whether the first block holds a NUL or mostly control characters.
bool looks_binary(std::string_view bytes);

// One number and nothing else; a leading + is allowed. False if it is none or too large for a
// double.
bool parse_double(std::string_view text, double* value);
// Whether parse_double failed because the number is too large.
bool is_too_large(std::string_view text);
bool parse_integer(std::string_view text, int64_t* value);

// The shortest text that reads back as the same bits.
void append_double(std::string& text, double value);

std::string lower_case(std::string_view text);

// The length of the well-formed UTF-8 sequence at the start of the text, 0 if there is none. The
// ranges of the second byte keep out overlong forms, surrogates and what lies beyond U+10FFFF.
size_t utf8_length(std::string_view text);

// At most 24 characters of the text; "?" stands for control characters and for bytes that are no
// UTF-8.
std::string in_quotes(std::string_view text);

// As complaints name the file: control characters, line ends among them, and bytes that are no
// UTF-8 become "\n" or "\x1b", so that a message stays one line of text.
std::string printable(std::string_view text);

// Walks over the lines of a text and splits each into columns.
class LineScanner {
 public:
  // join_continued: a backslash at the end of a line continues it on the next one.
  LineScanner(std::string file, std::string_view text, bool join_continued)
      : file_(std::move(file)), text_(text), join_continued_(join_continued) {}

  // Goes to the next line that has a column; false at the end of the text. What stands after
  // `comment` in a line does not count ('\0': no comments).
  bool next(char comment = '\0');

  // The columns of the current line, and its number (of the last line, at the end of the text).
  const std::vector<std::string_view>& columns() const { return columns_; }
  size_t line() const { return line_; }
  // The whole of the current line, without its comment, and whether an empty one stood before it.
  std::string_view text() const { return whole_; }
  bool after_blank() const { return after_blank_; }
  const std::string& file() const { return file_; }

  double number(size_t column) const;
  // An integer from 0 to 2^32 - 2; `what` names it in the complaint.
  uint32_t count(size_t column, const char* what) const;

  [[noreturn]] void fail(const std::string& what) const { fail_at(line_, what); }
  [[noreturn]] void fail_at(size_t line, const std::string& what) const;

 private:
  bool take_line();
  void split(char comment);

  std::string file_;
  std::string_view text_;
  bool join_continued_;
  size_t at_ = 0;
  size_t lines_taken_ = 0;
  size_t line_ = 0;
  std::string current_;
  std::string_view whole_;
  bool after_blank_ = false;
  std::vector<std::string_view> columns_;
};

}  // namespace wireskin_cli
