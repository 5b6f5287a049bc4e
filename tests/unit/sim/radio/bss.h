#pragma once

#include <gtest/gtest.h>

#include <optional>
#include <vector>

#include "sim/radio/infrastructure/management.h"
#include "tests/unit/sim/radio/dcf.h"

namespace sim::radio::test {

/// Infrastructure mode on 802.11b; station 1, called s1, is the access point unless the test says
/// otherwise. Times by hand: no
/// propagation delay.
class BssTest : public Ieee80211MacTest {
 protected:
  DcfConfig& dcf() { return *dcf_of(air.config); }

  void build(const std::vector<hal::Vec3>& places) {
    for (const hal::Vec3& place : places) air.add(place);
    if (dcf().bss.access_points.empty()) dcf().bss.access_points = {"s1"};
    air.build();
  }

  /// Of the frames that have gone out.
  std::vector<FrameType> types() const {
    std::vector<FrameType> all;
    for (const Log::Start& start : air.log.starts) all.push_back(start.frame.type);
    return all;
  }
  void forget() { air.log.starts.clear(); }

  std::optional<hal::Verdict> verdict_of(std::uint16_t station, std::uint64_t tag) {
    for (const Inbox::Ended& end : air.inbox(station).ended) {
      if (end.tag == tag) return end.verdict;
    }
    return std::nullopt;
  }

  std::vector<Log::Association>& associations = air.log.associations;
  std::vector<hal::Verdict>& relays_lost = air.log.relays_lost;
};

}  // namespace sim::radio::test
