#pragma once

#include <cstdint>
#include <string_view>

namespace results::report {

/// Cyclic redundancy check with the polynomial of IEEE Std 802.3-2018, clause 3.2.9, reflected, as
/// zip, PNG and MCAP files have it.
///
///   Crc32 crc;
///   crc.add("1234"), crc.add("56789");
///   crc.value();   // 0xcbf43926
class Crc32 {
 public:
  void add(std::string_view bytes);
  std::uint32_t value() const { return ~state_; }

 private:
  std::uint32_t state_ = 0xffffffff;
};

std::uint32_t crc32(std::string_view bytes);

}  // namespace results::report
