#pragma once

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "hal/types/math.h"
#include "tests/analytic/radio/peer.h"
#include "tests/unit/sim/radio/air.h"

namespace sim::radio::test {

/// QoS stations on a circle round one receiver: some of best effort and of video, whose queues are
/// never empty, and some of voice, saturated or with a packet 1 / rate apart.
struct QosCell {
  int best_effort = 1;
  int video = 0;
  int voice = 0;
  double distance = 5;                     ///< Radius of the circle, m.
  std::size_t payload_best_effort = 1500;  ///< Bytes of an MSDU without LLC/SNAP; also of video.
  std::size_t payload_voice = 1500;
  double voice_rate = 0;  ///< Packets a second; 0: saturated.
  hal::Duration warm_up = std::chrono::milliseconds{200};
  hal::Duration time = std::chrono::seconds{3};  ///< That is measured.
};

/// What one access category got.
struct Served {
  double mbps = 0;        ///< Goodput, MSDUs.
  double mean_delay = 0;  ///< ms, from the request to the arrival.
  double p95_delay = 0;   ///< ms
  double received = 0;
};

/// Builds the cell in `air`, whose config is set, and runs it.
class QosRun {
 public:
  QosRun(Air& air, const QosCell& cell) : air_(air), cell_(cell) {
    const int senders = cell.best_effort + cell.video + cell.voice;
    air.add({0, 0, 0});
    for (int i = 0; i < senders; ++i) {
      const double angle = 2 * hal::math::kPi * i / senders;
      air.add({cell.distance * hal::math::cos(angle), cell.distance * hal::math::sin(angle), 0});
    }
    air.build();
    air.inbox(1).forward = [this](const MacIndication& one) { note(one); };
    for (int i = 0; i < senders; ++i) start(static_cast<std::uint16_t>(i + 2), i, senders);
    air.run(cell.warm_up + cell.time);
  }

  Served best_effort() { return served(AccessCategory::kBestEffort); }
  Served video() { return served(AccessCategory::kVideo); }
  Served voice() { return served(AccessCategory::kVoice); }

 private:
  static constexpr int kQueued = 400;  // more than an A-MPDU of 64 A-MSDUs holds

  AccessCategory category_of(std::uint16_t station) const {
    const int index = station - 2;
    if (index < cell_.best_effort) return AccessCategory::kBestEffort;
    return index < cell_.best_effort + cell_.video ? AccessCategory::kVideo
                                                   : AccessCategory::kVoice;
  }
  bool is_voice(std::uint16_t station) const {
    return category_of(station) == AccessCategory::kVoice;
  }
  std::uint8_t priority_of(std::uint16_t station) const {
    const AccessCategory category = category_of(station);
    return category == AccessCategory::kVoice ? 6 : category == AccessCategory::kVideo ? 5 : 0;
  }

  void start(std::uint16_t station, int index, int senders) {
    using namespace std::chrono_literals;
    if (is_voice(station) && cell_.voice_rate > 0) {
      const auto period = hal::Duration{static_cast<std::int64_t>(1e9 / cell_.voice_rate)};
      for (hal::Duration at = period * index / senders; at < cell_.warm_up + cell_.time;
           at += period) {
        air_.at(at, [this, station] { send(station); });
      }
      return;
    }
    air_.inbox(station).refill = [this, station] { send(station); };
    air_.at(10us * (index + 1), [this, station] {
      for (int i = 0; i < kQueued; ++i) send(station);
    });
  }

  void send(std::uint16_t station) {
    const bool voice = is_voice(station);
    sent_.push_back(air_.events.now());
    air_.sap(station).transmit(
        {.destination = hal::AgentId{1},
         .priority = priority_of(station),
         .payload = marked(voice ? cell_.payload_voice : cell_.payload_best_effort),
         .tag = sent_.size()});
  }

  /// A payload that carries the number of its request.
  Payload marked(std::size_t size) const {
    hal::Bytes bytes(size);
    for (std::size_t i = 0; i < 4; ++i) bytes[i] = static_cast<std::uint8_t>(sent_.size() >> 8 * i);
    return std::make_shared<const hal::Bytes>(std::move(bytes));
  }

  void note(const MacIndication& one) {
    if (air_.events.now() < hal::Time{} + cell_.warm_up) return;
    std::size_t number = 0;
    for (std::size_t i = 0; i < 4; ++i) number |= std::size_t{(*one.payload)[i]} << 8 * i;
    const hal::Duration delay = air_.events.now() - sent_.at(number - 1);
    delays_[category_of(one.source.value)].push_back(hal::to_seconds(delay) * 1e3);
  }

  Served served(AccessCategory category) {
    std::vector<double>& delays = delays_[category];
    if (delays.empty()) return {};
    std::ranges::sort(delays);
    double sum = 0;
    for (const double delay : delays) sum += delay;
    const double count = static_cast<double>(delays.size());
    const auto bytes = static_cast<double>(
        category == AccessCategory::kVoice ? cell_.payload_voice : cell_.payload_best_effort);
    return {.mbps = count * bytes * 8e-6 / hal::to_seconds(cell_.time),
            .mean_delay = sum / count,
            .p95_delay = delays[delays.size() * 95 / 100],
            .received = count};
  }

  Air& air_;
  QosCell cell_;
  std::vector<hal::Time> sent_;
  std::map<AccessCategory, std::vector<double>> delays_;
};

}  // namespace sim::radio::test
