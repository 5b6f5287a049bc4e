#include "hal/files/recording/offered_qos.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>

namespace hal::files::recording {
namespace {

using namespace std::chrono_literals;
using Reliability = TopicQos::Reliability;
using Durability = TopicQos::Durability;

TEST(OfferedQos, IsNoneWithoutAProfile) {
  EXPECT_FALSE(read_offered_qos(""));
  EXPECT_FALSE(read_offered_qos("[]"));
}

TEST(OfferedQos, IsTheSameInNumbersAndWords) {
  const auto numbers = read_offered_qos(
      "- history: 1\n  depth: 7\n  reliability: 2\n  durability: 1\n  deadline:\n    sec: 1\n"
      "    nsec: 500000000\n");
  const auto words = read_offered_qos(
      "- {history: keep_last, depth: 7, reliability: best_effort, durability: transient_local, "
      "deadline: {sec: 1, nsec: 500000000}}");
  ASSERT_TRUE(numbers && words);
  EXPECT_EQ(numbers->qos, words->qos);
  EXPECT_EQ(numbers->qos,
            (TopicQos{Reliability::kBestEffort, Durability::kTransientLocal, 7, 1500ms}));
  EXPECT_TRUE(numbers->tells_depth);
}

TEST(OfferedQos, HasNoDeadlineThatIsInfiniteOrZero) {
  for (const char* deadline : {"{sec: 2147483647, nsec: 4294967295}", "{sec: 0, nsec: 0}",
                               "{sec: 9223372036, nsec: 854775807}"}) {
    const auto offered = read_offered_qos(std::string("- deadline: ") + deadline);
    ASSERT_TRUE(offered);
    EXPECT_FALSE(offered->qos.deadline) << deadline;
  }
}

TEST(OfferedQos, TellsADepthOnlyIfItIsThere) {
  EXPECT_FALSE(read_offered_qos("- history: 3\n  depth: 0\n")->tells_depth);
  EXPECT_EQ(read_offered_qos("- history: 3\n  depth: 0\n")->qos.depth, 10U);
  EXPECT_TRUE(read_offered_qos("- history: 2\n  depth: 0\n")->tells_depth);
  EXPECT_FALSE(read_offered_qos("- history: keep_all\n  depth: 9\n")->qos.depth);
}

TEST(OfferedQos, OfSeveralPublishersIsTheFirstButReliableAndTransientLocalWin) {
  const auto offered = read_offered_qos(
      "- {depth: 3, reliability: 2, durability: 2}\n- {depth: 9, reliability: 1, durability: 1}\n");
  EXPECT_EQ(offered->qos,
            (TopicQos{Reliability::kReliable, Durability::kTransientLocal, 3, std::nullopt}));
}

TEST(OfferedQos, RefusesWhatIsNoSuchList) {
  const auto said = [](const char* text) -> std::string {
    try {
      read_offered_qos(text);
    } catch (const std::runtime_error& e) {
      return e.what();
    }
    return {};
  };
  EXPECT_EQ(said("reliable"), "offered_qos_profiles: it is 'reliable'");
  EXPECT_EQ(said("- 5"), "offered_qos_profiles: a profile is '5'");
  EXPECT_EQ(said("- reliability: loud"), "offered_qos_profiles: reliability is 'loud'");
  EXPECT_EQ(said("- reliability: 9"), "offered_qos_profiles: reliability is '9'");
  EXPECT_EQ(said("- depth: -1"), "offered_qos_profiles: depth is '-1'");
  EXPECT_EQ(said("- depth: 99999999999"), "offered_qos_profiles: a depth is 99999999999");
  EXPECT_EQ(said("- deadline: {sec: x}"), "offered_qos_profiles: sec is 'x'");
  EXPECT_NE(said("- {history: 1"), "");
}

}  // namespace
}  // namespace hal::files::recording
