#include "sim/radio/channel/faint_frames.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <limits>

namespace sim::radio {
namespace {

constexpr std::size_t kFewFrames = 64;
/// While steps fit into their type, with the longest frame.
constexpr hal::Duration kLongest = std::chrono::minutes(8);
/// More than a place may be off when it is rounded to a float, as a share of its distance.
constexpr double kRounding = 1e-6;

}  // namespace

void FaintFrames::start(StationIndex from, hal::Time now, hal::Duration airtime) {
  const hal::Time over = now - neighbourhood_.longest_delay();
  if (frames_.size() >= most_ || now - begin_ > kLongest) forget(over);
  while (first_ < frames_.size() && end_of(first_) <= steps(over)) ++first_;
  frames_.push_back({.departure = neighbourhood_.departure(from, now),
                     .airtime = static_cast<std::uint32_t>(airtime.count()),
                     .order = next_++});
  look(frames_.size() - 1);
}

/// Fills in the glance at a frame. In order, or again.
void FaintFrames::look(std::size_t index) {
  const std::size_t lane = index % Glance::kFrames;
  if (index / Glance::kFrames == glances_.size()) {
    glances_.emplace_back().end.fill(std::numeric_limits<std::int32_t>::min());
  }
  Glance& glance = glances_[index / Glance::kFrames];
  const Departure& departure = frames_[index].departure;
  glance.x[lane] = static_cast<float>(departure.site.position.x);
  glance.y[lane] = static_cast<float>(departure.site.position.y);
  glance.end[lane] = steps(departure.at + hal::Duration{frames_[index].airtime}) + 1;
}

/// Removes frames that are over everywhere. Leaves room for several times as many as remain, so
/// that the cost per frame is small.
void FaintFrames::forget(hal::Time over) {
  std::erase_if(frames_, [over](const Frame& frame) {
    return frame.departure.at + hal::Duration{frame.airtime} <= over;
  });
  begin_ = over;
  glances_.clear();
  for (std::size_t i = 0; i < frames_.size(); ++i) look(i);
  first_ = 0;
  most_ = std::max(kFewFrames, 3 * frames_.size());
}

void FaintFrames::cut(StationIndex from, hal::Time sent, hal::Time cut) {
  for (std::size_t i = 0; i < frames_.size(); ++i) {
    Frame& frame = frames_[i];
    if (frame.departure.station != from || frame.departure.at != sent) continue;
    frame.airtime = std::min(frame.airtime, static_cast<std::uint32_t>((cut - sent).count()));
    look(i);
  }
}

void FaintFrames::collect(StationIndex receiver, hal::Time now,
                          std::vector<FaintSignal>& signals) const {
  const std::int32_t over = steps(now - neighbourhood_.longest_delay());
  const Neighbourhood::Circle near = neighbourhood_.around(receiver);
  const auto x = static_cast<float>(near.x), y = static_cast<float>(near.y);
  const double radius =
      near.radius + kRounding * (near.radius + std::abs(near.x) + std::abs(near.y));
  const auto square = static_cast<float>(radius * radius);
  for (std::size_t g = first_ / Glance::kFrames; g < glances_.size(); ++g) {
    const Glance& glance = glances_[g];
    std::array<std::uint8_t, Glance::kFrames> matters{};
    // Without a branch, which hardly any processor could guess; several are compared at once.
    for (std::size_t i = 0; i < Glance::kFrames; ++i) {
      const float dx = glance.x[i] - x, dy = glance.y[i] - y;
      const std::int32_t is_near = dx * dx + dy * dy <= square ? 1 : 0;
      const std::int32_t lasts = glance.end[i] > over ? 1 : 0;
      matters[i] = static_cast<std::uint8_t>(is_near & lasts);
    }
    static_assert(std::endian::native == std::endian::little, "the first byte is the lowest");
    const Frame* frames = frames_.data() + g * Glance::kFrames;
    for (std::uint64_t word :
         std::bit_cast<std::array<std::uint64_t, Glance::kFrames / 8>>(matters)) {
      for (; word != 0; word &= word - 1) {
        collect_one(frames[std::countr_zero(word) / 8], receiver, now, signals);
      }
      frames += 8;
    }
  }
}

void FaintFrames::collect_one(const Frame& frame, StationIndex receiver, hal::Time now,
                              std::vector<FaintSignal>& signals) const {
  if (precedes(frame.order, levels_[receiver].first) || frame.departure.station == receiver) return;
  const std::size_t before = signals.size();
  append(frame, receiver, signals);
  if (signals.size() > before && signals.back().end() <= now) signals.pop_back();
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
