#pragma once

#include <compare>
#include <cstdint>
#include <string>

namespace gateway::guard {

/// A UDP port of an IPv4 address, both as numbers.
struct UdpSender {
  std::uint32_t address = 0;
  std::uint16_t port = 0;
  auto operator<=>(const UdpSender&) const = default;
  std::string text() const;  ///< "127.0.0.1:7660"
};

}  // namespace gateway::guard
