#include "deflate.h"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "bytes.h"

namespace wireskin_cli {

namespace {

constexpr size_t k_window = 32768;
constexpr size_t k_shortest_match = 3;
constexpr size_t k_longest_match = 258;
constexpr int k_chain_steps = 48;
constexpr size_t k_block_tokens = 1 << 16;
constexpr size_t k_hash_size = 1 << 15;

constexpr unsigned k_end_of_block = 256;
constexpr unsigned k_first_length = 257;
constexpr unsigned k_length_symbols = 29;
constexpr unsigned k_distance_symbols = 30;

// The least length or distance of each symbol, and how many bits say how much more it is.
constexpr uint16_t k_length_base[] = {3,  4,  5,  6,   7,   8,   9,   10,  11, 13,
                                      15, 17, 19, 23,  27,  31,  35,  43,  51, 59,
                                      67, 83, 99, 115, 131, 163, 195, 227, 258};
constexpr uint8_t k_length_bits[] = {0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2,
                                     2, 3, 3, 3, 3, 4, 4, 4, 4, 5, 5, 5, 5, 0};
constexpr uint16_t k_distance_base[] = {
    1,   2,   3,   4,   5,   7,    9,    13,   17,   25,   33,   49,   65,    97,    129,
    193, 257, 385, 513, 769, 1025, 1537, 2049, 3073, 4097, 6145, 8193, 12289, 16385, 24577};
constexpr uint8_t k_distance_bits[] = {0, 0, 0, 0, 1, 1, 2, 2,  3,  3,  4,  4,  5,  5,  6,
                                       6, 7, 7, 8, 8, 9, 9, 10, 10, 11, 11, 12, 12, 13, 13};

// A byte (distance 0) or a repetition.
struct Token {
  uint16_t length_or_byte = 0;
  uint16_t distance = 0;
};

unsigned symbol_of(const uint16_t* base, unsigned count, unsigned value) {
  return static_cast<unsigned>(std::upper_bound(base, base + count, value) - base) - 1;
}

// Bits from the least significant of each byte on.
class BitWriter {
 public:
  explicit BitWriter(std::string& bytes) : bytes_(bytes) {}
  void put(unsigned value, unsigned count) {
    held_ |= static_cast<uint64_t>(value) << held_count_;
    held_count_ += count;
    for (; held_count_ >= 8; held_count_ -= 8, held_ >>= 8) flush_byte();
  }
  void finish() {
    if (held_count_ != 0) flush_byte();
    held_ = held_count_ = 0;
  }

 private:
  void flush_byte() { bytes_ += static_cast<char>(static_cast<unsigned char>(held_ & 0xff)); }
  std::string& bytes_;
  uint64_t held_ = 0;
  unsigned held_count_ = 0;
};

// A prefix code over the symbols: their lengths and, already in the order of writing, their bits.
struct PrefixCode {
  std::vector<uint8_t> lengths;
  std::vector<unsigned> codes;

  void put(BitWriter& bits, unsigned symbol) const { bits.put(codes[symbol], lengths[symbol]); }
};

// D. Huffman, "A Method for the Construction of Minimum-Redundancy Codes", 1952. Returns the
// greatest length. Symbols that do not occur get length 0.
unsigned huffman_lengths(const std::vector<unsigned>& counts, std::vector<uint8_t>& lengths) {
  struct Node {
    uint64_t count;
    size_t parent;
  };
  std::vector<Node> nodes;
  std::vector<size_t> roots;
  std::vector<size_t> leaf_of(counts.size(), 0);
  for (size_t s = 0; s < counts.size(); ++s) {
    if (counts[s] == 0) continue;
    leaf_of[s] = nodes.size();
    roots.push_back(nodes.size());
    nodes.push_back({counts[s], 0});
  }
  const auto rarer_last = [&nodes](size_t a, size_t b) {
    return nodes[a].count != nodes[b].count ? nodes[a].count > nodes[b].count : a > b;
  };
  std::make_heap(roots.begin(), roots.end(), rarer_last);
  while (roots.size() > 1) {
    size_t pair[2];
    for (size_t& child : pair) {
      std::pop_heap(roots.begin(), roots.end(), rarer_last);
      child = roots.back();
      roots.pop_back();
    }
    for (const size_t child : pair) nodes[child].parent = nodes.size();
    roots.push_back(nodes.size());
    nodes.push_back({nodes[pair[0]].count + nodes[pair[1]].count, 0});
    std::push_heap(roots.begin(), roots.end(), rarer_last);
  }
  unsigned longest = 0;
  for (size_t s = 0; s < counts.size(); ++s) {
    unsigned depth = 0;
    if (counts[s] != 0) {
      for (size_t i = leaf_of[s]; i + 1 < nodes.size(); i = nodes[i].parent) ++depth;
    }
    lengths[s] = static_cast<uint8_t>(depth);
    longest = std::max(longest, depth);
  }
  return longest;
}

// Codes in the canonical order of RFC 1951, section 3.2.2, reversed for writing.
void assign_codes(PrefixCode& code, unsigned limit) {
  code.codes.assign(code.lengths.size(), 0);
  unsigned next = 0;
  for (unsigned length = 1; length <= limit; ++length, next <<= 1) {
    for (size_t s = 0; s < code.lengths.size(); ++s) {
      if (code.lengths[s] != length) continue;
      for (unsigned bit = 0; bit < length; ++bit) {
        code.codes[s] |= (next >> bit & 1) << (length - 1 - bit);
      }
      ++next;
    }
  }
}

// Counts are flattened until no code is longer than the limit. Two symbols at least get a code, as
// a code of one symbol would have length 0.
PrefixCode prefix_code(std::vector<unsigned> counts, unsigned limit) {
  auto unused = std::count(counts.begin(), counts.end(), 0u);
  for (size_t s = 0; s < 2; ++s) {
    if (counts[s] != 0 || unused + 1 < static_cast<long>(counts.size())) continue;
    counts[s] = 1;
    --unused;
  }
  PrefixCode code;
  code.lengths.resize(counts.size());
  while (huffman_lengths(counts, code.lengths) > limit) {
    for (unsigned& count : counts) count = (count + 1) / 2;
  }
  assign_codes(code, limit);
  return code;
}

// The lengths of both codes, themselves coded with the alphabet of RFC 1951, section 3.2.7; without
// its symbols for repetitions, which would save some hundred bytes.
void put_codes(BitWriter& bits, const PrefixCode& literals, const PrefixCode& distances) {
  constexpr unsigned k_order[19] = {16, 17, 18, 0, 8,  7, 9,  6, 10, 5,
                                    11, 4,  12, 3, 13, 2, 14, 1, 15};
  std::vector<unsigned> counts(19, 0);
  for (const PrefixCode* code : {&literals, &distances}) {
    for (const uint8_t length : code->lengths) ++counts[length];
  }
  const PrefixCode lengths = prefix_code(counts, 7);
  bits.put(static_cast<unsigned>(literals.lengths.size()) - 257, 5);
  bits.put(static_cast<unsigned>(distances.lengths.size()) - 1, 5);
  bits.put(19 - 4, 4);
  for (const unsigned symbol : k_order) bits.put(lengths.lengths[symbol], 3);
  for (const PrefixCode* code : {&literals, &distances}) {
    for (const uint8_t length : code->lengths) lengths.put(bits, length);
  }
}

void put_token(BitWriter& bits, const PrefixCode& literals, const PrefixCode& distances,
               const Token& token) {
  if (token.distance == 0) {
    literals.put(bits, token.length_or_byte);
    return;
  }
  const unsigned length = symbol_of(k_length_base, k_length_symbols, token.length_or_byte);
  literals.put(bits, k_first_length + length);
  bits.put(token.length_or_byte - unsigned{k_length_base[length]}, k_length_bits[length]);
  const unsigned distance = symbol_of(k_distance_base, k_distance_symbols, token.distance);
  distances.put(bits, distance);
  bits.put(token.distance - unsigned{k_distance_base[distance]}, k_distance_bits[distance]);
}

void put_block(BitWriter& bits, const std::vector<Token>& tokens, bool last) {
  std::vector<unsigned> literal_counts(k_first_length + k_length_symbols, 0);
  std::vector<unsigned> distance_counts(k_distance_symbols, 0);
  literal_counts[k_end_of_block] = 1;
  for (const Token& token : tokens) {
    if (token.distance == 0) {
      ++literal_counts[token.length_or_byte];
      continue;
    }
    ++literal_counts[k_first_length +
                     symbol_of(k_length_base, k_length_symbols, token.length_or_byte)];
    ++distance_counts[symbol_of(k_distance_base, k_distance_symbols, token.distance)];
  }
  const PrefixCode literals = prefix_code(literal_counts, 15);
  const PrefixCode distances = prefix_code(distance_counts, 15);
  bits.put(last ? 1 : 0, 1);
  bits.put(2, 2);
  put_codes(bits, literals, distances);
  for (const Token& token : tokens) put_token(bits, literals, distances, token);
  literals.put(bits, k_end_of_block);
}

// Finds the longest earlier occurrence of what stands at a position.
class Matcher {
 public:
  explicit Matcher(std::string_view data)
      : data_(data), latest_(k_hash_size, k_nowhere), earlier_(k_window, k_nowhere) {}

  Token longest_match(size_t at) const {
    Token best;
    if (at + k_shortest_match > data_.size()) return best;
    const size_t room = std::min(k_longest_match, data_.size() - at);
    size_t candidate = latest_[hash(at)];
    for (int step = 0; step < k_chain_steps && candidate != k_nowhere; ++step) {
      if (at - candidate >= k_window) break;
      const size_t length = common_length(candidate, at, room);
      if (length >= k_shortest_match && length > best.length_or_byte) {
        best.length_or_byte = static_cast<uint16_t>(length);
        best.distance = static_cast<uint16_t>(at - candidate);
        if (length == room) break;
      }
      const size_t before = earlier_[candidate % k_window];
      if (before >= candidate) break;  // overwritten by a later position, or nowhere
      candidate = before;
    }
    return best;
  }

  void insert(size_t at) {
    if (at + k_shortest_match > data_.size()) return;
    size_t& head = latest_[hash(at)];
    earlier_[at % k_window] = head;
    head = at;
  }

 private:
  static constexpr size_t k_nowhere = static_cast<size_t>(-1);

  size_t hash(size_t at) const {
    const auto byte = [this, at](size_t i) {
      return static_cast<uint32_t>(static_cast<unsigned char>(data_[at + i]));
    };
    const uint32_t key = byte(0) | byte(1) << 8 | byte(2) << 16;
    return (key * 2654435761u) >> 17;
  }
  size_t common_length(size_t a, size_t b, size_t room) const {
    size_t length = 0;
    while (length < room && data_[a + length] == data_[b + length]) ++length;
    return length;
  }

  std::string_view data_;
  std::vector<size_t> latest_;
  std::vector<size_t> earlier_;
};

uint32_t adler32(std::string_view data) {
  uint32_t a = 1;
  uint32_t b = 0;
  for (const char c : data) {
    a = (a + static_cast<unsigned char>(c)) % 65521;
    b = (b + a) % 65521;
  }
  return b << 16 | a;
}

}  // namespace

std::string zlib_bytes(std::string_view data) {
  std::string bytes = "\x78\x9c";  // deflate, window of 32 KB
  BitWriter bits(bytes);
  Matcher matcher(data);
  std::vector<Token> tokens;
  for (size_t at = 0; at < data.size();) {
    if (tokens.size() == k_block_tokens) {
      put_block(bits, tokens, false);
      tokens.clear();
    }
    Token token = matcher.longest_match(at);
    const size_t length = token.distance == 0 ? 1 : token.length_or_byte;
    if (token.distance == 0) token.length_or_byte = static_cast<unsigned char>(data[at]);
    tokens.push_back(token);
    for (const size_t end = at + length; at < end; ++at) matcher.insert(at);
  }
  put_block(bits, tokens, true);
  bits.finish();
  append_big(bytes, adler32(data));
  return bytes;
}

}  // namespace wireskin_cli
