#pragma once

#include <cstdint>
#include <optional>

namespace gateway::guard {

/// Whether a process has a socket open; nullopt if that is not permitted to know or it has ended.
/// @param inode  of the socket, as in /proc/net/udp.
std::optional<bool> has_socket(std::int64_t pid, std::uint64_t inode);

/// A process that has a socket open; none, or none that this one may look at: nothing. Looks
/// through all processes.
std::optional<std::int64_t> process_with(std::uint64_t inode);

}  // namespace gateway::guard
