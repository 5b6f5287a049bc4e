#include "baraka/run/network/tcp_pace.h"

#include <algorithm>

namespace baraka::run::network {

using namespace std::chrono_literals;

void TcpPace::set_out(hal::Time virtual_time, hal::Time wall) {
  from_ = virtual_time;
  wall_from_ = wall;
}

/// A run that is slower than wall time is not made to catch up.
std::optional<hal::Duration> TcpPace::hold(hal::Time next, hal::Time wall) {
  constexpr hal::Duration kSlack = 50us, kLongest = 1ms;
  const hal::Duration ahead = (next - from_) - (wall - wall_from_);
  if (!may_have_timer_ || ahead <= hal::Duration{}) {
    set_out(next, wall);
    return std::nullopt;
  }
  if (ahead <= kSlack) return std::nullopt;
  if (!has_timer_()) {
    may_have_timer_ = false;
    set_out(next, wall);
    return std::nullopt;
  }
  return std::min(ahead, kLongest);
}

}  // namespace baraka::run::network
