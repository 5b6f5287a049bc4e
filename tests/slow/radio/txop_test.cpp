#include <gtest/gtest.h>

#include "tests/analytic/radio/ht_cell.h"

/// TXOP limits beside ns-3.37. It lets the Duration cover the whole TXOP limit and ends each TXOP
/// by a CF-End at the lowest rate if there is time for it: IEEE Std 802.11-2020, 10.23.2.10 permits
/// that and does not ask for it. Ours covers one exchange at a time.
namespace sim::radio::test {
namespace {

using namespace std::chrono_literals;

/// SIFS and 20 bytes at 6 Mb/s in 5 GHz: 20 us + 8 symbols of 4 us.
constexpr hal::Duration kCfEnd = 16us + 52us;

/// Counts the TXOPs whose first frame was answered and which leave time for a CF-End.
class CfEnds {
 public:
  explicit CfEnds(hal::Duration limit) : limit_(limit) {}

  void see(const Log::Start& start) {
    const bool is_data = start.frame.type == FrameType::kData;
    if (is_data && !is_of_same_ampdu(start.frame) && start.at - end_ > 20us) {
      finish();
      begin_ = start.at;
      is_answered_ = false;
    }
    is_answered_ |= !is_data;
    last_ = start.frame;
    end_ = start.at + start.frame.airtime;
  }
  int count() const { return count_; }

 private:
  bool is_of_same_ampdu(const Frame& frame) const {
    return frame.ampdu != 0 && frame.ampdu == last_.ampdu && frame.transmitter == last_.transmitter;
  }
  void finish() { count_ += is_answered_ && limit_ - (end_ - begin_) >= kCfEnd; }

  hal::Duration limit_;
  hal::Time begin_{}, end_{};  ///< Of the TXOP.
  bool is_answered_ = false;
  Frame last_{};
  int count_ = 0;
};

int cf_ends(const Log& log, hal::Time from, hal::Duration limit) {
  CfEnds all(limit);
  for (const Log::Start& start : log.starts) {
    if (start.at >= from) all.see(start);
  }
  return all.count();
}

/// Goodput in Mb/s if the TXOPs of ours had ended by CF-Ends.
double goodput_with_cf_ends(const PeerCell& peer, std::uint64_t seed) {
  Air air(ht_like_the_peer(peer.row));
  air.seed = seed;
  QosCell cell = cell_of(peer.row);
  cell.time = 4s;
  QosRun run(air, cell);
  const bool is_video = peer.row.at("ac") == "VI";
  const auto category = is_video ? AccessCategory::kVideo : AccessCategory::kBestEffort;
  const int ends =
      cf_ends(air.log, hal::Time{} + cell.warm_up, ht_of(air.config)->edca.of(category).txop_limit);
  const double mbps = (is_video ? run.video() : run.best_effort()).mbps;
  return mbps * hal::to_seconds(cell.time) / hal::to_seconds(cell.time + ends * kCfEnd);
}

class Txop : public testing::TestWithParam<PeerCell> {};

TEST_P(Txop, YieldsAsThePeersDoesWithoutItsCfEnds) {
  std::vector<double> ours;
  const std::uint64_t seeds = GetParam().is_alone() ? 2 : 10;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    ours.push_back(goodput_with_cf_ends(GetParam(), seed));
  }
  RecordProperty("mbps", std::to_string(mean_of(ours)));
  RecordProperty("theirs", std::to_string(mean_of(GetParam().mbps)));
  if (GetParam().is_alone() || !GetParam().is_aggregate()) {
    const double theirs = mean_of(GetParam().mbps);
    EXPECT_NEAR(mean_of(ours), theirs, tolerance_of(GetParam()) * theirs);
    return;
  }
  const auto [low, high] = relative_difference(ours, GetParam().mbps);
  RecordProperty("low", std::to_string(low));
  RecordProperty("high", std::to_string(high));
  EXPECT_GT(low, -0.04);
  EXPECT_LT(high, 0.04);
}

INSTANTIATE_TEST_SUITE_P(VhtHe, Txop,
                         testing::ValuesIn(cells("vht_he_ns3.csv",
                                                 [](const PeerCell& c) { return c.has_txop(); })),
                         [](const auto& c) { return name_of_cell(c.param.row); });

}  // namespace
}  // namespace sim::radio::test
