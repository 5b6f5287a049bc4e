#pragma once

#include "hal/types/random.h"
#include "sim/radio/mac/mac_base.h"
#include "sim/radio/radio_config.h"

namespace sim::radio {

class Radio;

/// The parts from which the MAC of a station of a ForeignProfileConfig is made.
struct MacParts {
  const MacBase::Context& context;     ///< As for the constructor of MacBase.
  const ForeignProfileConfig& config;  ///< As it applies to this station; outlives the MAC.
  Radio& radio;                        ///< Outlives the MAC; no other MAC uses it.
  hal::RandomStream backoff;           ///< "<agent>/backoff"
};

}  // namespace sim::radio
