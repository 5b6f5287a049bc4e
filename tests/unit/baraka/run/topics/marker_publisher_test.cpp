#include "baraka/run/topics/marker_publisher.h"

#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <thread>

#include "gateway/inspection/topic_browser.h"
#include "gateway/process/domains.h"
#include "tests/support/test_domain.h"
#include "tests/unit/results/record/test_run.h"

namespace baraka::run::topics::test {
namespace {

using namespace std::chrono_literals;

bool comes_true(const std::function<bool()>& condition) {
  const auto end = std::chrono::steady_clock::now() + 10s;
  while (std::chrono::steady_clock::now() < end) {
    if (condition()) return true;
    std::this_thread::sleep_for(5ms);
  }
  return false;
}

/// Two motes, a robot and a wall.
class MarkerPublisherTest : public testing::Test {
 protected:
  void SetUp() override { markers_.start(inside_); }

  /// All agents at one instant; the robot drives.
  void pass(std::chrono::milliseconds at) {
    for (const std::uint16_t agent : {std::uint16_t{1}, std::uint16_t{2}}) {
      markers_.on_body(hal::Time{at}, hal::AgentId{agent}, {static_cast<double>(agent), 0, 0});
    }
    markers_.on_body(hal::Time{at}, hal::AgentId{3}, {static_cast<double>(at.count()), 0, 0});
  }

  std::unique_ptr<gateway::inspection::TopicSubscription> subscribe() {
    std::unique_ptr<gateway::inspection::TopicSubscription> subscription;
    comes_true([&] {
      for (const auto& topic : browser_.topics()) {
        if (topic.name == "rt/markers") subscription = browser_.subscribe(topic);
      }
      return subscription != nullptr;
    });
    return subscription;
  }

  static std::string text_of(const gateway::inspection::RawSample& sample) {
    return gateway::inspection::to_yaml("visualization_msgs::msg::dds_::MarkerArray_", sample.bytes)
        .value_or("not decoded");
  }
  static bool shows(const std::string& text, const std::string& name) {
    return text.find("ns: \"" + name + "\"") != std::string::npos;
  }

  gateway::process::DomainHold hold_ = gateway::process::take_domain(test_domain());
  gateway::inspection::InspectionParticipant inside_{{.domain = hold_.domain()}};
  gateway::inspection::TopicBrowser browser_{hold_.domain()};
  MarkerPublisher markers_{results::record::test::small_config()};
};

TEST_F(MarkerPublisherTest, NothingIsWrittenWhileNobodyReads) {
  for (auto at = 0ms; at <= 500ms; at += 10ms) pass(at);
  const auto reader = subscribe();  // it would be given what was written before
  ASSERT_TRUE(reader && comes_true([&] { return reader->writers() == 1; }));
  EXPECT_FALSE(reader->next(300ms));
}

// An instant is shown when the next one begins: at most every 100 ms, what moved since; everything
// first and once a second.
TEST_F(MarkerPublisherTest, WhatMovedIsShownTenTimesASecondAndEverythingOnce) {
  const auto reader = subscribe();
  ASSERT_TRUE(reader && comes_true([&] { return reader->writers() == 1; }));
  std::vector<std::string> seen;
  auto at = 5000ms;
  ASSERT_TRUE(comes_true([&] {  // The writer knows of its reader a moment later.
    at += 100ms;
    pass(at);
    pass(at + 10ms);
    if (const auto sample = reader->next(500ms)) seen.push_back(text_of(*sample));
    return !seen.empty();
  }));
  const auto first = at;
  for (at += 20ms; at <= first + 1010ms; at += 10ms) pass(at);
  while (const auto sample = reader->next(300ms)) seen.push_back(text_of(*sample));
  ASSERT_EQ(seen.size(), 11u) << "at first, and then every 100 ms for a second";
  for (std::size_t i = 0; i < seen.size(); ++i) {
    EXPECT_TRUE(shows(seen[i], "r0")) << i;
    for (const char* const name : {"walls/fence", "m0", "m1"}) {
      EXPECT_EQ(shows(seen[i], name), i == 0 || i == 10) << i << ' ' << name;
    }
  }
}

}  // namespace
}  // namespace baraka::run::topics::test
