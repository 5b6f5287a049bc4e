#pragma once

#include <optional>
#include <string>

#include "sim/air/network_config.h"

namespace sim::scenario {

/// Parses "10.77.0.0/16" or "fd00::/8"; nullopt if the text is anything else, or has bits beyond
/// the prefix.
std::optional<air::IpNetwork> parsed_network(const std::string& text);

/// 0.0.0.0/0 or ::/0.
constexpr air::IpNetwork everything(bool is_ipv6) { return {.is_ipv6 = is_ipv6}; }

/// Whether an IPv4 address, in host order, is in the network.
bool is_within(const air::IpNetwork& network, std::uint32_t address);

}  // namespace sim::scenario
