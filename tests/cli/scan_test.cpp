#include "scan.h"

#include <doctest/doctest.h>

#include <cfloat>
#include <clocale>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <random>

#include "cli/support.h"

using namespace wireskin_cli;
using namespace cli_test;

static double parsed(const char* text) {
  double value = -77.0;
  REQUIRE(parse_double(text, &value));
  return value;
}

TEST_CASE("numbers in all their forms") {
  CHECK(parsed("1") == 1.0);
  CHECK(parsed("+0.25") == 0.25);
  CHECK(parsed("-1.5e3") == -1500.0);
  CHECK(parsed(".5") == 0.5);
  CHECK(parsed("5.") == 5.0);
  CHECK(parsed("1E+2") == 100.0);
  CHECK(parsed("4.9e-324") == 4.9e-324);
  CHECK(parsed("1e-999") == 0.0);
  CHECK(parsed("1e-99999999999999999999") == 0.0);
  CHECK(parsed("1000e-999") == 0.0);
  CHECK(parsed(("0." + std::string(400, '0') + "1").c_str()) == 0.0);
  CHECK(is_too_large("1e999"));
  CHECK(is_too_large("1e99999999999999999999"));
  CHECK(is_too_large(std::string(400, '7')));
  CHECK_FALSE(is_too_large("seven"));
  CHECK_FALSE(is_too_large("1e-999"));
  CHECK(std::isnan(parsed("nan")));
  CHECK(std::isinf(parsed("inf")));
}

TEST_CASE("what is no number") {
  double value = 0.0;
  for (const char* text :
       {"", "+", "-", "+-1", "++1", "1,5", "1.5x", "0x10", "e5", "1e999", "abc"}) {
    CAPTURE(text);
    CHECK_FALSE(parse_double(text, &value));
  }
  int64_t integer = 0;
  for (const char* text : {"", "1.0", "1e3", "0x1", "99999999999999999999", "+-3"}) {
    CAPTURE(text);
    CHECK_FALSE(parse_integer(text, &integer));
  }
  CHECK(parse_integer("-7", &integer));
  CHECK(integer == -7);
}

TEST_CASE("written numbers read back as the same bits") {
  std::mt19937_64 random(7);
  for (int i = 0; i < 20000; ++i) {
    const uint64_t bits = random();
    double value;
    std::memcpy(&value, &bits, sizeof value);
    if (!std::isfinite(value)) continue;
    std::string text;
    append_double(text, value);
    double back = 0.0;
    REQUIRE(parse_double(text, &back));
    uint64_t back_bits;
    std::memcpy(&back_bits, &back, sizeof back);
    REQUIRE(back_bits == bits);
  }
  std::string text;
  append_double(text, 0.1);
  CHECK(text == "0.1");
}

TEST_CASE("the decimal point does not follow the locale") {
  // Any installed locale with a comma will do; without one only the C locale is tested.
  for (const char* name : {"de_DE.UTF-8", "fr_FR.UTF-8", "de_DE", "C.UTF-8"}) {
    if (std::setlocale(LC_ALL, name) != nullptr) break;
  }
  std::string text;
  append_double(text, 1.5);
  const double value = parsed("2.5");
  std::setlocale(LC_ALL, "C");
  CHECK(text == "1.5");
  CHECK(value == 2.5);
}

TEST_CASE("binary files are told from text") {
  CHECK(looks_binary(std::string("v 1 2 3\n\0", 9)));
  CHECK(looks_binary(std::string(100, '\x01') + std::string(100, 'a')));
  CHECK_FALSE(looks_binary("v 1 2 3\r\n\tl 1 2\f\v\n"));
  CHECK_FALSE(looks_binary("# gr\xc3\xbc\xc3\x9f dich\n"));
}

TEST_CASE("lines end with LF, CR LF or CR, and are counted") {
  LineScanner scanner("f", "a\nb c\r\n\r\n  \t\rd", false);
  REQUIRE(scanner.next());
  CHECK(scanner.columns()[0] == "a");
  CHECK(scanner.line() == 1);
  REQUIRE(scanner.next());
  REQUIRE(scanner.columns().size() == 2);
  CHECK(scanner.columns()[1] == "c");
  CHECK(scanner.line() == 2);
  REQUIRE(scanner.next());
  CHECK(scanner.columns()[0] == "d");
  CHECK(scanner.line() == 5);
  CHECK_FALSE(scanner.next());
  CHECK(scanner.line() == 5);
}

TEST_CASE("a backslash continues a line, also at the end of the text") {
  LineScanner scanner("f", "l 1 \\\r\n2\\\n3\nx \\", true);
  REQUIRE(scanner.next());
  REQUIRE(scanner.columns().size() == 4);
  CHECK(scanner.columns()[3] == "3");
  CHECK(scanner.line() == 1);
  REQUIRE(scanner.next());
  CHECK(scanner.line() == 4);
  CHECK(scanner.columns().size() == 1);
}

TEST_CASE("empty lines before a line are noted, comments are not empty") {
  LineScanner scanner("f", "a\n\nb\n# c\nd # e\n", false);
  REQUIRE(scanner.next('#'));
  CHECK_FALSE(scanner.after_blank());
  REQUIRE(scanner.next('#'));
  CHECK(scanner.after_blank());
  REQUIRE(scanner.next('#'));
  CHECK_FALSE(scanner.after_blank());
  CHECK(scanner.text() == "d ");
}

TEST_CASE("comments") {
  LineScanner scanner("f", "# nothing\nv 1 # one\n", false);
  REQUIRE(scanner.next('#'));
  CHECK(scanner.columns().size() == 2);
  CHECK(scanner.line() == 2);
}

TEST_CASE("complaints quote in printable and short form") {
  CHECK(in_quotes("a\nb\xff") == "\"a?b?\"");
  CHECK(in_quotes(std::string(100, 'x')).size() < 40);
  // Text of any language is quoted whole and cut between characters; what is no text is not.
  CHECK(in_quotes("Kr\xC3\xBCmmung \xE6\x9B\xB2\xE7\xB7\x9A \xF0\x9F\x8C\x80") ==
        "\"Kr\xC3\xBCmmung \xE6\x9B\xB2\xE7\xB7\x9A \xF0\x9F\x8C\x80\"");
  std::string long_text, cut;
  for (int k = 0; k < 30; ++k) long_text += "\xC3\xA9";
  for (int k = 0; k < 24; ++k) cut += "\xC3\xA9";
  CHECK(in_quotes(long_text) == "\"" + cut + "...\"");
  CHECK(in_quotes("a\xC3") == "\"a?\"");                    // cut off
  CHECK(in_quotes("\xC0\xAF\xED\xA0\x80") == "\"?????\"");  // overlong, surrogate
  CHECK(in_quotes("\xC2\x9B"
                  "1m") == "\"?1m\"");  // a control sequence
  CHECK(printable("\xC3\xA9\n\x1b\xe9\xC2\x9B") == "\xC3\xA9\\n\\x1b\\xe9\\xc2\\x9b");
  LineScanner scanner("dir/file.net", "\n1 zwei\n", false);
  REQUIRE(scanner.next());
  CHECK(failure_of([&] { (void)scanner.number(1); }) == "dir/file.net:2: \"zwei\" is not a number");
  CHECK(failure_of([&] { (void)scanner.count(1, "a count"); }) ==
        "dir/file.net:2: \"zwei\" is not a count");
}

TEST_CASE("files that are missing, empty, binary, folders") {
  const ScratchFolder scratch("scan");
  const std::string missing = scratch / "missing";
  CHECK(failure_of([&] { load_text(missing); }) == missing + ": there is no such file");
  write_file(scratch / "empty", "");
  CHECK(failure_of([&] { load_text(scratch / "empty"); }).find("the file is empty") !=
        std::string::npos);
  write_file(scratch / "binary", std::string("\x7f"
                                             "ELF\0\0\0",
                                             7));
  CHECK(failure_of([&] { load_text(scratch / "binary"); }).find("this is a binary file") !=
        std::string::npos);
  CHECK(failure_of([&] { load_text(scratch.path()); }).find("cannot be") != std::string::npos);
  write_file(scratch / "mark", "\xEF\xBB\xBFv 1");
  CHECK(load_text(scratch / "mark") == "v 1");
}
