#pragma once

#include <algorithm>
#include <cstdint>

#include "hal/types/agent_id.h"
#include "hal/types/random.h"
#include "hal/types/time.h"
#include "sim/core/event_queue.h"

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
  void set_limits(std::uint32_t min, std::uint32_t max) {
    min_ = min;
    max_ = max;
    value_ = std::clamp(value_, min, max);
  }
  void grow() { value_ = value_ >= max_ ? max_ : 2 * value_ + 1; }

 private:
  std::uint32_t min_, max_, value_;
};

/// Intervals of one contention function.
struct AccessTiming {
  hal::Duration slot;
  hal::Duration aifs;      ///< DIFS, or AIFS of the access category.
  hal::Duration cca_time;  ///< As in DcfTiming.
  /// EDCA: the first slot is counted at the end of the AIFS, whether it stays idle or not (IEEE Std
  /// 802.11-2020, 10.23.2.4); DCF: each slot at its end, if it was idle (10.3.4.3).
  bool counts_first = false;
};

/// Access and backoff of one contention function (IEEE Std 802.11-2020, 10.3.4.2, 10.3.4.3 and
/// 10.23.2).
///
///               draw()                 medium idle for DIFS, AIFS or EIFS
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
  /// @param random,listener  outlive this object.
  Backoff(EventQueue& events, hal::AgentId agent, const AccessTiming& timing,
          hal::RandomStream& random, AccessListener& listener);

  /// Asks for access: on_access() is called once, as soon as the rules allow, and never from within
  /// this call. No effect if access has already been requested.
  void request(std::uint32_t contention_window);

  /// Starts a new backoff of 0 .. contention_window slots, whether or not access is requested.
  void draw(std::uint32_t contention_window);

  /// Report the state of the medium by physical and virtual carrier sense.
  void on_busy(std::uint32_t contention_window);
  void on_idle();

  /// Treats the medium as busy until this time, which may lie in the future: during an EIFS.
  void hold_until(hal::Time until) { held_until_ = until; }

  /// Replaces the interframe space, from the next time on that the medium becomes idle.
  void set_aifs(hal::Duration aifs);

  /// Resets all state when the radio is switched off. @param busy  state of the medium.
  void reset(bool busy);

 private:
  hal::Time counting_from() const;
  void count_slots(hal::Time until);
  void schedule();

  EventQueue& events_;
  hal::AgentId agent_;
  AccessTiming timing_;
  hal::RandomStream& random_;
  AccessListener& listener_;

  bool busy_ = false;
  bool wanted_ = false;
  bool backing_off_ = false;
  std::int64_t slots_ = 0;  ///< Slots left to count.
  hal::Time idle_since_{};
  hal::Time held_until_ = hal::Time::min();
  EventQueue::EventId access_;
  hal::Time access_at_{};
};

}  // namespace sim::radio
