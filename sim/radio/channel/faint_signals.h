#pragma once

#include <cstdint>
#include <vector>

#include "hal/types/time.h"
#include "sim/radio/channel/station_index.h"
#include "sim/radio/phy/reception.h"

namespace sim::radio {

/// Frames at one receiver that are too weak to be received or sensed by themselves. They add to the
/// interference and to the sensed energy from their start until their end. They cost no event:
/// their sum is computed on demand. Do not ask for a time before keep_from() or, without that,
/// before the last add().
/// Aligned to one cache line, because of the hundreds of receivers at which a frame is faint hardly
/// any is in the cache.
class alignas(64) FaintSignals {
 public:
  /// @param alarm  as in set_alarm().
  explicit FaintSignals(double alarm) : alarm_(alarm) {}

  /// Adds a frame. @param sent  now, when the frame leaves its transmitter; it starts here `delay`
  /// later.
  /// @param power  mW
  /// @return whether the sum may reach the alarm level.
  bool add(StationIndex from, hal::Time sent, hal::Duration delay, hal::Duration airtime,
           double power);

  /// Prefetches the memory to which add() will write.
  void prefetch() const { __builtin_prefetch(signals_.data() + signals_.size(), 1); }
  /// Prefetches the memory that add_to() will read.
  void prefetch_all() const {
    constexpr std::size_t kPerCacheLine = 64 / sizeof(Signal);
    for (std::size_t i = 0; i < signals_.size(); i += kPerCacheLine) {
      __builtin_prefetch(signals_.data() + i);
    }
  }

  /// Cuts off the frame that this transmitter began at `sent`: it ends there at `cut`, and here
  /// after its delay.
  void cut(StationIndex from, hal::Time sent, hal::Time cut);

  /// Adds the signals present at `at` to `sum`, and reduces `until` to the next start or end after
  /// `at`.
  void add_to(Interference& sum, hal::Time at, hal::Time& until) const;

  /// Adds the signals that are present both before and after `at`. Signals that start at `at` are
  /// left out: whether they are known by now depends on the order of events.
  void add_lasting_to(Interference& sum, hal::Time at) const;

  struct Span {
    hal::Time start{};
    hal::Time end{};
  };
  /// Start and end of the frame that was added last; the epoch if there is none.
  Span newest() const {
    if (signals_.empty()) return {};
    return {signals_.back().start, signals_.back().end()};
  }

  /// Upper bound of the sum at any time that may still be asked for [mW].
  double bound() const { return bound_; }

  /// Sets the level of the bound [mW] from which on add() returns true.
  void set_alarm(double power) { alarm_ = power; }

  /// keep_from(): a frame is being received, so signals from `at` on will be asked for later.
  /// keep_nothing(): no frame is being received.
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

  std::vector<Signal> signals_;  ///< In the order of transmission.
  double bound_ = 0;
  double alarm_;
  hal::Time needed_from_ = hal::Time::max();
};

}  // namespace sim::radio
