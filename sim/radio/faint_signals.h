#pragma once

#include <cstdint>
#include <vector>

#include "hal/types/time.h"
#include "sim/radio/reception.h"
#include "sim/radio/station_index.h"

namespace sim::radio {

/// Frames at one receiver that are too weak to be received or sensed by themselves: they add to the
/// interference from their start until their end, and to the sensed energy. They cost no event:
/// their sum is computed on demand. Do not ask for a time before keep_from() or, without that,
/// before the last add().
/// One cache line: of the hundreds at which a frame is faint, hardly any is in the cache.
class alignas(64) FaintSignals {
 public:
  /// @param alarm  as of set_alarm().
  explicit FaintSignals(double alarm) : alarm_(alarm) {}

  /// @param sent  when the frame left its transmitter, now; it starts here `delay` later.
  /// @param power  mW
  /// @return whether the sum may reach the alarm.
  bool add(StationIndex from, hal::Time sent, hal::Duration delay, hal::Duration airtime,
           double power);

  /// Asks the cache for what add() will write to.
  void prefetch() const { __builtin_prefetch(signals_.data() + signals_.size(), 1); }
  /// The same of what add_to() will read.
  void prefetch_all() const {
    constexpr std::size_t kPerCacheLine = 64 / sizeof(Signal);
    for (std::size_t i = 0; i < signals_.size(); i += kPerCacheLine) {
      __builtin_prefetch(signals_.data() + i);
    }
  }

  /// The frame that this transmitter began at `sent` ends at `cut` there, and here after its delay.
  void cut(StationIndex from, hal::Time sent, hal::Time cut);

  /// Adds what there is at `at`, and brings `until` forward to the next start or end after `at`.
  void add_to(Interference& sum, hal::Time at, hal::Time& until) const;

  /// Adds what there was before `at` and is after it: whether what starts at `at` is known already
  /// depends on the order of events.
  void add_lasting_to(Interference& sum, hal::Time at) const;

  struct Span {
    hal::Time start{};
    hal::Time end{};
  };
  /// Of the frame that was added last; the epoch if there is none.
  Span newest() const {
    if (signals_.empty()) return {};
    return {signals_.back().start, signals_.back().end()};
  }

  /// No less than the sum of any time that may still be asked for, mW.
  double bound() const { return bound_; }

  /// The bound from which on add() says that the sum wants to be looked at, mW.
  void set_alarm(double power) { alarm_ = power; }

  /// A frame is being received: what there is from now on will be asked for later; or none is.
  void keep_from(hal::Time at) { needed_from_ = at; }
  void keep_nothing() { needed_from_ = hal::Time::max(); }

 private:
  struct Signal {
    hal::Time start{};
    double power = 0;           ///< mW
    std::uint32_t airtime = 0;  ///< ns
    std::uint32_t delay = 0;    ///< ns
    StationIndex from = 0;

    hal::Time end() const { return start + hal::Duration{airtime}; }
  };

  void forget(hal::Time now);

  std::vector<Signal> signals_;  ///< In the order in which they were sent.
  double bound_ = 0;
  double alarm_;
  hal::Time needed_from_ = hal::Time::max();
};

}  // namespace sim::radio
