#include <gtest/gtest.h>

#include "tests/analytic/radio/ht_cell.h"

namespace sim::radio::test {
namespace {

/// 40 MHz in 5 GHz, the short guard interval, A-MSDU, 20 stations.
class MoreHt : public testing::TestWithParam<PeerCell> {};

TEST_P(MoreHt, SaturatesAsThePeerDoes) { expect_goodput_of_the_peer(GetParam()); }

INSTANTIATE_TEST_SUITE_P(Ns3, MoreHt, testing::ValuesIn(cells("ht_more_ns3.csv")),
                         [](const auto& c) { return name_of_cell(c.param.row); });

}  // namespace
}  // namespace sim::radio::test
