#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hal/node/exchange/action.h"
#include "hal/node/exchange/event.h"
#include "hal/types/time.h"

namespace hal::node::exchange {

/// Events for one process: all of one round, or of one lookahead window.
struct Step {
  std::string server;
  std::uint64_t run = 0;
  std::uint64_t sequence = 0;  ///< 1, 2, 3, … per process.
  Time until{};                ///< No event in a later Step is before this time.
  std::vector<Event> events;   ///< By (time, agent, cause, arrival).
  bool operator==(const Step&) const = default;
};

/// The answer to the Step of the same sequence.
struct Reply {
  std::string process;
  std::uint64_t run = 0;
  std::uint64_t sequence = 0;
  std::vector<Action> actions;  ///< In the order of the controllers' calls.
  bool operator==(const Reply&) const = default;
};

}  // namespace hal::node::exchange
