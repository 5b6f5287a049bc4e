#include "sim/scenario/ip_network.h"

#include <arpa/inet.h>

#include <algorithm>
#include <charconv>
#include <cstring>

namespace sim::scenario {
namespace {

constexpr int kIpv4Bits = 32, kIpv6Bits = 128;

/// Whether all bits of the address beyond the prefix are 0.
bool is_network(const air::IpNetwork& network) {
  for (int bit = network.prefix; bit < kIpv6Bits; ++bit) {
    const int octet = network.address[static_cast<std::size_t>(bit / 8)];
    if ((octet & 0x80 >> bit % 8) != 0) return false;
  }
  return true;
}

}  // namespace

std::optional<air::IpNetwork> parsed_network(const std::string& text) {
  const std::size_t slash = text.find('/');
  if (slash == std::string::npos) return std::nullopt;
  const std::string address = text.substr(0, slash);
  air::IpNetwork network{.is_ipv6 = address.find(':') != std::string::npos};
  const int family = network.is_ipv6 ? AF_INET6 : AF_INET;
  if (::inet_pton(family, address.c_str(), network.address.data()) != 1) return std::nullopt;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data() + slash + 1, end, network.prefix);
  const int most = network.is_ipv6 ? kIpv6Bits : kIpv4Bits;
  const bool is_good = error == std::errc{} && rest == end && network.prefix >= 0 &&
                       network.prefix <= most && is_network(network);
  if (!is_good) return std::nullopt;
  return network;
}

bool is_within(const air::IpNetwork& network, std::uint32_t address) {
  if (network.is_ipv6) return false;
  std::uint32_t first = 0;
  std::memcpy(&first, network.address.data(), sizeof first);
  return network.prefix == 0 || (ntohl(first) ^ address) >> (kIpv4Bits - network.prefix) == 0;
}

}  // namespace sim::scenario
