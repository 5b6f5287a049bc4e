#pragma once

#include <string>
#include <vector>

#include "sim/agents/simulation_config.h"

namespace sim::scenario {

/// A word for which a run can have a count, possibly 0: "collision" of receptions.
struct Countable {
  std::string family;   ///< Prefix of the scalars: "receptions", "messages.ends", "states", …
  std::string program;  ///< Controller that declares it; "": the run itself.
  std::string word;     ///< As in the other tables: "retry limit".
};

/// What a run counts.
struct Counted {
  bool frames = true, messages = true;
  bool samples = true;  ///< Of DDS, if an agent has a network.
};

/// All countable words except those that controllers declare. They depend on the profile of the
/// radio and on the routing of a run, not on the values of their keys, so that runs can be compared
/// in some of which a count is 0.
std::vector<Countable> countable_of(const agents::SimulationConfig& config, const Counted& counted);

}  // namespace sim::scenario
