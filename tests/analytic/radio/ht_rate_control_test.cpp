#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "tests/analytic/radio/qos_cell.h"

/// minstrel_ht and ideal beside those of ns-3.37: a saturated sender with A-MPDU and its receiver.
namespace sim::radio::test {
namespace {

using namespace std::chrono_literals;

/// What GoogleTest prints of it is a name.
struct RatedLink {
  PeerRow row;
  double least = 1e9, sum = 0, most = 0;  ///< Mb/s, of the peer's seeds.
  int seeds = 0;
};

std::string name_of_rated(const PeerRow& row) {
  std::string name = row.at("phy") + "_" + row.at("manager") + "_" + row.at("distance_m");
  std::ranges::replace(name, '.', 'p');
  return name;
}

std::vector<RatedLink> rated_links() {
  std::map<std::string, RatedLink> links;
  for (const PeerRow& row : read_peer("ht_rates_ns3.csv")) {
    RatedLink& link = links.try_emplace(name_of_rated(row), RatedLink{row}).first->second;
    const double mbps = std::stod(row.at("goodput_mbps"));
    link.least = std::min(link.least, mbps);
    link.most = std::max(link.most, mbps);
    link.sum += mbps;
    ++link.seeds;
  }
  std::vector<RatedLink> all;
  for (const auto& [name, link] : links) all.push_back(link);
  return all;
}

/// Without a preamble detector, as the peer's; with its statistics, BER of 1e-6 of `ideal` and
/// interval of 50 ms.
RadioConfig rated_config(const PeerRow& row) {
  RadioConfig config =
      profile_defaults(row.at("phy") == "n" ? Profile::kIeee80211n : Profile::kIeee80211ac);
  HtConfig& ht = *ht_of(config);
  ht.propagation.chain = {LogDistanceConfig{}};
  ht.bits_at_risk = BitsAtRisk::kPayloadTime;
  ht.mcs.times = PpduTimes::kNs3;
  ht.receiver.energy_detection = hal::Dbm{-62};
  ht.receiver.sensitivity = ht.receiver.cca_threshold = hal::Dbm{-101};
  ht.receiver.min_sinr = hal::Decibels{-10};
  ht.rate_control.kind =
      row.at("manager") == "ideal" ? RateControlKind::kIdeal : RateControlKind::kMinstrelHt;
  ht.rate_control.minstrel_interval = 50ms;
  ht.rate_control.ideal_loss = 1e-6 * 8 * 1238;  // MPDU of 1200 bytes
  return config;
}

double rated_goodput(const PeerRow& row, std::uint64_t seed) {
  Air air(rated_config(row));
  air.seed = seed;
  const auto seconds = [&](const char* key) { return hal::Duration{1s * std::stol(row.at(key))}; };
  QosRun run(air, {.distance = std::stod(row.at("distance_m")),
                   .warm_up = seconds("warm"),
                   .time = seconds("seconds")});
  return run.best_effort().mbps;
}

class HtRates : public testing::TestWithParam<RatedLink> {};

TEST_P(HtRates, AreNearThePeers) {
  const RatedLink& link = GetParam();
  double sum = 0;
  constexpr int kSeeds = 3;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    sum += rated_goodput(link.row, static_cast<std::uint64_t>(seed));
  }
  const double ours = sum / kSeeds, theirs = link.sum / link.seeds;
  RecordProperty("mbps", std::to_string(ours));
  RecordProperty("theirs", std::to_string(theirs));
  EXPECT_NEAR(ours, theirs, 0.05 * theirs);
}

INSTANTIATE_TEST_SUITE_P(Peer, HtRates, testing::ValuesIn(rated_links()),
                         [](const auto& c) { return name_of_rated(c.param.row); });

}  // namespace
}  // namespace sim::radio::test
