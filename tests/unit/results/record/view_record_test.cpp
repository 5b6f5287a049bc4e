// What a view needs of a run: frames one by one, routes, readings, queues, contacts.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>

#include "hal/node/routing/packet.h"
#include "hal/types/path_metric.h"
#include "results/record/body_log.h"
#include "results/record/frame_log.h"
#include "results/record/look_log.h"
#include "results/record/recorder.h"
#include "sim/air/ethertypes.h"
#include "tests/unit/results/record/test_run.h"

namespace results::record::test {
namespace {

using namespace std::chrono_literals;
using hal::AgentId;
using hal::Time;
using hal::Verdict;

class ViewRecordTest : public testing::Test {
 protected:
  ViewRecordTest() : folder(testing::UnitTest::GetInstance()->current_test_info()->name()) {}

  Recorder& record(RecorderOptions options) {
    recorder = nullptr;
    recorder = std::make_unique<Recorder>(folder.file(), small_config(), options);
    return *recorder;
  }

  std::string asked(const std::string& sql) {
    if (recorder) recorder->commit();
    return ask(folder.file(), sql);
  }

  static sim::radio::Frame frame(std::uint64_t id) {
    sim::radio::Frame frame;
    frame.id = id;
    frame.transmitter = AgentId{1};
    frame.receiver = AgentId{2};
    frame.rate = hal::BitsPerSecond{2e6};
    frame.duration = 314us;
    return frame;
  }

  Folder folder;
  std::unique_ptr<Recorder> recorder;
};

TEST_F(ViewRecordTest, AFrameNamesTheMessageThatItCarriesAndItsSinr) {
  Recorder& one = record({.frames = sim::scenario::Detail::kAll});
  sim::radio::Frame data = frame(1);
  data.ethertype = sim::radio::kEthertypeRouting;
  data.payload =
      std::make_shared<const hal::Bytes>(hal::node::routing::encode(hal::node::routing::Data{
          .header = {.topic = "help", .source = AgentId{3}, .destination = AgentId{2}},
          .id = 77,
          .transmissions = 2,
          .payload = {1}}));
  one.on_frame_start(Time{5ns}, data);
  one.on_sinr(12.5);
  one.on_reception(Time{6ns}, data, AgentId{2}, Verdict::kDelivered, -60);
  one.on_reception(Time{6ns}, data, AgentId{3}, Verdict::kPreambleMissed, -70);
  EXPECT_EQ(asked("SELECT packet || ' ' || sender || '/' || message FROM frames"), "data 3/77");
  EXPECT_EQ(asked("SELECT duration_ns || ' ' || rate_bps FROM frames"), "314000 2000000");
  EXPECT_EQ(asked("SELECT group_concat(agent || ' ' || IFNULL(sinr_db, 'none')) FROM frame_ends"),
            "2 12.5,3 none");
}

TEST_F(ViewRecordTest, AFrameNamesTheProtocolsOfAProgramsPacketAndHasAHashOfItsBytes) {
  Recorder& one = record({.frames = sim::scenario::Detail::kAll});
  sim::radio::Frame arp = frame(1), other = frame(2), ack = frame(3), routed = frame(4);
  arp.ethertype = sim::air::kEthertypeArp;
  arp.payload = std::make_shared<const hal::Bytes>(hal::Bytes{1, 2});
  other.ethertype = arp.ethertype;
  other.payload = std::make_shared<const hal::Bytes>(hal::Bytes{1, 3});
  ack.type = sim::radio::FrameType::kAck;
  routed.ethertype = sim::radio::kEthertypeRouting;
  routed.payload = arp.payload;
  for (const sim::radio::Frame* sent : {&arp, &other, &ack, &routed})
    one.on_frame_start(Time{5ns}, *sent);
  EXPECT_EQ(asked("SELECT group_concat(IFNULL(protocol, '-')) FROM frames"), "ARP,ARP,-,-");
  EXPECT_EQ(asked("SELECT COUNT(DISTINCT payload_hash) || COUNT(payload_hash) FROM frames"), "23");
}

// 5000 rows are those of 2500 frames that end at one radio each; the second after begins anew.
TEST_F(ViewRecordTest, ASampleIsTheBeginOfEachSecondWholeFrameByFrame) {
  Recorder& one = record({.frames = sim::scenario::Detail::kSample});
  std::uint64_t id = 0;
  for (const Time second : {Time{}, Time{1s}}) {
    for (int i = 0; i < 3000; ++i) {
      const sim::radio::Frame sent = frame(++id);
      one.on_frame_start(second + i * 100us, sent);
      one.on_reception(second + i * 100us + 50us, sent, AgentId{2}, Verdict::kDelivered, -60);
    }
  }
  static_assert(FrameLog::kRowsOfSecond == 5000);
  EXPECT_EQ(asked("SELECT COUNT(*) || ' ' || SUM(at_ns < 1000000000) FROM frames"), "5000 2500");
  EXPECT_EQ(asked("SELECT COUNT(*) FROM frame_ends e JOIN frames f USING (frame)"), "5000");
  EXPECT_EQ(asked("SELECT MAX(at_ns) FROM frames WHERE at_ns < 1000000000"), "249900000");
  EXPECT_EQ(asked("SELECT COUNT(*) FROM frame_ends"), "5000");
  EXPECT_EQ(asked("SELECT SUM(count) FROM frames_sent"), "6000");
}

// It is still in the air when another frame begins in the next second.
TEST_F(ViewRecordTest, TheEndsOfAFrameThatIsLeftOutAreLeftOutInTheNextSecondToo) {
  Recorder& one = record({.frames = sim::scenario::Detail::kSample});
  std::uint64_t id = 0;
  for (std::uint64_t i = 0; i < FrameLog::kRowsOfSecond; ++i) one.on_frame_start({}, frame(++id));
  const sim::radio::Frame left_out = frame(++id), next = frame(++id);
  one.on_frame_start(Time{999'900us}, left_out);
  one.on_frame_start(Time{1s}, next);
  one.on_reception(Time{1s + 100us}, left_out, AgentId{2}, Verdict::kDelivered, -60);
  one.on_reception(Time{1s + 200us}, next, AgentId{2}, Verdict::kDelivered, -60);
  EXPECT_EQ(asked("SELECT COUNT(*) FROM frames"), "5001");
  EXPECT_EQ(asked("SELECT group_concat(frame) FROM frame_ends"), fmt::format("{}", next.id));
}

// Equation 1 of the paper by hand: r = 1/hops with weight 1, beta 2; H where the next hop is the
// end.
TEST_F(ViewRecordTest, ARouteHasItsWeightInEquationOne) {
  Recorder& one = record({.routes = sim::scenario::Detail::kAll});
  const hal::Route far{"help", AgentId{3}, AgentId{2}, {.hops = 4, .delay = 5ms, .energy = 1e-3}};
  hal::Route direct = far;
  direct.next_hop = AgentId{3};
  one.on_route_change(Time{1s}, AgentId{1}, {far, false});
  one.on_route_change(Time{2s}, AgentId{1}, {direct, false});
  one.on_route_change(Time{3s}, AgentId{1}, {far, true});
  EXPECT_EQ(asked("SELECT weight || ' ' || hops || ' ' || delay_ns FROM routes WHERE at_ns = 1e9"),
            "0.0625 4 5000000");
  EXPECT_EQ(asked("SELECT weight FROM routes WHERE at_ns = 2e9"), "1000000000000.0");
  EXPECT_EQ(asked("SELECT IFNULL(weight, 'gone') || IFNULL(hops, 'gone') FROM routes"
                  " WHERE at_ns = 3e9"),
            "gonegone");
}

TEST_F(ViewRecordTest, NothingOfRoutesAndReadingsIsKeptUnasked) {
  Recorder& one = record({});
  one.on_route_change(Time{1s}, AgentId{1}, {{"help", AgentId{3}, AgentId{2}, {}}, false});
  EXPECT_FALSE(one.observes_readings());
  EXPECT_EQ(asked("SELECT COUNT(*) FROM routes"), "0");
}

TEST_F(ViewRecordTest, AReadingIsWrittenWhenItChangesAndNotMoreOftenThanAsked) {
  Recorder& one = record({.pose_period = 100ms, .readings = sim::scenario::Detail::kSample});
  hal::Channel infrared;
  infrared.name = "infrared";
  infrared.kind = "range";
  infrared.length = 2;
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  const auto reads = [&](Time at, double first) {
    const double values[] = {first, nothing};
    one.on_reading(at, AgentId{3}, infrared, values);
  };
  reads(Time{}, 0.25);
  reads(Time{50ms}, 0.5);  // within the period
  reads(Time{100ms}, 0.25);
  reads(Time{200ms}, 0.125);
  EXPECT_EQ(asked("SELECT group_concat(at_ns || ': ' || reading) FROM readings"),
            "0: 0.25 -,200000000: 0.125 -");
}

TEST_F(ViewRecordTest, OfManyValuesOrVoltagesNothingIsKeptButWithAll) {
  hal::Channel channel;
  channel.kind = "voltage";
  channel.length = 2;
  EXPECT_FALSE(record({.readings = sim::scenario::Detail::kSample}).observes(AgentId{3}, channel));
  channel.kind = "scan";
  channel.length = 33;
  EXPECT_FALSE(recorder->observes(AgentId{3}, channel));
  channel.length = 32;
  EXPECT_TRUE(recorder->observes(AgentId{3}, channel));
  channel.kind = "odometry";
  EXPECT_TRUE(record({.readings = sim::scenario::Detail::kAll}).observes(AgentId{3}, channel));
}

// Two steps at the wall, one away from it, one at a body: each touch once.
TEST_F(ViewRecordTest, QueuesAndContactsAreWrittenWhenTheyChange) {
  std::uint64_t queue = 0;
  sim::agents::ContactCounts contacts;
  NewDatabase database(folder.file());
  database.execute("BEGIN");
  Commits commits(database);
  LookLog looks(database, {.period = 100ms, .queues = true}, commits);
  looks.look_at([&](AgentId) { return queue; });
  BodyLog bodies(database, 1s, commits);
  bodies.look_at([&](AgentId) { return contacts; });
  queue = 3;
  for (const hal::Duration at : {1ms, 2ms}) {
    looks.on_request_end(Time{at}, AgentId{1}, AgentId{2}, hal::Verdict::kDelivered);
  }
  for (const auto& [at, wall, body] : {std::tuple{1, 5, 0}, {2, 9, 0}, {3, 9, 0}, {4, 12, 1}}) {
    contacts = {.wall_steps = static_cast<std::uint64_t>(wall),
                .object_steps = static_cast<std::uint64_t>(body)};
    bodies.on_body(Time{std::chrono::seconds{at}}, AgentId{3}, {.x = 1.0 * at});
  }
  commits.commit();
  EXPECT_EQ(ask(folder.file(), "SELECT agent || ' ' || at_ns || ' ' || frames FROM queues"),
            "1 1000000 3");
  EXPECT_EQ(ask(folder.file(), "SELECT group_concat((at_ns / 1000000000) || other) FROM contacts"),
            "1wall,4wall,4body");
}

}  // namespace
}  // namespace results::record::test
