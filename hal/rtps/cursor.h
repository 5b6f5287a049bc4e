#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

#include "hal/rtps/entity_id.h"

namespace hal::rtps {

/// Octets as transmitted (OMG DDSI-RTPS 2.5, 9.4).
using Octets = std::span<const std::byte>;

enum class Endianness : std::uint8_t { kBig, kLittle };

/// Reads numbers one after another, never past the end: there every value is 0 and is_short() is
/// true.
class Cursor {
 public:
  Cursor(Octets octets, Endianness endianness) : octets_(octets), endianness_(endianness) {}

  std::uint8_t u8() { return read<std::uint8_t>(); }
  std::uint16_t u16() { return read<std::uint16_t>(); }
  std::uint32_t u32() { return read<std::uint32_t>(); }
  std::uint64_t u64() { return read<std::uint64_t>(); }
  /// SequenceNumber_t (9.3.2): a signed high and an unsigned low half.
  std::int64_t sequence_number() {
    const std::uint64_t high = u32();
    return static_cast<std::int64_t>(high << 32U | u32());
  }
  /// EntityId_t (9.3.1.2): four octets in the same order for either endianness.
  EntityId entity() {
    const Octets taken = take(4);
    std::uint32_t value = 0;
    for (const std::byte octet : taken) value = value << 8U | std::to_integer<std::uint32_t>(octet);
    return {value};
  }
  /// The next octets; empty if there are fewer.
  Octets take(std::size_t count) {
    if (count > left()) {
      is_short_ = true;
      position_ = octets_.size();
      return {};
    }
    const Octets taken = octets_.subspan(position_, count);
    position_ += count;
    return taken;
  }

  std::size_t left() const { return octets_.size() - position_; }
  std::size_t position() const { return position_; }
  bool is_short() const { return is_short_; }

 private:
  template <class T>
  T read() {
    const Octets taken = take(sizeof(T));
    if (taken.empty()) return 0;
    T value;
    std::memcpy(&value, taken.data(), sizeof(T));
    const bool is_swapped =
        (endianness_ == Endianness::kLittle) != (std::endian::native == std::endian::little);
    return is_swapped ? swapped(value) : value;
  }
  static std::uint8_t swapped(std::uint8_t value) { return value; }
  static std::uint16_t swapped(std::uint16_t value) { return __builtin_bswap16(value); }
  static std::uint32_t swapped(std::uint32_t value) { return __builtin_bswap32(value); }
  static std::uint64_t swapped(std::uint64_t value) { return __builtin_bswap64(value); }

  Octets octets_;
  Endianness endianness_;
  std::size_t position_ = 0;
  bool is_short_ = false;
};

}  // namespace hal::rtps
