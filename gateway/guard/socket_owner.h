#pragma once

#include <cstdint>
#include <optional>

namespace gateway::guard {

/// Whether a process has a socket open; nullopt if this process may not know, or the other one has
/// ended.
/// @param inode  of the socket, as in /proc/net/udp.
std::optional<bool> has_socket(std::int64_t pid, std::uint64_t inode);

/// A process that has a socket open; nullopt if there is none that this process may inspect.
/// Searches all processes.
std::optional<std::int64_t> process_with(std::uint64_t inode);

}  // namespace gateway::guard
