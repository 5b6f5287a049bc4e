#include "results/record/dds_values.h"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "tests/unit/sim/air/ledger/dds_packets.h"

namespace sim::air::test {
namespace {

using namespace std::chrono_literals;
using hal::AgentId;
using results::record::DdsValues;
using scenario::DdsSide;
using scenario::DdsValue;

constexpr std::uint32_t kWriter = 0x00000103, kReader = 0x00000204;
const hal::Bytes kPayload(40, 1);

/// Agent 1 writes "scan", which 2 and 3 read. Every 100 ms all values are noted.
class DdsValuesTest : public testing::Test {
 protected:
  DdsValuesTest() : replay(radio::profile_defaults(radio::Profile::kIeee80211g)) {}

  void build(bool is_watched = true) {
    replay.build();
    if (is_watched) watch();
    for (const std::uint8_t one : {std::uint8_t{1}, std::uint8_t{2}, std::uint8_t{3}})
      send(2ms * one, one, hal::kEveryone, Rtps(one).spdp());
    send(150ms, 1, hal::kEveryone, Rtps(1).sedp(1, kWriter, "scan"));
    for (const std::uint8_t reader : {std::uint8_t{2}, std::uint8_t{3}})
      send(100ms * reader + 10ms, reader, hal::kEveryone,
           Rtps(reader).sedp(reader, kReader, "scan"));
  }
  void watch() {
    values = std::make_unique<DdsValues>(
        replay.ledger(),
        [this](const DdsValues::Place& place, DdsSide side) {
          known.emplace_back(place.first.value, side, replay.events.now());
        },
        [this](hal::Time at, const DdsValues::Place& place, DdsValue value) {
          if (value == DdsValue::kLatency)
            latencies[place.first.value].push_back(*values->value(at, place, value));
          ++events[{place.first.value, value}];
        });
  }
  void send(hal::Duration at, std::uint16_t from, AgentId to, const Rtps& message) {
    replay.send(udp(at, from, to, message.bytes(), ++id_, 1500));
  }
  void at(hal::Duration when, std::function<void()> what) {
    auto* const action =
        actions_.emplace_back(std::make_unique<std::function<void()>>(std::move(what))).get();
    replay.events.schedule(hal::Time{when}, Rank::kScenario, kWorld, [action] { (*action)(); });
  }
  void turn_off(AgentId station, hal::Duration from, hal::Duration to) {
    at(from, [this, station] { replay.network->sap(station).set_radio(false); });
    at(to, [this, station] { replay.network->sap(station).set_radio(true); });
  }
  std::optional<double> value(std::uint16_t agent, DdsValue which) {
    return values->value(replay.events.now(), {AgentId{agent}, 1}, which);
  }
  double asked(const std::string& sql) const {
    const std::string answer = replay.ask(sql);
    return answer == "none" || answer == "null" ? -1 : std::stod(answer);
  }
  bool is_known(std::uint16_t agent, DdsSide side, hal::Duration from, hal::Duration to) const {
    return std::ranges::count_if(known, [&](const auto& one) {
             return std::get<0>(one) == agent && std::get<1>(one) == side &&
                    std::get<2>(one) >= hal::Time{from} && std::get<2>(one) < hal::Time{to};
           }) == 1;
  }

  Replay replay;
  std::unique_ptr<DdsValues> values;
  std::vector<std::tuple<std::uint16_t, DdsSide, hal::Time>> known;
  std::map<std::uint16_t, std::vector<double>> latencies;
  std::map<std::pair<std::uint16_t, DdsValue>, int> events;

 private:
  std::vector<std::unique_ptr<std::function<void()>>> actions_;
  std::uint16_t id_ = 0;
};

TEST_F(DdsValuesTest, AreKnownWhenTheTopicIsAnnouncedThereAndNotBefore) {
  build();
  replay.run(1s);
  EXPECT_TRUE(is_known(1, DdsSide::kWriter, 150ms, 210ms));
  EXPECT_TRUE(is_known(1, DdsSide::kTransmitter, 150ms, 210ms));
  EXPECT_TRUE(is_known(2, DdsSide::kReader, 210ms, 310ms));
  EXPECT_TRUE(is_known(3, DdsSide::kReader, 310ms, 1s));
  EXPECT_FALSE(is_known(1, DdsSide::kReader, 0s, 1s));
  EXPECT_FALSE(is_known(2, DdsSide::kWriter, 0s, 1s));
  EXPECT_EQ(known.size(), 6U) << "each once";
}

TEST_F(DdsValuesTest, WhatIsMissingIsNotZeroAndZeroIsNotMissing) {
  build();
  at(900ms, [this] {
    for (const DdsValue zero : {DdsValue::kSamples, DdsValue::kDelivered, DdsValue::kFirstTry,
                                DdsValue::kRepaired, DdsValue::kRepairs, DdsValue::kAirtime})
      EXPECT_EQ(value(2, zero), 0.0) << static_cast<int>(zero);
    EXPECT_EQ(value(1, DdsValue::kSent), 0.0);
    for (const DdsValue none : {DdsValue::kDeliveredShare, DdsValue::kLatency, DdsValue::kAge})
      EXPECT_EQ(value(2, none), std::nullopt) << static_cast<int>(none);
  });
  turn_off(AgentId{3}, 950ms, 1100ms);
  send(1s, 1, hal::kEveryone, Rtps(1).data(kWriter, 1, kPayload));
  replay.run(2s);
  EXPECT_EQ(value(2, DdsValue::kDeliveredShare), 1.0);
  EXPECT_EQ(value(3, DdsValue::kDeliveredShare), 0.0) << "one was sent to it";
  EXPECT_EQ(value(3, DdsValue::kAge), std::nullopt) << "none has arrived";
  EXPECT_EQ(value(3, DdsValue::kLatency), std::nullopt);
}

TEST_F(DdsValuesTest, AgeIsThatOfTheNewestSampleNotOfTheLastToArrive) {
  build();
  turn_off(AgentId{3}, 950ms, 1100ms);
  send(1s, 1, hal::kEveryone, Rtps(1).data(kWriter, 1, kPayload));
  send(2s, 1, hal::kEveryone, Rtps(1).data(kWriter, 2, kPayload));
  send(3s, 1, hal::kEveryone, Rtps(1).data(kWriter, 1, kPayload));
  at(2500ms, [this] { EXPECT_NEAR(*value(3, DdsValue::kAge), 0.5, 1e-9); });
  at(3500ms, [this] {
    EXPECT_NEAR(*value(3, DdsValue::kAge), 1.5, 1e-9) << "not 2.5 s: the older one came later";
    EXPECT_NEAR(*value(3, DdsValue::kLatency), 2, 0.01) << "of the last to arrive";
    EXPECT_EQ(value(3, DdsValue::kRepaired), 1.0);
    EXPECT_EQ(value(3, DdsValue::kFirstTry), 1.0);
    EXPECT_EQ(value(2, DdsValue::kFirstTry), 2.0);
  });
  replay.run(4s);
}

// Against SQL over the rows of single samples, to the sample and the nanosecond.
TEST_F(DdsValuesTest, AreAtTheEndWhatTheRowsOfSamplesSay) {
  replay.options.samples = scenario::Detail::kAll;
  build();
  turn_off(AgentId{3}, 990ms, 1310ms);
  turn_off(AgentId{2}, 1690ms, 1790ms);
  for (std::uint32_t i = 1; i <= 20; ++i) {
    send(1s + 100ms * i, 1, hal::kEveryone, Rtps(1).data(kWriter, i, kPayload));
    if (i % 3 == 0)
      send(1s + 100ms * i + 50ms, 1, hal::kEveryone, Rtps(1).data(kWriter, i - 2, kPayload));
  }
  send(4s, 1, AgentId{2}, Rtps(1).data(kWriter, 21, kPayload));
  replay.run(20s);
  values->find_transmitters();
  EXPECT_EQ(value(1, DdsValue::kSent), 21.0);
  EXPECT_EQ(*value(1, DdsValue::kSent),
            asked("SELECT COUNT(DISTINCT sequence_number) FROM samples"));
  for (const std::uint16_t agent : {std::uint16_t{2}, std::uint16_t{3}}) {
    SCOPED_TRACE(agent);
    const std::string at = fmt::format(" FROM samples WHERE receiver = {}", agent);
    EXPECT_EQ(value(agent, DdsValue::kSamples), asked("SELECT COUNT(*)" + at));
    EXPECT_EQ(value(agent, DdsValue::kDelivered), asked("SELECT COUNT(left_ns)" + at));
    EXPECT_EQ(value(agent, DdsValue::kRepaired), asked("SELECT SUM(repaired)" + at));
    EXPECT_EQ(value(agent, DdsValue::kRepairs), asked("SELECT SUM(repairs)" + at));
    EXPECT_DOUBLE_EQ(*value(agent, DdsValue::kDeliveredShare),
                     asked("SELECT 1.0 * COUNT(left_ns) / COUNT(*)" + at));
    EXPECT_EQ(latencies[agent].size(), asked("SELECT COUNT(left_ns)" + at));
    double sum = 0;
    for (const double latency : latencies[agent]) sum += latency;
    EXPECT_NEAR(sum, asked("SELECT SUM(left_ns - entered_ns) * 1e-9" + at), 1e-9);
  }
  EXPECT_LT(*value(3, DdsValue::kDelivered), *value(3, DdsValue::kSamples));
  EXPECT_GT(*value(3, DdsValue::kRepaired), 0.0);
  for (const std::uint16_t agent : {std::uint16_t{1}, std::uint16_t{2}}) {
    const double airtime =
        asked(fmt::format("SELECT IFNULL(SUM(airtime_ns), 0) * 1e-9 FROM air_accounts WHERE topic "
                          "= 'scan' AND agent = {}",
                          agent));
    EXPECT_NEAR(*value(agent, DdsValue::kAirtime), airtime, 1e-12);
    EXPECT_EQ(airtime > 0, agent == 1) << "2 sends no acknowledgements here";
  }
}

TEST_F(DdsValuesTest, EventsAreThoseOfTheValueThatChanged) {
  build();
  turn_off(AgentId{3}, 950ms, 1100ms);
  send(1s, 1, hal::kEveryone, Rtps(1).data(kWriter, 1, kPayload));
  send(2s, 1, hal::kEveryone, Rtps(1).data(kWriter, 1, kPayload));
  replay.run(3s);
  EXPECT_EQ((events[{1, DdsValue::kSent}]), 1) << "one sample, though to two agents";
  EXPECT_EQ((events[{2, DdsValue::kFirstTry}]), 1);
  EXPECT_EQ((events[{2, DdsValue::kRepairs}]), 1);
  EXPECT_EQ((events[{2, DdsValue::kRepaired}]), 0);
  EXPECT_EQ((events[{3, DdsValue::kRepaired}]), 1);
  EXPECT_EQ((events[{3, DdsValue::kDeliveredShare}]), 2) << "sent, and then delivered";
}

}  // namespace
}  // namespace sim::air::test
