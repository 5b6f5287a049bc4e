#pragma once

#include <map>
#include <vector>

#include "hal/types/agent_id.h"
#include "hal/types/geometry.h"

namespace controllers {

/// An agent and its position, m, in any common frame.
struct Seen {
  hal::AgentId agent;
  hal::Vec2 position;
};

/// A gap in the network, which a robot can bridge by standing halfway between two agents.
struct Gap {
  hal::AgentId island;         ///< Lowest address in a group of agents that are cut off together.
  double need = 0;             ///< Sum of the needs of that group.
  hal::AgentId near{}, far{};  ///< One agent of the group, and one beyond the gap.
  hal::Vec2 place{};           ///< m, halfway between near and far.
};

/// The gaps around calling agents, one per island; gaps too wide for one robot (2 reach) are left
/// out.
///
/// Callers within `reach` of each other form one island. A silent agent within reach of a caller
/// must have failed: if it worked and heard the sink, the caller would hear it, too; if it worked
/// and did not hear the sink, it would call. So the far side of a gap is the nearest silent agent
/// that is out of reach of all callers.
/// @param seen  all other agents.  @param callers  need of each.  @param reach  of a radio, m
/// @param seen  agents without oneself.  @param callers  need of each.  @param reach  m, of a radio
std::vector<Gap> find_gaps(const std::vector<Seen>& seen,
                           const std::map<hal::AgentId, double>& callers, double reach);

/// Relative importance of distance, energy and need.
struct Weights {
  double need = 1, energy = 1, distance = 1;  ///< Exponents, >= 0; 0: ignored.
  double drive_cost = 0;                      ///< J/m.
  double reserve = 0;                         ///< J that must remain on arrival.
};

/// Worth of a gap, need^a left^b / (1 m + distance)^c (a formula of this project), where a, b, c
/// are the exponents in `weights` and `left` is the energy that remains on arrival: in joules, so
/// that robots with different batteries can be compared. 0: the energy does not suffice.
/// @param distance  m  @param energy  J in the battery
double worth(const Gap& gap, double distance, double energy, const Weights& weights);

}  // namespace controllers
