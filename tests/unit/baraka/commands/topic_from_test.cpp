#include "baraka/commands/topic_from.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <string>

#include "hal/files/config/yaml.h"

namespace baraka::commands {
namespace {

using namespace std::chrono_literals;
using hal::TopicQos;
using hal::files::recording::RecordedTopic;
using hal::files::recording::Recording;
using testing::HasSubstr;
using Node = hal::files::config::Node;

Recording some_recording() {
  RecordedTopic scan{
      "rt/scan",
      "sensor_msgs/msg/LaserScan",
      TopicQos{TopicQos::Reliability::kBestEffort, TopicQos::Durability::kVolatile, 5, 200ms},
      {}};
  for (int i = 0; i < 30; ++i) scan.samples.push_back({i * 100ms, 2000});
  const RecordedTopic once{"rt/it's", "", std::nullopt, {{0ms, 5}}};
  const RecordedTopic never{"rt/cmd_vel", "geometry_msgs/msg/Twist", TopicQos{}, {}};
  return {2900ms, {scan, once, never}, {{5000, {{0ms, 100}, {1s, 100}}}}, {"one thing\nto know"}};
}

const Node& value(const Node& mapping, const std::string& key) {
  const auto* const entry = mapping.find(key);
  if (entry == nullptr) throw std::runtime_error("no key " + key);
  return entry->value;
}

TEST(RecordingPage, IsYamlWithTheKeysOfTopics) {
  std::vector<hal::files::config::Problem> problems;
  std::size_t values_left = 1000;
  const Node root = hal::files::config::parse_yaml(recording_page(some_recording(), "/bag.mcap"),
                                                   {}, problems, values_left);
  ASSERT_TRUE(problems.empty()) << problems.front().what;
  const Node& topics = value(root, "topics");
  ASSERT_EQ(topics.items.size(), 2U);
  const Node& scan = topics.items[0];
  EXPECT_EQ(value(scan, "name").text, "rt/{agent}/scan");
  EXPECT_EQ(value(scan, "size").text, "2 kB");
  EXPECT_EQ(value(scan, "rate").text, "10 Hz");
  EXPECT_EQ(scan.find("jitter"), nullptr);
  EXPECT_EQ(value(scan, "reliability").text, "best_effort");
  EXPECT_EQ(value(scan, "history").text, "5");
  EXPECT_EQ(value(scan, "durability").text, "volatile");
  EXPECT_EQ(value(scan, "deadline").text, "200 ms");
  EXPECT_EQ(value(scan, "readers").items.size(), 1U);
  // One sample has no rate: the recording itself plays it.
  EXPECT_EQ(value(topics.items[1], "from").text, "/bag.mcap");
  EXPECT_EQ(value(topics.items[1], "name").text, "rt/it's");
}

TEST(RecordingPage, ShowsEachTopicAndFlowWithItsShareOfTheBytes) {
  const std::string page = recording_page(some_recording(), "/bag.mcap");
  EXPECT_THAT(page, testing::StartsWith("# /bag.mcap: 2.900 s\n"));
  EXPECT_THAT(page, testing::ContainsRegex("# rt/scan +sensor_msgs/msg/LaserScan +30 +10 Hz +0 s "
                                           "+2000 +2000 +2000 +99.7 % +best_effort, 5, volatile, "
                                           "deadline 200 ms\n"));
  EXPECT_THAT(page, testing::ContainsRegex("# UDP to port 5000 +- +2 +1 Hz .* 0.3 % +-\n"));
  EXPECT_THAT(page, HasSubstr("# one thing\n# to know\n"));
  EXPECT_THAT(page, HasSubstr("  # rt/cmd_vel, geometry_msgs/msg/Twist: no sample\n"));
}

TEST(RecordingPage, SaysWhereQosIsNotRecorded) {
  Recording recording = some_recording();
  recording.topics[0].qos.reset();
  EXPECT_THAT(recording_page(recording, "b"),
              HasSubstr("    reliability: reliable  # QoS is not recorded\n    history: 10\n"));
}

}  // namespace
}  // namespace baraka::commands
