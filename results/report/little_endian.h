#pragma once

#include <bit>
#include <concepts>
#include <cstdint>
#include <string>
#include <type_traits>

namespace results::report {

/// Appends a number, the least significant byte first, on every machine.
template <std::unsigned_integral Number>
void append_little_endian(std::string& bytes, Number value) {
  for (std::size_t i = 0; i < sizeof value; ++i) {
    bytes += static_cast<char>(static_cast<std::uint8_t>(value >> (8 * i)));
  }
}

template <std::signed_integral Number>
void append_little_endian(std::string& bytes, Number value) {
  append_little_endian(bytes, static_cast<std::make_unsigned_t<Number>>(value));
}

inline void append_little_endian(std::string& bytes, float value) {
  append_little_endian(bytes, std::bit_cast<std::uint32_t>(value));
}
inline void append_little_endian(std::string& bytes, double value) {
  append_little_endian(bytes, std::bit_cast<std::uint64_t>(value));
}
inline void append_little_endian(std::string& bytes, bool value) {
  bytes += static_cast<char>(value);
}

}  // namespace results::report
