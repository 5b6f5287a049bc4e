#pragma once

#include "hal/types/random.h"
#include "sim/radio/mac_base.h"
#include "sim/radio/radio_config.h"

namespace sim::radio {

class Radio;

/// What the MAC of a station of a ForeignProfileConfig is made of.
struct MacParts {
  const MacBase::Context& context;     ///< As MacBase takes it.
  const ForeignProfileConfig& config;  ///< As it is for this station; outlives the MAC …
  Radio& radio;                        ///< … and so does this, which is the MAC's alone.
  hal::RandomStream backoff;           ///< "<agent>/backoff"
};

}  // namespace sim::radio
