#include <gtest/gtest.h>

#include "tests/analytic/radio/ht_cell.h"

namespace sim::radio::test {
namespace {

class Ht : public testing::TestWithParam<PeerCell> {};

// Several senders of A-MPDUs, and more cells, are in tests/slow/radio.
TEST_P(Ht, SaturatesAsThePeerDoes) { expect_goodput_of_the_peer(GetParam()); }

INSTANTIATE_TEST_SUITE_P(Saturation, Ht,
                         testing::ValuesIn(cells("ht_saturation_ns3.csv", is_quick)),
                         [](const auto& c) { return name_of_cell(c.param.row); });
INSTANTIATE_TEST_SUITE_P(WithoutEifs, Ht, testing::ValuesIn(cells("ht_ampdu_ns3.csv", is_quick)),
                         [](const auto& c) { return name_of_cell(c.param.row); });
INSTANTIATE_TEST_SUITE_P(BlockAck, Ht, testing::ValuesIn(cells("ht_blockack_ns3.csv", is_quick)),
                         [](const auto& c) { return name_of_cell(c.param.row); });

}  // namespace
}  // namespace sim::radio::test
