#pragma once

#include <string>

#include "hal/types/math.h"
#include "tests/analytic/radio/peer.h"
#include "tests/unit/sim/radio/air.h"

namespace sim::radio::test {

struct Saturated {
  double mbps = 0;     ///< Goodput, MAC payload.
  double failure = 0;  ///< Share of the first frames of exchanges that got no answer.
};

/// One row of saturation_ns3.csv: n senders on a circle of 5 m round one receiver, their queues
/// never empty. Measured from 200 ms on for `time`.
inline Saturated saturate(const PeerRow& row, std::uint64_t seed, hal::Duration time) {
  using namespace std::chrono_literals;
  constexpr hal::Duration kWarmUp = 200ms;
  const bool rts = row.at("rtscts") == "1";
  const std::size_t payload = std::stoul(row.at("payload"));
  Air air(like_the_peer(row.at("data"), rts));
  air.seed = seed;
  waves_of(air.config)->contention.slot = std::chrono::microseconds(std::stol(row.at("slot_us")));
  waves_of(air.config)->phy.control_rate = rate_of_mode(row.at("ctl"));
  dcf_of(air.config)->basic_rates = {hal::BitsPerSecond{std::stod(row.at("ack")) * 1e6},
                                     rate_of_mode(row.at("ctl"))};
  air.add({0, 0, 0});
  const int senders = std::stoi(row.at("n"));
  for (int i = 0; i < senders; ++i) {
    const double angle = 2 * hal::math::kPi * i / senders;
    air.add({5 * hal::math::cos(angle), 5 * hal::math::sin(angle), 0});
  }
  air.build();
  for (std::uint16_t s = 2; s <= air.size(); ++s) {
    air.inbox(s).refill = [&air, s, payload] { air.send(s, 1, payload); };
    air.send(s, 1, payload);
    air.send(s, 1, payload);
  }
  air.run(kWarmUp);
  const std::size_t before = air.inbox(1).received.size();
  const std::size_t log_before = air.log.starts.size();
  air.run(kWarmUp + time);
  const auto received = static_cast<double>(air.inbox(1).received.size() - before);
  const FrameType opener = rts ? FrameType::kRts : FrameType::kData;
  double attempts = 0;
  for (std::size_t i = log_before; i < air.log.starts.size(); ++i) {
    attempts += air.log.starts[i].frame.type == opener ? 1 : 0;
  }
  return {received * static_cast<double>(payload) * 8e-6 / hal::to_seconds(time),
          1 - received / attempts};
}

/// The mean of five seeds.
inline Saturated saturate_five_times(const PeerRow& row, hal::Duration time) {
  Saturated mean;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Saturated one = saturate(row, seed, time);
    mean.mbps += one.mbps / 5;
    mean.failure += one.failure / 5;
  }
  return mean;
}

/// 802.11b at 11 Mb/s, ACK at 1 Mb/s, RTS, 1500 bytes, 5 senders: "b11_b1_1_20_1_1500_5".
inline std::string name_of_row(const PeerRow& row) {
  std::string name;
  for (const char* const column : {"data", "ctl", "ack", "slot_us", "rtscts", "payload", "n"}) {
    if (!name.empty()) name += '_';
    const std::string& value = row.at(column);
    name += value.substr(0, value.find('.'));
  }
  return name;
}

}  // namespace sim::radio::test
