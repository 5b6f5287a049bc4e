#include <gtest/gtest.h>

#include <initializer_list>
#include <set>
#include <string>

#include "sim/radio/radio_rules.h"
#include "tests/unit/sim/radio/bss.h"

namespace sim::radio::test {
namespace {

using hal::Verdict;

/// IETF RFC 791 and 768, with ports that tell flows apart.
Payload udp_packet(std::uint8_t port, std::size_t bytes) {
  hal::Bytes packet(bytes);
  packet[0] = 0x45;
  packet[9] = 17;
  packet[23] = port;
  return std::make_shared<const hal::Bytes>(std::move(packet));
}

/// A queue for each receiver and category: station 1 sends to 2 and 3, which are 5 m away.
class StationQueues : public testing::Test {
 protected:
  explicit StationQueues(Profile profile = Profile::kIeee80211n)
      : air(profile), programs(air.events) {
    dcf().queues.per = QueuePer::kStation;
    air.add_line(3, 5);
  }
  DcfConfig& dcf() { return *dcf_of(air.config); }

  void send(std::uint16_t to, std::uint8_t priority, std::size_t bytes, std::uint64_t tag) {
    air.sap(1).transmit({.destination = hal::AgentId{to},
                         .priority = priority,
                         .payload = std::make_shared<const hal::Bytes>(bytes),
                         .tag = tag});
  }
  std::size_t ended(Verdict verdict) {
    return static_cast<std::size_t>(
        std::ranges::count(air.inbox(1).ended, verdict, &Inbox::Ended::verdict));
  }
  /// The ends have tags 0 .. count - 1, each once.
  void expect_each_ends_once(std::size_t count) {
    std::set<std::uint64_t> tags;
    for (const Inbox::Ended& one : air.inbox(1).ended) tags.insert(one.tag);
    EXPECT_EQ(tags.size(), count);
    EXPECT_EQ(air.inbox(1).ended.size(), count);
  }

  Air air;
  Inbox programs;
};

TEST_F(StationQueues, EachHasTheLimit) {
  dcf().queues.limit = 10;
  air.build();
  air.at(1ms, [this] {
    std::uint64_t tag = 0;
    for (const std::uint16_t to : std::initializer_list<std::uint16_t>{2, 3}) {
      for (const std::uint8_t priority : std::initializer_list<std::uint8_t>{0, 6}) {
        for (int i = 0; i < 15; ++i) send(to, priority, 100, tag++);
      }
    }
  });
  air.run();
  expect_each_ends_once(60);
  EXPECT_EQ(ended(Verdict::kDelivered), 40u) << "the medium was asked for, no more, at 1 ms";
  EXPECT_EQ(ended(Verdict::kQueueFull), 20u);
}

TEST_F(StationQueues, MayHaveALimitOfBytes) {
  dcf().queues.limit_bytes = 1000;
  air.build();
  air.at(1ms, [this] {
    for (std::uint64_t i = 0; i < 15; ++i) send(2, 0, 100, i);
  });
  air.run();
  EXPECT_EQ(ended(Verdict::kDelivered), 10u);
  EXPECT_EQ(ended(Verdict::kQueueFull), 5u);
  EXPECT_EQ(air.sap(1).waiting(), 0u);
}

TEST_F(StationQueues, TellTheirRoom) {
  dcf().queues.limit = 10;
  air.build();
  EXPECT_EQ(air.sap(1).room(), 10u);
  for (std::uint64_t i = 0; i < 4; ++i) send(2, 0, 100, i);
  EXPECT_EQ(air.sap(1).room(), 6u);
  EXPECT_EQ(air.sap(1).waiting(), 4u);
  air.run();
  EXPECT_EQ(air.sap(1).room(), 10u);
}

// In the one queue of a radio requests are served in the order in which they came, but for those
// that share an A-MPDU: 200 wait before the one to station 3, and a window may overtake it.
TEST_F(StationQueues, AreOneByDefaultInWhichAStreamDoesNotKeepTheMedium) {
  dcf().queues.per = QueuePer::kRadio;
  air.build();
  std::size_t to_2 = 0;
  air.inbox(1).refill = [&] {
    ++to_2;
    send(2, 0, 1500, 0);
  };
  air.at(1ms, [this] {
    for (int i = 0; i < 200; ++i) send(2, 0, 1500, 0);
  });
  std::size_t before = 0, after = 0;
  air.at(101ms, [&] {
    before = to_2;
    send(3, 0, 1500, 1);
  });
  air.inbox(3).forward = [&](const MacIndication&) { after = to_2; };
  air.run(1s);
  EXPECT_GE(after, before + 190);
  EXPECT_LE(after, before + 200 + 64);
}

// A full queue of one receiver leaves those of others alone.
TEST_F(StationQueues, AreServedInTurn) {
  dcf().aggregation.max_ampdu = 0;
  dcf().queues.limit = 100;
  air.build();
  air.at(1ms, [this] {
    for (std::uint64_t i = 0; i < 50; ++i) send(2, 0, 1000, i);
    for (std::uint64_t i = 50; i < 60; ++i) send(3, 0, 1000, i);
  });
  air.run();
  expect_each_ends_once(60);
  std::string receivers;
  for (const Log::Start& start : air.log.starts) {
    if (start.frame.type == FrameType::kData) {
      receivers += std::to_string(start.frame.receiver.value);
    }
  }
  EXPECT_EQ(receivers.substr(0, 24), "232323232323232323232222");
}

TEST_F(StationQueues, FillAggregates) {
  dcf().queues.limit = 1000;
  air.build();
  air.at(1ms, [this] {
    for (std::uint64_t i = 0; i < 200; ++i) send(i % 2 == 0 ? 2 : 3, 0, 500, i);
  });
  air.run();
  expect_each_ends_once(200);
  EXPECT_EQ(ended(Verdict::kDelivered), 200u);
  std::set<std::pair<std::uint32_t, std::uint16_t>> ampdus;
  std::uint32_t most = 0, same = 0, last = 0;
  for (const Log::Start& start : air.log.starts) {
    if (start.frame.ampdu == 0) continue;
    same = start.frame.ampdu == last ? same + 1 : 1;
    last = start.frame.ampdu;
    most = std::max(most, same);
    ampdus.insert({start.frame.ampdu, start.frame.receiver.value});
  }
  EXPECT_EQ(most, 64u);
  EXPECT_LE(ampdus.size(), 8u);
}

TEST_F(StationQueues, SurviveLosses) {
  dcf().queues.limit = 1000;
  dcf().receiver.loss.probability = 0.2;
  dcf().aggregation.max_amsdu = 3000;
  air.build();
  std::uint64_t tag = 0;
  air.at(1ms, [&] {
    for (; tag < 600; ++tag) send(tag % 2 == 0 ? 2 : 3, tag % 8 == 0 ? 3 : 0, 400, tag);
  });
  air.run(3s);
  expect_each_ends_once(600);
  EXPECT_EQ(air.sap(1).waiting(), 0u);
  EXPECT_GT(ended(Verdict::kDelivered), 580u);
}

TEST_F(StationQueues, EndAllWhenTheRadioGoesOff) {
  dcf().queues.limit = 1000;
  air.build();
  air.at(1ms, [this] {
    for (std::uint64_t i = 0; i < 300; ++i) send(i % 2 == 0 ? 2 : 3, 0, 500, i);
  });
  air.at(10ms, [this] { air.sap(1).set_radio(false); });
  air.at(20ms, [this] { air.sap(1).set_radio(true); });
  air.at(21ms, [this] { send(2, 0, 500, 300); });
  air.run();
  expect_each_ends_once(301);
  EXPECT_GT(ended(Verdict::kRadioOff), 100u);
  EXPECT_EQ(air.inbox(1).ended.back().verdict, Verdict::kDelivered);
}

// dot11EDCATableMSDULifetime: best effort waits behind voice.
TEST_F(StationQueues, HaveTheLifetimeOfTheirCategory) {
  dcf().queues.limit = 1000;
  dcf().edca.of(AccessCategory::kVoice).msdu_lifetime = 3ms;
  dcf().msdu_lifetime = 500ms;
  dcf().aggregation.max_ampdu = 0;
  air.build();
  air.at(1ms, [this] {
    for (std::uint64_t i = 0; i < 20; ++i) send(2, 6, 1400, i);
    for (std::uint64_t i = 20; i < 40; ++i) send(2, 0, 1400, i);
  });
  air.run();
  expect_each_ends_once(40);
  EXPECT_GT(ended(Verdict::kExpired), 5u);
  for (const Inbox::Ended& one : air.inbox(1).ended) {
    if (one.verdict == Verdict::kExpired) {
      EXPECT_LT(one.tag, 20u) << "voice";
    }
    if (one.verdict == Verdict::kDelivered && one.tag < 20) {
      EXPECT_LT(one.at, hal::Time{} + 1ms + 3ms + 500us);
    }
  }
}

TEST(QueueRules, NameWhatCannotBe) {
  const auto broken = [](auto change) {
    Ieee80211gConfig config;
    change(config.queues);
    const auto rules = broken_rules(RadioConfig(config));
    return rules.empty() ? "" : rules.front().key;
  };
  EXPECT_EQ(broken([](auto&) {}), "");
  EXPECT_EQ(broken([](auto& c) { c.discipline = Discipline::kFqCodel; }), "queues.per");
  EXPECT_EQ(broken([](auto& c) { c.airtime_fairness = true; }), "queues.per");
  EXPECT_EQ(broken([](auto& c) { c.limit_bytes = 1000; }), "queues.per");
  EXPECT_EQ(broken([](auto& c) { c.fq_codel.target = c.fq_codel.interval; }), "queues.target");
  EXPECT_EQ(broken([](auto& c) { c.fq_codel.quantum = 0; }), "queues.quantum");
  EXPECT_EQ(broken([](auto& c) { c.fq_codel.flows = 0; }), "queues.flows");
  EXPECT_EQ(broken([](auto& c) { c.airtime_quantum = {}; }), "queues.airtime_quantum");
}

/// 95 % delay of a thin flow of programs, 100 bytes every 10 ms, beside one that always has 400
/// frames waiting, to the same receiver. ms
class ThinFlow : public StationQueues {
 protected:
  double p95() {
    dcf().queues.limit = 400;
    air.build();
    air.sap(1).add_client(0x0800, bulk_and_thin);
    air.sap(2).add_client(0x0800, programs);
    programs.forward = [this](const MacIndication& one) {
      if ((*one.payload)[23] != kThin) return;
      delays.push_back(hal::to_seconds(air.events.now() - sent[received++]) * 1e3);
    };
    bulk_and_thin.refill = [this] { fill(); };
    air.at(1ms, [this] { fill(); });
    for (int i = 0; i < 200; ++i) {
      air.at(1s + i * 10ms, [this] {
        sent.push_back(air.events.now());
        packet(kThin, 100);
      });
    }
    air.run(4s);
    std::ranges::sort(delays);
    const double delay = delays.at(delays.size() * 95 / 100);
    RecordProperty("p95_ms", std::to_string(delay));
    return delay;
  }
  void fill() {
    while (air.sap(1).room() > 0) packet(1, 1400);
  }
  void packet(std::uint8_t port, std::size_t bytes) {
    air.sap(1).transmit({.destination = hal::AgentId{2},
                         .ethertype = 0x0800,
                         .payload = udp_packet(port, bytes),
                         .tag = port});
  }
  static constexpr std::uint8_t kThin = 2;
  Inbox bulk_and_thin{air.events};
  std::vector<hal::Time> sent;
  std::vector<double> delays;
  std::size_t received = 0;
};

// A FIFO of 400 frames of 1400 bytes lasts 4.48 Mb / 65 Mb/s = 69 ms, or more; what is on the air
// has left it.
TEST_F(ThinFlow, WaitsForAllOthersInAFifo) { EXPECT_GT(p95(), 65); }

// With fq_codel it is in the next A-MPDU: after the one that is being sent. Each has 65,535 bytes
// at 65 Mb/s, 8.1 ms, and its BlockAck and backoff.
TEST_F(ThinFlow, IsInTheNextAggregateWithFqCodel) {
  dcf().queues.discipline = Discipline::kFqCodel;
  EXPECT_LT(p95(), 2 * 8.4);
  EXPECT_EQ(delays.size(), 200u);
  const auto dropped =
      std::ranges::count(bulk_and_thin.ended, Verdict::kQueueDelay, &Inbox::Ended::verdict);
  EXPECT_GT(dropped, 10) << "CoDel drops of the other flow";
}

/// The same at an access point, s1, and its stations.
class AccessPointQueues : public BssTest {
 protected:
  AccessPointQueues() {
    dcf().queues.per = QueuePer::kStation;
    dcf().contention.queue_limit = 50;
  }
};

TEST_F(AccessPointQueues, PassOnWhatComes) {
  build({{0, 0, 0}, {50, 0, 0}, {0, 50, 0}, {-50, 0, 0}});
  air.at(1s, [this] {
    for (std::uint64_t i = 0; i < 10; ++i) {
      air.send(1, 2, kPayload, i);
      air.send(2, 3, kPayload, i);
      air.send(3, 4, kPayload, i);
      air.send(4, hal::kEveryone.value, kPayload, i);
      air.send(1, 9, kPayload, 100 + i);
    }
  });
  air.run(3s);
  EXPECT_EQ(air.inbox(2).received.size(), 20u);
  EXPECT_EQ(air.inbox(3).received.size(), 20u);
  EXPECT_EQ(air.inbox(4).received.size(), 10u);
  EXPECT_EQ(air.inbox(1).received.size(), 10u);
  EXPECT_EQ(verdict_of(1, 100), Verdict::kNoRoute) << "nobody has that address";
  EXPECT_EQ(verdict_of(1, 1), Verdict::kDelivered);
  for (std::uint16_t station = 1; station <= 4; ++station) {
    EXPECT_EQ(air.sap(station).waiting(), 0u);
  }
}

TEST_F(AccessPointQueues, WaitForTheAssociation) {
  build({{0, 0, 0}, {50, 0, 0}});
  for (std::uint64_t i = 0; i < 60; ++i) air.send(2, 1, kPayload, i);
  air.run(119ms);
  EXPECT_EQ(air.inbox(1).received.size(), 0u);
  EXPECT_EQ(air.inbox(2).ended.size(), 10u) << "50 fit";
  air.run(1s);
  EXPECT_EQ(air.inbox(1).received.size(), 50u);
}

// A full queue for a station that does not answer is not in the way of others.
TEST_F(AccessPointQueues, OfDeafStationsDoNotBlockOthers) {
  without_rts();
  build({{0, 0, 0}, {50, 0, 0}, {0, 50, 0}});
  air.at(1s, [this] {
    air.sap(2).set_radio(false);
    for (std::uint64_t i = 0; i < 50; ++i) air.send(1, 2, kPayload, i);
    air.send(1, 3, kPayload, 100);
  });
  air.run(1050ms);
  EXPECT_EQ(verdict_of(1, 100), Verdict::kDelivered);
  EXPECT_GT(air.sap(1).waiting(), 40u);
}

}  // namespace
}  // namespace sim::radio::test
