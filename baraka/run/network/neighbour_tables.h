#pragma once

#include <cstdint>
#include <optional>

namespace baraka::run::network {

/// How often the kernel's neighbour tables (ARP, IPv6 neighbour discovery) were full; each time a
/// packet was lost. All network namespaces of a computer share these tables; their size is
/// net.ipv4.neigh.default.gc_thresh3 and net.ipv6.neigh.default.gc_thresh3. Source: column
/// table_fulls of /proc/net/stat/arp_cache and ndisc_cache.
/// @return none: the system does not provide the numbers.
std::optional<std::uint64_t> neighbour_table_overflows();

}  // namespace baraka::run::network
