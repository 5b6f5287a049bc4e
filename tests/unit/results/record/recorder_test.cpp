#include "results/record/recorder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <memory>

#include "hal/node/routing/packet.h"
#include "results/record/body_log.h"
#include "sim/radio/mac/frame.h"
#include "tests/unit/results/record/test_run.h"

namespace results::record::test {
namespace {

using namespace std::chrono_literals;
using hal::AgentId;
using hal::Time;
using hal::Verdict;

hal::Message one_message(hal::MessageId id, AgentId to = AgentId{2}) {
  return {.source = AgentId{1}, .destination = to, .id = id, .topic = "help", .payload = {1, 2}};
}

sim::radio::Frame data_frame(AgentId from, AgentId to) {
  sim::radio::Frame frame;
  frame.id = 1;
  frame.transmitter = from;
  frame.receiver = to;
  return frame;
}

class RecorderTest : public testing::Test {
 protected:
  RecorderTest()
      : folder(testing::UnitTest::GetInstance()->current_test_info()->name()),
        recorder(std::make_unique<Recorder>(folder.file(), small_config())) {}

  std::string asked(const std::string& sql) {
    recorder->commit();
    return ask(folder.file(), sql);
  }

  Folder folder;
  std::unique_ptr<Recorder> recorder;
};

TEST_F(RecorderTest, DescribesTheRun) {
  recorder->set("scenario", "tiny");
  EXPECT_EQ(asked("SELECT value FROM run WHERE key = 'seed'"), "7");
  EXPECT_EQ(asked("SELECT value FROM run WHERE key = 'scenario'"), "tiny");
  EXPECT_EQ(asked("SELECT value FROM run WHERE key = 'profile'"), "mobility_framework");
  EXPECT_EQ(asked("SELECT value FROM run WHERE key = 'result'"), "running");
  EXPECT_EQ(asked("SELECT group_concat(name || kind, ',') FROM agents"), "m0mote,m1mote,r0robot");
  EXPECT_EQ(asked("SELECT agent || state || after_ns FROM ends WHERE result = 'arrived'"),
            "2DONE1000000000");
  EXPECT_EQ(asked("SELECT agent FROM ends WHERE result = 'timeout'"), "null");
}

TEST_F(RecorderTest, NamesBodiesThatAreLost) {
  recorder->on_body_lost({AgentId{3}, sim::physics::BodyLoss::kTipped, Time{1230ms}});
  EXPECT_EQ(asked("SELECT agent || ' ' || what || ' ' || at_ns FROM lost_bodies"),
            "3 tipped over 1230000000");
}

TEST_F(RecorderTest, SaysHowTheRunEnded) {
  std::uint64_t hash = 0;
  sim::Fingerprint fingerprint([&](const sim::Fingerprint::Row& row) {
    hash = *row.hash;
    recorder->add(row);
  });
  fingerprint.at(sim::Part::kAir, AgentId{1}, Time{1s}).add(std::uint64_t{5});
  fingerprint.finish();
  recorder->find<BodyLog>()->add_contacts(AgentId{3}, {.wall_steps = 4, .object_steps = 5});
  recorder->on_body(Time{}, AgentId{3}, {});
  recorder->finish({.kind = sim::agents::Outcome::Kind::kEnded,
                    .result = "arrived",
                    .error = "",
                    .ended_at = Time{2500ms},
                    .events = 10,
                    .exchanges = 4},
                   fingerprint);
  recorder->set("wall_s", 0.5);  // known only now, and readable without another commit
  const auto value = [this](const std::string& key) {
    return ask(folder.file(), "SELECT value FROM run WHERE key = '" + key + "'");
  };
  EXPECT_EQ(value("result"), "arrived");
  EXPECT_EQ(value("simulated_s"), "2.5");
  EXPECT_EQ(value("wall_s"), "0.5");
  EXPECT_EQ(value("exchanges"), "4");
  EXPECT_EQ(value("error"), "none");
  EXPECT_EQ(value("fingerprint"), sim::to_hex(fingerprint.total()));
  EXPECT_EQ(value("fingerprint_air"), sim::to_hex(fingerprint.part(sim::Part::kAir)));
  EXPECT_EQ(value("frames_digest"), sim::to_hex(sim::agents::FrameDigest{}.value()));
  EXPECT_EQ(asked("SELECT second || part || agent || hash FROM fingerprints"),
            "1air1" + std::to_string(static_cast<std::int64_t>(hash)));
  EXPECT_EQ(asked("SELECT wall_steps || '/' || object_steps FROM bodies"), "4/5");
}

TEST_F(RecorderTest, WritesADigestOfAllFrames) {
  const sim::radio::Frame frame = data_frame(AgentId{1}, AgentId{2});
  sim::agents::FrameDigest digest;
  digest.on_frame_start(Time{1s}, frame);
  recorder->on_frame_start(Time{1s}, frame);
  EXPECT_EQ(recorder->frames_digest(), digest.value());
  recorder->finish({}, sim::Fingerprint{});
  EXPECT_EQ(asked("SELECT value FROM run WHERE key = 'frames_digest'"),
            sim::to_hex(digest.value()));
}

TEST_F(RecorderTest, WritesNoKeyThatIsNotDescribed) {
  sim::agents::Outcome outcome{
      .kind = sim::agents::Outcome::Kind::kFailed, .result = "failed", .error = "e"};
  outcome.real_time.emplace();
  recorder->finish(outcome, sim::Fingerprint{});
  recorder.reset();
  Database database(folder.file(), Database::Mode::kRead);
  Statement query(database, "SELECT key FROM run");
  int keys = 0;
  for (; query.next(); ++keys) {
    const auto is_it = [&](const RunKey& key) { return key.name == query.text(0); };
    EXPECT_TRUE(std::ranges::any_of(run_keys(), is_it)) << query.text(0);
  }
  EXPECT_GT(keys, 20);
}

TEST_F(RecorderTest, TotalsOfManyPairsWaitUntilTheyAreFewBesideWhatTheyCount) {
  const std::string rows = "SELECT count(*) FROM receptions";
  const auto hear_all = [this] {
    for (std::uint16_t other = 10; other < 5010; ++other) {
      const sim::radio::Frame frame = data_frame(AgentId{other}, AgentId{1});
      recorder->on_reception(Time{1s}, frame, AgentId{1}, Verdict::kCollision, -80);
    }
  };
  hear_all();
  EXPECT_EQ(asked(rows), "0");
  for (int i = 0; i < 63; ++i) hear_all();
  EXPECT_EQ(asked(rows), "5000");
  EXPECT_EQ(asked("SELECT DISTINCT count FROM receptions"), "64");
}

TEST_F(RecorderTest, TotalsAreWrittenAtLeastOncePerPeriod) {
  for (std::uint16_t other = 10; other < 5010; ++other) {
    recorder->on_reception(Time{1s}, data_frame(AgentId{other}, AgentId{1}), AgentId{1},
                           Verdict::kCollision, -80);
  }
  recorder->on_body(Time{Commits::kCommitPeriod}, AgentId{1}, {});
  EXPECT_EQ(ask(folder.file(), "SELECT count(*) FROM receptions"), "5000");
}

TEST_F(RecorderTest, KeepsTheSettings) {
  recorder->add_settings({{"radio.profile", "disk"}, {"seed", "7"}});
  EXPECT_EQ(asked("SELECT group_concat(key || '=' || value, ' ') FROM settings"),
            "radio.profile=disk seed=7");
}

TEST_F(RecorderTest, ARunThatCouldNotBeWrittenSaysSoAndKeepsWhatWasCommitted) {
  recorder->on_state(Time{1s}, AgentId{1}, "EARLY");
  recorder->commit();
  recorder->on_state(Time{2s}, AgentId{1}, "LATE");
  recorder->give_up({.kind = sim::agents::Outcome::Kind::kFailed,
                     .result = "failed",
                     .error = "the disk is full",
                     .ended_at = Time{2s}});
  EXPECT_EQ(asked("SELECT group_concat(value) FROM run WHERE key IN ('result', 'error')"),
            "the disk is full,failed");
  EXPECT_EQ(asked("SELECT group_concat(state) FROM states"), "EARLY");
  recorder.reset();
  EXPECT_EQ(ask(folder.file(), "PRAGMA journal_mode"), "delete");
}

TEST_F(RecorderTest, LeavesOnePlainFileBehind) {
  recorder.reset();
  int files = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder.path())) {
    ++files;
  }
  EXPECT_EQ(files, 1);
  EXPECT_EQ(ask(folder.file(), "PRAGMA journal_mode"), "delete");
}

TEST_F(RecorderTest, WhatWasCommittedIsThereIfTheRunIsCutShort) {
  recorder->on_state(Time{1s}, AgentId{1}, "EARLY");
  recorder->on_state(Time{10s}, AgentId{1}, "AT_COMMIT");  // kCommitPeriod has passed
  recorder->on_state(Time{11s}, AgentId{1}, "LATE");
  EXPECT_EQ(ask(folder.file(), "SELECT group_concat(state) FROM states"), "EARLY,AT_COMMIT");
}

TEST_F(RecorderTest, CommitsAfterManyRows) {
  for (int i = 0; i < Commits::kCommitRows - 1; ++i) recorder->on_state(Time{}, AgentId{1}, "X");
  EXPECT_EQ(ask(folder.file(), "SELECT COUNT(*) FROM states"), "0");
  recorder->on_state(Time{}, AgentId{1}, "X");
  EXPECT_EQ(ask(folder.file(), "SELECT COUNT(*) FROM states"),
            std::to_string(Commits::kCommitRows));
}

TEST_F(RecorderTest, FollowsAMessageToItsDelivery) {
  recorder->on_message_sent(Time{1ms}, one_message(1));
  recorder->on_fate(Time{2ms}, AgentId{1}, 1, hal::Fate::kHandedOver);
  recorder->on_message_end(Time{4ms}, AgentId{2}, AgentId{1}, 1, Verdict::kDelivered);
  recorder->on_message_delivered(Time{4ms}, AgentId{2}, one_message(1), 2);
  EXPECT_EQ(asked("SELECT destination || topic || bytes || '/' || sent_ns FROM messages"),
            "2help2/1000000");
  EXPECT_EQ(asked("SELECT fate || fate_ns FROM messages"), "handed over2000000");
  EXPECT_EQ(asked("SELECT verdict FROM messages"), "delivered");
  EXPECT_EQ(asked("SELECT at_ns || '/' || delay_ns || '/' || transmissions FROM deliveries"),
            "4000000/3000000/2");
}

TEST_F(RecorderTest, DeliveryWinsOverTheEndOfAnotherCopy) {
  recorder->on_message_sent(Time{}, one_message(1));
  recorder->on_message_delivered(Time{1ms}, AgentId{2}, one_message(1), 1);
  recorder->on_message_end(Time{2ms}, AgentId{3}, AgentId{1}, 1, Verdict::kRetryLimit);
  EXPECT_EQ(asked("SELECT verdict FROM messages"), "delivered");
}

TEST_F(RecorderTest, AMessageUnderWayHasNoVerdict) {
  recorder->on_message_sent(Time{}, one_message(1));
  recorder->on_message_sent(Time{}, one_message(2));
  recorder->on_message_end(Time{1s}, AgentId{1}, AgentId{1}, 2, Verdict::kNoRoute);
  EXPECT_EQ(asked("SELECT verdict FROM messages WHERE id = 1"), "null");
  EXPECT_EQ(asked("SELECT fate FROM messages WHERE id = 1"), "null");
  EXPECT_EQ(asked("SELECT verdict FROM messages WHERE id = 2"), "no route");
}

TEST_F(RecorderTest, CountsFramesByPeerClassAndVerdict) {
  const sim::radio::Frame broadcast = data_frame(AgentId{1}, hal::kEveryone);
  sim::radio::Frame rts = data_frame(AgentId{1}, AgentId{2});
  rts.type = sim::radio::FrameType::kRts;
  for (int i = 0; i < 3; ++i) recorder->on_frame_start(Time{}, broadcast);
  recorder->on_frame_start(Time{}, rts);
  recorder->on_faint(rts, 4);
  recorder->on_faint(broadcast, 3);
  recorder->on_reception(Time{}, broadcast, AgentId{2}, Verdict::kDelivered, -60);
  recorder->on_reception(Time{}, rts, AgentId{3}, Verdict::kCollision, -60);
  recorder->on_delivered(Time{}, broadcast, AgentId{2});
  recorder->on_request_end(Time{}, AgentId{1}, AgentId{2}, Verdict::kRetryLimit);
  EXPECT_EQ(asked("SELECT count FROM frames_sent WHERE class = 'broadcast' AND peer = 65535"), "3");
  EXPECT_EQ(asked("SELECT count FROM frames_sent WHERE class = 'rts'"), "1");
  EXPECT_EQ(asked("SELECT agent || peer || addressed || verdict FROM receptions"
                  " WHERE class = 'broadcast'"),
            "211delivered");
  EXPECT_EQ(asked("SELECT agent || peer || addressed || verdict FROM receptions"
                  " WHERE class = 'rts'"),
            "310collision");
  EXPECT_EQ(asked("SELECT agent || peer || class || count FROM packets"), "21broadcast1");
  EXPECT_EQ(asked("SELECT agent || peer || verdict || count FROM requests"), "12retry limit1");
  recorder->on_frame_start(Time{}, broadcast);  // counts go on after they were written
  EXPECT_EQ(asked("SELECT count FROM frames_sent WHERE class = 'broadcast'"), "4");
  EXPECT_EQ(asked("SELECT agent || ' ' || count FROM faint"), "1 7");
  EXPECT_EQ(asked("SELECT COUNT(*) FROM frames"), "0");
}

TEST_F(RecorderTest, WritesEachFrameOnlyOnRequest) {
  recorder = nullptr;
  recorder = std::make_unique<Recorder>(folder.file(), small_config(),
                                        RecorderOptions{.frames = sim::scenario::Detail::kAll});
  const sim::radio::Frame frame = data_frame(AgentId{1}, AgentId{2});
  recorder->on_frame_start(Time{5ns}, frame);
  recorder->on_reception(Time{6ns}, frame, AgentId{2}, Verdict::kNoise, -90.5);
  EXPECT_EQ(asked("SELECT at_ns || class FROM frames"), "5unicast");
  EXPECT_EQ(asked("SELECT at_ns || verdict || rssi_dbm FROM frame_ends"), "6noise-90.5");
}

// 3 m, then 4 m at a right angle; half a second apart.
TEST_F(RecorderTest, AddsUpThePathAtEveryControlInstantAndWritesPosesOncePerSecond) {
  const AgentId robot{3};
  recorder->on_body(Time{}, robot, {.x = 0, .y = 0, .clearance = 5});
  recorder->on_body(Time{500ms}, robot, {.x = 3, .y = 0, .tilt = 0.1, .clearance = 0.5});
  recorder->on_body(Time{1s}, robot, {.x = 3, .y = 4, .clearance = 2});
  recorder->on_body(Time{2s}, robot, {.x = 3, .y = 4, .clearance = 2});
  EXPECT_EQ(asked("SELECT path_m || '/' || clearance_m || '/' || tilt_rad FROM bodies"),
            "7.0/0.5/0.1");
  EXPECT_EQ(asked("SELECT x_m || '/' || y_m FROM bodies"), "3.0/4.0");
  EXPECT_EQ(asked("SELECT group_concat(at_ns) FROM poses"), "0,1000000000");  // no news at 2 s
  EXPECT_EQ(asked("SELECT wall_steps FROM bodies"), "null");
}

TEST_F(RecorderTest, WhereABodyIsPutItDidNotGo) {
  const AgentId robot{3};
  recorder->on_displaced(Time{}, robot);  // as it comes
  recorder->on_body(Time{}, robot, {.x = 0, .y = 0});
  recorder->on_body(Time{1s}, robot, {.x = 3, .y = 4});
  recorder->on_displaced(Time{1500ms}, robot);
  recorder->on_body(Time{2s}, robot, {.x = 300, .y = 4});
  recorder->on_body(Time{3s}, robot, {.x = 300, .y = 5});
  recorder->on_displaced(Time{3500ms}, robot);
  recorder->on_body(Time{4s}, robot, {.x = 300, .y = 5});  // to where it was
  recorder->on_body(Time{5s}, robot, {.x = 300, .y = 7});
  EXPECT_EQ(asked("SELECT path_m FROM bodies"), "8.0");
}

TEST_F(RecorderTest, AWorldWithoutWallsHasNoClearance) {
  recorder->on_body(Time{}, AgentId{3}, {.clearance = std::numeric_limits<double>::infinity()});
  EXPECT_EQ(asked("SELECT clearance_m FROM bodies"), "null");
}

TEST_F(RecorderTest, KeepsWallsAsSeenFromAbove) {
  EXPECT_EQ(
      asked("SELECT name || '/' || x_m || '/' || y_m || '/' || yaw_rad || '/' || size_x_m || '/' ||"
            " size_y_m FROM walls"),
      "fence/5.0/6.0/0.5/2.0/0.25");
}

TEST_F(RecorderTest, KeepsLinksDiscoveriesAndStates) {
  recorder->on_start({{AgentId{1}, AgentId{2}}});
  recorder->on_discovery(Time{2s}, AgentId{1}, {"help", AgentId{2}, 962181ns, true});
  recorder->on_state(Time{3s}, AgentId{2}, "WAIT");
  EXPECT_EQ(asked("SELECT a || '-' || b FROM links"), "1-2");
  EXPECT_EQ(asked("SELECT agent || topic || destination || '/' || ended_ns || '/' || took_ns"
                  " || '/' || found FROM discoveries"),
            "1help2/2000000000/962181/1");
  EXPECT_EQ(asked("SELECT agent || state || at_ns FROM states"), "2WAIT3000000000");
}

TEST_F(RecorderTest, CountsWhatRoutingDoes) {
  using hal::node::routing::ProtocolEvent;
  const std::string sum =
      "SELECT group_concat(agent || event || count, ',') FROM (SELECT * FROM routing_events"
      " ORDER BY agent, event)";
  EXPECT_EQ(asked(sum), "null");
  recorder->on_protocol_event(AgentId{2}, ProtocolEvent::kRreqSent);
  recorder->on_protocol_event(AgentId{2}, ProtocolEvent::kRreqSent);
  recorder->on_protocol_event(AgentId{1}, ProtocolEvent::kHelloSent);
  EXPECT_EQ(asked(sum), "1hello sent1,2rreq sent2");
  recorder->on_protocol_event(AgentId{2}, ProtocolEvent::kRreqSent);
  EXPECT_EQ(asked(sum), "1hello sent1,2rreq sent3");
}

TEST_F(RecorderTest, KeepsWhatControllersRecord) {
  recorder->on_record(Time{1s}, AgentId{2}, "distance", 0.1);
  recorder->on_record(Time{1s}, AgentId{1}, "tries", -3);
  EXPECT_EQ(asked("SELECT group_concat(agent || name || at_ns || '/' || (value = 0.1) || '/' ||"
                  " (value = -3), ' ') FROM recorded"),
            "2distance1000000000/1/0 1tries1000000000/0/1");
}

}  // namespace
}  // namespace results::record::test
