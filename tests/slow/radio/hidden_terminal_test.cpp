#include "tests/analytic/radio/hidden_cell.h"

namespace sim::radio::test {
namespace {

class MoreHiddenTerminals : public testing::TestWithParam<HiddenGroup> {};

TEST_P(MoreHiddenTerminals, HaveThePeersGoodput) { expect_goodput_of_the_peer(GetParam()); }

INSTANTIATE_TEST_SUITE_P(Ns3, MoreHiddenTerminals, testing::ValuesIn(hidden_groups(false)),
                         [](const auto& c) { return name_of_group(c.param.row); });

}  // namespace
}  // namespace sim::radio::test
