#pragma once

#include <cstdint>

#include "hal/types/time.h"

namespace sim::radio {

/// What a radio does.
enum class RadioActivity : std::uint8_t { kTransmitting, kReceiving, kListening, kOff };

/// Is told at once when a radio begins to do something else, while the radio is still at it: to
/// take note, and to schedule, nothing else.
class RadioUseListener {
 public:
  virtual ~RadioUseListener() = default;
  virtual void on_activity(RadioActivity activity) = 0;
};

/// How long a radio has been in each of its states since time 0.
struct RadioUse {
  hal::Duration transmitting{};
  hal::Duration receiving{};  ///< The medium was busy; profiles without a MAC never are.
  hal::Duration listening{};
  hal::Duration off{};
};

}  // namespace sim::radio
