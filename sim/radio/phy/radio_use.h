#pragma once

#include <cstdint>

#include "hal/types/time.h"

namespace sim::radio {

/// Activity of a radio.
enum class RadioActivity : std::uint8_t { kTransmitting, kReceiving, kListening, kOff };

/// Is called when the activity of a radio changes, while the radio is changing state: a callback
/// may only record the change and schedule events.
class RadioUseListener {
 public:
  virtual ~RadioUseListener() = default;
  virtual void on_activity(RadioActivity activity) = 0;
};

/// How long a radio has been in each of its states since time 0.
struct RadioUse {
  hal::Duration transmitting{};
  hal::Duration receiving{};  ///< Medium busy; always 0 in profiles without medium access.
  hal::Duration listening{};
  hal::Duration off{};
};

}  // namespace sim::radio
