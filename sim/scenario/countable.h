#pragma once

#include <string>
#include <vector>

#include "sim/agents/simulation_config.h"

namespace sim::scenario {

/// A word of which a run can have a count, be it 0: "collision" of receptions.
struct Countable {
  std::string family;   ///< As scalars begin: "receptions", "messages.ends", "states", …
  std::string program;  ///< Whose controllers; "": of the run.
  std::string word;     ///< As the other tables have it: "retry limit".
};

/// All but what controllers declare, by what the run is: its radio's profile and its routing, not
/// the values of their keys, so that runs are compared in which one of these makes the count 0.
/// @param frames, messages  whether they are counted.
std::vector<Countable> countable_of(const agents::SimulationConfig& config, bool frames,
                                    bool messages);

}  // namespace sim::scenario
