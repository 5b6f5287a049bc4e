#pragma once

#include <cstddef>
#include <string>

namespace gateway {

/// Makes room for the files that this process opens to serve so many controller processes: raises
/// its limit of open files as far as it may be raised.
/// @throws std::runtime_error  if that is not far enough, saying how to raise it further.
void make_room_for(std::size_t processes);

/// What an errno of fork, pipe or the like means, with the limit that was met and how to raise it.
std::string limit_met(int error);

}  // namespace gateway
