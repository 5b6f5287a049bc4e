#pragma once

#include <vector>

#include "hal/types/verdict.h"
#include "sim/radio/radio_config.h"

namespace sim::radio {

/// Verdicts that frames can have at radios of a profile, for any values of its keys: a count of one
/// of these without events is 0; a count of any other does not exist. kBelowSensitivity is always
/// among them, because records derive its count from the frames sent.
std::vector<hal::Verdict> reception_verdicts(const RadioConfig& config);

/// Verdicts that requests to the link can have.
/// @param has_access_points  whether some station is an access point.
std::vector<hal::Verdict> request_verdicts(const RadioConfig& config, bool has_access_points);

}  // namespace sim::radio
