#pragma once

#include <map>
#include <vector>

#include "hal/types/agent_id.h"
#include "hal/types/geometry.h"

namespace controllers {

/// An agent, and where it is: m, in any one frame.
struct Seen {
  hal::AgentId agent;
  hal::Vec2 position;
};

/// A gap in the network, and how it can be bridged: by standing halfway between two agents.
struct Gap {
  hal::AgentId island;  ///< Those that are cut off together, by the lowest address among them.
  double need = 0;      ///< Sum of theirs.
  hal::AgentId near{}, far{};  ///< One of them, and one beyond the gap.
  hal::Vec2 place{};           ///< m, halfway.
};

/// The gaps that somebody called about, by island; those too wide for one robot are left out.
///
/// Callers within `reach` of each other are one island. Who is silent within reach of a caller must
/// have failed: did it live and hear the sink, the caller would, too; did it live and not, it would
/// call. So the far side of a gap is the nearest agent that is silent, and out of reach of all who
/// call, of no island.
/// @param seen  agents without oneself.  @param callers  need of each.  @param reach  m, of a radio
std::vector<Gap> find_gaps(const std::vector<Seen>& seen,
                           const std::map<hal::AgentId, double>& callers, double reach);

/// How distance, energy and need count against each other.
struct Weights {
  double need = 1, energy = 1, distance = 1;  ///< Exponents, >= 0; 0: does not count.
  double drive_cost = 0;                      ///< J for a metre.
  double reserve = 0;                         ///< J that must be left on arrival.
};

/// need^a left^b / (1 m + distance)^c, `left` being the energy that is left on arrival: joules, so
/// that robots with batteries of different size can be compared. 0: not to be reached with what
/// there is.
/// @param distance  m  @param energy  J in the battery
double worth(const Gap& gap, double distance, double energy, const Weights& weights);

}  // namespace controllers
