// A strict reader of JSON (RFC 8259) for the tests. Values are kept by their path, members of
// objects joined with dots: "stage_ms.factor". Numbers and words are kept as written, strings
// unescaped (beyond ASCII only as far as the tests need). Throws on anything that is not JSON.
#pragma once

#include <cstring>
#include <map>
#include <stdexcept>
#include <string>

namespace cli_test {

class JsonReader {
 public:
  explicit JsonReader(const std::string& text) : text_(text) {
    value("");
    blanks();
    need(at_ == text_.size(), "text after the value");
  }
  std::map<std::string, std::string> values;

 private:
  void need(bool condition, const char* what) const {
    if (!condition) {
      throw std::runtime_error(std::string("json: ") + what + " at " + std::to_string(at_));
    }
  }
  char peek() const { return at_ < text_.size() ? text_[at_] : '\0'; }
  char take() {
    need(at_ < text_.size(), "end of text");
    return text_[at_++];
  }
  void blanks() {
    while (peek() != '\0' && std::strchr(" \t\r\n", peek()) != nullptr) ++at_;
  }
  bool took(char c) {
    blanks();
    if (peek() != c) return false;
    ++at_;
    return true;
  }

  void value(const std::string& path) {
    blanks();
    if (peek() == '{') {
      object(path);
    } else if (peek() == '[') {
      array(path);
    } else if (peek() == '"') {
      values[path] = string();
    } else if (peek() == '-' || (peek() >= '0' && peek() <= '9')) {
      values[path] = number();
    } else {
      values[path] = word();
    }
  }
  void object(const std::string& path) {
    take();
    if (took('}')) return;
    do {
      blanks();
      const std::string key = string();
      need(took(':'), "colon");
      const std::string inner = path.empty() ? key : path + "." + key;
      need(values.count(inner) == 0, "a key twice");
      value(inner);
    } while (took(','));
    need(took('}'), "end of object");
  }
  // Item i of "list" is "list.i", their number "list.size".
  void array(const std::string& path) {
    take();
    size_t count = 0;
    if (!took(']')) {
      do {
        value(path + "." + std::to_string(count++));
      } while (took(','));
      need(took(']'), "end of array");
    }
    values[path + ".size"] = std::to_string(count);
  }
  std::string string() {
    std::string result;
    need(take() == '"', "string");
    for (char c = take(); c != '"'; c = take()) {
      need(static_cast<unsigned char>(c) >= 32, "control character");
      result += c == '\\' ? escaped() : std::string(1, c);
    }
    return result;
  }
  std::string escaped() {
    const char c = take();
    if (c != 'u') {
      need(std::strchr("\"\\/bfnrt", c) != nullptr, "escape");
      return {c};
    }
    unsigned code = 0;
    for (int i = 0; i < 4; ++i) {
      const char* digits = "0123456789abcdef";
      const char* digit = std::strchr(digits, take());
      need(digit != nullptr && *digit != '\0', "hexadecimal digit");
      code = 16 * code + static_cast<unsigned>(digit - digits);
    }
    return code < 128 ? std::string(1, static_cast<char>(code)) : "\xEF\xBF\xBD";
  }
  size_t digits(std::string& result) {
    size_t count = 0;
    for (; peek() >= '0' && peek() <= '9'; ++count) result += take();
    return count;
  }
  std::string number() {
    std::string result;
    if (peek() == '-') result += take();
    const bool zero = peek() == '0';
    const size_t count = digits(result);
    need(count == 1 || (count > 1 && !zero), "number");
    if (peek() == '.') {
      result += take();
      need(digits(result) > 0, "digits after the point");
    }
    if (peek() == 'e' || peek() == 'E') {
      result += take();
      if (peek() == '+' || peek() == '-') result += take();
      need(digits(result) > 0, "digits of the exponent");
    }
    return result;
  }
  std::string word() {
    for (const char* known : {"null", "true", "false"}) {
      if (text_.compare(at_, std::strlen(known), known) != 0) continue;
      at_ += std::strlen(known);
      return known;
    }
    throw std::runtime_error("json: no value at " + std::to_string(at_));
  }

  const std::string text_;
  size_t at_ = 0;
};

}  // namespace cli_test
