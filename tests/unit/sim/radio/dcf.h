#pragma once

#include <gtest/gtest.h>

#include "tests/unit/sim/radio/air.h"

namespace sim::radio::test {
using namespace std::chrono_literals;

// IEEE Std 802.11-2016, 16.2.2 and 16.3.4, long preamble: 192 us + bits / rate, rounded up.
inline constexpr hal::Duration kRts = 352us;   // 20 bytes at 1 Mb/s
inline constexpr hal::Duration kCts = 304us;   // 14 bytes at 1 Mb/s
inline constexpr hal::Duration kAck = 304us;   // 14 bytes at 1 Mb/s
inline constexpr hal::Duration kData = 291us;  // 100 + 36 bytes at 11 Mb/s: 98.9 us
inline constexpr std::size_t kPayload = 100;   // bytes
inline constexpr hal::Duration kSifs = 10us;
inline constexpr hal::Duration kSlot = 20us;
inline constexpr hal::Duration kDifs = 50us;
inline constexpr hal::Duration kEifs = 364us;
inline constexpr hal::Duration kTimeout = 222us;

/// Stations 600 m apart hear their neighbours only: at 40 mW the carrier is sensed up to 787 m.
class Ieee80211MacTest : public testing::Test {
 protected:
  Ieee80211MacTest() : air(Profile::kIeee80211b) {
    waves_of(air.config)->propagation.propagation_delay = false;  // times by hand
    waves_of(air.config)->propagation.interference_floor =
        waves_of(air.config)->receiver.sensitivity;
  }
  void build_line(int stations) {
    air.add_line(stations, 600);
    air.build();
  }
  void without_rts() { waves_of(air.config)->contention.rts_threshold = 2347; }
  void with_rts() { waves_of(air.config)->contention.rts_threshold = 0; }
  hal::Duration start_of(std::size_t frame) const {
    return air.log.starts.at(frame).at.time_since_epoch();
  }
  void expect_slots(hal::Duration backoff, std::int64_t window) {
    EXPECT_GE(backoff, 0us);
    EXPECT_EQ(backoff % kSlot, 0us);
    EXPECT_LE(backoff / kSlot, window);
  }

  Air air;
};

}  // namespace sim::radio::test
