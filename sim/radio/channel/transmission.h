#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "hal/types/time.h"
#include "sim/core/event_queue.h"
#include "sim/radio/channel/propagation.h"
#include "sim/radio/channel/station_index.h"
#include "sim/radio/mac/ppdu.h"

namespace sim::radio {

class Radio;

/// A PPDU on its way to the radios that it affects.
struct Transmission {
  /// Events of the frame at each radio, with propagation delay.
  enum class Phase : std::uint8_t { kArrival, kWindow, kEnd };
  static constexpr std::size_t kPhases = 3;

  struct Receiver {
    Radio* radio;
    StationIndex index;
    Propagation::Arrival arrival;
    /// Reserved place of the event of each phase. Order 0, which no event of a radio has: the event
    /// does not happen here, or has not been reserved yet.
    std::array<EventQueue::Place, kPhases> places{};
  };

  /// Each phase has one event in the queue, which serves one receiver after the other.
  struct Series {
    std::size_t next = 0;  ///< The receiver that its event is for.
    bool is_pending = false;
  };

  hal::Time due(Phase phase, const Receiver& receiver) const {
    return start + receiver.arrival.delay + after_arrival[static_cast<std::size_t>(phase)];
  }

  PpduPtr ppdu;
  Radio* from = nullptr;
  hal::Time start{};
  std::array<hal::Duration, kPhases> after_arrival{};
  std::vector<Receiver> receivers;  ///< In order of arrival.
  std::array<Series, kPhases> series;
  EventQueue::EventId end;
  int uses = 0;  ///< Number of pending events; at 0 the transmission is over.
};

/// Pool of transmissions, each reused for one frame after another, so that a frame allocates no
/// memory.
class Transmissions {
 public:
  Transmission& claim() {
    if (free_.empty()) {
      all_.push_back(std::make_unique<Transmission>());
      free_.push_back(all_.back().get());
    }
    Transmission& claimed = *free_.back();
    free_.pop_back();
    return claimed;
  }

  void add_use(Transmission& transmission) { ++transmission.uses; }

  /// Removes a use; the last one returns the transmission to the pool.
  void drop_use(Transmission& transmission) {
    if (--transmission.uses > 0) return;
    std::vector<Transmission::Receiver> receivers = std::move(transmission.receivers);
    receivers.clear();
    transmission = {};
    transmission.receivers = std::move(receivers);
    free_.push_back(&transmission);
  }

 private:
  std::vector<std::unique_ptr<Transmission>> all_;
  std::vector<Transmission*> free_;
};

}  // namespace sim::radio
