#include <gtest/gtest.h>

#include <memory>

#include "hal/node/routing/packet.h"
#include "results/record/recorder.h"
#include "sim/radio/mac/frame.h"
#include "tests/unit/results/record/test_run.h"

namespace results::record::test {
namespace {

using namespace std::chrono_literals;
using hal::AgentId;
using hal::Time;
using hal::Verdict;

hal::Message message(hal::MessageId id, AgentId to = AgentId{2}) {
  return {.source = AgentId{1}, .destination = to, .id = id, .topic = "help", .payload = {1, 2}};
}

/// The frame with which agent 1 broadcasts its message `id`.
sim::radio::Frame broadcast_frame(hal::MessageId id) {
  sim::radio::Frame frame;
  frame.transmitter = AgentId{1};
  frame.receiver = hal::kEveryone;
  frame.id = id;
  frame.airtime = 250us;
  frame.ethertype = sim::radio::kEthertypeRouting;
  frame.payload = std::make_shared<const hal::Bytes>(hal::node::routing::encode(
      hal::node::routing::Data{.header = {"help", AgentId{1}, hal::kEveryone, id},
                               .id = id,
                               .transmissions = 1,
                               .payload = {1, 2}}));
  return frame;
}

class BroadcastRecord : public testing::Test {
 protected:
  BroadcastRecord()
      : folder(testing::UnitTest::GetInstance()->current_test_info()->name()),
        recorder(std::make_unique<Recorder>(folder.file(), small_config())) {}

  std::string asked(const std::string& sql) {
    recorder->commit();
    return ask(folder.file(), sql);
  }

  /// Agent 1 broadcasts, and radios 2 and 3 do this with its frame.
  void broadcast(hal::MessageId id, std::vector<Verdict> verdicts) {
    const Time at{std::chrono::seconds{id}};
    const sim::radio::Frame frame = broadcast_frame(id);
    recorder->on_message_sent(at, message(id, hal::kEveryone));
    recorder->on_frame_start(at, frame);
    AgentId receiver{2};
    for (const Verdict verdict : verdicts) {
      recorder->on_reception(at + frame.airtime, frame, receiver, verdict, -60);
      if (verdict == Verdict::kDelivered) {
        recorder->on_message_delivered(at + frame.airtime, receiver, message(id, hal::kEveryone),
                                       1);
      }
      ++receiver.value;
    }
    recorder->on_request_end(at + frame.airtime, AgentId{1}, hal::kEveryone, Verdict::kDelivered);
    recorder->on_fate(at + frame.airtime, AgentId{1}, id, hal::Fate::kHandedOver);
  }

  std::string broadcast_row(int id) {
    return asked(
        "SELECT reached || ' of ' || addressees || ' ' || ifnull(verdict, 'null')"
        " FROM broadcasts WHERE id = " +
        std::to_string(id));
  }

  void finish(Time ended_at) {
    recorder->finish({.kind = sim::agents::Outcome::Kind::kUntil,
                      .result = "until",
                      .error = "",
                      .ended_at = ended_at},
                     sim::Fingerprint{});
  }

  Folder folder;
  std::unique_ptr<Recorder> recorder;
};

TEST_F(BroadcastRecord, SaysHowManyItReachedAndWhyItReachedNobody) {
  broadcast(1, {Verdict::kReceiverTransmitting, Verdict::kReceiverTransmitting});
  broadcast(2, {Verdict::kDelivered, Verdict::kCollision});
  broadcast(3, {Verdict::kReceiverTransmitting, Verdict::kCollision});
  broadcast(4, {});
  finish(Time{10s});
  EXPECT_EQ(broadcast_row(1), "0 of 2 receiver transmitting");
  EXPECT_EQ(broadcast_row(2), "1 of 2 delivered");
  EXPECT_EQ(broadcast_row(3), "0 of 2 collision") << "one each: the first in the list of verdicts";
  EXPECT_EQ(broadcast_row(4), "0 of 2 below sensitivity");
  EXPECT_EQ(asked("SELECT verdict || count FROM requests"), "transmitted4");
  EXPECT_EQ(asked("SELECT fate FROM messages WHERE id = 1"), "handed over");
}

TEST_F(BroadcastRecord, HasNoVerdictWhileItsFrameIsInTheAir) {
  broadcast(1, {});
  finish(Time{1s + 100us});
  EXPECT_EQ(broadcast_row(1), "0 of 2 null");
}

TEST_F(BroadcastRecord, RelaysAndSearchesOfOthersAreNotItsOwn) {
  broadcast(1, {Verdict::kDelivered});
  sim::radio::Frame relay = broadcast_frame(1);
  relay.transmitter = AgentId{2};
  recorder->on_frame_start(Time{2s}, relay);
  recorder->on_reception(Time{2s}, relay, AgentId{3}, Verdict::kCollision, -60);
  finish(Time{10s});
  EXPECT_EQ(broadcast_row(1), "1 of 2 delivered");
}

std::vector<std::string> lines(std::vector<UnheardTopic> topics) {
  std::vector<std::string> lines;
  for (const UnheardTopic& topic : topics) lines.push_back(to_line(topic));
  return lines;
}

TEST_F(BroadcastRecord, ATopicOfWhichNothingArrivedIsNamedWithSendersCountAndVerdict) {
  for (hal::MessageId id = 1; id <= 3; ++id) broadcast(id, {Verdict::kReceiverTransmitting});
  hal::Message other = message(4, hal::kEveryone);
  other.source = AgentId{3};
  recorder->on_message_sent(Time{5s}, other);
  recorder->on_message_end(Time{5s}, AgentId{3}, AgentId{3}, 4, Verdict::kRadioOff);
  hal::Message last = message(5);
  recorder->on_message_sent(Time{6s}, last);  // on its way
  finish(Time{10s});
  EXPECT_EQ(
      lines(recorder->unheard_topics()),
      std::vector<std::string>{"topic 'help': none of 4 messages of m0, r0 arrived at anyone; "
                               "receiver transmitting (3)"});
}

TEST_F(BroadcastRecord, ATopicThatArrivedOnceOrIsOnItsWayIsNot) {
  broadcast(1, {Verdict::kCollision});
  broadcast(2, {Verdict::kDelivered});
  hal::Message under_way = message(3);
  under_way.topic = "other";
  recorder->on_message_sent(Time{3s}, under_way);
  finish(Time{10s});
  EXPECT_EQ(lines(recorder->unheard_topics()), std::vector<std::string>{});
}

TEST(UnheardTopics, NameEightSendersAtMost) {
  UnheardTopic topic{.topic = "x", .messages = 9, .verdict = "no route", .with_verdict = 9};
  for (int i = 0; i < 9; ++i) topic.senders.push_back("m" + std::to_string(i));
  EXPECT_EQ(to_line(topic),
            "topic 'x': none of 9 messages of m0, m1, m2, m3, m4, m5, m6, m7 and 1 more arrived at "
            "anyone; no route (9)");
}

}  // namespace
}  // namespace results::record::test
