#pragma once

#include <string>
#include <vector>

#include "baraka/run/network/network_of_run.h"
#include "sim/agents/real_time.h"

namespace baraka::run::network {

/// Reasons to doubt the result of a run with networks, one line each.
/// @param factor  simulated seconds per second.
/// @param limit  of the lateness of frames.
std::vector<std::string> network_warnings(const sim::agents::AirSummary& air,
                                          const NetworkSummary& network, double factor,
                                          hal::Duration limit);

/// The same of a run in lock-step, in which nothing is late.
std::vector<std::string> held_network_warnings(const sim::agents::AirSummary& air,
                                               const NetworkSummary& network);

/// Prints the numbers as "key: value" lines on standard output.
void print_network(const sim::agents::AirSummary& air, const NetworkSummary& network);

}  // namespace baraka::run::network
