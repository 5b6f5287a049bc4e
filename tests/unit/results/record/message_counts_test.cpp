#include "results/record/message_counts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "hal/types/random.h"
#include "results/record/recorder.h"
#include "tests/unit/results/record/test_run.h"

/// The views message_ends, message_fates, message_deliveries and broadcast_sums say the same
/// whether messages are listed, counted, or the first of each second listed and the others counted.
namespace results::record::test {
namespace {

using namespace std::chrono_literals;
using hal::AgentId;
using hal::Fate;
using hal::MessageId;
using hal::Time;
using hal::Verdict;

std::string all_of(const std::filesystem::path& file, const std::string& view,
                   const std::string& columns) {
  return ask(file, "SELECT group_concat(line, '\n') FROM (SELECT " + columns + " AS line FROM " +
                       view + " ORDER BY 1)");
}

hal::Message message(AgentId from, MessageId id, AgentId to, const std::string& topic,
                     std::size_t bytes) {
  return {
      .source = from, .destination = to, .id = id, .topic = topic, .payload = hal::Bytes(bytes)};
}

class MessageCountsTest : public testing::Test {
 protected:
  MessageCountsTest()
      : folder(testing::UnitTest::GetInstance()->current_test_info()->name()),
        list(std::make_unique<Recorder>(folder.path() / "list.sqlite", small_config(),
                                        RecorderOptions{.messages = sim::scenario::Detail::kAll})),
        counts(std::make_unique<Recorder>(
            folder.path() / "counts.sqlite", small_config(),
            RecorderOptions{.messages = sim::scenario::Detail::kCounts})),
        sample(std::make_unique<Recorder>(
            folder.path() / "sample.sqlite", small_config(),
            RecorderOptions{.messages = sim::scenario::Detail::kSample})) {}

  template <class Tell>
  void both(Tell tell) {
    tell(*list);
    tell(*counts);
    tell(*sample);
  }

  void expect_equal(const std::string& view, const std::string& columns) {
    const std::string listed = all_of(folder.path() / "list.sqlite", view, columns);
    EXPECT_EQ(all_of(folder.path() / "counts.sqlite", view, columns), listed);
    EXPECT_EQ(all_of(folder.path() / "sample.sqlite", view, columns), listed);
    EXPECT_NE(listed, "null") << "nothing was compared";
  }

  void expect_equal_views() {
    both([](Recorder& recorder) { recorder.commit(); });
    expect_equal("message_ends",
                 "sender || ' ' || destination || topic || verdict || count || ' ' || bytes");
    expect_equal("message_fates", "sender || ' ' || destination || topic || fate || count");
    expect_equal("message_deliveries",
                 "sender || ' ' || destination || topic || receiver || ' ' || transmissions || ' ' "
                 "|| count || ' ' || bytes || ' ' || late || ' ' || delay_sum_ns || ' ' || "
                 "delay_least_ns || ' ' || delay_greatest_ns");
    expect_equal("broadcast_sums",
                 "sender || topic || messages || ' ' || addressees || ' ' || reached");
  }

  Folder folder;
  std::unique_ptr<Recorder> list, counts, sample;
};

TEST_F(MessageCountsTest, CountsAreThoseOfTheList) {
  hal::RandomStream random(1, "messages");
  std::vector<hal::Message> sent;
  std::vector<MessageId> last(4);
  std::set<std::tuple<int, MessageId, int>> got;
  Time now{};
  for (int step = 0; step < 12000; ++step) {
    now += std::chrono::microseconds{random.below(300)};  // more than a sample has room for
    const std::uint32_t what = sent.empty() ? 0 : random.below(6);
    if (what == 0) {
      const auto from = static_cast<std::uint16_t>(1 + random.below(3));
      const AgentId to[] = {AgentId{1}, AgentId{2}, hal::kEveryone, hal::kNeighbours};
      sent.push_back(message(AgentId{from}, ++last[from], to[random.below(4)],
                             random.below(2) == 0 ? "help" : "chat", random.below(50)));
      both([&](Recorder& recorder) { recorder.on_message_sent(now, sent.back()); });
      continue;
    }
    const auto latest = static_cast<std::uint32_t>(std::min<std::size_t>(20, sent.size()));
    const hal::Message& which = sent[sent.size() - 1 - random.below(latest)];
    const auto verdict = static_cast<Verdict>(random.below(hal::kVerdictCount));
    const AgentId receiver{static_cast<std::uint16_t>(1 + random.below(3))};
    if (what == 1) {
      both([&](Recorder& recorder) {
        recorder.on_message_end(now, receiver, which.source, which.id, verdict);
      });
    } else if (what == 2) {
      const Fate fate = static_cast<Fate>(which.id % 4);  // told again, it is the same
      both([&](Recorder& recorder) { recorder.on_fate(now, which.source, which.id, fate); });
    } else if (got.insert({which.source.value, which.id, receiver.value}).second) {
      both([&](Recorder& recorder) {
        recorder.on_message_delivered(now, receiver, which, static_cast<int>(1 + which.id % 3));
      });
    }
    if (step % 2000 == 1999) expect_equal_views();
  }
  const auto file = folder.path() / "sample.sqlite";
  EXPECT_EQ(ask(file, "SELECT COUNT(*) > 100 FROM messages WHERE destination >= 65534"), "1");
  EXPECT_EQ(ask(file, "SELECT SUM(count) > 100 FROM counted_ends"), "1");
}

TEST_F(MessageCountsTest, WhatHasNoEndYetIsUnderWayHoweverOldItIs) {
  both([](Recorder& recorder) {
    recorder.on_message_sent(Time{}, message(AgentId{1}, 1, AgentId{2}, "old", 3));
    for (MessageId id = 2; id <= 40; ++id) {
      const Time at{std::chrono::seconds{id}};
      recorder.on_message_sent(at, message(AgentId{1}, id, AgentId{2}, "new", 3));
      recorder.on_message_end(at, AgentId{1}, AgentId{1}, id, Verdict::kNoRoute);
      recorder.on_fate(at, AgentId{1}, id, Fate::kNoRoute);
    }
  });
  both([](Recorder& recorder) { recorder.commit(); });
  expect_equal("message_ends", "topic || verdict || count");
  both([](Recorder& recorder) {
    recorder.on_message_delivered(Time{50s}, AgentId{2},
                                  message(AgentId{1}, 1, AgentId{2}, "old", 3), 2);
    recorder.on_fate(Time{50s}, AgentId{1}, 1, Fate::kHandedOver);
    recorder.commit();
  });
  expect_equal("message_ends", "topic || verdict || count");
  expect_equal("message_fates", "topic || fate || count");
  expect_equal("message_deliveries", "topic || count || delay_greatest_ns");
}

TEST_F(MessageCountsTest, ADeliveryLongAfterItsMessageWasSettledHasNoDelay) {
  const auto send = [this](MessageId id, Time at) {
    counts->on_message_sent(at, message(AgentId{1}, id, hal::kEveryone, "t", 3));
    counts->on_fate(at, AgentId{1}, id, Fate::kHandedOver);
    counts->on_message_delivered(at + 1ms, AgentId{2},
                                 message(AgentId{1}, id, hal::kEveryone, "t", 3), 1);
  };
  send(1, Time{});
  // The old ones are looked at with every 32nd.
  for (hal::MessageId id = 2; id <= 32; ++id) send(id, Time{MessageCounts::kKept + 1ns});
  counts->on_message_delivered(Time{20s}, AgentId{3},
                               message(AgentId{1}, 1, hal::kEveryone, "t", 3), 1);
  counts->commit();
  EXPECT_EQ(ask(folder.path() / "counts.sqlite",
                "SELECT group_concat(receiver || ':' || count || '/' || late || '/' ||"
                " ifnull(delay_greatest_ns, 'null'), ' ') FROM message_deliveries"),
            "2:32/0/1000000 3:1/1/null");
}

TEST_F(MessageCountsTest, NothingOfMessagesIsWrittenWhereNothingIsAskedFor) {
  Recorder recorder(
      folder.file(), small_config(),
      {.frames = sim::scenario::Detail::kNone, .messages = sim::scenario::Detail::kNone});
  recorder.on_message_sent(Time{}, message(AgentId{1}, 1, AgentId{2}, "t", 3));
  recorder.on_message_delivered(Time{}, AgentId{2}, message(AgentId{1}, 1, AgentId{2}, "t", 3), 1);
  sim::radio::Frame frame;
  frame.transmitter = AgentId{1};
  frame.receiver = AgentId{2};
  recorder.on_frame_start(Time{}, frame);
  recorder.on_faint(frame, 3);
  recorder.on_reception(Time{}, frame, AgentId{2}, Verdict::kDelivered, -60);
  recorder.on_delivered(Time{}, frame, AgentId{2});
  recorder.on_request_end(Time{}, AgentId{1}, AgentId{2}, Verdict::kDelivered);
  recorder.finish({.kind = sim::agents::Outcome::Kind::kUntil, .result = "until", .error = ""},
                  sim::Fingerprint{});
  for (const char* table : {"message_ends", "message_deliveries", "frames_sent", "receptions",
                            "faint", "packets", "requests", "frames"}) {
    EXPECT_EQ(ask(folder.file(), std::string("SELECT count(*) FROM ") + table), "0") << table;
  }
}

}  // namespace
}  // namespace results::record::test
