#include "sim/air/samples.h"

#include <gtest/gtest.h>

#include <functional>
#include <memory>

#include "tests/unit/sim/air/ledger/dds_packets.h"

namespace sim::air::test {
namespace {

using namespace std::chrono_literals;
using hal::AgentId;

constexpr std::uint32_t kScanWriter = 0x00000103, kScanReader = 0x00000204;
const hal::Bytes kScan(40, 1);

/// Agent 1 writes a topic that 2 and 3 read; SEDP told so to everyone.
class SamplesTest : public testing::Test {
 protected:
  SamplesTest() : replay(radio::profile_defaults(radio::Profile::kIeee80211g)) {}

  void build() {
    replay.build();
    for (const std::uint8_t one : {std::uint8_t{1}, std::uint8_t{2}, std::uint8_t{3}})
      send(2ms * one, one, hal::kEveryone, Rtps(one).spdp());
    send(10ms, 1, hal::kEveryone, Rtps(1).sedp(1, kScanWriter, "scan"));
    for (const std::uint8_t reader : {std::uint8_t{2}, std::uint8_t{3}})
      send(10ms * reader, reader, hal::kEveryone, Rtps(reader).sedp(reader, kScanReader, "scan"));
  }
  void send(hal::Duration at, std::uint16_t from, AgentId to, const Rtps& message,
            std::size_t mtu = 1500) {
    replay.send(udp(at, from, to, message.bytes(), ++id_, mtu));
  }
  void turn_off(AgentId station, hal::Duration from, hal::Duration to) {
    const auto set = [this, station](hal::Duration at, bool on) {
      auto* const action =
          actions
              .emplace_back(std::make_unique<std::function<void()>>(
                  [this, station, on] { replay.network->sap(station).set_radio(on); }))
              .get();
      replay.events.schedule(hal::Time{at}, Rank::kScenario, kWorld, [action] { (*action)(); });
    };
    set(from, false);
    set(to, true);
  }
  std::string sums(int receiver) {
    return replay.ask(
        "SELECT samples || ' sent, ' || delivered || ' delivered, ' || first_try || ' at first, '"
        " || repairs || ' repairs, ' || under_way || ' under way' FROM sample_sums WHERE receiver"
        " = " +
        std::to_string(receiver));
  }

  Replay replay;
  std::vector<std::unique_ptr<std::function<void()>>> actions;
  std::uint16_t id_ = 0;
};

TEST_F(SamplesTest, WhatIsSentToEachByItselfIsNoRepair) {
  build();
  for (const std::uint16_t to : {std::uint16_t{2}, std::uint16_t{3}})
    send(1s + 1ms * to, 1, AgentId{to}, Rtps(1).data(kScanWriter, 1, kScan));
  replay.run(3s);
  EXPECT_EQ(sums(2), "1 sent, 1 delivered, 1 at first, 0 repairs, 0 under way");
  EXPECT_EQ(sums(3), "1 sent, 1 delivered, 1 at first, 0 repairs, 0 under way");
  expect_sums_of_the_radio(replay);
}

// 3 is off when the sample is broadcast, and gets it when it is sent again; by then 2 has it.
TEST_F(SamplesTest, WhatCameByTheSecondTryIsRepairedThereOnly) {
  build();
  turn_off(AgentId{3}, 900ms, 1100ms);
  for (const auto at : {1s, 2s, 3s})
    send(at, 1, hal::kEveryone, Rtps(1).data(kScanWriter, 1, kScan).heartbeat(kScanWriter, 1));
  replay.run(5s);
  EXPECT_EQ(sums(2), "1 sent, 1 delivered, 1 at first, 2 repairs, 0 under way");
  EXPECT_EQ(sums(3), "1 sent, 1 delivered, 0 at first, 2 repairs, 0 under way");
  EXPECT_EQ(replay.ask("SELECT repaired FROM samples WHERE receiver = 3"), "1");
  EXPECT_EQ(replay.ask("SELECT left_ns / 1000000000 FROM samples WHERE receiver = 3"), "2");
  expect_sums_of_the_radio(replay);
}

TEST_F(SamplesTest, WhatIsAddressedWithinTheGroupIsForThatOneOnly) {
  build();
  send(1s, 1, hal::kEveryone, Rtps(1).info_destination(3).data(kScanWriter, 1, kScan));
  replay.run(5s);
  EXPECT_EQ(sums(2), "none");
  EXPECT_EQ(sums(3), "1 sent, 1 delivered, 1 at first, 0 repairs, 0 under way");
}

// 2 is off and gets nothing; the frame is named, and how its last transmission ended there.
TEST_F(SamplesTest, WhatIsLostHasTheVerdictOfItsLastFrame) {
  build();
  turn_off(AgentId{2}, 900ms, 1100ms);
  send(1s, 1, AgentId{2}, Rtps(1).data(kScanWriter, 1, kScan));
  send(15s, 1, AgentId{2}, Rtps(1).data(kScanWriter, 2, kScan));
  replay.run(20s);
  EXPECT_EQ(sums(2), "2 sent, 1 delivered, 1 at first, 0 repairs, 0 under way");
  EXPECT_EQ(replay.ask("SELECT verdict || count FROM sample_losses"), "radio off1");
  EXPECT_EQ(replay.ask("SELECT retry FROM frames WHERE frame IN (SELECT frame FROM samples)"), "1");
  expect_sums_of_the_radio(replay);
}

TEST_F(SamplesTest, WhatFindsTheQueueFullIsLostToThat) {
  radio::dcf_of(replay.config.radio)->contention.queue_limit = 2;
  build();
  for (std::uint32_t i = 1; i <= 20; ++i)
    send(1s, 1, AgentId{2}, Rtps(1).data(kScanWriter, i, kScan));
  send(15s, 1, AgentId{2}, Rtps(1).data(kScanWriter, 21, kScan));
  replay.run(20s);
  EXPECT_EQ(replay.ask("SELECT GROUP_CONCAT(verdict) FROM sample_losses"), "queue full");
  EXPECT_EQ(replay.ask("SELECT samples - delivered FROM sample_sums"),
            replay.ask("SELECT count FROM requests WHERE verdict = 'queue full'"));
}

// Whom SEDP did not reach, or who asks for more than the writer offers, is no reader of its.
TEST_F(SamplesTest, OnlyMatchedReadersCount) {
  turn_off(AgentId{3}, 9ms, 15ms);
  build();
  send(100ms, 2, hal::kEveryone, Rtps(2).sedp(2, 0x00000304, "other"));
  send(200ms, 1, hal::kEveryone, Rtps(1).sedp(1, 0x00000503, "other", false));
  for (const std::uint32_t writer : {kScanWriter, 0x00000503U})
    send(1s, 1, hal::kEveryone, Rtps(1).data(writer, 1, kScan));
  replay.run(5s);
  EXPECT_EQ(sums(2), "1 sent, 1 delivered, 1 at first, 0 repairs, 0 under way");
  EXPECT_EQ(sums(3), "1 sent, 0 delivered, 0 at first, 0 repairs, 1 under way");
}

// SEDP comes before SPDP there, so nobody listens to it, until it is sent again.
TEST_F(SamplesTest, ReadersAreMatchedOnceTheirParticipantsKnowEachOther) {
  turn_off(AgentId{3}, 0ms, 5ms);
  build();
  send(1s, 1, hal::kEveryone, Rtps(1).data(kScanWriter, 1, kScan));
  send(2s, 1, hal::kEveryone, Rtps(1).spdp());
  send(3s, 1, hal::kEveryone, Rtps(1).data(kScanWriter, 2, kScan));
  send(4s, 1, hal::kEveryone, Rtps(1).sedp(1, kScanWriter, "scan"));
  send(5s, 1, hal::kEveryone, Rtps(1).data(kScanWriter, 3, kScan));
  replay.run(6s);
  EXPECT_EQ(sums(2), "3 sent, 3 delivered, 3 at first, 0 repairs, 0 under way");
  EXPECT_EQ(sums(3), "3 sent, 1 delivered, 1 at first, 0 repairs, 2 under way");
}

// A datagram of 40 kB in fragments of IP of 576 bytes, one of which is lost.
TEST_F(SamplesTest, ADatagramWithoutOneFragmentIsNone) {
  radio::dcf_of(replay.config.radio)->contention.queue_limit = 200;
  build();
  send(1s, 1, hal::kEveryone, Rtps(1).data(kScanWriter, 1, hal::Bytes(40'000, 1)), 576);
  turn_off(AgentId{3}, 1020ms, 1020100us);
  send(15s, 1, hal::kEveryone, Rtps(1).data(kScanWriter, 2, kScan));
  replay.run(20s);
  EXPECT_EQ(sums(2), "2 sent, 2 delivered, 2 at first, 0 repairs, 0 under way");
  EXPECT_EQ(sums(3), "2 sent, 1 delivered, 1 at first, 0 repairs, 0 under way");
  EXPECT_EQ(replay.ask("SELECT verdict FROM sample_losses WHERE receiver = 3"), "radio off");
  EXPECT_EQ(
      replay.ask("SELECT submessages FROM air_writers WHERE kind = 'DATA' AND topic = 'scan'"),
      "2");
  expect_sums_of_the_radio(replay);
}

TEST_F(SamplesTest, FragmentsAreRepairedOneByOne) {
  build();
  send(1s, 1, AgentId{2}, Rtps(1).data_frag(kScanWriter, 1, 1, 3).data_frag(kScanWriter, 1, 3, 3));
  send(1100ms, 1, AgentId{2}, Rtps(1).data_frag(kScanWriter, 1, 2, 3));
  send(1200ms, 1, AgentId{2}, Rtps(1).data_frag(kScanWriter, 1, 3, 3));
  replay.run(20s);
  EXPECT_EQ(sums(2), "1 sent, 1 delivered, 1 at first, 1 repairs, 0 under way");
  EXPECT_EQ(sums(3), "none");
  EXPECT_EQ(replay.ask("SELECT fragments FROM sample_sums WHERE receiver = 2"), "3");
  EXPECT_EQ(replay.ask("SELECT left_ns > 1100000000 FROM samples WHERE receiver = 2"), "1");
}

/// Agent 1 writes a topic that some others read: everyone knows everything.
class HostileSamplesTest : public testing::Test {
 protected:
  void read_by(std::uint16_t agents) {
    for (std::uint16_t agent = 1; agent <= 1 + agents; ++agent) {
      hal::rtps::Guid guid{{}, {agent == 1 ? kScanWriter : kScanReader}};
      guid.prefix.octets.fill(static_cast<std::byte>(agent));
      endpoints.place(guid.prefix, AgentId{agent});
      const EndpointIndex index = endpoints.learn(
          {}, {.guid = guid, .topic = "scan", .type = "type", .reliability = 2, .partitions = {}});
      if (agent == 1) writer = index;
      const AgentId there{static_cast<std::uint16_t>(agent == 1 ? 2 : 1)};
      endpoints.meet(guid.prefix, there);
      endpoints.reach(index, index, there);
    }
    ASSERT_EQ(endpoints.readers_of(writer).size(), agents);
  }
  void send(std::int64_t number, std::uint32_t fragments) {
    const DatagramPart part{
        .writer = writer, .sequence_number = number, .all_fragments = fragments};
    samples.on_sent(hal::Time{hal::Duration{++sent}}, {.serial = sent, .source = AgentId{1}}, part,
                    hal::kEveryone);
  }
  std::uint64_t counted(std::uint16_t receiver) {
    samples.finish(hal::Time{1h});
    return samples.sums()[{writer, AgentId{receiver}}].samples;
  }

  Endpoints endpoints;
  Samples samples{endpoints};
  EndpointIndex writer = 0;
  std::uint64_t sent = 0;
};

// One datagram that names so many fragments has memory set aside for them all.
TEST_F(HostileSamplesTest, MoreFragmentsThanAreFollowedSettleTheOldest) {
  read_by(2);
  constexpr std::size_t kMost = Samples::kMostOpenFragments / (2 * Samples::kMostFragments);
  for (std::int64_t number = 1; number <= 200; ++number) {
    send(number, Samples::kMostFragments);
    ASSERT_LE(samples.open(), kMost);
  }
  EXPECT_EQ(samples.open(), kMost);
  EXPECT_EQ(counted(2), 200U) << "those settled early as well";
  EXPECT_EQ(samples.open(), 0U);
  for (std::int64_t number = 201; number <= 200 + std::int64_t{kMost}; ++number)
    send(number, Samples::kMostFragments);
  EXPECT_EQ(samples.open(), kMost) << "what is settled leaves room for as many again";
}

TEST_F(HostileSamplesTest, WhatArrivedTakesNoRoom) {
  read_by(1);
  DatagramPart part{.writer = writer,
                    .fragments = Samples::kMostFragments,
                    .all_fragments = Samples::kMostFragments};
  constexpr std::int64_t kSent = 2 * Samples::kMostOpenFragments / Samples::kMostFragments;
  for (part.sequence_number = 1; part.sequence_number <= kSent; ++part.sequence_number) {
    samples.on_sent({}, {.serial = 1, .source = AgentId{1}}, part, hal::kEveryone);
    samples.on_received({}, {.serial = 1, .source = AgentId{1}}, part, AgentId{2});
  }
  EXPECT_EQ(samples.open(), std::size_t{kSent}) << "none was settled early";
}

TEST_F(HostileSamplesTest, ASampleOfMoreFragmentsIsNotFollowed) {
  read_by(100);
  send(1, Samples::kMostFragments + 1);
  EXPECT_EQ(samples.open(), 0U);
  send(2, Samples::kMostFragments);
  EXPECT_EQ(samples.open(), 0U) << "by a hundred agents";
  send(3, Samples::kMostOpenFragments / 100);
  EXPECT_EQ(samples.open(), 1U);
}

// Making room for one settles another of the same writer with a higher number.
TEST_F(HostileSamplesTest, ASampleThatMakingRoomMadeOldIsNotBegun) {
  read_by(1);
  constexpr std::size_t kMost = Samples::kMostOpenFragments / Samples::kMostFragments;
  for (std::size_t i = 0; i < kMost; ++i)
    send(1000 + static_cast<std::int64_t>(i), Samples::kMostFragments);
  send(5, Samples::kMostFragments);
  EXPECT_EQ(samples.open(), kMost - 1);
  EXPECT_EQ(counted(2), kMost);
}

}  // namespace
}  // namespace sim::air::test
