#pragma once

#include <vector>

#include "hal/types/verdict.h"
#include "sim/radio/radio_config.h"

namespace sim::radio {

/// How frames can end at radios of a profile, whatever its keys say: a count of one of these that
/// nobody made is 0, a count of another does not exist. kBelowSensitivity is told of by who sent.
std::vector<hal::Verdict> reception_verdicts(const RadioConfig& config);

/// Likewise, of what the link is asked to send.
/// @param has_access_points  some station is one.
std::vector<hal::Verdict> request_verdicts(const RadioConfig& config, bool has_access_points);

}  // namespace sim::radio
