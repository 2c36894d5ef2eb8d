// Numbers appended to a byte string in a fixed byte order, whatever that of the machine.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>

namespace wireskin_cli {

template <size_t Size>
using UintOfSize =
    std::conditional_t<Size == 8, uint64_t, std::conditional_t<Size == 4, uint32_t, uint16_t>>;

template <typename T>
void append_little(std::string& bytes, T value) {
  UintOfSize<sizeof(T)> bits;
  static_assert(sizeof bits == sizeof value, "numbers of 2, 4 or 8 bytes");
  std::memcpy(&bits, &value, sizeof bits);
  for (size_t i = 0; i < sizeof bits; ++i) {
    bytes += static_cast<char>(static_cast<unsigned char>(bits >> (8 * i) & 0xff));
  }
}

inline void append_big(std::string& bytes, uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) {
    bytes += static_cast<char>(static_cast<unsigned char>(value >> shift & 0xff));
  }
}

}  // namespace wireskin_cli
