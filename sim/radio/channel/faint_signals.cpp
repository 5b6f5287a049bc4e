#include "sim/radio/channel/faint_signals.h"

#include <algorithm>

namespace sim::radio {
namespace {

constexpr std::size_t kSmallest = 8;

}  // namespace

FaintSignals::FaintSignals(FaintFrames& frames, StationIndex self, double alarm)
    : alarm_(alarm), frames_(&frames), self_(self), asks_(frames.answers(self)) {
  level().alarm = alarm;
}

/// If there may be no room, or frames of stations are asked for.
bool FaintSignals::add_with_care(StationIndex from, hal::Time sent, hal::Duration delay,
                                 hal::Duration airtime, double power) {
  if (signals_.size() == signals_.capacity()) make_room(sent);
  append(from, sent, delay, airtime, power);
  if (asks_) {
    has_added_ = true;
    signals_.back().order = frames_->pass();
    level().bound += power;
    return may_alarm(sent);
  }
  bound_ += power;
  return bound_ >= alarm_ && may_alarm_after(sent);
}

/// When the bound without asking has reached the alarm.
bool FaintSignals::may_alarm_after(hal::Time now) {
  forget(now);
  return bound_ >= alarm_;
}

bool FaintSignals::start(hal::Time now) {
  if (is_kept()) {
    if (signals_.size() == signals_.capacity()) make_room(now);
    frames_->collect_last(self_, signals_);
  }
  return may_alarm(now);
}

bool FaintSignals::may_alarm(hal::Time now) {
  if (level().bound < alarm_) return false;
  if (asks_) bring_up_to(now);
  forget(now);
  return level().bound >= alarm_;
}

void FaintSignals::displace(hal::Time now) {
  if (asks_) bring_up_to(now);
  for (FaintSignal& signal : signals_) signal.is_added = true;
  has_added_ = true;
  frames_->leave_to(self_);
}

/// Asks for what is on the air now, unless it is known. @pre asks_
void FaintSignals::bring_up_to(hal::Time now) {
  if (is_kept() || level().asked == frames_->next()) return;
  level().asked = frames_->next();
  if (has_added_) {
    std::erase_if(signals_, [now](const FaintSignal& signal) {
      return !signal.is_added || signal.end() <= now;
    });
    has_added_ = !signals_.empty();
  } else {
    signals_.clear();
  }
  frames_->collect(self_, now, signals_);
  if (has_added_) {
    std::ranges::sort(signals_, FaintFrames::precedes, &FaintSignal::order);
  }
  add_up();
}

/// Called when there is none.
void FaintSignals::make_room(hal::Time now) {
  if (asks_) bring_up_to(now);
  forget(now);
}

/// Removes signals that are over. Reserves room for as many again as remain, so that the cost per
/// signal is small.
void FaintSignals::forget(hal::Time now) {
  const hal::Time needed = std::min(now, needed_from_);
  std::erase_if(signals_, [needed](const FaintSignal& signal) { return signal.end() <= needed; });
  if (2 * signals_.size() > signals_.capacity() || signals_.capacity() == 0) {
    signals_.reserve(std::max(kSmallest, 2 * signals_.capacity()));
  }
  add_up();
}

void FaintSignals::add_up() {
  double sum = 0;
  for (const FaintSignal& signal : signals_) sum += signal.power;
  (asks_ ? level().bound : bound_) = sum;
}

void FaintSignals::cut(StationIndex from, hal::Time sent, hal::Time cut) {
  for (FaintSignal& signal : signals_) {
    const bool is_it = signal.from == static_cast<std::uint16_t>(from) &&
                       signal.start == sent + hal::Duration{signal.delay};
    if (is_it)
      signal.airtime = std::min(signal.airtime, static_cast<std::uint32_t>((cut - sent).count()));
  }
}

void FaintSignals::add_to(Interference& sum, hal::Time at, hal::Time& until) {
  if (asks_) bring_up_to(at);
  for (const FaintSignal& signal : signals_) {
    const hal::Time end = signal.end();
    if (end <= at) continue;
    if (signal.start > at) {
      until = std::min(until, signal.start);
      continue;
    }
    until = std::min(until, end);
    sum.sum += signal.power;
    sum.strongest = std::max(sum.strongest, signal.power);
  }
}

void FaintSignals::add_lasting_to(Interference& sum, hal::Time at) {
  if (asks_) bring_up_to(at);
  // Asked for when a reception begins, which then looks at them several times.
  if (!asks_ && !signals_.empty()) forget(at);
  for (const FaintSignal& signal : signals_) {
    if (signal.start >= at || signal.end() <= at) continue;
    sum.sum += signal.power;
    sum.strongest = std::max(sum.strongest, signal.power);
  }
}

}  // namespace sim::radio
