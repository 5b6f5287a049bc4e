#pragma once

#include <bit>
#include <concepts>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "hal/types/agent_id.h"
#include "hal/types/message.h"
#include "hal/types/time.h"

namespace hal {

/// A type with a fixed encoding in a payload: an integer, a bool, an enumeration (as its integer),
/// a float or double (IEEE 754), a Time or Duration (ns, 64 bits), an address (16 bits).
template <class T>
concept PlainValue =
    std::integral<T> || std::is_enum_v<T> || std::same_as<T, float> || std::same_as<T, double> ||
    std::same_as<T, Time> || std::same_as<T, Duration> || std::same_as<T, AgentId>;

/// Writes plain values in order, little-endian and without padding, so that every processor and
/// compiler reads the same values.
///
///   robot.send(m17, "where", hal::PayloadWriter().put(pose.x).put(pose.y).put(kCharging).bytes());
///   …
///   hal::PayloadReader in(message.payload);
///   const auto x = in.get<double>(), y = in.get<double>();
///   const auto doing = in.get<Doing>();
///   if (!in.ended_well()) return;  // not what "where" carries
class PayloadWriter {
 public:
  /// Appends a value of sizeof(T) octets; Time and Duration take 8, an address takes 2.
  template <PlainValue T>
  PayloadWriter& put(T value);

  /// Appends the length as 16 bits, then the bytes. A text beyond 65535 bytes is truncated.
  PayloadWriter& put(std::string_view text) {
    text = text.substr(0, std::numeric_limits<std::uint16_t>::max());
    put(static_cast<std::uint16_t>(text.size()));
    bytes_.insert(bytes_.end(), text.begin(), text.end());
    return *this;
  }
  /// The same for a string literal.
  PayloadWriter& put(const char* text) { return put(std::string_view(text)); }

  /// Everything written so far.
  const Bytes& bytes() const { return bytes_; }

 private:
  Bytes bytes_;
};

/// Reads what PayloadWriter wrote, in the same order. Past the end it returns zeros and remembers
/// the error: call ended_well() once before using any value. The bytes must outlive it.
class PayloadReader {
 public:
  /// Starts at the first of the bytes.
  explicit PayloadReader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  /// The next value; 0 past the end.
  template <PlainValue T>
  T get();
  /// The next text, as put(std::string_view) wrote it.
  std::string text() {
    const auto part = cut(get<std::uint16_t>());
    return {part.begin(), part.end()};
  }

  /// Whether all octets were read, none past the end, and every bool was 0 or 1.
  bool ended_well() const { return !broken_ && bytes_.empty(); }

 private:
  std::span<const std::uint8_t> cut(std::size_t size) {
    if (size > bytes_.size()) {
      broken_ = true;
      size = bytes_.size();
    }
    const auto part = bytes_.first(size);
    bytes_ = bytes_.subspan(size);
    return part;
  }

  std::span<const std::uint8_t> bytes_;
  bool broken_ = false;
};

template <PlainValue T>
PayloadWriter& PayloadWriter::put(T value) {
  if constexpr (std::is_enum_v<T>) {
    return put(static_cast<std::underlying_type_t<T>>(value));
  } else if constexpr (std::same_as<T, AgentId>) {
    return put(value.value);
  } else if constexpr (std::same_as<T, Duration>) {
    return put(value.count());
  } else if constexpr (std::same_as<T, Time>) {
    return put(value.time_since_epoch());
  } else if constexpr (std::same_as<T, float>) {
    return put(std::bit_cast<std::uint32_t>(value));
  } else if constexpr (std::same_as<T, double>) {
    return put(std::bit_cast<std::uint64_t>(value));
  } else {
    for (std::size_t octet = 0; octet < sizeof value; ++octet) {
      bytes_.push_back(static_cast<std::uint8_t>(static_cast<std::uint64_t>(value) >> 8 * octet));
    }
    return *this;
  }
}

template <PlainValue T>
T PayloadReader::get() {
  if constexpr (std::is_enum_v<T>) {
    return static_cast<T>(get<std::underlying_type_t<T>>());
  } else if constexpr (std::same_as<T, AgentId>) {
    return AgentId{get<std::uint16_t>()};
  } else if constexpr (std::same_as<T, Duration>) {
    return Duration{get<std::int64_t>()};
  } else if constexpr (std::same_as<T, Time>) {
    return Time{get<Duration>()};
  } else if constexpr (std::same_as<T, float>) {
    return std::bit_cast<float>(get<std::uint32_t>());
  } else if constexpr (std::same_as<T, double>) {
    return std::bit_cast<double>(get<std::uint64_t>());
  } else if constexpr (std::same_as<T, bool>) {
    const auto octet = get<std::uint8_t>();
    broken_ = broken_ || octet > 1;
    return octet == 1;
  } else {
    std::uint64_t value = 0;
    int shift = 0;
    for (const std::uint8_t octet : cut(sizeof(T))) {
      value |= std::uint64_t{octet} << shift;
      shift += 8;
    }
    return static_cast<T>(value);
  }
}

}  // namespace hal
