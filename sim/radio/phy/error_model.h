#pragma once

#include "hal/types/quantity.h"
#include "sim/radio/radio_config.h"

namespace sim::radio {

/// Probability that all of `bits` bits sent at `rate` arrive when the SINR (a ratio, not dB) is the
/// same for all of them.
///
/// kMobilityFramework: independent bit errors as the Mobility Framework 1.0a5 computes them, 2 MHz
/// bandwidth (source as imported into INET in 2005, MF80211: Decider80211).
/// kDsss: additive white noise in 22 MHz after L. E. Miller, "Validation of 802.11a/UWB Coexistence
/// Simulation", NIST, 2003: DBPSK at 1 Mb/s, DQPSK at 2 Mb/s, CCK as 16-ary biorthogonal keying at
/// 5.5 Mb/s and two of those side by side at 11 Mb/s.
/// @param sinr  >= 0, may be infinite.
/// @param bits  >= 0; fractions count.
/// @pre rate is 1, 2, 5.5 or 11 Mb/s.
double success_probability(ErrorModel model, double sinr, hal::BitsPerSecond rate, double bits);

}  // namespace sim::radio
