#pragma once

#include <vector>

#include "results/fleet/fleet_answer.h"

namespace results::fleet {

/// The share of the time from which on a radio counts as busy all the time: what is left are the
/// gaps between frames and their backoff.
inline constexpr double kFull = 0.9;

/// The limits that a case misses, with causes. A limit is missed if the mean over the runs is
/// beyond it, or if a run has no such quantity.
std::vector<Miss> misses_of(const FleetFile& fleet, const CaseAnswer& answer);

/// A share as "97.3 %", a time as "12.4 ms".
std::string share_text(double share);
std::string time_text(double seconds);

}  // namespace results::fleet
