#include "sim/radio/channel/faint_signals.h"

#include <algorithm>

namespace sim::radio {
namespace {

constexpr std::size_t kSmallest = 8;

std::uint32_t nanoseconds(hal::Duration duration) {
  return static_cast<std::uint32_t>(duration.count());
}

}  // namespace

bool FaintSignals::add(StationIndex from, hal::Time sent, hal::Duration delay,
                       hal::Duration airtime, double power) {
  if (signals_.size() == signals_.capacity()) forget(sent);
  signals_.push_back({.start = sent + delay,
                      .power = power,
                      .airtime = nanoseconds(airtime),
                      .delay = nanoseconds(delay),
                      .from = from});
  bound_ += power;
  if (bound_ < alarm_) return false;
  forget(sent);
  return bound_ >= alarm_;
}

/// Removes signals that are over. Reserves room for as many again as remain, so that the cost per
/// signal is small.
void FaintSignals::forget(hal::Time now) {
  const hal::Time needed = std::min(now, needed_from_);
  std::erase_if(signals_, [needed](const Signal& signal) { return signal.end() <= needed; });
  if (2 * signals_.size() > signals_.capacity() || signals_.capacity() == 0) {
    signals_.reserve(std::max(kSmallest, 2 * signals_.capacity()));
  }
  bound_ = 0;
  for (const Signal& signal : signals_) bound_ += signal.power;
}

void FaintSignals::cut(StationIndex from, hal::Time sent, hal::Time cut) {
  for (Signal& signal : signals_) {
    const bool is_it = signal.from == from && signal.start == sent + hal::Duration{signal.delay};
    if (is_it) signal.airtime = std::min(signal.airtime, nanoseconds(cut - sent));
  }
}

void FaintSignals::add_to(Interference& sum, hal::Time at, hal::Time& until) const {
  for (const Signal& signal : signals_) {
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

void FaintSignals::add_lasting_to(Interference& sum, hal::Time at) const {
  for (const Signal& signal : signals_) {
    if (signal.start >= at || signal.end() <= at) continue;
    sum.sum += signal.power;
    sum.strongest = std::max(sum.strongest, signal.power);
  }
}

}  // namespace sim::radio
