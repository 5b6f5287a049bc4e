#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "hal/types/time.h"
#include "sim/core/event_queue.h"
#include "sim/radio/frame.h"
#include "sim/radio/propagation.h"
#include "sim/radio/station_index.h"

namespace sim::radio {

class Radio;

/// A frame on its way to the radios that notice it.
struct Transmission {
  /// What happens to it at each of them, with propagation delay.
  enum class Phase : std::uint8_t { kArrival, kWindow, kEnd };
  static constexpr std::size_t kPhases = 3;

  struct Receiver {
    Radio* radio;
    StationIndex index;
    Propagation::Arrival arrival;
    /// Among the events of its time, by phase. Order 0, which no event of a radio has: it does not
    /// happen here, or not yet.
    std::array<EventQueue::Place, kPhases> places{};
  };

  /// A phase takes one event after another, not one for each receiver at a time, in the queue.
  struct Series {
    std::size_t next = 0;  ///< The receiver that its event is for.
    bool is_pending = false;
  };

  hal::Time due(Phase phase, const Receiver& receiver) const {
    return start + receiver.arrival.delay + after_arrival[static_cast<std::size_t>(phase)];
  }

  FramePtr frame;
  Radio* from = nullptr;
  hal::Time start{};
  std::array<hal::Duration, kPhases> after_arrival{};
  std::vector<Receiver> receivers;  ///< In the order in which it arrives.
  std::array<Series, kPhases> series;
  EventQueue::EventId end;
  int uses = 0;  ///< By events that are pending. Without any it is over.
};

/// Transmissions, each for one frame after another, so that none costs memory of its own.
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

  /// Gives it back with the last use.
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
