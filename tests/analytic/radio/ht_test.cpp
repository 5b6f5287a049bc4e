#include <gtest/gtest.h>

#include <map>

#include "tests/analytic/radio/ht_cell.h"

namespace sim::radio::test {
namespace {

/// One cell and the mean of the peer's seeds.
struct PeerCell {
  PeerRow row;
  double mbps = 0;
  int seeds = 0;
};

std::vector<PeerCell> cells(const std::string& file) {
  std::map<std::string, PeerCell> cells;
  for (const PeerRow& row : read_peer(file)) {
    PeerCell& cell = cells.try_emplace(name_of_cell(row), PeerCell{row}).first->second;
    cell.mbps += std::stod(row.at("goodput_mbps"));
    ++cell.seeds;
  }
  std::vector<PeerCell> all;
  for (auto& [name, cell] : cells) {
    cell.mbps /= cell.seeds;
    all.push_back(cell);
  }
  return all;
}

class Ht : public testing::TestWithParam<PeerCell> {};

// 802.11n beside ns-3.37. One sender: 0.5 %. Several, single MPDUs: 1.5 %; A-MPDU: 4 %.
TEST_P(Ht, SaturatesAsThePeerDoes) {
  const PeerCell& cell = GetParam();
  const bool is_alone = cell.row.at("n_be") == "1";
  const bool is_aggregate = cell.row.at("max_ampdu") != "0";
  const double ours = mean_goodput(cell.row, is_alone ? 2 : is_aggregate ? 10 : 5);
  RecordProperty("mbps", std::to_string(ours));
  RecordProperty("theirs", std::to_string(cell.mbps));
  EXPECT_NEAR(ours, cell.mbps, (is_alone ? 0.005 : is_aggregate ? 0.04 : 0.015) * cell.mbps);
}

std::string name_of(const testing::TestParamInfo<PeerCell>& info) {
  return name_of_cell(info.param.row);
}

INSTANTIATE_TEST_SUITE_P(Saturation, Ht, testing::ValuesIn(cells("ht_saturation_ns3.csv")),
                         name_of);
INSTANTIATE_TEST_SUITE_P(BlockAck, Ht, testing::ValuesIn(cells("ht_blockack_ns3.csv")), name_of);

}  // namespace
}  // namespace sim::radio::test
