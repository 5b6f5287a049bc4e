#pragma once

#include <vector>

#include "results/fleet/fleet_answer.h"

namespace results::fleet {

/// The air counts as full if one radio has frames to send in at least kSaturated of the time, and
/// one finds the medium busy in at least kBusy: the rest of a saturated channel are the gaps
/// between frames and the backoff, which take half of it where frames are short (G. Bianchi,
/// "Performance Analysis of the IEEE 802.11 Distributed Coordination Function", IEEE Journal on
/// Selected Areas in Communications 18(3), 2000).
inline constexpr double kSaturated = 0.9, kBusy = 0.4;

/// The limits that a case misses, with causes. A limit is missed if the Estimate over the
/// runs is beyond it, or if a run has no such quantity.
std::vector<Miss> misses_of(const FleetFile& fleet, const CaseAnswer& answer);

/// A share as "97.3 %", a time as "12.4 ms".
std::string share_text(double share);
std::string time_text(double seconds);

}  // namespace results::fleet
