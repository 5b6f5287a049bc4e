#include <gtest/gtest.h>

#include "tests/analytic/radio/saturated_cell.h"

namespace sim::radio::test {
namespace {

using namespace std::chrono_literals;

/// Rows that are quick; all of them are in tests/slow/radio.
std::vector<PeerRow> quick_rows() {
  std::vector<PeerRow> rows = read_peer("saturation_ns3.csv");
  std::erase_if(rows, [](const PeerRow& row) {
    const bool is_slow = row.at("data") == "g54" && row.at("n") != "1";
    return (row.at("n") != "1" && row.at("n") != "5") || row.at("payload") != "1500" || is_slow;
  });
  return rows;
}

class Saturation : public testing::TestWithParam<PeerRow> {};

// 1.5 % and 0.012 absolute with five seeds.
TEST_P(Saturation, MatchesThePeer) {
  const Saturated ours = saturate_five_times(GetParam(), 6s);
  const double theirs = std::stod(GetParam().at("ns3_mbps"));
  EXPECT_NEAR(ours.mbps, theirs, 0.015 * theirs);
  EXPECT_NEAR(ours.failure, std::stod(GetParam().at("ns3_p")), 0.012);
  RecordProperty("mbps", std::to_string(ours.mbps));
  RecordProperty("failure", std::to_string(ours.failure));
}

INSTANTIATE_TEST_SUITE_P(Ns3, Saturation, testing::ValuesIn(quick_rows()),
                         [](const auto& c) { return name_of_row(c.param); });

}  // namespace
}  // namespace sim::radio::test
