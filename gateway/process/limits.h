#pragma once

#include <cstddef>
#include <string>

namespace gateway::process {

/// Raises this process's limit of open files, as far as permitted, to what it needs to serve this
/// number of controller processes.
/// @throws std::runtime_error  if that does not suffice, with advice how to raise it further.
void make_room_for(std::size_t processes);

/// Text for an errno of fork, pipe and similar calls, with the limit that was reached and how to
/// raise it.
std::string limit_met(int error);

}  // namespace gateway::process
