#pragma once

#include <cstdint>
#include <optional>

namespace baraka::run::network {

/// How often the kernel's tables of neighbours (ARP, IPv6) have had no room for one: each time a
/// packet has gone nowhere. All network namespaces of a computer share them, and
/// net.ipv4.neigh.default.gc_thresh3 with its twin of ipv6 is their size. After
/// /proc/net/stat/arp_cache and ndisc_cache, column table_fulls.
/// @return none: the system does not tell.
std::optional<std::uint64_t> neighbour_table_overflows();

}  // namespace baraka::run::network
