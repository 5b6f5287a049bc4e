// Samples through an access point: what does not come is lost to what became of its last carrier on
// its last hop, and the access point's relays say the same.
#include <gtest/gtest.h>

#include <functional>
#include <memory>

#include "tests/unit/sim/air/ledger/dds_packets.h"

namespace sim::air::test {
namespace {

using namespace std::chrono_literals;
using hal::AgentId;

constexpr std::uint32_t kRelayedWriter = 0x00000103, kRelayedReader = 0x00000204;

/// 1 and 3 write topics that 2 reads, 1 one that 3 reads, too; all of it passes through 4.
class RelayedSamplesTest : public testing::Test {
 protected:
  RelayedSamplesTest() : replay(radio::profile_defaults(radio::Profile::kIeee80211g), 4) {
    dcf().bss.access_points = {"s4"};
  }
  radio::DcfConfig& dcf() { return *radio::dcf_of(replay.config.radio); }

  /// From 1 s on they are associated, from 1.5 s on matched.
  /// @param rounds  of discovery, half a second each.
  void build(int rounds = 1) {
    replay.build();
    for (int round = 0; round < rounds; ++round) {
      const hal::Duration at = 1s + round * 500ms;
      for (const std::uint8_t one : {std::uint8_t{1}, std::uint8_t{2}, std::uint8_t{3}})
        send(at + 20ms * one, one, hal::kEveryone, Rtps(one).spdp());
      for (const std::uint8_t one : {std::uint8_t{1}, std::uint8_t{3}})
        tell(at + 100ms + 20ms * one, one, kRelayedWriter);
      for (const std::uint8_t one : {std::uint8_t{2}, std::uint8_t{3}})
        tell(at + 200ms + 20ms * one, one, kRelayedReader);
    }
  }
  void tell(hal::Duration at, std::uint8_t from, std::uint32_t entity) {
    send(at, from, hal::kEveryone, Rtps(from).sedp(from, entity, "scan"));
  }
  void send(hal::Duration at, std::uint16_t from, AgentId to, const Rtps& message,
            std::size_t mtu = 1500) {
    replay.send(udp(at, from, to, message.bytes(), ++id_, mtu));
  }
  void send_before_the_writer_is_known() {
    replay.build();
    for (const std::uint8_t one : {std::uint8_t{1}, std::uint8_t{2}, std::uint8_t{3}})
      send(1s + 20ms * one, one, hal::kEveryone, Rtps(one).spdp());
    tell(1200ms, 2, kRelayedReader);
    send(1300ms, 1, AgentId{3}, Rtps(1).sedp(1, kRelayedWriter, "scan"));
    send(2s, 1, AgentId{2}, Rtps(1).data(kRelayedWriter, 1, hal::Bytes(40, 1)));
  }
  void turn_off(AgentId station, hal::Duration at) {
    replay.events.schedule(hal::Time{at}, Rank::kScenario, kWorld,
                           [this, station] { replay.network->sap(station).set_radio(false); });
  }
  std::string sums(int receiver) {
    return replay.ask(
        "SELECT SUM(samples) || ' sent, ' || SUM(delivered) || ' delivered, ' || SUM(under_way) ||"
        " ' under way' FROM sample_sums WHERE receiver = " +
        std::to_string(receiver));
  }
  std::string losses() {
    return replay.ask(
        "SELECT IFNULL(GROUP_CONCAT(n || ' ' || verdict || ' at ' || agent, ', '), '') FROM (SELECT"
        " verdict, agent, SUM(count) AS n FROM sample_losses GROUP BY 1, 2 ORDER BY 1, 2)");
  }
  std::string relays(const std::string& where) {
    return replay.ask("SELECT IFNULL(SUM(count), 0) FROM relays WHERE " + where);
  }
  void expect_all_accounted_for() {
    EXPECT_EQ(replay.ask("SELECT SUM(samples) - SUM(delivered) - SUM(under_way) FROM sample_sums"),
              replay.ask("SELECT IFNULL(SUM(count), 0) FROM sample_losses"));
    expect_sums_of_the_radio(replay);
  }

  Replay replay;

 private:
  std::uint16_t id_ = 0;
};

// Two that send at less than a third of what the air takes, to one: the access point has no more
// than its third, and its queue overflows, not theirs. Frames collide, too, and are sent again.
TEST_F(RelayedSamplesTest, WhatFindsTheAccessPointsQueueFullIsLostToThat) {
  dcf().contention.queue_limit = 20;
  build();
  constexpr int kSamples = 1500;
  for (int i = 1; i <= kSamples; ++i) {
    for (const std::uint8_t from : {std::uint8_t{1}, std::uint8_t{3}}) {
      send(2s + i * 1100us, from, AgentId{2},
           Rtps(from).data(kRelayedWriter, static_cast<std::uint32_t>(i), hal::Bytes(400, 1)));
    }
  }
  replay.run(20s);
  EXPECT_EQ(replay.ask("SELECT COUNT(*) FROM requests WHERE verdict = 'queue full' AND agent <> 4"),
            "0");
  const std::string full = relays("agent = 4 AND destination = 2 AND verdict = 'queue full'");
  EXPECT_GT(std::stoi(full), 100);
  EXPECT_EQ(losses(), full + " queue full at 4");
  EXPECT_GT(std::stoi(replay.ask("SELECT COUNT(*) FROM frame_ends WHERE verdict = 'collision'")),
            10);
  EXPECT_EQ(relays("destination = 2"), std::to_string(2 * kSamples)) << "all that was sent to it";
  EXPECT_EQ(relays("destination = 2 AND verdict = 'delivered'"),
            replay.ask("SELECT SUM(delivered) FROM sample_sums"));
  // One of the twenty is being sent.
  EXPECT_EQ(replay.ask("SELECT most || ' ' || waiting FROM relay_queues WHERE destination = 2"),
            "20 0");
  EXPECT_EQ(replay.ask("SELECT frames FROM relay_queues WHERE destination = 2"),
            relays("destination = 2 AND verdict <> 'queue full'"));
  expect_all_accounted_for();
}

// Each attempt is lost with these probabilities, and so are acknowledgements of the first hop: what
// is given up at a hop is lost there, what came through at another attempt is not, heard or not.
TEST_F(RelayedSamplesTest, WhatIsGivenUpAtAHopIsLostThere) {
  radio::waves_of(replay.config.radio)->receiver.loss.links = {
      {"s1", "s4", 0.4}, {"s4", "s1", 0.3}, {"s4", "s2", 0.5}};
  dcf().contention.short_retry_limit = 4;
  build(4);
  constexpr int kSamples = 600;
  for (int i = 1; i <= kSamples; ++i) {
    send(4s + i * 10ms, 1, AgentId{2},
         Rtps(1).data(kRelayedWriter, static_cast<std::uint32_t>(i), hal::Bytes(400, 1)));
  }
  replay.run(30s);
  const std::string to_2 = "source = 1 AND destination = 2";
  const int relayed = std::stoi(relays(to_2));
  const std::string lost = relays(to_2 + " AND verdict = 'retry limit'");
  EXPECT_LT(relayed, kSamples);
  EXPECT_GT(std::stoi(lost), 0);
  EXPECT_EQ(losses(), std::to_string(kSamples - relayed) + " random loss at 1, " + lost +
                          " random loss at 4");
  EXPECT_GT(std::stoi(replay.ask("SELECT SUM(count) FROM requests WHERE agent = 1 AND peer = 2 AND"
                                 " verdict = 'retry limit'")),
            kSamples - relayed)
      << "some came and were not heard to have come";
  expect_all_accounted_for();
}

TEST_F(RelayedSamplesTest, WhoIsOffIsToldByTheAccessPointsFrames) {
  build();
  turn_off(AgentId{2}, 1900ms);
  for (std::uint32_t i = 1; i <= 5; ++i)
    send(2s + i * 100ms, 1, AgentId{2}, Rtps(1).data(kRelayedWriter, i, hal::Bytes(40, 1)));
  send(15s, 1, AgentId{3}, Rtps(1).data(kRelayedWriter, 6, hal::Bytes(40, 1)));
  replay.run(20s);
  EXPECT_EQ(sums(2), "5 sent, 0 delivered, 0 under way");
  EXPECT_EQ(losses(), "5 radio off at 4");
  EXPECT_EQ(relays("verdict = 'retry limit' AND source = 1"), "5");
  EXPECT_EQ(replay.ask("SELECT GROUP_CONCAT(DISTINCT f.transmitter || f.retry) FROM samples s JOIN"
                       " frames f ON f.frame = s.frame WHERE s.lost_at = 4"),
            "41");
  expect_all_accounted_for();
}

// A group frame reaches 3 and not 2; what the access point itself does not get, nobody does.
TEST_F(RelayedSamplesTest, OfAGroupEachHasItsOwnVerdict) {
  build();
  turn_off(AgentId{2}, 1900ms);
  send(2s, 1, hal::kEveryone, Rtps(1).data(kRelayedWriter, 1, hal::Bytes(40, 1)));
  turn_off(AgentId{4}, 2500ms);
  send(2501ms, 1, hal::kEveryone, Rtps(1).data(kRelayedWriter, 2, hal::Bytes(40, 1)));
  replay.run(20s);
  EXPECT_EQ(losses(), "2 radio off at 1, 1 radio off at 4");
  EXPECT_EQ(sums(3), "2 sent, 1 delivered, 0 under way");
  EXPECT_EQ(relays("source = 1 AND destination = 65535 AND verdict = 'transmitted'"), "3");
  expect_all_accounted_for();
}

// 2 drives away at 100 m/s and hears the access point no more: no radio says how its frames ended.
TEST_F(RelayedSamplesTest, WhoDoesNotNoticeAFrameIsTooFar) {
  replay.antennas.place(AgentId{2}, {{-100, 10, 0}, {100, 0, 0}});
  build();
  send(15s, 1, AgentId{2}, Rtps(1).data(kRelayedWriter, 1, hal::Bytes(40, 1)));
  send(16s, 1, hal::kEveryone, Rtps(1).data(kRelayedWriter, 2, hal::Bytes(40, 1)));
  send(40s, 1, AgentId{3}, Rtps(1).data(kRelayedWriter, 3, hal::Bytes(40, 1)));
  replay.run(41s);
  EXPECT_EQ(sums(2), "2 sent, 0 delivered, 0 under way");
  EXPECT_EQ(sums(3), "2 sent, 2 delivered, 0 under way");
  EXPECT_EQ(losses(), "2 below sensitivity at 4");
  expect_all_accounted_for();
}

// 2's word of its reader comes to 1, not 1's word of its writer to 2.
TEST_F(RelayedSamplesTest, WhatComesBeforeTheWriterIsKnownThereIsNotMatched) {
  send_before_the_writer_is_known();
  tell(15s, 3, kRelayedReader);  // more than ten seconds later: it is settled
  replay.run(20s);
  EXPECT_EQ(sums(2), "1 sent, 0 delivered, 0 under way");
  EXPECT_EQ(losses(), "1 not matched at 2");
  expect_all_accounted_for();
}

TEST_F(RelayedSamplesTest, WhatIsNotMatchedYetAtTheEndIsUnderWay) {
  send_before_the_writer_is_known();
  replay.run(5s);
  EXPECT_EQ(sums(2), "1 sent, 0 delivered, 1 under way");
  EXPECT_EQ(losses(), "");
  expect_all_accounted_for();
}

// IP cuts the datagram; the access point has no room for all of its fragments.
TEST_F(RelayedSamplesTest, ADatagramOfWhichAFragmentFindsTheQueueFullIsLostToThat) {
  dcf().contention.queue_limit = 40;
  build();
  for (std::uint32_t i = 1; i <= 30; ++i) {
    for (const std::uint8_t from : {std::uint8_t{1}, std::uint8_t{3}}) {
      send(2s + i * 30ms, from, AgentId{2},
           Rtps(from).data(kRelayedWriter, i, hal::Bytes(15'000, 1)), 576);
    }
  }
  send(20s, 1, AgentId{2}, Rtps(1).data(kRelayedWriter, 31, hal::Bytes(40, 1)));
  replay.run(21s);
  EXPECT_EQ(relays("destination = 2 AND verdict NOT IN ('delivered', 'queue full')"), "0");
  const int lost = std::stoi(replay.ask("SELECT SUM(samples) - SUM(delivered) FROM sample_sums"));
  EXPECT_GT(lost, 10);
  EXPECT_EQ(losses(), std::to_string(lost) + " queue full at 4");
}

}  // namespace
}  // namespace sim::air::test
