// Decompression of the zlib format, written for these tests alone and slow: bit by bit, codes found
// by comparing with every code of the length read so far. Throws on anything that RFC 1950 or RFC
// 1951 does not allow.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace cli_test {

class Inflater {
 public:
  explicit Inflater(const std::string& bytes) : bytes_(bytes) {}

  std::string run() {
    const unsigned header = byte(0) << 8 | byte(1);
    need((header >> 8 & 15) == 8 && header % 31 == 0, "zlib header");
    at_ = 16;
    for (bool last = false; !last;) {
      last = bits(1) == 1;
      const unsigned kind = bits(2);
      need(kind != 3, "block type");
      if (kind == 0) stored();
      if (kind == 1) compressed(fixed_literals(), std::vector<unsigned>(30, 5));
      if (kind == 2) dynamic();
    }
    const size_t tail = (at_ + 7) / 8;
    need(tail + 4 == bytes_.size(), "length of the stream");
    const uint32_t sum =
        byte(tail) << 24 | byte(tail + 1) << 16 | byte(tail + 2) << 8 | byte(tail + 3);
    need(sum == adler(), "checksum");
    return out_;
  }

 private:
  static void need(bool condition, const char* what) {
    if (!condition) throw std::runtime_error(std::string("inflate: ") + what);
  }
  unsigned byte(size_t i) const {
    need(i < bytes_.size(), "end of data");
    return static_cast<unsigned char>(bytes_[i]);
  }
  unsigned bits(unsigned count) {
    unsigned value = 0;
    for (unsigned i = 0; i < count; ++i, ++at_) value |= (byte(at_ / 8) >> (at_ % 8) & 1) << i;
    return value;
  }
  static std::vector<unsigned> fixed_literals() {
    std::vector<unsigned> lengths(288, 8);
    for (size_t i = 144; i < 256; ++i) lengths[i] = 9;
    for (size_t i = 256; i < 280; ++i) lengths[i] = 7;
    return lengths;
  }
  void stored() {
    at_ = (at_ + 7) / 8 * 8;
    const unsigned size = bits(16);
    need((bits(16) ^ size) == 0xffff, "stored length");
    for (unsigned i = 0; i < size; ++i) out_ += static_cast<char>(bits(8));
  }

  struct Code {
    std::vector<unsigned> first;                 // of each length
    std::vector<std::vector<unsigned>> symbols;  // of each length, in order
  };
  static Code code_of(const std::vector<unsigned>& lengths) {
    Code code{std::vector<unsigned>(16, 0), std::vector<std::vector<unsigned>>(16)};
    for (size_t s = 0; s < lengths.size(); ++s) {
      if (lengths[s] != 0) code.symbols[lengths[s]].push_back(static_cast<unsigned>(s));
    }
    unsigned next = 0;
    for (size_t length = 1; length < 16; ++length) {
      next = (next + static_cast<unsigned>(code.symbols[length - 1].size())) << 1;
      code.first[length] = next;
      need(next + code.symbols[length].size() <= 1u << length, "oversubscribed code");
    }
    return code;
  }
  unsigned symbol(const Code& code) {
    unsigned value = 0;
    for (size_t length = 1; length < 16; ++length) {
      value = value << 1 | bits(1);
      const unsigned offset = value - code.first[length];
      if (value >= code.first[length] && offset < code.symbols[length].size()) {
        return code.symbols[length][offset];
      }
    }
    throw std::runtime_error("inflate: no such code");
  }

  void dynamic() {
    static const size_t order[] = {16, 17, 18, 0, 8,  7, 9,  6, 10, 5,
                                   11, 4,  12, 3, 13, 2, 14, 1, 15};
    const size_t literals = bits(5) + 257;
    const size_t distances = bits(5) + 1;
    const size_t count = bits(4) + 4;
    need(literals <= 286 && distances <= 30, "number of codes");
    std::vector<unsigned> lengths(19, 0);
    for (size_t i = 0; i < count; ++i) lengths[order[i]] = bits(3);
    const Code code = code_of(lengths);
    std::vector<unsigned> all;
    while (all.size() < literals + distances) {
      const unsigned s = symbol(code);
      unsigned repeat = 1;
      unsigned value = s < 16 ? s : 0;
      if (s == 16) {
        need(!all.empty(), "repetition of nothing");
        value = all.back();
        repeat = 3 + bits(2);
      }
      if (s == 17) repeat = 3 + bits(3);
      if (s == 18) repeat = 11 + bits(7);
      all.insert(all.end(), repeat, value);
    }
    need(all.size() == literals + distances, "repetition beyond the codes");
    const auto middle = all.begin() + static_cast<long>(literals);
    compressed({all.begin(), middle}, {middle, all.end()});
  }

  void compressed(const std::vector<unsigned>& literal_lengths,
                  const std::vector<unsigned>& distance_lengths) {
    const Code literals = code_of(literal_lengths);
    const Code distances = code_of(distance_lengths);
    while (true) {
      const unsigned s = symbol(literals);
      if (s == 256) return;
      if (s < 256) {
        out_ += static_cast<char>(s);
        continue;
      }
      need(s < 286, "length symbol");
      const size_t length = repetition(s - 257);
      const size_t distance = distance_of(symbol(distances));
      need(distance <= out_.size(), "distance before the start");
      for (size_t i = 0; i < length; ++i) out_ += out_[out_.size() - distance];
    }
  }
  // Four symbols a bit from the ninth on; the last one is 258.
  size_t repetition(unsigned s) {
    if (s == 28) return 258;
    if (s < 8) return s + 3;
    const unsigned extra = s / 4 - 1;
    return 3 + ((4 + s % 4) << extra) + bits(extra);
  }
  // Two symbols a bit from the fifth on.
  size_t distance_of(unsigned s) {
    need(s < 30, "distance symbol");
    if (s < 4) return s + 1;
    const unsigned extra = s / 2 - 1;
    return 1 + ((2 + s % 2) << extra) + bits(extra);
  }
  uint32_t adler() const {
    uint32_t a = 1, b = 0;
    for (const char c : out_) {
      a = (a + static_cast<unsigned char>(c)) % 65521;
      b = (b + a) % 65521;
    }
    return b << 16 | a;
  }

  const std::string& bytes_;
  size_t at_ = 0;  // in bits
  std::string out_;
};

inline std::string inflate(const std::string& bytes) {
  return Inflater(bytes).run();
}

}  // namespace cli_test
