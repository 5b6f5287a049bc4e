#include <gtest/gtest.h>

#include "tests/analytic/radio/ht_cell.h"

namespace sim::radio::test {
namespace {

using namespace std::chrono_literals;

bool is_single(const PeerCell& cell) {
  return !cell.has_txop() && (cell.is_alone() || !cell.is_aggregate());
}
bool is_spread(const PeerCell& cell) {
  return !cell.has_txop() && !cell.is_alone() && cell.is_aggregate();
}

/// 802.11n in 40 MHz, with the short guard interval, A-MSDU, 20 stations; 802.11ac and ax in up to
/// 80 MHz, with two streams and every guard interval.
class Mcs : public testing::TestWithParam<PeerCell> {};

TEST_P(Mcs, SaturatesAsThePeerDoes) { expect_goodput_of_the_peer(GetParam()); }

INSTANTIATE_TEST_SUITE_P(MoreHt, Mcs, testing::ValuesIn(cells("ht_more_ns3.csv", is_single)),
                         [](const auto& c) { return name_of_cell(c.param.row); });
INSTANTIATE_TEST_SUITE_P(VhtHe, Mcs, testing::ValuesIn(cells("vht_he_ns3.csv", is_single)),
                         [](const auto& c) { return name_of_cell(c.param.row); });

bool is_single_and_slow(const PeerCell& cell) { return is_single(cell) && !is_quick(cell); }

INSTANTIATE_TEST_SUITE_P(Saturation, Mcs,
                         testing::ValuesIn(cells("ht_saturation_ns3.csv", is_single_and_slow)),
                         [](const auto& c) { return name_of_cell(c.param.row); });
INSTANTIATE_TEST_SUITE_P(WithoutEifs, Mcs,
                         testing::ValuesIn(cells("ht_ampdu_ns3.csv", is_single_and_slow)),
                         [](const auto& c) { return name_of_cell(c.param.row); });

class RestartedTimer : public testing::TestWithParam<PeerCell> {};

// Short frames at the highest rate in 2.4 GHz: what tolerance_of() allows for is due to this timer.
TEST_P(RestartedTimer, BringsThePeerAsNearAsOtherCells) {
  expect_goodput_of_the_peer(GetParam(), 0.015);
}

INSTANTIATE_TEST_SUITE_P(Ht, RestartedTimer,
                         testing::ValuesIn(cells("ht_restart_ns3.csv",
                                                 [](const PeerCell&) { return true; })),
                         [](const auto& c) { return name_of_cell(c.param.row); });

class AmpduCell : public testing::TestWithParam<PeerCell> {};

TEST_P(AmpduCell, HasTheGoodputOfThePeer) { expect_interval_of_the_peer(GetParam(), 10s); }

INSTANTIATE_TEST_SUITE_P(Ht, AmpduCell, testing::ValuesIn(cells("ht_ampdu_ns3.csv", is_spread)),
                         [](const auto& c) { return name_of_cell(c.param.row); });
INSTANTIATE_TEST_SUITE_P(MoreHt, AmpduCell, testing::ValuesIn(cells("ht_more_ns3.csv", is_spread)),
                         [](const auto& c) { return name_of_cell(c.param.row); });
INSTANTIATE_TEST_SUITE_P(VhtHe, AmpduCell, testing::ValuesIn(cells("vht_he_ns3.csv", is_spread)),
                         [](const auto& c) { return name_of_cell(c.param.row); });

}  // namespace
}  // namespace sim::radio::test
