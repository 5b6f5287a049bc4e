#include "sim/radio/channel/faint_frames.h"

#include <algorithm>
#include <cstddef>

namespace sim::radio {
namespace {

constexpr std::size_t kFewFrames = 64;

}  // namespace

void FaintFrames::start(StationIndex from, hal::Time now, hal::Duration airtime) {
  const hal::Time over = now - neighbourhood_.longest_delay();
  while (first_ < where_.size() && where_[first_].end <= over) ++first_;
  if (frames_.size() >= most_) forget(over);
  frames_.push_back({.departure = neighbourhood_.departure(from, now),
                     .airtime = static_cast<std::uint32_t>(airtime.count()),
                     .order = next_++});
  const hal::Vec3& at = frames_.back().departure.site.position;
  where_.push_back({at.x, at.y, now + airtime});
}

/// Removes frames that are over everywhere. Leaves room for several times as many as remain, so
/// that the cost per frame is small.
void FaintFrames::forget(hal::Time over) {
  std::size_t kept = 0;
  for (std::size_t i = first_; i < frames_.size(); ++i) {
    if (where_[i].end <= over) continue;
    where_[kept] = where_[i];
    frames_[kept++] = frames_[i];
  }
  where_.resize(kept);
  frames_.erase(frames_.begin() + static_cast<std::ptrdiff_t>(kept), frames_.end());
  first_ = 0;
  most_ = std::max(kFewFrames, 3 * kept);
}

void FaintFrames::cut(StationIndex from, hal::Time sent, hal::Time cut) {
  for (std::size_t i = 0; i < frames_.size(); ++i) {
    Frame& frame = frames_[i];
    if (frame.departure.station != from || frame.departure.at != sent) continue;
    frame.airtime = std::min(frame.airtime, static_cast<std::uint32_t>((cut - sent).count()));
    where_[i].end = sent + hal::Duration{frame.airtime};
  }
}

void FaintFrames::collect(StationIndex receiver, hal::Time now,
                          std::vector<FaintSignal>& signals) const {
  const hal::Time over = now - neighbourhood_.longest_delay();
  const Neighbourhood::Circle near = neighbourhood_.around(receiver);
  const std::uint32_t first = levels_[receiver].first;
  for (std::size_t i = first_; i < where_.size(); ++i) {
    const Where& frame = where_[i];
    const double dx = frame.x - near.x, dy = frame.y - near.y;
    // Both computed: hardly any processor could guess them.
    if ((dx * dx + dy * dy > near.radius_squared) | (frame.end <= over)) continue;
    if (precedes(frames_[i].order, first) || frames_[i].departure.station == receiver) continue;
    const std::size_t before = signals.size();
    append(frames_[i], receiver, signals);
    if (signals.size() > before && signals.back().end() <= now) signals.pop_back();
  }
}

void FaintFrames::append(const Frame& frame, StationIndex receiver,
                         std::vector<FaintSignal>& signals) const {
  const Propagation::Arrival arrival = neighbourhood_.mean_arrival(frame.departure, receiver);
  if (arrival.strength != Propagation::Strength::kFaint) return;
  const FaintSignal signal{.start = frame.departure.at + arrival.delay,
                           .power = arrival.power.value,
                           .airtime = frame.airtime,
                           .delay = static_cast<std::uint32_t>(arrival.delay.count()),
                           .order = frame.order,
                           .from = static_cast<std::uint16_t>(frame.departure.station)};
  // Not push_back(): FaintSignals::add() is faster if it alone has that in line.
  signals.insert(signals.end(), signal);
}

}  // namespace sim::radio
