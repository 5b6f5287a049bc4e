#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "hal/types/prefetch.h"
#include "hal/types/time.h"
#include "sim/radio/channel/faint_frames.h"
#include "sim/radio/channel/station_index.h"
#include "sim/radio/phy/reception.h"

namespace sim::radio {

/// Frames at one receiver that are too weak to be received or sensed by themselves. They add to the
/// interference and to the sensed energy from their start until their end. They cost no event:
/// their sum is computed on demand. Do not ask for a time before keep_from() or, without that,
/// before the last add().
///
/// Frames are either added when they begin, or are among the FaintFrames: of these a receiver keeps
/// only what it needs, while it is receiving (keep_from()) or when it adds up energy.
/// Aligned to one cache line, because of the hundreds of receivers at which a frame is faint hardly
/// any is in the cache.
class alignas(64) FaintSignals {
 public:
  /// @param frames  outlives this; knows this receiver. @param alarm  as in set_alarm().
  FaintSignals(FaintFrames& frames, StationIndex self, double alarm);

  /// Adds a frame. @param sent  now, when the frame leaves its transmitter; it starts here `delay`
  /// later.
  /// @param power  mW
  /// @return whether the sum may reach the alarm level.
  bool add(StationIndex from, hal::Time sent, hal::Duration delay, hal::Duration airtime,
           double power);

  /// The last of the FaintFrames begins, is faint here, and the bound has reached the alarm.
  /// @return whether the sum may reach the alarm level.
  bool start(hal::Time now);

  /// This receiver is about to jump elsewhere: what is on the air reaches it where it was.
  void displace(hal::Time now);

  /// Prefetches the memory to which add() will write.
  void prefetch() const { __builtin_prefetch(signals_.data() + signals_.size(), 1); }
  /// Prefetches the memory that add_to() will read.
  void prefetch_all() const {
    if (asks_) frames_->prefetch(self_);
    hal::prefetch(signals_);
  }

  /// Cuts off the frame that this transmitter began at `sent`: it ends there at `cut`, and here
  /// after its delay.
  void cut(StationIndex from, hal::Time sent, hal::Time cut);

  /// Adds the signals present at `at` to `sum`, and reduces `until` to the next start or end after
  /// `at`. @pre `at` is now, or not before keep_from().
  void add_to(Interference& sum, hal::Time at, hal::Time& until);

  /// Adds the signals that are present both before and after `at`. Signals that start at `at` are
  /// left out: whether they are known by now depends on the order of events. @pre as add_to()
  void add_lasting_to(Interference& sum, hal::Time at);

  struct Span {
    hal::Time start{};
    hal::Time end{};
  };
  /// Start and end of the last frame, when the alarm has been raised for it or it has been asked
  /// for since; the epoch if there is none.
  Span newest() const {
    if (signals_.empty()) return {};
    return {signals_.back().start, signals_.back().end()};
  }

  /// Upper bound of the sum at any time that may still be asked for [mW].
  double bound() const { return asks_ ? level().bound : bound_; }

  /// Sets the level of the bound [mW] from which on add() returns true.
  void set_alarm(double power) {
    alarm_ = power;
    if (asks_ && !is_kept()) level().alarm = alarm_;
  }

  /// keep_from(): a frame is being received, so signals from `at` on will be asked for later.
  /// keep_nothing(): no frame is being received.
  /// @param at  now, the first time.
  void keep_from(hal::Time at) {
    if (asks_ && !is_kept()) {
      bring_up_to(at);
      level().alarm = -std::numeric_limits<double>::infinity();
    }
    needed_from_ = at;
  }
  void keep_nothing() {
    needed_from_ = hal::Time::max();
    if (asks_) level().alarm = alarm_;
  }

 private:
  bool is_kept() const { return needed_from_ != hal::Time::max(); }
  FaintFrames::Level& level() const { return frames_->level(self_); }
  bool may_alarm(hal::Time now);
  bool may_alarm_after(hal::Time now);
  bool add_with_care(StationIndex from, hal::Time sent, hal::Duration delay, hal::Duration airtime,
                     double power);
  void append(StationIndex from, hal::Time sent, hal::Duration delay, hal::Duration airtime,
              double power);
  void make_room(hal::Time now);
  void bring_up_to(hal::Time now);
  void forget(hal::Time now);
  void add_up();

  std::vector<FaintSignal> signals_;  ///< In the order of transmission.
  double alarm_;
  hal::Time needed_from_ = hal::Time::max();
  FaintFrames* frames_;
  double bound_ = 0;  ///< If nothing is asked for.
  StationIndex self_;
  bool asks_;               ///< Frames of stations are asked for; else each is added.
  bool has_added_ = false;  ///< Whether any of the signals may be `is_added`. Known if it asks.
};

// Called for each of hundreds of receivers of a frame; what hardly ever happens is elsewhere.
[[gnu::always_inline]] inline bool FaintSignals::add(StationIndex from, hal::Time sent,
                                                     hal::Duration delay, hal::Duration airtime,
                                                     double power) {
  if (asks_ || signals_.size() == signals_.capacity()) [[unlikely]] {
    return add_with_care(from, sent, delay, airtime, power);
  }
  append(from, sent, delay, airtime, power);
  bound_ += power;
  if (bound_ < alarm_) [[likely]]
    return false;
  return may_alarm_after(sent);
}

inline void FaintSignals::append(StationIndex from, hal::Time sent, hal::Duration delay,
                                 hal::Duration airtime, double power) {
  if (signals_.size() == signals_.capacity()) __builtin_unreachable();  // else not in line
  // In place: a copy of members just written one by one would wait for them.
  FaintSignal& signal = signals_.emplace_back();
  signal.start = sent + delay;
  signal.power = power;
  signal.airtime = static_cast<std::uint32_t>(airtime.count());
  signal.delay = static_cast<std::uint32_t>(delay.count());
  signal.from = static_cast<std::uint16_t>(from);
  signal.is_added = true;
}

static_assert(sizeof(FaintSignals) == 64);

}  // namespace sim::radio
