#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <string>
#include <vector>

#include "tests/analytic/radio/peer.h"

/// Why ns-3.37 loses more frames to collisions than ours where they are short: a right frame ends
/// the EIFS that follows a wrong one (IEEE Std 802.11-2020, 10.3.2.3.7), but not theirs. A
/// neighbour that synchronised to one of two colliding frames then stays away for 351 us, and
/// returns at the same time as others.
namespace sim::radio::test {
namespace {

// EDCA's best effort in 2.4 GHz, us: SIFS + 3 slots, and SIFS + an ACK at 1 Mb/s + that.
constexpr std::int64_t kSlot = 9'000, kSifs = 10'000, kAifs = kSifs + 3 * kSlot;
constexpr std::int64_t kEifs = kSifs + 192'000 + 112'000 + kAifs;

struct Wait {
  std::int64_t free_since = 0;  ///< End of the last frame, ns.
  std::int64_t defer = kAifs;
  std::int64_t counter = 0;
  std::int64_t planned =
      0;  ///< When the counter was to be over, as seen at the end of a wrong frame.

  /// The counter goes down once at the end of AIFS or EIFS and once after each slot (10.23.2.4).
  void hear(const PeerRow& row) {
    const std::int64_t begin = std::stoll(row.at("begin")) - free_since - defer;
    if (begin >= 0) counter -= std::min(counter, begin / kSlot + 1);
    free_since = std::stoll(row.at("end"));
    defer = row.at("event") == "wrong" ? kEifs : kAifs;
    if (row.at("event") == "wrong") planned = due();
  }
  std::int64_t due() const { return free_since + defer + counter * kSlot; }
};

std::map<std::string, std::vector<PeerRow>> waits() {
  std::map<std::string, std::vector<PeerRow>> cases;
  for (const PeerRow& row : read_peer("eifs_ns3.csv")) cases[row.at("case")].push_back(row);
  return cases;
}

TEST(Eifs, OfThePeerDoesNotEndWithARightFrame) {
  const auto cases = waits();
  ASSERT_EQ(cases.size(), 8);
  for (const auto& [name, rows] : cases) {
    SCOPED_TRACE(name);
    Wait wait{.free_since = std::stoll(rows.front().at("begin")),
              .counter = std::stoll(rows.front().at("end"))};
    for (const PeerRow& row : rows) {
      if (row.at("event") == "right" || row.at("event") == "wrong") wait.hear(row);
    }
    const std::int64_t sent = std::stoll(rows.back().at("begin"));
    EXPECT_LE(std::abs(sent - wait.planned), 100);  // ns
    EXPECT_LT(wait.due(), sent - 1'000);            // by the standard
  }
}

}  // namespace
}  // namespace sim::radio::test
