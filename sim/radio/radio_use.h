#pragma once

#include "hal/types/time.h"

namespace sim::radio {

/// How long a radio has been in each of its states since time 0.
struct RadioUse {
  hal::Duration transmitting{};
  hal::Duration receiving{};  ///< The medium was busy; profiles without a MAC never are.
  hal::Duration listening{};
  hal::Duration off{};
};

}  // namespace sim::radio
