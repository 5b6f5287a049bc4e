#pragma once

#include <cstdint>

#include "hal/types/agent_id.h"
#include "hal/types/random.h"
#include "hal/types/time.h"
#include "sim/core/event_queue.h"
#include "sim/radio/mac/dcf_timing.h"

namespace sim::radio {

/// Is called when the station may access the medium.
class AccessListener {
 public:
  virtual ~AccessListener() = default;
  virtual void on_access() = 0;
};

/// Contention window (IEEE Std 802.11-2016, 10.3.3): 2^n - 1 between two limits.
class ContentionWindow {
 public:
  ContentionWindow(std::uint32_t min, std::uint32_t max) : min_(min), max_(max), value_(min) {}
  std::uint32_t value() const { return value_; }
  void reset() { value_ = min_; }
  void grow() { value_ = value_ >= max_ ? max_ : 2 * value_ + 1; }

 private:
  std::uint32_t min_, max_, value_;
};

/// DCF access and backoff of one station (IEEE Std 802.11-2016, 10.3.4.2 and 10.3.4.3).
///
///               draw()                 medium idle for DIFS or EIFS
///   no backoff ------------> frozen <-------------------------> counting
///      ^                             medium busy                   |
///      +--------------- all slots counted: on_access(), if wanted -+
///
/// A station that requests access gets it at once if the medium has been idle long enough; if it is
/// busy, the station draws a backoff. A frame that begins within the CCA time before a slot
/// boundary is not detected at it (10.3.7): the slot counts as idle, and a station whose backoff
/// ends at the boundary transmits. Slots are counted lazily: there is one event, at the end, and
/// only while access is requested.
class Backoff {
 public:
  Backoff(EventQueue& events, hal::AgentId agent, const DcfTiming& timing, hal::RandomStream random,
          AccessListener& listener);

  /// Asks for access: on_access() is called once, as soon as the rules allow, and never from within
  /// this call. No effect if access has already been requested.
  void request(std::uint32_t contention_window);

  /// Starts a new backoff of 0 .. contention_window slots, whether or not access is requested.
  void draw(std::uint32_t contention_window);

  /// Report the state of the medium by physical and virtual carrier sense.
  void on_busy(std::uint32_t contention_window);
  void on_idle();

  /// Treats the time until now as busy, after the station's own response timeout.
  void restart_idle();

  /// No slot is counted before this time: the end of an EIFS.
  void hold_until(hal::Time until) { not_before_ = until; }

  /// Resets all state when the radio is switched off. @param busy  state of the medium.
  void reset(bool busy);

 private:
  hal::Time counting_from() const;
  void count_slots(hal::Time until);
  void schedule();

  EventQueue& events_;
  hal::AgentId agent_;
  DcfTiming timing_;
  hal::RandomStream random_;
  AccessListener& listener_;

  bool busy_ = false;
  bool wanted_ = false;
  bool backing_off_ = false;
  std::int64_t slots_ = 0;  ///< Slots left to count.
  hal::Time idle_since_{};
  hal::Time not_before_{};
  EventQueue::EventId access_;
  hal::Time access_at_{};
};

}  // namespace sim::radio
