#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>

#include "sim/report/little_endian.h"

namespace sim::report {

/// A message in plain CDR, little endian, as ROS 2 puts it on the wire (OMG DDS-XTypes 1.3, 7.4.1
/// and 7.6.3.1.2): four bytes that say so, then the members one after the other, each number at a
/// multiple of its size, counted behind the four bytes.
///
///   Cdr message;
///   message.put(std::int32_t{1});
///   message.put("text");
///   file << message.bytes();
class Cdr {
 public:
  template <class Number>
  requires std::is_arithmetic_v<Number>
  void put(Number value) {
    align(sizeof value);
    append_little_endian(bytes_, value);
  }
  /// Its length with the zero byte, then the text and a zero byte.
  void put(std::string_view text);
  void put(const char* text) { put(std::string_view(text)); }

  /// How many items of a sequence follow.
  void put_count(std::size_t items) { put(static_cast<std::uint32_t>(items)); }

  const std::string& bytes() const { return bytes_; }

 private:
  static constexpr std::size_t kHeader = 4;

  void align(std::size_t size);

  std::string bytes_{'\0', '\1', '\0', '\0'};
};

}  // namespace sim::report
