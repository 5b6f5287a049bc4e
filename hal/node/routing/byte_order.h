#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <utility>

#include "hal/types/message.h"

namespace hal::node::routing {

/// Writes integers into bytes, most significant octet first.
class ByteWriter {
 public:
  void u8(std::uint8_t value) { bytes_.push_back(value); }
  void u16(std::uint16_t value) { put(value, 2); }
  void u32(std::uint32_t value) { put(value, 4); }
  void u64(std::uint64_t value) { put(value, 8); }
  void bytes(const Bytes& value) { bytes_.insert(bytes_.end(), value.begin(), value.end()); }
  Bytes take() { return std::move(bytes_); }

 private:
  void put(std::uint64_t value, int octets) {
    for (int shift = 8 * (octets - 1); shift >= 0; shift -= 8) {
      bytes_.push_back(static_cast<std::uint8_t>(value >> shift));
    }
  }
  Bytes bytes_;
};

/// Reads what ByteWriter wrote. Past the end it returns zeros and records the error: call
/// ended_well() once.
class ByteReader {
 public:
  explicit ByteReader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  std::uint8_t u8() { return static_cast<std::uint8_t>(get(1)); }
  std::uint16_t u16() { return static_cast<std::uint16_t>(get(2)); }
  std::uint32_t u32() { return static_cast<std::uint32_t>(get(4)); }
  std::uint64_t u64() { return get(8); }
  std::string text(std::size_t size) {
    const auto part = cut(size);
    return {part.begin(), part.end()};
  }
  Bytes rest() {
    const auto part = cut(bytes_.size());
    return {part.begin(), part.end()};
  }

  /// Whether every octet was read, and none past the end.
  bool ended_well() const { return !overrun_ && bytes_.empty(); }

 private:
  std::span<const std::uint8_t> cut(std::size_t size) {
    if (size > bytes_.size()) {
      overrun_ = true;
      size = bytes_.size();
    }
    const auto part = bytes_.first(size);
    bytes_ = bytes_.subspan(size);
    return part;
  }
  std::uint64_t get(std::size_t octets) {
    std::uint64_t value = 0;
    for (const std::uint8_t octet : cut(octets)) value = value << 8 | octet;
    return value;
  }

  std::span<const std::uint8_t> bytes_;
  bool overrun_ = false;
};

}  // namespace hal::node::routing
