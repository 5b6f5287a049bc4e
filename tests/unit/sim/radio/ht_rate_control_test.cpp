#include <gtest/gtest.h>

#include <map>
#include <optional>
#include <set>
#include <vector>

#include "hal/types/math.h"
#include "sim/radio/rate/ideal.h"
#include "sim/radio/rate/minstrel_ht.h"
#include "sim/radio/station_profile.h"

namespace sim::radio::test {
namespace {

using namespace std::chrono_literals;

constexpr hal::AgentId kPeerVht{2}, kPeerHt{3}, kPeerOfdm{4}, kPeerNarrow{5};

/// A station of 802.11ac with two streams, 80 MHz and the short guard interval, and its receivers.
class HtRateControlTest : public testing::Test {
 protected:
  HtRateControlTest() : config_(sender()), modes_(config_) {
    const auto& ac = std::get<Ieee80211acConfig>(config_);
    cell_.add(kPeerVht, capabilities_of(ac));
    Ieee80211nConfig n;
    set_channel(n, 36);
    cell_.add(kPeerHt, capabilities_of(n));
    Ieee80211gConfig a;
    a.phy.channel = 36;
    cell_.add(kPeerOfdm, capabilities_of(a));
    Capabilities narrow = capabilities_of(ac);
    narrow.width = 40;
    narrow.streams = 1;
    narrow.short_guard = false;
    cell_.add(kPeerNarrow, narrow);
    ladders_.emplace(make_ladder(ac, modes_), cell_);
  }

  static RadioConfig sender() {
    Ieee80211acConfig ac;
    ac.mcs.streams = 2;
    ac.mcs.guard = 400ns;
    return ac;
  }
  MinstrelHt minstrel() { return {rates, *ladders_, hal::RandomStream(1, "a/rates")}; }

  /// Sends `ppdus` A-MPDUs of 10 MPDUs. @param works  whether a mode's MPDUs all arrive, or none.
  template <class Works>
  std::vector<ModeId> send(RateControl& control, int ppdus, Works works,
                           hal::AgentId to = kPeerVht) {
    std::vector<ModeId> used;
    std::uint32_t attempt = 0;
    for (int i = 0; i < ppdus; ++i, now += 2ms) {
      used.push_back(control.mode(to, attempt, now).id());
      const bool is_received = works(used.back());
      control.on_aggregate(to, is_received ? 10 : 0, 10);
      attempt = is_received ? 0 : attempt + 1;
    }
    return used;
  }

  RateControlConfig rates;
  hal::Time now{};
  RadioConfig config_;
  ModeSet modes_;
  Cell cell_;
  std::optional<RateLadders> ladders_;
};

constexpr auto kAllWork = [](const ModeId&) { return true; };

TEST_F(HtRateControlTest, GroupsAreThoseThatTheReceiverKnows) {
  const auto shapes = [&](hal::AgentId to) {
    std::set<std::tuple<int, int, int>> all;
    for (const Ladder& group : ladders_->groups_to(to)) {
      const ModeId& id = group.front().mode->id();
      all.emplace(id.streams, id.width, id.guard.count());
      for (const Rung& rung : group) {
        EXPECT_EQ(rung.mode->id().guard, id.guard);
        EXPECT_EQ(rung.mode->modulation_class(),
                  to == kPeerHt ? ModulationClass::kHt : ModulationClass::kVht);
      }
    }
    EXPECT_EQ(all.size(), ladders_->groups_to(to).size());
    return all;
  };
  EXPECT_EQ(shapes(kPeerVht).size(), 2u * 3u * 2u);
  EXPECT_EQ(shapes(kPeerNarrow), (std::set<std::tuple<int, int, int>>{{1, 20, 800}, {1, 40, 800}}));
  EXPECT_EQ(shapes(kPeerHt), (std::set<std::tuple<int, int, int>>{{1, 20, 800}}));
  EXPECT_TRUE(ladders_->groups_to(kPeerOfdm).empty());
}

TEST_F(HtRateControlTest, MinstrelHtFindsTheFastestModeThatWorks) {
  MinstrelHt control = minstrel();
  EXPECT_EQ(control.mode(kPeerVht, 0, now).id().width, 20);
  const auto works = [](const ModeId& id) { return id.width < 80 && id.mcs <= 5; };
  send(control, 20'000, works);
  std::map<ModeId, int> used;
  for (const ModeId& id : send(control, 1000, works)) ++used[id];
  const ModeId best{ModulationClass::kVht, 5, 2, 40, 400ns};
  EXPECT_GT(used[best], 930);
}

// 16 PPDUs and twice ten MPDUs lie between two samples.
TEST_F(HtRateControlTest, MinstrelHtSamplesAtItsPace) {
  const auto samples = [this](std::uint32_t wait) {
    rates.minstrel_ht_wait = wait;
    MinstrelHt control = minstrel();
    const auto works = [](const ModeId& id) { return id.streams == 1 && id.mcs == 0; };
    send(control, 20'000, works);
    std::map<bool, int> worked;
    for (const ModeId& id : send(control, 3700, works)) ++worked[works(id)];
    return worked[false];
  };
  EXPECT_NEAR(samples(16), 3700 / 38, 2);  // the attempt after the sample waits, too
  EXPECT_NEAR(samples(100), 3700 / 122, 2);
}

TEST_F(HtRateControlTest, MinstrelHtTriesASampleOnceThenTheBest) {
  MinstrelHt control = minstrel();
  const auto works = [](const ModeId& id) { return id.mcs == 0 && id.streams == 1; };
  send(control, 20'000, works);
  const std::vector<ModeId> used = send(control, 500, works);
  for (std::size_t i = 1; i < used.size(); ++i) {
    EXPECT_TRUE(works(used[i - 1]) || works(used[i])) << i;
  }
}

// Best, then the second best, then the most reliable.
TEST_F(HtRateControlTest, MinstrelHtGoesDownItsChain) {
  rates.minstrel_ht_wait = 1'000'000;
  MinstrelHt control = minstrel();
  send(control, 100, kAllWork, kPeerHt);
  now += 1s;
  const ModeId best = control.mode(kPeerHt, 0, now).id();
  std::vector<ModeId> chain{best};
  for (std::uint32_t failures = 1; failures < 20; ++failures) {
    control.on_aggregate(kPeerHt, 0, 10);
    const ModeId id = control.mode(kPeerHt, failures, now).id();
    if (id != chain.back()) chain.push_back(id);
  }
  EXPECT_GE(chain.size(), 2u);
  EXPECT_LE(chain.size(), 3u);
  control.on_aggregate(kPeerHt, 1, 10);
  EXPECT_EQ(control.mode(kPeerHt, 0, now).id(), best) << "the interval has not ended";
}

TEST_F(HtRateControlTest, MinstrelHtServesOlderStationsAsMinstrelDoes) {
  MinstrelHt control = minstrel();
  Minstrel plain(rates, *ladders_, hal::RandomStream(1, "a/rates"));
  EXPECT_EQ(send(control, 500, kAllWork, kPeerOfdm), send(plain, 500, kAllWork, kPeerOfdm));
}

TEST_F(HtRateControlTest, MinstrelHtIsTheSameInEachRun) {
  MinstrelHt first = minstrel();
  const auto works = [](const ModeId& id) { return id.mcs < 4; };
  const auto used = send(first, 3000, works);
  now = {};
  MinstrelHt second = minstrel();
  EXPECT_EQ(send(second, 3000, works), used);
}

TEST_F(HtRateControlTest, IdealBeginsSlowlyAndForgetsASilentReceiver) {
  Ideal ideal(rates, *ladders_);
  const ModeId slowest = ideal.mode(kPeerVht, 0, now).id();
  EXPECT_EQ(slowest, (ModeId{ModulationClass::kVht, 0, 1, 20, 800ns}));
  ideal.on_answer(kPeerVht, hal::Decibels{60}, 20);
  ideal.on_result(kPeerVht, true);
  EXPECT_EQ(ideal.mode(kPeerVht, 0, now).id(), modes_.data().id());
  for (int i = 0; i < 6; ++i) ideal.on_result(kPeerVht, false);
  EXPECT_EQ(ideal.mode(kPeerVht, 6, now).id(), modes_.data().id());
  ideal.on_result(kPeerVht, false);
  EXPECT_EQ(ideal.mode(kPeerVht, 7, now).id(), slowest);
}

// What it chooses loses no more than it may, and everything faster loses more.
TEST_F(HtRateControlTest, IdealKeepsItsLossAtEachSnr) {
  for (const double loss : {0.001, 0.3}) {
    rates.ideal_loss = loss;
    Ideal ideal(rates, *ladders_);
    for (double snr = 9; snr < 45; snr += 0.7) {
      ideal.on_answer(kPeerVht, hal::Decibels{snr}, 20);
      const PhyMode& chosen = ideal.mode(kPeerVht, 0, now);
      for (const Ladder& group : ladders_->groups_to(kPeerVht)) {
        for (const Rung& rung : group) {
          const double ratio = hal::math::pow(10, snr / 10) * 20 / rung.mode->width();
          const double lost = 1 - rung.mode->success(ratio, rung.mode->bits_at_risk(rung.bits));
          const bool is_faster = rung.mode->rate() > chosen.rate();
          EXPECT_TRUE(rung.mode != &chosen || lost <= loss * 1.0001) << snr;
          EXPECT_TRUE(!is_faster || lost > loss * 0.9999) << snr;
        }
      }
    }
  }
}

}  // namespace
}  // namespace sim::radio::test
