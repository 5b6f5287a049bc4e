#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <thread>
#include <utility>

#include "gateway/guard/guarded_type.h"
#include "gateway/inspection/air_inspector.h"
#include "gateway/inspection/emergency_stop_reader.h"
#include "gateway/inspection/inspection_endpoints.h"
#include "gateway/inspection/inspector.h"
#include "gateway/inspection/marker_inspector.h"
#include "gateway/inspection/pose_reader.h"
#include "gateway/inspection/topic_browser.h"
#include "gateway/inspection/twist_reader.h"
#include "gateway/process/domains.h"
#include "idl/ros/values.h"
#include "inspectPubSubTypes.h"
#include "tests/support/test_domain.h"

namespace gateway::inspection {
namespace {

using namespace std::chrono_literals;
using geometry_msgs::msg::dds_::PoseStamped_PubSubType;
using geometry_msgs::msg::dds_::Quaternion_;
using geometry_msgs::msg::dds_::Twist_PubSubType;
using std_msgs::msg::dds_::Bool_PubSubType;

bool holds_soon(const std::function<bool()>& condition, hal::Duration within = 10s) {
  const auto end = std::chrono::steady_clock::now() + within;
  while (std::chrono::steady_clock::now() < end) {
    if (condition()) return true;
    std::this_thread::sleep_for(5ms);
  }
  return false;
}

/// Two participants in a domain that nobody else uses.
class Inspection : public testing::Test {
 protected:
  template <class PubSub>
  std::unique_ptr<InspectionWriter<PubSub>> writer(const std::string& topic,
                                                   Keep keep = Keep::kForThoseHere) {
    return std::make_unique<InspectionWriter<PubSub>>(outside_.participant(), topic, 10, readers_,
                                                      keep);
  }

  process::DomainHold hold_ = process::take_domain(test_domain());
  InspectionParticipant inside_{{.domain = hold_.domain()}};
  InspectionParticipant outside_{{.domain = hold_.domain()}};
  std::atomic<int> readers_{0};
};

TEST_F(Inspection, APoseReaderGivesTheLastGoodPose) {
  std::atomic<int> calls{0};
  PoseReader reader(inside_, "/mocap/r0", [&](const OutsidePose&) { ++calls; });
  auto poses = writer<PoseStamped_PubSubType>("rt/mocap/r0");
  ASSERT_TRUE(holds_soon([&] { return poses->has_readers() && reader.writers() == 1; }));
  EXPECT_FALSE(reader.last());
  auto& sample = poses->sample();
  sample.header().frame_id("map");
  sample.header().stamp().sec(12);
  sample.header().stamp().nanosec(500'000'000);
  sample.pose().position().x(1.5);
  sample.pose().position().y(-2);
  sample.pose().position().z(0.3);
  sample.pose().orientation(idl::ros::to_quaternion(2.5));
  poses->write();
  ASSERT_TRUE(holds_soon([&] { return reader.last().has_value(); }));
  EXPECT_EQ(reader.last()->pose.x, 1.5);
  EXPECT_EQ(reader.last()->pose.y, -2);
  EXPECT_NEAR(reader.last()->pose.theta, 2.5, 1e-15);
  EXPECT_EQ(reader.last()->frame, "map");
  EXPECT_EQ(reader.last()->sender_time_ns, 12'500'000'000);

  sample.pose().position().x(std::numeric_limits<double>::quiet_NaN());
  poses->write();
  sample.pose().position().x(7);
  sample.pose().orientation(Quaternion_());  // no rotation
  poses->write();
  ASSERT_TRUE(holds_soon([&] { return reader.dropped() == 2; }));
  EXPECT_EQ(reader.last()->pose.x, 1.5);
  EXPECT_EQ(calls, 1);
}

TEST_F(Inspection, ATwistReaderNumbersCommandsAndDropsWhatIsNotFinite) {
  TwistReader reader(inside_, "r0");
  auto twists = writer<Twist_PubSubType>("rt/r0/cmd_vel");
  ASSERT_TRUE(holds_soon([&] { return twists->has_readers() && reader.writers() == 1; }));
  twists->sample().linear().x(0.4);
  twists->sample().linear().y(-0.1);
  twists->sample().angular().z(0.9);
  for (std::uint64_t number = 1; number <= 2; ++number) {
    twists->write();
    ASSERT_TRUE(holds_soon([&] { return reader.last() && reader.last()->number == number; }));
    EXPECT_EQ(reader.last()->twist, (hal::Twist2{0.4, -0.1, 0.9}));
  }
  twists->sample().linear().z(std::numeric_limits<double>::infinity());
  twists->write();
  ASSERT_TRUE(holds_soon([&] { return reader.dropped() == 1; }));
  EXPECT_EQ(reader.last()->number, 2u);
}

TEST_F(Inspection, AnEmergencyStopReachesARobotThatStartsLater) {
  auto stop = writer<Bool_PubSubType>("rt/r0/emergency_stop", Keep::kForLatecomers);
  stop->sample().data(true);
  stop->write();
  EmergencyStopReader reader(inside_, "r0");
  EXPECT_TRUE(holds_soon([&] { return reader.is_stopped(); }));
}

TEST_F(Inspection, AnEmergencyStopIsHeardFromWritersThatKeepNothingAndIsReleasedAgain) {
  EmergencyStopReader reader(inside_, "r0");
  auto stop = writer<Bool_PubSubType>("rt/r0/emergency_stop");
  ASSERT_TRUE(holds_soon([&] { return stop->has_readers() && reader.writers() == 1; }));
  EXPECT_FALSE(reader.is_stopped());
  for (const bool stopped : {true, false}) {
    stop->sample().data(stopped);
    stop->write();
    EXPECT_TRUE(holds_soon([&] { return reader.is_stopped() == stopped; }));
  }
}

TEST_F(Inspection, WhoDidNotPullTheEmergencyStopCannotReleaseItWhileWhoDidIsThere) {
  EmergencyStopReader reader(inside_, "r0");
  auto button = writer<Bool_PubSubType>("rt/r0/emergency_stop", Keep::kForLatecomers);
  InspectionParticipant elsewhere{{.domain = hold_.domain()}};
  auto panel = std::make_unique<InspectionWriter<Bool_PubSubType>>(
      elsewhere.participant(), "rt/r0/emergency_stop", 10, readers_, Keep::kForLatecomers);
  ASSERT_TRUE(holds_soon([&] { return reader.writers() == 2; }));
  button->sample().data(true);
  button->write();
  ASSERT_TRUE(holds_soon([&] { return reader.is_stopped(); }));
  panel->write();  // false
  EXPECT_FALSE(holds_soon([&] { return !reader.is_stopped(); }, 300ms));
  button.reset();
  ASSERT_TRUE(holds_soon([&] { return reader.writers() == 1; }));
  EXPECT_TRUE(reader.is_stopped()) << "gone, not released";
  panel->write();
  EXPECT_TRUE(holds_soon([&] { return !reader.is_stopped(); }));
}

TEST_F(Inspection, AnEmergencyStopOfAnybodyCanBeReleasedHere) {
  EmergencyStopReader reader(inside_, "r0");
  auto button = writer<Bool_PubSubType>("rt/r0/emergency_stop");
  ASSERT_TRUE(holds_soon([&] { return button->has_readers() && reader.writers() == 1; }));
  button->sample().data(true);
  button->write();
  ASSERT_TRUE(holds_soon([&] { return reader.is_stopped(); }));
  reader.release();
  EXPECT_FALSE(reader.is_stopped());
}

TEST(GuardedType, DropsWhatFastCdrThrowsAt) {
  guard::GuardedType<Bool_PubSubType> type;
  std_msgs::msg::dds_::Bool_ value;
  for (const auto& [byte, is_good] : {std::pair{0, true}, {1, true}, {2, false}}) {
    guard::rtps::SerializedPayload_t payload(5);
    // CDR_LE; after that a boolean, which is 0 or 1 (OMG CORBA 3.0, 15.3.1.5).
    const std::array<std::uint8_t, 5> bytes{0, 1, 0, 0, static_cast<std::uint8_t>(byte)};
    std::ranges::copy(bytes, payload.data);
    payload.length = 5;
    EXPECT_EQ(type.deserialize(&payload, &value), is_good) << byte;
  }
}

/// Waits for a topic of the inspector and subscribes to it.
std::unique_ptr<TopicSubscription> subscribe(TopicBrowser& browser, const std::string& name) {
  std::unique_ptr<TopicSubscription> subscription;
  const bool found = holds_soon([&] {
    for (const SeenTopic& topic : browser.topics()) {
      if (topic.name == name) subscription = browser.subscribe(topic);
    }
    return subscription != nullptr;
  });
  EXPECT_TRUE(found) << name;
  return subscription;
}

TEST_F(Inspection, WhatNobodyReadsIsNotCountedAsRead) {
  Inspector inspector(inside_, {{.name = "r0", .start = std::nullopt, .ranges = {}}});
  EXPECT_FALSE(inspector.has_readers());
  TopicBrowser browser(hold_.domain());
  auto odometry = subscribe(browser, "rt/r0/odom");
  EXPECT_TRUE(holds_soon([&] { return inspector.has_readers(Inspector::Topic::kOdometry); }));
  EXPECT_TRUE(inspector.has_readers());
  EXPECT_FALSE(inspector.has_readers(Inspector::Topic::kClock));
  odometry.reset();
  EXPECT_TRUE(holds_soon([&] { return !inspector.has_readers(); }));
}

TEST_F(Inspection, AMessagesFateIsShownWithAllItsMembers) {
  Inspector inspector(inside_, {});
  TopicBrowser browser(hold_.domain());
  const auto fates = subscribe(browser, "rt/baraka/message_fates");
  ASSERT_TRUE(holds_soon(
      [&] { return inspector.has_readers(Inspector::Topic::kFates) && fates->writers() == 1; }));
  inspector.publish_fate(hal::time_from_ns(1'500'000'000), {.sender = "m1",
                                                            .id = 7,
                                                            .node = "m2",
                                                            .fate = std::nullopt,
                                                            .verdict = hal::Verdict::kRetryLimit});
  const auto sample = fates->next(10s);
  ASSERT_TRUE(sample);
  EXPECT_EQ(to_yaml("baraka_msgs::msg::dds_::MessageFate_", sample->bytes),
            "stamp:\n  sec: 1\n  nanosec: 500000000\nsender: \"m1\"\nid: 7\nnode: \"m2\"\n"
            "fate: \"\"\nverdict: \"retry limit\"\n");
}

TEST_F(Inspection, WhatTheAirIsUsedForIsShownWithAllItsMembers) {
  AirInspector inspector(inside_);
  EXPECT_FALSE(inspector.has_readers());
  TopicBrowser browser(hold_.domain());
  const auto topics = subscribe(browser, "rt/baraka/air_topics");
  const auto kinds = subscribe(browser, "rt/baraka/air_kinds");
  ASSERT_TRUE(holds_soon(
      [&] { return inspector.readers() == 2 && topics->writers() == 1 && kinds->writers() == 1; }));
  inspector.publish(hal::time_from_ns(1'500'000'000), AirInspector::TopicUse{.topic = "scan",
                                                                             .samples = 9,
                                                                             .delivered = 8,
                                                                             .first_try = 6,
                                                                             .latency_median = 2ms,
                                                                             .latency_p99 = 30ms,
                                                                             .airtime = 1250ms,
                                                                             .share = 0.25});
  inspector.publish(hal::time_from_ns(2'000'000'000),
                    AirInspector::KindUse{.purpose = "network",
                                          .kind = "UDP",
                                          .port = 5201,
                                          .frames = 7,
                                          .retries = 3,
                                          .submessages = 6,
                                          .bits = 1'000'000'000'000,
                                          .airtime = 1s,
                                          .share = 0.5});
  const auto topic = topics->next(10s);
  const auto kind = kinds->next(10s);
  ASSERT_TRUE(topic && kind);
  EXPECT_EQ(
      to_yaml("baraka_msgs::msg::dds_::AirTopic_", topic->bytes),
      "stamp:\n  sec: 1\n  nanosec: 500000000\ntopic: \"scan\"\nsamples: 9\ndelivered: 8\n"
      "first_try: 6\nrepaired: 2\nlatency_median:\n  sec: 0\n  nanosec: 2000000\n"
      "latency_p99:\n  sec: 0\n  nanosec: 30000000\nairtime:\n  sec: 1\n  nanosec: 250000000\n"
      "share: 0.25\n");
  EXPECT_EQ(to_yaml("baraka_msgs::msg::dds_::AirKind_", kind->bytes),
            "stamp:\n  sec: 2\n  nanosec: 0\npurpose: \"network\"\nkind: \"UDP\"\nport: 5201\n"
            "frames: 7\nretries: 3\nsubmessages: 6\nbits: 1000000000000\nairtime:\n  sec: 1\n"
            "  nanosec: 0\nshare: 0.5\n");
}

TEST_F(Inspection, ARangeBeyondReachIsInfinite) {
  InspectedRange first, second;
  first.name = "ir_0";
  second.name = "ir_1";
  Inspector inspector(inside_,
                      {{.name = "r0", .start = hal::Pose2{1, 2, 0}, .ranges = {first, second}}});
  TopicBrowser browser(hold_.domain());
  const auto ranges = subscribe(browser, "rt/r0/range");
  ASSERT_TRUE(holds_soon(
      [&] { return inspector.has_readers(Inspector::Topic::kRange) && ranges->writers() == 1; }));
  const std::vector<double> metres{0.5, std::numeric_limits<double>::quiet_NaN(), 9};
  inspector.publish_ranges(hal::Time{}, 0, metres);
  for (const char* const expected : {"range: 0.5\n", "range: .inf\n"}) {
    const auto sample = ranges->next(10s);
    ASSERT_TRUE(sample);
    const auto text = to_yaml("sensor_msgs::msg::dds_::Range_", sample->bytes);
    ASSERT_TRUE(text);
    EXPECT_TRUE(text->ends_with(expected)) << *text;
  }
  EXPECT_FALSE(ranges->next(50ms)) << "there are two sensors";
}

TEST_F(Inspection, AMarkerStandsWhereItsBodyTurnedItAndIsKeptForLateReaders) {
  MarkerInspector inspector(inside_);
  inspector.publish();  // nothing was added
  const hal::DrawnBody robot{
      "r0", hal::DrawnAs::kRobot, {{.size = {1, 2, 3}, .centre = {0.5, 0, 0.25}}}};
  inspector.add(hal::time_from_ns(1'500'000'000), robot, {1, 2, std::acos(0.0)});
  inspector.publish();
  TopicBrowser browser(hold_.domain());
  const auto markers = subscribe(browser, "rt/markers");
  EXPECT_TRUE(holds_soon([&] { return inspector.readers() == 1; }));
  const auto sample = markers->next(10s);
  ASSERT_TRUE(sample);
  visualization_msgs::msg::dds_::MarkerArray_PubSubType type;
  visualization_msgs::msg::dds_::MarkerArray_ value;
  guard::rtps::SerializedPayload_t payload(static_cast<std::uint32_t>(sample->bytes.size()));
  std::ranges::copy(sample->bytes, payload.data);
  payload.length = payload.max_size;
  ASSERT_TRUE(type.deserialize(&payload, &value));
  ASSERT_EQ(value.markers().size(), 1u);
  const auto& marker = value.markers().front();
  EXPECT_EQ(marker.ns(), "r0");
  EXPECT_EQ(marker.type(), 1) << "a cube";
  EXPECT_NEAR(marker.pose().position().x(), 1, 1e-15);
  EXPECT_NEAR(marker.pose().position().y(), 2.5, 1e-15);
  EXPECT_EQ(marker.pose().position().z(), 0.25);
  EXPECT_NEAR(idl::ros::heading_of(marker.pose().orientation()), std::acos(0.0), 1e-15);
  EXPECT_EQ(marker.scale().z(), 3);
  EXPECT_EQ(marker.color().a(), 1);
  const auto text = to_yaml("visualization_msgs::msg::dds_::MarkerArray_", sample->bytes);
  ASSERT_TRUE(text);
  EXPECT_TRUE(
      text->starts_with("markers:\n  - header:\n      stamp:\n        sec: 1\n"
                        "        nanosec: 500000000\n      frame_id: \"world\"\n"
                        "    ns: \"r0\"\n    id: 0\n    type: 1\n    action: 0\n"))
      << *text;
  EXPECT_TRUE(
      text->ends_with("    mesh_file:\n      filename: \"\"\n      data: []\n"
                      "    mesh_use_embedded_materials: false\n"))
      << *text;
}

TEST(TopicText, BytesThatAreNoValueOfTheTypeAreNotDecoded) {
  const std::string type = "tf2_msgs::msg::dds_::TFMessage_";
  EXPECT_EQ(to_yaml(type, {0, 1, 0, 0, 0, 0, 0, 0}), "transforms:\n");
  EXPECT_EQ(to_yaml(type, {0, 1, 0, 0, 1, 0, 0, 0}), std::nullopt) << "one transform, but none";
  EXPECT_EQ(to_yaml(type, {0, 1, 0, 0, 255, 255, 255, 255}), std::nullopt);
  EXPECT_EQ(to_yaml(type, {}), std::nullopt);
  EXPECT_EQ(to_yaml("std_msgs::msg::dds_::String_", {0, 1, 0, 0}), std::nullopt) << "unknown type";
}

}  // namespace
}  // namespace gateway::inspection
