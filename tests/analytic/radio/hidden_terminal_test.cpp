#include "tests/analytic/radio/hidden_cell.h"

namespace sim::radio::test {
namespace {

class HiddenTerminals : public testing::TestWithParam<HiddenGroup> {};

TEST_P(HiddenTerminals, HaveThePeersGoodput) { expect_goodput_of_the_peer(GetParam()); }

INSTANTIATE_TEST_SUITE_P(Ns3, HiddenTerminals, testing::ValuesIn(hidden_groups(true)),
                         [](const auto& c) { return name_of_group(c.param.row); });

}  // namespace
}  // namespace sim::radio::test
